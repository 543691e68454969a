//! Licenses that the command prints, which are in its packages.
//!
//! `NOTICES_UPDATE=1 cargo test -p linkwright-cli licenses` writes them after a change of dependencies.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::folder::{EXAM, Folder};
use crate::printed::json;

/// Platform whose packages are listed: others have packages of the same authors instead.
const PLATFORM: &str = "x86_64-unknown-linux-gnu";

/// Line of every Apache license, of which one text is enough: its owner is named elsewhere.
const APACHE: &str = "Version 2.0, January 2004";

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Package of another author.
struct Package {
    name: String,
    version: String,
    license: String,
    folder: PathBuf,
}

/// Packages of other authors in the command with all its features, by name.
fn packages() -> Vec<Package> {
    let mut command = Command::new(env!("CARGO"));
    command.args(["metadata", "--format-version=1", "--offline", "--locked"]);
    command.args(["--all-features", "--filter-platform", PLATFORM]);
    let output = command.current_dir(repository()).output().expect("cargo");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let metadata = json(&text);
    let list = |value: &serde_json::Value| value.as_array().cloned().unwrap_or_default();
    let word = |value: &serde_json::Value| value.as_str().unwrap_or_default().to_string();
    let nodes: BTreeMap<String, Vec<serde_json::Value>> = list(&metadata["resolve"]["nodes"])
        .iter()
        .map(|node| (word(&node["id"]), list(&node["deps"])))
        .collect();
    let all = list(&metadata["packages"]);
    let command = all.iter().find(|it| it["name"] == "linkwright-cli");
    let mut open = vec![word(&command.expect("the command")["id"])];
    let mut used = BTreeSet::new();
    while let Some(id) = open.pop() {
        let needed = nodes[&id].iter().filter(|it| {
            let kinds = list(&it["dep_kinds"]);
            kinds.iter().any(|kind| kind["kind"].is_null())
        });
        let needed: Vec<String> = needed.map(|it| word(&it["pkg"])).collect();
        if used.insert(id) {
            open.extend(needed);
        }
    }
    let foreign = all
        .iter()
        .filter(|it| used.contains(&word(&it["id"])) && !it["source"].is_null());
    let mut packages: Vec<Package> = foreign
        .map(|it| Package {
            name: word(&it["name"]),
            version: word(&it["version"]),
            license: word(&it["license"]),
            folder: Path::new(&word(&it["manifest_path"]))
                .parent()
                .expect("a folder")
                .to_path_buf(),
        })
        .collect();
    packages.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    packages
}

/// Texts of licenses in a folder, in the order of the file names.
fn texts(folder: &Path) -> Vec<String> {
    const NAMES: [&str; 7] = [
        "LICENSE",
        "LICENCE",
        "COPYING",
        "COPYRIGHT",
        "NOTICE",
        "OFL",
        "UFL",
    ];
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| {
        let name = path.file_name().and_then(|it| it.to_str());
        let name = name.unwrap_or_default().to_uppercase();
        path.is_file() && NAMES.iter().any(|it| name.starts_with(it))
    });
    paths.sort();
    let read = |path: &PathBuf| std::fs::read_to_string(path).ok();
    let lines = |text: String| {
        let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
        lines.join("\n").trim_matches('\n').to_string()
    };
    paths.iter().filter_map(read).map(lines).collect()
}

/// Notices according to the packages.
fn notices() -> String {
    let packages = packages();
    let mut text = String::from(
        "Linkwright is licensed under the MIT license or the Apache License, Version 2.0, at your choice.\n\
         The command contains the font Ubuntu Light, Copyright 2011 Canonical Ltd., under the Ubuntu font license, and\n\
         what follows of other authors. The package of the font, epaint_default_fonts, has other fonts as well, some of\n\
         them under the SIL Open Font License; their licenses are among the texts below.\n\nPackages:\n",
    );
    let mut notices: BTreeMap<String, (Vec<String>, String)> = BTreeMap::new();
    for package in &packages {
        text += &format!("  {} ({})\n", package.name, package.license);
        let license_texts = texts(&package.folder);
        for license in license_texts
            .into_iter()
            .chain(texts(&package.folder.join("fonts")))
        {
            if license.contains(APACHE) {
                continue;
            }
            // Line breaks differ.
            let key = license.split_whitespace().collect::<Vec<_>>().join(" ");
            let entry = notices.entry(key).or_insert((Vec::new(), license));
            if entry.0.last() != Some(&package.name) {
                entry.0.push(package.name.clone());
            }
        }
    }
    let apache = std::fs::read_to_string(repository().join("LICENSE-APACHE")).expect("a license");
    let of_apache = packages
        .iter()
        .filter(|it| it.license.contains("Apache-2.0"))
        .map(|it| it.name.clone());
    let mut sections: Vec<(Vec<String>, String)> = notices.into_values().collect();
    sections.sort();
    sections.push((of_apache.collect(), apache.trim_matches('\n').to_string()));
    for (mut names, license) in sections {
        names.dedup();
        let rule = "=".repeat(100);
        text += &format!("\n{rule}\n{}\n{rule}\n\n{license}\n", names.join(", "));
    }
    text
}

#[test]
fn the_licenses_of_all_that_the_command_is_built_from_are_printed() {
    let path = repository().join("codegen/command/NOTICES.txt");
    let expected = notices();
    if std::env::var_os("NOTICES_UPDATE").is_some() {
        // What the command prints is the file as it was compiled with.
        std::fs::write(&path, &expected).expect("written");
        return;
    }
    let text = std::fs::read_to_string(&path).expect("the notices");
    let differs = text.lines().zip(expected.lines()).find(|(a, b)| a != b);
    assert!(
        text == expected,
        "{path:?} is of other dependencies, first: {differs:?}\nrun `NOTICES_UPDATE=1 cargo test -p linkwright-cli licenses`"
    );
    for part in [
        "UBUNTU FONT LICENCE Version 1.0",
        "SIL OPEN FONT LICENSE Version 1.1",
        "Copyright 2011 Canonical Ltd.",
        "  nalgebra (",
        "  resvg (",
        "Apache License\n",
    ] {
        assert!(text.contains(part), "{part}");
    }
    // The binary and its package have the same file.
    let packaged = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("NOTICES.txt"));
    assert_eq!(
        packaged.expect("the notices of the binary"),
        text.as_bytes()
    );
    let folder = Folder::new("licenses", EXAM);
    assert_eq!(folder.run("--licenses").exits_with(0).stdout, text);
    folder.run("--licenses solve a.mech").exits_with(2);
    let help = folder.run("").exits_with(2).stderr;
    assert!(help.contains("--licenses"), "{help}");
}
