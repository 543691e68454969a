//! Manual pages.

use crate::folder::{EXAM, Folder};

#[test]
fn every_command_has_a_manual_page() {
    let folder = Folder::new("man", EXAM);
    let help = folder.run("--help").exits_with(0).stdout;
    let listed = help.lines().skip_while(|it| *it != "Commands:").skip(1);
    let listed = listed.take_while(|it| !it.is_empty());
    let mut expected: Vec<String> = listed
        .filter_map(|line| line.split_whitespace().next())
        .filter(|it| *it != "help")
        .map(|name| format!("linkwright-{name}.1"))
        .collect();
    expected.push("linkwright.1".to_string());
    expected.sort();
    let ran = folder.run("man --out pages").exits_with(0);
    assert_eq!(
        ran.stdout,
        format!("wrote {} pages to pages\n", expected.len())
    );
    assert_eq!(folder.list("pages"), expected);
    let page = folder.read("pages/linkwright-generate.1");
    for part in [".TH linkwright-generate 1", "\\-\\-check", "two_body.rs"] {
        assert!(page.contains(part), "{part}");
    }
    // Its own pages are replaced, and no other file is.
    folder.run("man --out pages").exits_with(0);
    std::fs::write(folder.file("pages/linkwright.1"), "mine").expect("written");
    folder.run("man --out pages").exits_with(2);
    assert_eq!(folder.read("pages/linkwright.1"), "mine");
}
