//! Writes a crate with a mechanism, a loop and a test, which builds without changes.
//!
//! The folder of the crate is created with all its files, or not at all; existing files are never touched.

use std::fs;
use std::io;
use std::path::Path;

use linkwright_codegen::stages::files;

use super::{Outcome, Problem, print};
use crate::arguments::New;

/// Files of a crate, each with its template.
const FILES: [(&str, &str); 8] = [
    ("Cargo.toml", include_str!("../template/manifest.toml")),
    ("build.rs", include_str!("../template/build.rs")),
    (
        "descriptions/four_bar.mech",
        include_str!("../template/four_bar.mech"),
    ),
    ("src/lib.rs", include_str!("../template/lib.rs")),
    ("src/main.rs", include_str!("../template/main.rs")),
    ("tests/motion.rs", include_str!("../template/motion.rs")),
    ("README.md", include_str!("../template/readme.md")),
    (".gitignore", include_str!("../template/gitignore")),
];

/// Names that are keywords of Rust, crates of its distribution, or folders of a build.
const TAKEN: [&str; 64] = [
    "abstract",
    "alloc",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "build",
    "const",
    "continue",
    "core",
    "crate",
    "deps",
    "do",
    "dyn",
    "else",
    "enum",
    "examples",
    "extern",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "incremental",
    "let",
    "linkwright",
    "linkwright-codegen",
    "linkwright_codegen",
    "loop",
    "macro",
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "proc-macro",
    "proc_macro",
    "pub",
    "ref",
    "return",
    "self",
    "static",
    "std",
    "struct",
    "super",
    "test",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
];

/// Writes the crate.
///
/// # Errors
/// The name is not a valid crate name, its folder exists, or it cannot be written.
pub fn run(arguments: &New) -> Result<Outcome, Problem> {
    let folder = &arguments.name;
    let name = crate_name(folder)?;
    let [runtime, codegen] = dependencies(arguments.path.as_deref())?;
    let module = name.replace('-', "_");
    let texts = FILES.map(|(path, template)| {
        let text = template.replace("{{crate}}", name);
        let text = text.replace("{{module}}", &module);
        let text = text.replace("{{runtime}}", &runtime);
        (path, text.replace("{{codegen}}", &codegen))
    });
    let mut texts = Vec::from(texts);
    if lies_in_package(folder) {
        texts[0]
            .1
            .push_str("\n# Not a member of the workspace around it.\n[workspace]\n");
    }
    write(folder, &texts)?;
    print(|output| {
        writeln!(output, "wrote the crate `{name}` to {}", folder.display())?;
        writeln!(
            output,
            "run `cargo run` in it, and look at descriptions/four_bar.mech"
        )
    })?;
    Ok(Outcome::Done)
}

/// Returns the last part of the path if it is a valid crate name.
fn crate_name(folder: &Path) -> Result<&str, Problem> {
    let refused = |why: String| {
        let name = folder.display();
        Problem(format!("error: `{name}` is not the name of a crate: {why}"))
    };
    let name = folder
        .file_name()
        .and_then(|it| it.to_str())
        .unwrap_or_default();
    let is_plain = |it: char| it.is_ascii_alphanumeric() || it == '-' || it == '_';
    if !name.starts_with(|it: char| it.is_ascii_alphabetic()) || !name.chars().all(is_plain) {
        let why = "a name starts with a letter and has letters, digits, `-` and `_`";
        return Err(refused(why.to_string()));
    }
    if TAKEN.contains(&name.to_ascii_lowercase().as_str()) {
        return Err(refused(
            "this name has another meaning in Rust, or is that of a crate in use".to_string(),
        ));
    }
    Ok(name)
}

/// Returns the dependencies on the runtime and the generator for the manifest.
fn dependencies(clone: Option<&Path>) -> Result<[String; 2], Problem> {
    let Some(clone) = clone else {
        let version = env!("CARGO_PKG_VERSION");
        return Ok([(); 2].map(|()| format!("\"{version}\"")));
    };
    let refused = |why: &str| {
        Problem(format!(
            "error: `{}` is not a clone of the repository of Linkwright: {why}",
            clone.display()
        ))
    };
    let root = fs::canonicalize(clone).map_err(|error| refused(&files::reason(&error)))?;
    let manifest = |crate_folder: &str| {
        let path = root.join(crate_folder);
        if !path.join("Cargo.toml").is_file() {
            return Err(refused(&format!("it has no `{crate_folder}/Cargo.toml`")));
        }
        let path = path
            .to_str()
            .ok_or_else(|| refused("its path is not UTF-8"))?;
        // Escapes of TOML strings include those that Rust writes here.
        Ok(format!("{{ path = {path:?} }}"))
    };
    Ok([manifest("runtime")?, manifest("codegen")?])
}

/// True if cargo may assign the crate to a surrounding workspace.
fn lies_in_package(folder: &Path) -> bool {
    let parent = fs::canonicalize(files::folder_of(folder));
    parent.is_ok_and(|it| {
        it.ancestors()
            .any(|above| above.join("Cargo.toml").is_file())
    })
}

/// Creates the folder with all files in it, or nothing.
fn write(folder: &Path, texts: &[(&str, String)]) -> Result<(), Problem> {
    let above = files::folder_of(folder);
    files::sweep(above);
    let written = files::make_folder(folder, |inside| {
        texts.iter().try_for_each(|(path, text)| {
            let path = inside.join(path);
            fs::create_dir_all(files::folder_of(&path))?;
            fs::write(path, text)
        })
    });
    written.map_err(|error| {
        let reason = match error.kind() {
            io::ErrorKind::AlreadyExists => "it exists already".to_string(),
            io::ErrorKind::NotFound => "its parent folder does not exist".to_string(),
            _ => files::reason(&error),
        };
        Problem(format!(
            "error: cannot write `{}`: {reason}",
            folder.display()
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_cargo_refuses_are_refused() {
        for name in [
            "",
            "..",
            "/",
            "1arm",
            "-arm",
            "a.b",
            "a b",
            "ärm",
            "fn",
            "Self",
            "test",
            "linkwright",
            "_a",
        ] {
            assert!(crate_name(Path::new(name)).is_err(), "{name}");
        }
        for (path, name) in [
            ("arm", "arm"),
            ("a/b/my-arm_2", "my-arm_2"),
            ("../Arm/", "Arm"),
        ] {
            assert_eq!(crate_name(Path::new(path)), Ok(name));
        }
        assert!(TAKEN.is_sorted());
    }

    #[test]
    fn nothing_is_left_of_what_failed() {
        let folder = std::env::temp_dir().join(format!("linkwright-new-{}", std::process::id()));
        let texts = [("a/b", String::new()), ("a/b/c", String::new())];
        assert!(write(&folder, &texts).is_err());
        assert!(!folder.exists());
    }
}
