//! Writes descriptions of the study of stability under other names, for build scripts: one module has one scalar, and
//! two modules cannot have one name.

use std::fs;
use std::path::{Path, PathBuf};

use crate::described::empty_folder;

/// Writes `study_NAME.mech` of a folder as `single_study_NAME`; gives the folder.
pub fn write(folder: &str) -> PathBuf {
    let output = empty_folder("single_study");
    for entry in fs::read_dir(Path::new(folder)).expect("the folder of descriptions") {
        let path = entry.expect("a listed file").path();
        let name = path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|name| name.starts_with("study_")) else {
            continue;
        };
        let text = fs::read_to_string(&path).expect("a readable description");
        let text = text.replace("mechanism study_", "mechanism single_study_");
        fs::write(output.join(format!("single_{name}")), text).expect("the copy is written");
    }
    output
}
