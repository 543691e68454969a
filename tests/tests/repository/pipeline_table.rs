//! The table of the generator's modules in the guide states the first sentence of each module's head.
//!
//! After an intended change, `GUIDE_UPDATE=1 cargo test -p linkwright-tests --test repository` writes the table again.

use std::fs;

use linkwright_tests::files;

use super::rooms::ORDER;

const PAGE: &str = "codegen/guide/theory.md";

const TITLES: &str = "| module | folder | responsibility |\n|---|---|---|\n";

/// Modules beside the pipeline.
const LEFT_OUT: [&str; 2] = ["stages", "lib"];

/// Returns the first sentence of a module's head.
fn first_sentence(text: &str) -> Option<String> {
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    let paragraph: Vec<&str> = lines
        .map(str::trim)
        .take_while(|line| !line.is_empty())
        .collect();
    let paragraph = paragraph.join(" ");
    let end = match paragraph.find(". ") {
        Some(end) => end + 1,
        None => paragraph.len(),
    };
    let sentence = paragraph[..end].to_string();
    sentence.ends_with('.').then_some(sentence)
}

fn table() -> String {
    let mut table = TITLES.to_string();
    for (folder, modules) in ORDER {
        for module in modules.iter().filter(|it| !LEFT_OUT.contains(it)) {
            let root = files::repository().join(folder);
            let candidates = [
                (root.join(module).join("mod.rs"), format!("{module}/")),
                (root.join(format!("{module}.rs")), format!("{module}.rs")),
            ];
            let (file, name) = candidates
                .into_iter()
                .find(|(file, _)| file.is_file())
                .unwrap_or_else(|| panic!("{folder} has no module `{module}`"));
            let text = fs::read_to_string(&file).expect("the module can be read");
            let sentence = first_sentence(&text)
                .unwrap_or_else(|| panic!("{} does not open with a sentence", file.display()));
            table += &format!("| `{name}` | `{folder}/` | {sentence} |\n");
        }
    }
    table
}

#[test]
fn the_guide_states_the_responsibility_of_each_module() {
    let page = files::repository().join(PAGE);
    let text = fs::read_to_string(&page).expect("the guide can be read");
    let start = text.find(TITLES).expect("the guide has the table");
    let end = text[start..].find("\n\n").expect("text follows the table") + start + 1;
    let table = table();
    if text[start..end] == table {
        return;
    }
    if std::env::var_os("GUIDE_UPDATE").is_some() {
        let updated = format!("{}{table}{}", &text[..start], &text[end..]);
        fs::write(&page, updated).expect("the guide can be written");
        return;
    }
    panic!(
        "{PAGE} states\n{}\nthe heads of the modules state\n{table}",
        &text[start..end]
    );
}

#[test]
fn a_sentence_ends_at_its_full_stop() {
    let text = "//! Reads `a.mech` of\n//! a file. More.\n//!\n//! Invariant.\n";
    assert_eq!(
        first_sentence(text).as_deref(),
        Some("Reads `a.mech` of a file.")
    );
    assert_eq!(first_sentence("//! A head without an end\n"), None);
    assert_eq!(first_sentence("use std::fs;\n"), None);
}
