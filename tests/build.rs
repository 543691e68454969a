//! Generates the mechanisms that only tests need, the repository's in single precision, and a list of the latter.

mod registry;

use linkwright_codegen::{Options, Scalar};

fn main() {
    linkwright_codegen::build("descriptions");
    let single = Options {
        scalar: Scalar::F32,
    };
    linkwright_codegen::build_with("../mechanisms", &single);
    registry::write("../mechanisms");
}
