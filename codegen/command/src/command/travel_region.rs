//! Finds the region of two drives, and draws it.

use std::path::Path;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_page::motion;
use linkwright_solver::travel::{Drive, Region};

use super::description::outputs;
use super::travel::immovable;
use super::{Outcome, Problem, in_folder, print};
use crate::arguments::Travel as Arguments;
use crate::output::Output;
use crate::progress::Progress;
use crate::report::{picture, region_picture, region_text};
use crate::terminal;

/// Number of points of a border that the progress bar expects.
const EXPECTED_POINTS: usize = 600;

/// Follows the border of the region and reports it.
///
/// # Errors
/// An option cannot be used, the equations cannot be solved with the drives as inputs, or a picture cannot be written.
pub(super) fn run(
    arguments: &Arguments,
    source: &Source,
    derived: &Derived,
    drives: &[Drive; 2],
) -> Result<Outcome, Problem> {
    let system = &derived.system;
    let names: Vec<String> = arguments.point.iter().cloned().collect();
    let point = match names.is_empty() {
        true => None,
        false => {
            let points = motion::points(system, &names);
            let points = points.map_err(|text| Problem(format!("error: {text}")))?;
            points.first().copied()
        }
    };
    let mut files = outputs(&arguments.described.file, source, arguments.force);
    let mut file = |folder: &Path, name: &str| -> Result<Output, Problem> {
        Ok(files.file(&in_folder(folder, name)?, picture::SIGNATURE)?)
    };
    let plot = arguments.plot.as_deref();
    let plane = plot.map(|folder| file(folder, "region.svg")).transpose()?;
    let workspace = plot.filter(|_| point.is_some());
    let workspace = workspace
        .map(|folder| file(folder, "workspace.svg"))
        .transpose()?;
    let mut progress = Progress::new(EXPECTED_POINTS);
    let region = Region::new(derived, drives, arguments.at, point, |count| {
        progress.reached(count);
    });
    progress.finish();
    let mechanism = &system.mechanism;
    let region = match region {
        Ok(region) => region,
        Err(reason) => return immovable(&reason, mechanism, &arguments.drive, arguments.at),
    };
    print(|output| match arguments.json {
        true => region_text::write_json(&region, system, output),
        false => {
            let mut text = Vec::new();
            region_text::write(&region, system, arguments.at, &mut text)?;
            let text = String::from_utf8_lossy(&text).into_owned();
            output.write_all(terminal::fitted(text).as_bytes())
        }
    })?;
    let title = mechanism.title();
    let units = region_text::units_of(&region, system);
    let length = mechanism.units.of_messages().of("m");
    let drawn =
        |picture: Result<String, String>| picture.map_err(|text| Problem(format!("error: {text}")));
    let mut pictures = Vec::new();
    if let Some(output) = plane {
        pictures.push((
            output,
            drawn(region_picture::plane(&title, &region, &units))?,
        ));
    }
    if let (Some(output), Some(name)) = (workspace, names.first()) {
        let picture = region_picture::workspace(&title, &region, name, &length);
        pictures.push((output, drawn(picture)?));
    }
    for (output, picture) in pictures {
        let path = output.path().to_path_buf();
        output.write(|output| output.write_all(picture.as_bytes()))?;
        if !arguments.json {
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(Outcome::Done)
}
