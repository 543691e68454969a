//! Lists the functions that a generated header declares, so that a program calls all of them.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::rust::type_name;

/// A motion of a mechanism as its header declares it.
#[derive(Clone, Debug)]
pub struct Declared {
    /// Prefix of its functions: `four_bar`.
    pub prefix: String,
    /// Prefix of its types: `FourBar`.
    pub type_name: String,
    /// Name of the motion; `None` if the mechanism has only one.
    pub motion: Option<String>,
    /// Number of coordinates.
    pub coordinates: usize,
    /// True if frames hold the coordinates.
    pub holds_coordinates: bool,
    /// Numbers of parameters and inputs.
    pub parameters: usize,
    pub inputs: usize,
    /// Fields of the assembly modes.
    pub modes: Vec<String>,
    /// True if stored assemblies can be selected.
    pub stores_assemblies: bool,
    /// Functions of a frame, and those of the textbook formulation.
    pub of_frame: Vec<OfFrame>,
    pub textbook: Vec<Textbook>,
}

/// Function of a frame: its name without the prefix, and its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OfFrame {
    pub name: String,
    pub returned: Returned,
}

/// Result of a function of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Returned {
    Number,
    Pair,
    Motion,
    Optional,
    Matrix(usize, usize),
    /// Forces of a load; true if it is a vector.
    Forces(bool, usize),
    Sensitivity,
    PointSensitivity,
    Determinant,
    Determinants(usize),
}

/// Function of the textbook formulation, and the number of values that it writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Textbook {
    pub name: String,
    pub sizes: Vec<usize>,
}

/// The header with every declaration on a line, and without comments.
fn flattened(header: &str) -> Vec<String> {
    let mut code = String::new();
    let mut rest = header;
    while let Some((before, comment)) = rest.split_once("/*") {
        code.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    code.push_str(rest);
    let code: Vec<&str> = code.lines().filter(|line| !line.starts_with('#')).collect();
    let code = code.join(" ");
    let words: Vec<&str> = code.split_whitespace().collect();
    words
        .join(" ")
        .split(';')
        .map(|it| it.trim().to_string())
        .collect()
}

/// Numbers in brackets: 2 and 3 of `found[2][3])`.
fn sizes(declaration: &str) -> Vec<usize> {
    let parts = declaration.split('[').skip(1);
    parts
        .filter_map(|it| it.split(']').next()?.parse().ok())
        .collect()
}

/// Names of the fields of a structure; empty if the structure is missing.
fn fields(lines: &[String], name: &str) -> Vec<String> {
    let opening = format!("typedef struct {name} {{");
    let Some(start) = lines.iter().position(|line| line.contains(&opening)) else {
        return Vec::new();
    };
    let mut names = Vec::new();
    for line in &lines[start..] {
        if line.starts_with('}') {
            break;
        }
        let field = line.rsplit(' ').next().unwrap_or_default();
        names.push(field.split('[').next().unwrap_or_default().to_string());
    }
    names
}

/// Motions of a description as its header declares them.
///
/// # Panics
/// The description has errors.
pub fn motions(source: &Source, header: &str) -> Vec<Declared> {
    let read = linkwright_codegen::read(source).expect("the description has been generated");
    let of = |motion: Option<&str>| {
        let name = &read.motions[0].system.mechanism.name;
        let prefix = motion.map_or(name.clone(), |it| format!("{name}_{it}"));
        declared(header, &prefix, &type_name(&prefix), motion)
    };
    let motions = read.motions.iter();
    let motions = motions.map(|it| it.system.mechanism.motion.as_ref());
    motions
        .map(|it| of(it.map(|it| it.name.as_str())))
        .collect()
}

/// Declarations of the motion whose types have this prefix.
fn declared(header: &str, prefix: &str, type_name: &str, motion: Option<&str>) -> Declared {
    let lines = flattened(header);
    let frame = fields(&lines, &format!("{type_name}Frame"));
    let mut modes = fields(&lines, &format!("{type_name}Branches"));
    let stores_assemblies = modes.last().is_some_and(|it| it == "assembly");
    if stores_assemblies {
        modes.pop();
    }
    let mut of_frame = Vec::new();
    let mut textbook = Vec::new();
    for line in &lines {
        let Some((head, arguments)) = line.split_once('(') else {
            continue;
        };
        let Some(name) = head
            .rsplit([' ', '*'])
            .next()
            .and_then(|it| it.strip_prefix(prefix)?.strip_prefix('_'))
        else {
            continue;
        };
        let name = name.to_string();
        if arguments.starts_with(&format!("const {type_name}Coordinates *q,")) {
            textbook.push(Textbook {
                name,
                sizes: sizes(arguments),
            });
            continue;
        }
        if !arguments.starts_with(&format!("const {type_name}Frame *frame")) {
            continue;
        }
        let size = sizes(arguments);
        let head = head.trim_start_matches("LINKWRIGHT_FUNCTION ");
        let returned = head.split(' ').next().unwrap_or_default();
        let returned = match (returned, size.as_slice()) {
            ("double" | "float", _) => Returned::Number,
            ("bool", _) => Returned::Optional,
            ("void", [2]) if !arguments.contains("normalized") && !name.starts_with("forces_") => {
                Returned::Pair
            }
            ("void", [rows, columns]) if name.starts_with("transmission_") => {
                Returned::Matrix(*rows, *columns)
            }
            ("void", [2, number]) if name.starts_with("forces_") => Returned::Forces(true, *number),
            ("void", [number]) if name.starts_with("forces_") => Returned::Forces(false, *number),
            ("void", [number]) => Returned::Determinants(*number),
            (it, _) if it.ends_with("_point_motion") => Returned::Motion,
            (it, _) if it.ends_with("_normalized_determinant") => Returned::Determinant,
            (it, _) if it.ends_with("PointSensitivity") => Returned::PointSensitivity,
            (it, _) if it.ends_with("Sensitivity") => Returned::Sensitivity,
            _ => panic!("a function of a frame that is not known: {line}"),
        };
        of_frame.push(OfFrame { name, returned });
    }
    Declared {
        prefix: prefix.to_string(),
        type_name: type_name.to_string(),
        motion: motion.map(str::to_string),
        coordinates: fields(&lines, &format!("{type_name}Coordinates")).len(),
        holds_coordinates: frame.iter().any(|field| field == "qdd"),
        parameters: fields(&lines, &format!("{type_name}Parameters")).len(),
        inputs: fields(&lines, &format!("{type_name}Inputs")).len(),
        stores_assemblies,
        modes: modes.into_iter().filter(|mode| mode != "none").collect(),
        of_frame,
        textbook,
    }
}
