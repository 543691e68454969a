//! Announces the files of `solve` before its work, and writes them afterwards.

use std::path::{Path, PathBuf};

use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::{Observable, Schedule, View};

use super::{Problem, in_folder};
use crate::arguments::Reported;
use crate::output::{Output, Outputs, Refused};
use crate::report::pairs::Pair;
use crate::report::{frame_table, pairs, paths, picture, plot};
use linkwright_page::motion::Followed;

/// Help for a file that cannot be written and was not requested.
const ELSEWHERE: &str = "`--out DIR` writes to another folder, and `--no-files` writes none";

/// Files that are requested.
pub struct Files {
    /// Table of all frames.
    pub frames: Option<Output>,
    points: Vec<Picture>,
    coordinates: Vec<Picture>,
    reported: Vec<Picture>,
    paths: Option<Picture>,
    /// Pairs of quantities with their pictures.
    pairs: Vec<(Pair, Picture)>,
    folder: PathBuf,
}

/// Stem of a picture's file, and its output.
struct Picture {
    name: String,
    output: Output,
}

impl Files {
    /// Announces the files of a motion with these selected points and coordinates; for a brief motion, only the requested ones.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn new(
        reported: &Reported,
        mut outputs: Outputs,
        is_brief: bool,
        pool: &Pool,
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
            .map(|path| placed(is_asked, outputs.file(&path, frame_table::SIGNATURE)))
            .transpose()?;
        let mut files = Files {
            frames,
            points: Vec::new(),
            coordinates: Vec::new(),
            reported: Vec::new(),
            paths: None,
            pairs: Vec::new(),
            folder: reported.plot.clone().or(default).unwrap_or_default(),
        };
        let pairs = Pair::of(&reported.curve, pool, system).map_err(Problem)?;
        // A curve has at least two frames.
        if schedule.wanted() < 2 {
            return Ok(files);
        }
        for pair in pairs {
            let name = pair.stem();
            let path = in_folder(&files.folder, &format!("{name}.svg"))?;
            let output = placed(true, outputs.file(&path, picture::SIGNATURE))?;
            files.pairs.push((pair, Picture { name, output }));
        }
        if files.folder == Path::new("") {
            return Ok(files);
        }
        let names = points.iter().map(|&it| system.outputs[it].name.as_str());
        // Without `--show`, angles are in the tables only.
        let coordinates = match reported.show.is_empty() {
            true => &[],
            false => coordinates,
        };
        let coordinate_names = coordinates.iter();
        let coordinate_names = coordinate_names.map(|&it| system.coordinates[it].name.as_str());
        let paths = (!points.is_empty()).then_some("paths");
        let columns = linkwright_solver::reported::names(pool, system);
        let columns = columns.iter().map(|(name, _)| name.as_str());
        let names = distinct(names.chain(coordinate_names).chain(columns).chain(paths));
        let is_asked = reported.plot.is_some() || reported.out.is_some();
        let mut pictures = Vec::with_capacity(names.len());
        for name in names {
            let path = in_folder(&files.folder, &format!("{name}.svg"))?;
            let output = placed(is_asked, outputs.file(&path, picture::SIGNATURE))?;
            pictures.push(Picture { name, output });
        }
        files.paths = paths.and_then(|_| pictures.pop());
        files.reported = pictures.split_off(points.len() + coordinates.len());
        files.coordinates = pictures.split_off(points.len());
        files.points = pictures;
        Ok(files)
    }

    /// True if a picture is drawn.
    pub fn has_pictures(&self) -> bool {
        !(self.points.is_empty() && self.coordinates.is_empty() && self.pairs.is_empty())
    }

    /// Returns the pairs of quantities whose pictures are drawn.
    pub fn pairs(&self) -> Vec<[Observable; 2]> {
        let pairs = self.pairs.iter();
        pairs.map(|(pair, _)| pair.observables()).collect()
    }

    /// Draws what moves, if there are frames; prints a line about each file.
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
        let reported = plot::reported(motion, course, units).map_err(refused)?;
        let paths = paths::paths(motion, course, &is_drawn, &units.of("m")).map_err(refused)?;
        let pictures = self.points.into_iter().zip(points);
        let pictures = pictures.chain(self.coordinates.into_iter().zip(coordinates));
        let pictures = pictures.chain(self.reported.into_iter().zip(reported));
        let pictures = pictures.chain(self.paths.into_iter().zip([paths]));
        let (pairs, files): (Vec<Pair>, Vec<Picture>) = self.pairs.into_iter().unzip();
        let drawn = pairs::pictures(&pairs, motion, course, units).map_err(refused)?;
        let pictures = pictures.chain(files.into_iter().zip(drawn));
        let mut names = Vec::new();
        for (Picture { name, output }, text) in pictures {
            // Quantities at rest have no picture.
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

/// Adds the help to the refusal of a file that was not requested.
fn placed(is_asked: bool, output: Result<Output, Refused>) -> Result<Output, Refused> {
    output.map_err(|refused| match is_asked {
        false => refused.or_help(ELSEWHERE),
        true => refused,
    })
}

/// Folder of files that are not requested: `target/linkwright/excavator` if there is a `Cargo.toml`, otherwise `excavator`.
///
/// A mechanism with several motions has a folder for each below it.
pub(super) fn folder(system: &System) -> PathBuf {
    let mechanism = &system.mechanism;
    let motion = mechanism.motion.as_ref().map(|motion| motion.name.as_str());
    let above = match Path::new("Cargo.toml").is_file() {
        true => Path::new("target/linkwright"),
        false => Path::new(""),
    };
    let names = [mechanism.name.as_str()].into_iter().chain(motion);
    above.join(names.collect::<PathBuf>())
}

/// Makes names distinct without regard to case, since some file systems ignore it: later ones get a number.
pub(super) fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
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
