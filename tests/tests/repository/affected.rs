//! The table of tests for changed files, `.ci/affected`, leads from existing files to existing tests.

use std::fs;
use std::path::Path;

use linkwright_tests::files;

/// The rows of the table: a prefix of paths, and tests.
fn rows() -> Vec<(String, Vec<String>)> {
    let table = fs::read_to_string(files::repository().join(".ci/affected")).expect("the table");
    let rows = table.lines().filter(|line| !line.is_empty());
    rows.filter(|line| !line.starts_with('#'))
        .map(|line| {
            let mut words = line.split_whitespace().map(str::to_string);
            (words.next().expect("a path"), words.collect())
        })
        .collect()
}

/// The names in the manifests of the workspace.
fn packages() -> Vec<String> {
    let manifests = files::below(
        &files::repository(),
        "toml",
        &["target", ".git", "node_modules"],
    );
    let names = manifests.iter().filter(|it| it.ends_with("Cargo.toml"));
    names
        .filter_map(|path| {
            let text = fs::read_to_string(path).expect("a manifest");
            let line = text.lines().find(|line| line.starts_with("name = "))?;
            Some(line.split('"').nth(1)?.to_string())
        })
        .collect()
}

/// True if a test is a package, one of its modules, a binary of this package or one of its modules.
fn exists(test: &str, packages: &[String]) -> bool {
    let (name, module) = match test.split_once("::") {
        Some((name, module)) => (name, Some(module)),
        None => (test, None),
    };
    let binary = files::package("tests").join(name);
    let is_there = |folder: &Path, module: &str| {
        folder.join(format!("{module}.rs")).exists() || folder.join(module).is_dir()
    };
    match module {
        None => binary.is_dir() || packages.iter().any(|it| it == name),
        Some(module) if binary.is_dir() => is_there(&binary, module),
        // The only package whose modules of tests are chosen.
        Some(module) if name == "linkwright-cli" => {
            let tests = files::repository().join("codegen/cli/tests");
            let binaries = fs::read_dir(tests).expect("the binaries of the command");
            let folders = binaries.map(|it| it.expect("a folder").path());
            folders.into_iter().any(|it| is_there(&it, module))
        }
        Some(_) => false,
    }
}

#[test]
fn every_row_leads_from_files_to_tests() {
    let packages = packages();
    let rows = rows();
    assert!(rows.len() > 20, "{}", rows.len());
    for (path, tests) in rows {
        assert!(
            files::repository().join(&path).exists(),
            "{path} does not exist"
        );
        assert!(!tests.is_empty(), "{path} has no tests");
        for test in tests {
            assert!(exists(&test, &packages), "{path}: {test} is missing");
        }
    }
}

#[test]
fn every_package_has_a_row() {
    let rows = rows();
    for path in files::below(&files::repository(), "rs", &["target", ".git"]) {
        let path = path
            .strip_prefix(files::repository())
            .expect("a path in the repository");
        let path = path.to_str().expect("a path in UTF-8");
        let is_source = path.contains("/src/") && !path.starts_with("tests/");
        let has_row = rows
            .iter()
            .any(|(prefix, _)| path.starts_with(prefix.as_str()));
        assert!(!is_source || has_row, "{path} has no row in .ci/affected");
    }
}
