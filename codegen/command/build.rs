//! Checks that the live page is built where the feature `live` embeds it.

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // A file that does not exist would count as changed in every build.
    if !cfg!(feature = "live") {
        return;
    }
    println!("cargo::rerun-if-changed=live.html");
    if !Path::new("live.html").exists() {
        println!(
            "cargo::error=the feature `live` embeds the live page, which is not built: run `codegen/web/build`"
        );
    }
}
