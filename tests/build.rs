//! Generates the mechanisms that only tests need, the repository's in single precision, a list of the latter, and all of them
//! once more with what their drivers transmit, and those with parameters with their sensitivities.

mod registry;
mod sensing;
mod transmitting;

use linkwright_codegen::{Options, Scalar};

fn main() {
    linkwright_codegen::build("descriptions");
    let single = Options {
        scalar: Scalar::F32,
    };
    linkwright_codegen::build_with("../mechanisms", &single);
    registry::write("../mechanisms");
    sensing::write("descriptions");
    transmitting::write(&["descriptions", "../mechanisms"]);
}
