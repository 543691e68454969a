//! Lists the public items of each package that users call, so that a change of the list is seen.
//!
//! `PUBLIC_UPDATE=1` writes `tests/public.txt` again. Items that the documentation hides do not count.

mod tree;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;

use linkwright_tests::files;
use tree::{Declared, Module, Package};

/// Packages whose items users call, with their folders.
const PUBLIC_PACKAGES: [(&str, &str); 7] = [
    ("linkwright", "runtime"),
    ("linkwright_math", "runtime/math"),
    ("linkwright_codegen", "codegen"),
    ("linkwright_macros", "codegen/macros"),
    ("linkwright_solver", "codegen/solver"),
    ("linkwright_calibrate", "codegen/calibrate"),
    ("linkwright_editing", "codegen/editing"),
];

/// Packages from which they export items, with their folders.
const INTERNAL_PACKAGES: [(&str, &str); 2] = [
    ("linkwright_description", "codegen/description"),
    ("linkwright_program", "codegen/program"),
];

/// Packages by the names of their crates.
struct Packages(BTreeMap<&'static str, Package>);

/// Path of a module: the name of its crate, and those of the modules in it.
type Place = Vec<String>;

impl Packages {
    fn read() -> Self {
        let all = PUBLIC_PACKAGES.into_iter().chain(INTERNAL_PACKAGES);
        Self(
            all.map(|(name, folder)| {
                let root = files::repository().join(folder).join("src/lib.rs");
                (name, Package::read(&root))
            })
            .collect(),
        )
    }

    fn module(&self, place: &[String]) -> Option<&Module> {
        let (name, path) = place.split_first()?;
        let root = &self.0.get(name.as_str())?.root;
        path.iter()
            .try_fold(root, |module, name| Some(&module.modules.get(name)?.1))
    }

    /// Place of the module, or of the item, to which a path leads from a module.
    fn target(&self, from: &[String], path: &[String]) -> Option<(Place, String)> {
        let (last, modules) = path.split_last()?;
        let mut place = match path.first()?.as_str() {
            "crate" => vec![from.first()?.clone()],
            name if self.0.contains_key(name) => vec![name.to_string()],
            _ => from.to_vec(),
        };
        for name in modules {
            match name.as_str() {
                "crate" | "self" => {}
                "super" => {
                    place.pop();
                }
                name if self.0.contains_key(name) => {}
                name => {
                    let module = self.module(&place)?;
                    if module.modules.contains_key(name) {
                        place.push(name.to_string());
                    } else {
                        let import = module
                            .imports
                            .iter()
                            .find(|it| it.name.as_deref() == Some(name))?;
                        let (mut inner, last) = self.target(&place, &import.path)?;
                        inner.push(last);
                        place = inner;
                    }
                }
            }
        }
        Some((place, last.clone()))
    }

    /// Adds the public items of a module under this path.
    fn list(&self, place: &[String], path: &str, listed: &mut BTreeSet<String>) {
        let Some(module) = self.module(place) else {
            return;
        };
        for name in module.items.keys().chain(module.modules.keys()) {
            let item = module.items.get(name);
            let item = item.or_else(|| Some(&module.modules.get(name)?.0));
            if item.is_some_and(|it| it.is_public && !it.is_hidden) {
                self.add(place, name, &format!("{path}{name}"), listed);
            }
        }
        for import in &module.imports {
            if !import.is_public || import.is_hidden {
                continue;
            }
            let target = self.target(place, &import.path);
            match (&import.name, target) {
                (Some(name), Some((place, last))) => {
                    self.add(&place, &last, &format!("{path}{name}"), listed);
                }
                (Some(name), None) => {
                    listed.insert(format!("use {path}{name}"));
                }
                (None, Some((mut place, last))) => {
                    place.push(last);
                    self.list(&place, path, listed);
                }
                (None, None) => {
                    listed.insert(format!("use {}::*", import.path.join("::")));
                }
            }
        }
    }

    /// Adds the item of this name in a module, which documentation shows at a path.
    fn add(&self, place: &[String], name: &str, path: &str, listed: &mut BTreeSet<String>) {
        let module = self.module(place);
        if let Some((entry, _)) = module.and_then(|it| it.modules.get(name)) {
            if entry.is_hidden {
                return;
            }
            listed.insert(format!("{} {path}", entry.kind));
            let inner = [place, &[name.to_string()]].concat();
            self.list(&inner, &format!("{path}::"), listed);
        } else if let Some(item) = module.and_then(|it| it.items.get(name)) {
            if !item.is_hidden {
                listed.insert(self.line(place, name, item, path));
            }
        } else {
            let import = module.and_then(|it| {
                let mut imports = it.imports.iter();
                imports.find(|it| it.name.as_deref() == Some(name))
            });
            let target = import.and_then(|it| self.target(place, &it.path));
            match target {
                Some((inner, last)) if (&inner, &last) != (&place.to_vec(), &name.to_string()) => {
                    self.add(&inner, &last, path, listed);
                }
                _ => {
                    listed.insert(format!("use {path}"));
                }
            }
        }
    }

    /// Line of an item: `struct Signal { value, rate, acceleration }`.
    fn line(&self, place: &[String], name: &str, item: &Declared, path: &str) -> String {
        let package = place.first().and_then(|it| self.0.get(it.as_str()));
        let mut members = item.members.clone();
        if let Some(implemented) = package.and_then(|it| it.implemented.get(name)) {
            members.extend(implemented.iter().cloned());
        }
        let members: Vec<String> = members.into_iter().collect();
        if members.is_empty() {
            return format!("{} {path}", item.kind);
        }
        format!("{} {path} {{ {} }}", item.kind, members.join(", "))
    }
}

/// Text of the list: each package with its number of items, and an item per line.
fn list() -> String {
    let packages = Packages::read();
    let mut text = String::new();
    for (name, _) in PUBLIC_PACKAGES {
        let mut listed = BTreeSet::new();
        packages.list(&[name.to_string()], "", &mut listed);
        let macros = &packages.0[name].macros;
        listed.extend(macros.iter().map(|it| format!("macro {it}")));
        writeln!(text, "{name}: {} items", listed.len()).expect("a String takes everything");
        for line in listed {
            writeln!(text, "  {line}").expect("a String takes everything");
        }
    }
    text
}

#[test]
fn public_items_are_those_of_the_list() {
    let path = files::package("public.txt");
    let list = list();
    if std::env::var_os("PUBLIC_UPDATE").is_some() {
        fs::write(&path, &list).expect("the list is written");
    }
    let expected = fs::read_to_string(&path).unwrap_or_default();
    let lines = |text: &str| text.lines().map(str::to_string).collect::<BTreeSet<_>>();
    let (now, before) = (lines(&list), lines(&expected));
    let difference: Vec<String> = now
        .difference(&before)
        .map(|it| format!("+ {it}"))
        .chain(before.difference(&now).map(|it| format!("- {it}")))
        .collect();
    assert!(
        list == expected,
        "public items differ from tests/public.txt; write it again with PUBLIC_UPDATE=1:\n{}",
        difference.join("\n")
    );
}
