//! Generates a module for each description in `descriptions/`.

fn main() {
    linkwright_codegen::build("descriptions");
}
