//! Generates the mechanisms that only tests need, and the repository's in single precision.

use linkwright_codegen::{Options, Scalar};

fn main() {
    linkwright_codegen::build("descriptions");
    let single = Options {
        scalar: Scalar::F32,
    };
    linkwright_codegen::build_with("../mechanisms", &single);
}
