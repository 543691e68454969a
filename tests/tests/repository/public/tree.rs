//! Reads the modules of a package from its sources, without running the compiler.
//!
//! What macros expand to is not read, except for the macros that a package exports.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, Fields, ImplItem, Item, TraitItem, Type, UseTree, Visibility};

/// Item of a module, with its public members.
#[derive(Clone, Debug)]
pub struct Declared {
    /// Keyword and members: `struct: time, kind`.
    pub kind: &'static str,
    /// Names of public fields, variants, functions and constants.
    pub members: BTreeSet<String>,
    /// True if the item is public.
    pub is_public: bool,
    /// True if the documentation does not show the item.
    pub is_hidden: bool,
}

/// Name that a module imports.
#[derive(Clone, Debug)]
pub struct Import {
    /// Segments of the path.
    pub path: Vec<String>,
    /// Name in the module; `None` for all names of the path.
    pub name: Option<String>,
    /// True if the import is public.
    pub is_public: bool,
    /// True if the documentation does not show the import.
    pub is_hidden: bool,
}

/// Module of a package.
#[derive(Debug, Default)]
pub struct Module {
    /// Items besides modules, by name.
    pub items: BTreeMap<String, Declared>,
    /// Imports, in the order of the source.
    pub imports: Vec<Import>,
    /// Modules in this one, each with its entry as an item.
    pub modules: BTreeMap<String, (Declared, Module)>,
}

/// Package: its root, and public members that are implemented apart from their types.
#[derive(Debug, Default)]
pub struct Package {
    /// Root module.
    pub root: Module,
    /// Public functions and constants by the name of their type.
    pub implemented: BTreeMap<String, BTreeSet<String>>,
    /// Exported macros that the documentation shows.
    pub macros: BTreeSet<String>,
}

impl Package {
    /// Reads the package whose root is this file.
    ///
    /// # Panics
    /// If a source cannot be read.
    pub fn read(root: &Path) -> Self {
        let mut package = Self::default();
        let folder = root.parent().expect("a source lies in a folder");
        package.root = package.module(&items_of(root), folder);
        package
    }

    /// Reads a module whose modules lie in this folder.
    fn module(&mut self, items: &[Item], folder: &Path) -> Module {
        let mut module = Module::default();
        for item in items {
            if !is_test(attributes(item)) {
                self.add(item, &mut module, folder);
            }
        }
        module
    }

    fn add(&mut self, item: &Item, module: &mut Module, folder: &Path) {
        let (kind, name, visibility, members) = match item {
            Item::Mod(it) => {
                let name = it.ident.to_string();
                let below = folder.join(&name);
                let inner = match &it.content {
                    Some((_, items)) => self.module(items, &below),
                    None => self.module(&items_of(&source_of(&below)), &below),
                };
                let entry = declared("mod", &it.vis, &it.attrs, BTreeSet::new());
                module.modules.insert(name, (entry, inner));
                return;
            }
            Item::Use(it) => {
                let (is_public, is_hidden) = (is_public(&it.vis), is_hidden(&it.attrs));
                imports(&it.tree, &mut Vec::new(), &mut |path, name| {
                    module.imports.push(Import {
                        path,
                        name,
                        is_public,
                        is_hidden,
                    });
                });
                return;
            }
            Item::Impl(it) => {
                if let (None, Type::Path(of)) = (&it.trait_, &*it.self_ty)
                    && let Some(last) = of.path.segments.last()
                {
                    let members = self.implemented.entry(last.ident.to_string()).or_default();
                    members.extend(it.items.iter().filter_map(implemented));
                }
                return;
            }
            Item::Macro(it) => {
                let is_exported = it.attrs.iter().any(|it| it.path().is_ident("macro_export"));
                if let (true, false, Some(name)) = (is_exported, is_hidden(&it.attrs), &it.ident) {
                    self.macros.insert(name.to_string());
                }
                return;
            }
            Item::Struct(it) => ("struct", &it.ident, &it.vis, fields(&it.fields)),
            Item::Enum(it) => {
                let variants = it.variants.iter().filter(|it| !is_hidden(&it.attrs));
                let names = variants.map(|it| it.ident.to_string()).collect();
                ("enum", &it.ident, &it.vis, names)
            }
            Item::Trait(it) => {
                let names = it.items.iter().filter_map(required).collect();
                ("trait", &it.ident, &it.vis, names)
            }
            Item::Fn(it) => {
                let is_macro = it.attrs.iter().any(|it| it.path().is_ident("proc_macro"));
                let kind = if is_macro { "macro" } else { "fn" };
                (kind, &it.sig.ident, &it.vis, BTreeSet::new())
            }
            Item::Const(it) => ("const", &it.ident, &it.vis, BTreeSet::new()),
            Item::Static(it) => ("static", &it.ident, &it.vis, BTreeSet::new()),
            Item::Type(it) => ("type", &it.ident, &it.vis, BTreeSet::new()),
            _ => return,
        };
        let entry = declared(kind, visibility, attributes(item), members);
        module.items.insert(name.to_string(), entry);
    }
}

/// Items of a source.
///
/// # Panics
/// If it cannot be read.
fn items_of(path: &Path) -> Vec<Item> {
    let text = fs::read_to_string(path).unwrap_or_else(|it| panic!("{}: {it}", path.display()));
    let file = syn::parse_file(&text).unwrap_or_else(|it| panic!("{}: {it}", path.display()));
    file.items
}

/// Source of the module to which this folder would belong.
fn source_of(folder: &Path) -> PathBuf {
    let beside = folder.with_extension("rs");
    if beside.exists() {
        beside
    } else {
        folder.join("mod.rs")
    }
}

fn declared(
    kind: &'static str,
    visibility: &Visibility,
    attributes: &[Attribute],
    members: BTreeSet<String>,
) -> Declared {
    Declared {
        kind,
        members,
        is_public: is_public(visibility),
        is_hidden: is_hidden(attributes),
    }
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

fn words_of(attribute: &Attribute) -> String {
    let list = attribute.meta.require_list();
    list.map(|it| it.tokens.to_string()).unwrap_or_default()
}

fn is_hidden(attributes: &[Attribute]) -> bool {
    let mut docs = attributes.iter().filter(|it| it.path().is_ident("doc"));
    docs.any(|it| words_of(it) == "hidden")
}

fn is_test(attributes: &[Attribute]) -> bool {
    let mut conditions = attributes.iter().filter(|it| it.path().is_ident("cfg"));
    conditions.any(|it| words_of(it) == "test")
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(it) => &it.attrs,
        Item::Enum(it) => &it.attrs,
        Item::Fn(it) => &it.attrs,
        Item::Impl(it) => &it.attrs,
        Item::Macro(it) => &it.attrs,
        Item::Mod(it) => &it.attrs,
        Item::Static(it) => &it.attrs,
        Item::Struct(it) => &it.attrs,
        Item::Trait(it) => &it.attrs,
        Item::Type(it) => &it.attrs,
        Item::Use(it) => &it.attrs,
        _ => &[],
    }
}

/// Names of public fields.
fn fields(fields: &Fields) -> BTreeSet<String> {
    let public = fields
        .iter()
        .enumerate()
        .filter(|(_, it)| is_public(&it.vis) && !is_hidden(&it.attrs));
    public
        .map(|(place, it)| {
            let name = it.ident.as_ref();
            name.map_or_else(|| place.to_string(), ToString::to_string)
        })
        .collect()
}

/// Name of a public member that a type implements; `None` for others.
fn implemented(item: &ImplItem) -> Option<String> {
    let (name, visibility, attributes) = match item {
        ImplItem::Fn(it) => (&it.sig.ident, &it.vis, &it.attrs),
        ImplItem::Const(it) => (&it.ident, &it.vis, &it.attrs),
        _ => return None,
    };
    (is_public(visibility) && !is_hidden(attributes)).then(|| name.to_string())
}

/// Name of a member of a trait; `None` if the documentation does not show it.
fn required(item: &TraitItem) -> Option<String> {
    let (name, attributes) = match item {
        TraitItem::Fn(it) => (&it.sig.ident, &it.attrs),
        TraitItem::Const(it) => (&it.ident, &it.attrs),
        TraitItem::Type(it) => (&it.ident, &it.attrs),
        _ => return None,
    };
    (!is_hidden(attributes)).then(|| name.to_string())
}

/// Calls `add` with the path of each imported name, and with the name in the module.
fn imports(
    tree: &UseTree,
    path: &mut Vec<String>,
    add: &mut impl FnMut(Vec<String>, Option<String>),
) {
    match tree {
        UseTree::Path(it) => {
            path.push(it.ident.to_string());
            imports(&it.tree, path, add);
            path.pop();
        }
        UseTree::Group(it) => it.items.iter().for_each(|it| imports(it, path, add)),
        UseTree::Glob(_) => add(path.clone(), None),
        UseTree::Name(it) if it.ident == "self" => add(path.clone(), path.last().cloned()),
        UseTree::Name(it) => {
            let name = it.ident.to_string();
            add(
                [path.as_slice(), std::slice::from_ref(&name)].concat(),
                Some(name),
            );
        }
        UseTree::Rename(it) => {
            let last = [it.ident.to_string()];
            let name = it.rename.to_string();
            add([path.as_slice(), &last].concat(), Some(name));
        }
    }
}
