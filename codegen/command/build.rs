//! Checks that the live page is built where the feature `live` embeds it.

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=live.html");
    if cfg!(feature = "live") && !Path::new("live.html").exists() {
        println!(
            "cargo::error=the feature `live` embeds the live page, which is not built: run `codegen/web/build`"
        );
    }
}
