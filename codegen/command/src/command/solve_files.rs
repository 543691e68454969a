//! *What `solve` is asked, before the work* → *the files that it will write*, and afterwards their contents.

use std::path::{Path, PathBuf};

use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::view::View;

use super::{Problem, in_folder};
use crate::arguments::Reported;
use crate::motion::Followed;
use crate::output::{Output, Outputs, Refused};
use crate::report::{comma_separated, paths, picture, plot};

/// What is said of a file that cannot be written and that nobody asked for.
const ELSEWHERE: &str = "`--out DIR` writes to another folder, and `--no-files` writes none";

/// The files that are wanted.
pub struct Files {
    /// The table of all frames.
    pub frames: Option<Output>,
    points: Vec<Picture>,
    coordinates: Vec<Picture>,
    forces: Vec<Picture>,
    paths: Option<Picture>,
    folder: PathBuf,
}

/// A file without its ending, and where it goes.
struct Picture {
    name: String,
    output: Output,
}

impl Files {
    /// Those of a motion of which these points and coordinates are shown; of a brief one only what is asked for.
    ///
    /// # Errors
    /// One of them cannot be written.
    pub fn new(
        reported: &Reported,
        mut outputs: Outputs,
        is_brief: bool,
        system: &System,
        [points, coordinates]: [&[usize]; 2],
        schedule: &Schedule,
    ) -> Result<Files, Problem> {
        let is_quiet = reported.json || reported.no_files || is_brief;
        let default = match &reported.out {
            Some(folder) => Some(folder.clone()),
            None => (!is_quiet).then(|| folder(system)),
        };
        let frames = reported.csv.clone();
        let frames = frames.or_else(|| Some(default.as_ref()?.join("motion.csv")));
        let frames = frames.filter(|path| path != Path::new("-"));
        let is_asked = reported.csv.is_some() || reported.out.is_some();
        let frames = frames
            .map(|path| placed(is_asked, outputs.file(&path, comma_separated::SIGNATURE)))
            .transpose()?;
        let mut files = Files {
            frames,
            points: Vec::new(),
            coordinates: Vec::new(),
            forces: Vec::new(),
            paths: None,
            folder: reported.plot.clone().or(default).unwrap_or_default(),
        };
        // A curve needs two frames.
        if files.folder == Path::new("") || schedule.wanted() < 2 {
            return Ok(files);
        }
        let names = points.iter().map(|&it| system.outputs[it].name.as_str());
        // Angles that `--show` does not name are in the tables alone.
        let coordinates = match reported.show.is_empty() {
            true => &[],
            false => coordinates,
        };
        let shown = coordinates.iter();
        let shown = shown.map(|&it| system.coordinates[it].name.as_str());
        let paths = (!points.is_empty()).then_some("paths");
        let forces = linkwright_solver::forces::names(system);
        let forces = forces.iter().map(|(name, _)| name.as_str());
        let names = distinct(names.chain(shown).chain(forces).chain(paths));
        let is_asked = reported.plot.is_some() || reported.out.is_some();
        let mut pictures = Vec::with_capacity(names.len());
        for name in names {
            let path = in_folder(&files.folder, &format!("{name}.svg"))?;
            let output = placed(is_asked, outputs.file(&path, picture::SIGNATURE))?;
            pictures.push(Picture { name, output });
        }
        files.paths = paths.and_then(|_| pictures.pop());
        files.forces = pictures.split_off(points.len() + coordinates.len());
        files.coordinates = pictures.split_off(points.len());
        files.points = pictures;
        Ok(files)
    }

    /// Whether something is drawn.
    pub fn has_pictures(&self) -> bool {
        !self.points.is_empty() || !self.coordinates.is_empty()
    }

    /// Draws what moves, if there are frames to draw; a line about what is written.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn draw<V: View>(
        self,
        motion: &Followed<V>,
        units: &OutputUnits,
    ) -> Result<Option<String>, Problem> {
        let course = motion.course.as_ref().filter(|_| motion.count > 1);
        let Some(course) = course else {
            return Ok(None);
        };
        let refused = |text| Problem(format!("error: {text}"));
        let points = plot::points(motion, course, units).map_err(refused)?;
        let is_drawn: Vec<bool> = points.iter().map(Option::is_some).collect();
        let coordinates = plot::coordinates(motion, course, units).map_err(refused)?;
        let forces = plot::forces(motion, course, units).map_err(refused)?;
        let paths = paths::paths(motion, course, &is_drawn, &units.of("m")).map_err(refused)?;
        let pictures = self.points.into_iter().zip(points);
        let pictures = pictures.chain(self.coordinates.into_iter().zip(coordinates));
        let pictures = pictures.chain(self.forces.into_iter().zip(forces));
        let pictures = pictures.chain(self.paths.into_iter().zip([paths]));
        let mut names = Vec::new();
        for (Picture { name, output }, text) in pictures {
            // What stands still has no picture.
            let Some(text) = text else { continue };
            output.write(|output| output.write_all(text.as_bytes()))?;
            names.push(name);
        }
        Ok(match names.as_slice() {
            [] => None,
            [name] => Some(
                self.folder
                    .join(format!("{name}.svg"))
                    .display()
                    .to_string(),
            ),
            names => Some(format!(
                "{} ({})",
                self.folder.join("*.svg").display(),
                names.join(", ")
            )),
        })
    }
}

/// What nobody asked for, and cannot be written, can be asked for elsewhere.
fn placed(is_asked: bool, output: Result<Output, Refused>) -> Result<Output, Refused> {
    output.map_err(|refused| match is_asked {
        false => refused.or_help(ELSEWHERE),
        true => refused,
    })
}

/// The folder for what is written unasked: in a folder with a `Cargo.toml` `target/linkwright/excavator`, and elsewhere `excavator`;
/// below it one of the motion, where there are several.
fn folder(system: &System) -> PathBuf {
    let mechanism = &system.mechanism;
    let motion = mechanism.motion.as_ref().map(|motion| motion.name.as_str());
    let above = match Path::new("Cargo.toml").is_file() {
        true => Path::new("target/linkwright"),
        false => Path::new(""),
    };
    let names = [mechanism.name.as_str()].into_iter().chain(motion);
    above.join(names.collect::<PathBuf>())
}

/// File names: where two differ in case only, the later one gets a number, since some file systems cannot tell them apart.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    names
        .map(|name| {
            let mut file = name.to_string();
            let mut number = 2;
            while taken.contains(&file.to_lowercase()) {
                file = format!("{name}-{number}");
                number += 1;
            }
            taken.push(file.to_lowercase());
            file
        })
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn file_names_differ_in_more_than_case() {
        let names = super::distinct(["a", "A", "b", "A2"].into_iter());
        assert_eq!(names, ["a", "A-2", "b", "A2"]);
    }
}
