//! Units of measurement: descriptions, columns and documentation have equal units, with the values of standards.

use std::collections::BTreeSet;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::columns::{Columns, Known, Unit};
use linkwright_codegen::stages::model::UNITS;
use linkwright_tests::files;

/// Value in SI units of a parameter with this text.
fn value(written: &str) -> Result<f64, String> {
    let text = format!(
        "mechanism m {{
            param p = {written};
            body arm at (0, 0);
            absolute_x(arm) = 0;
            absolute_y(arm) = 0;
            drive phi(arm) = t;
        }}"
    );
    let source = Source::new("units.mech", text);
    let read = linkwright_codegen::read(&source).map_err(|found| found.render(&source))?;
    let derived = read.only().expect("one motion");
    let parameter = &derived.system.mechanism.parameters[0];
    Ok(derived
        .pool
        .graph
        .constant_value(parameter.nominal)
        .expect("a number"))
}

/// Factors of the BIPM's brochure (9th edition) and of NIST SP 811, appendix B.
const STANDARDS: [(&str, f64); 14] = [
    ("1inch", 0.0254),
    ("1ft", 0.3048),
    ("1lbf", 4.448_221_615_260_5),
    ("1turns", std::f64::consts::TAU),
    ("1U/min", std::f64::consts::PI / 30.0),
    ("30r/min", std::f64::consts::PI),
    ("-30U/min", -std::f64::consts::PI),
    ("2*30U/min", 2.0 * std::f64::consts::PI),
    ("1r/s", std::f64::consts::TAU),
    ("1min", 60.0),
    ("60Hz", 60.0),
    ("60*1/1min", 1.0),
    ("1MN", 1e6),
    ("1t", 1e3),
];

#[test]
fn factors_are_those_of_standards() {
    for (written, expected) in STANDARDS {
        let computed = value(written).unwrap_or_else(|error| panic!("{written}: {error}"));
        let off = (computed / expected - 1.0).abs();
        assert!(off < 1e-15, "{written}: {computed}");
    }
    for written in ["1U", "2r", "1U/kg", "30U /min"] {
        let error = value(written).expect_err(written);
        assert!(error.contains("K20"), "{error}");
    }
}

#[test]
fn columns_know_all_units_of_descriptions() {
    for name in UNITS {
        let described = value(&format!("1{name}")).expect(name);
        let column = Unit::parse(name).unwrap_or_else(|| panic!("columns lack {name}"));
        assert_eq!(column.si(1.0).to_bits(), described.to_bits(), "{name}");
    }
}

/// Compares the table in the documentation of the language.
#[test]
fn the_documentation_lists_all_units() {
    let path = files::repository().join("mechanisms/README.md");
    let text = std::fs::read_to_string(path).expect("the documentation");
    let (_, table) = text
        .split_once("| suffix | is | factor |")
        .expect("a table of units");
    let (table, _) = table.split_once("\n\n").expect("an end");
    let listed: BTreeSet<&str> = table
        .lines()
        .filter_map(|line| line.split('|').nth(1))
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .collect();
    let words: BTreeSet<&str> = listed
        .iter()
        .copied()
        .filter(|it| !it.contains('/'))
        .collect();
    assert_eq!(words, UNITS.iter().copied().collect());
    for name in listed {
        value(&format!("1{name}")).expect(name);
    }
}

#[test]
fn a_line_of_units_may_not_contradict_the_names() {
    for (text, place) in [
        ("t (s),P_x (mm)\ns,m\n0,50\n", "m"),
        ("t (s);P_x / mm\n[ms];[mm]\n0;50\n", "[ms]"),
    ] {
        let refused = Columns::read(text.as_bytes(), Known::default()).expect_err("a fault");
        let [fault] = refused.faults.as_slice() else {
            panic!("{refused:?}");
        };
        assert_eq!(text.get(fault.span.range()), Some(place), "{fault:?}");
        assert!(fault.message.contains("beside its name"), "{fault:?}");
    }
    for text in [
        "t (s),P_x (mm)\ns,mm\n0,50\n",
        "t (s),M (mN*m)\n[s],[Nmm]\n0,50\n",
        "t,P_x (mm)\ns,mm\n0,50\n",
        // A row of names below a title does not count as units, although t is a tonne.
        "lift,four_bar\nt,s\n0,50\n",
    ] {
        let columns = Columns::read(text.as_bytes(), Known::default());
        assert!(columns.is_ok(), "{text}: {columns:?}");
    }
}
