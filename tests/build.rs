//! Generates the mechanisms that only tests need, the repository's and those of the study of stability in single precision, a
//! list of the repository's, and all of them once more with what their drivers transmit.

mod registry;
mod single_study;
mod transmitting;

use linkwright_codegen::{Options, Scalar};

fn main() {
    linkwright_codegen::build("descriptions");
    let single = Options {
        scalar: Scalar::F32,
    };
    linkwright_codegen::build_with("../mechanisms", &single);
    linkwright_codegen::build_with(single_study::write("descriptions"), &single);
    registry::write("../mechanisms");
    transmitting::write(&["descriptions", "../mechanisms"]);
}
