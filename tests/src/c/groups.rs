//! Writes programs that compare groups with mechanisms alone.

use linkwright_codegen::Scalar;
use linkwright_codegen::diagnostic::Source;

use super::header::{Declared, motions};

/// Comparison of one motion.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Prefix of the motion's functions: `four_bar`.
    pub prefix: String,
    /// Source of a function of this name, after `compare_`, which includes `lanes_program.h`.
    pub text: String,
}

/// Returns the comparisons of all motions of a description, whose header has this text and, without extension, this name.
pub fn comparisons(source: &Source, header: &str, stem: &str, scalar: Scalar) -> Vec<Comparison> {
    let motions = motions(source, header);
    let comparisons = motions.iter().map(|it| comparison(it, stem, scalar));
    comparisons.collect()
}

fn comparison(motion: &Declared, stem: &str, scalar: Scalar) -> Comparison {
    let (real, suffix) = match scalar {
        Scalar::F64 => ("double", ""),
        Scalar::F32 => ("float", "f"),
    };
    let Declared {
        prefix,
        type_name,
        parameters,
        inputs,
        ..
    } = motion;
    let text = format!(
        "#include \"{stem}.h\"
#define TYPE {type_name}
#define PREFIX {prefix}
#define CONSTANT {}
#define NAME \"{prefix}\"
#define REAL {real}
#define FAILURE linkwright{suffix}_failure
#define PARAMETERS {parameters}
#define INPUTS {inputs}
#include \"lanes_program.h\"
",
        prefix.to_uppercase()
    );
    Comparison {
        prefix: prefix.clone(),
        text,
    }
}
