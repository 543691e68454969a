//! Generates the mechanisms that only tests need.

fn main() {
    linkwright_codegen::build("descriptions");
}
