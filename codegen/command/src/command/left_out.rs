//! Reports features that this build leaves out.

use super::Problem;

/// Features of the package, each with true if this build has it.
const FEATURES: [(&str, bool); 6] = [
    ("png", cfg!(feature = "png")),
    ("lsp", cfg!(feature = "lsp")),
    ("calibrate", cfg!(feature = "calibrate")),
    ("live", cfg!(feature = "live")),
    ("man", cfg!(feature = "man")),
    ("parquet", cfg!(feature = "parquet")),
];

/// Returns the error about a feature that is left out, and the command that adds it to the features of this build.
///
/// `effect` completes the sentence "`feature`, which …".
pub fn refusal(feature: &str, effect: &str) -> Problem {
    let features = FEATURES
        .iter()
        .filter(|(name, is_built)| *is_built || *name == feature);
    let features: Vec<&str> = features.map(|(name, _)| *name).collect();
    let install = format!(
        "cargo install --profile optimized --path codegen/cli --no-default-features --features {}",
        features.join(",")
    );
    let error = format!("this `linkwright` was built without `{feature}`, which {effect}");
    let help = format!("install it with the feature `{feature}`: `{install}`");
    Problem(format!("error: {error}\n  = help: {help}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_adds_one_feature_to_those_of_the_build() {
        let Problem(text) = refusal("lsp", "serves editors");
        let (error, help) = text.split_once('\n').expect("two lines");
        assert_eq!(
            error,
            "error: this `linkwright` was built without `lsp`, which serves editors"
        );
        let (_, listed) = help.rsplit_once(' ').expect("a list of features");
        for (name, is_built) in FEATURES {
            let is_listed = listed.trim_end_matches('`').split(',').any(|it| it == name);
            assert_eq!(is_listed, is_built || name == "lsp", "{help}");
        }
    }
}
