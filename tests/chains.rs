//! Writes the modules of pantographs and a list of them, for build scripts: each solved by tearing and by all
//! equations at once, in f64 and in f32.

use std::env;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, Scalar, generate, write_module};

use crate::pantograph::Pantograph;
use crate::registry;

/// Numbers of cells, and ratios of the size of each cell to that of the one before.
const SHORT_CHAINS: [(usize, f64); 3] = [(6, 1.0), (6, 0.8), (6, 1.4)];

/// Chains of the report alone: their modules are as large as a quarter of all others.
const LONG_CHAINS: [(usize, f64); 4] = [(12, 1.0), (12, 0.8), (12, 1.4), (30, 1.0)];

/// Solution methods of a chain, with their statements. A normalized determinant of all equations needs all of them.
const WAYS: [(&str, &str); 2] = [("torn", "unguarded;"), ("dense", "unguarded; monitor;")];

const SCALARS: [(&str, Scalar); 2] = [("double", Scalar::F64), ("single", Scalar::F32)];

/// Writes the modules, and `chains.rs` with all of them.
pub fn write() {
    let (mut modules, mut list) = (String::new(), String::new());
    let long = match env::var_os("CARGO_FEATURE_LONG_CHAINS") {
        Some(_) => &LONG_CHAINS[..],
        None => &[],
    };
    for (place, &(cells, growth)) in SHORT_CHAINS.iter().chain(long).enumerate() {
        let chain = Pantograph::new(cells, growth);
        let mut views = String::new();
        for (scalar, kind) in SCALARS {
            let options = Options {
                scalar: kind,
                ..Options::default()
            };
            let follow = WAYS.map(|(way, statements)| {
                let name = format!("chain_{place}_{way}_{scalar}");
                let source = Source::new("pantograph.mech", chain.text(statements));
                let module = generate(&source, &options).expect("a chain has a plan");
                write_module(&name, module.code()).expect("the module is written");
                modules +=
                    &format!("mod {name} {{\n    linkwright::include_mechanism!({name});\n}}\n");
                format!("{way}: followed::<{name}::Loops>")
            });
            views += &format!("        {scalar}: Ways {{ {} }},\n", follow.join(", "));
        }
        list += &format!(
            "    Chain {{\n        cells: {cells},\n        growth: {growth:?},\n{views}    }},\n"
        );
    }
    let list = format!(
        "{modules}\n/// Every compiled chain.\npub const CHAINS: &[Chain] = &[\n{list}];\n"
    );
    registry::write("chains.rs", &list);
}
