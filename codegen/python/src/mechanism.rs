//! Holds a description that was opened: the class `Mechanism`.
//!
//! An object never changes. Values, assembly and requests are given when it is made, and a changed mechanism is another object.

use std::path::PathBuf;
use std::sync::Mutex;

use linkwright::Blocks as _;
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::model::{Dimension, set};
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::{Diagnostics, Read, Requests, Source};
use linkwright_solver::opened::{determined, solvable};
use linkwright_solver::{Instant, Interpreted, Modes, Unopened};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::findings::{Finding, raised, refused, unopened};

/// Mechanism of a description, ready to be solved.
#[pyclass(frozen, module = "linkwright._core")]
pub struct Mechanism {
    pub(crate) source: Source,
    motion: Option<String>,
    assembly: Option<String>,
    pub(crate) derived: Derived,
    /// Solution, of which each call takes a copy: its registers belong to one thread.
    interpreted: Mutex<Interpreted>,
    warnings: Vec<Finding>,
}

/// Parameter or input with its value: name, kind, value (`None` for a function of time), unit, ends of its range, documentation.
type Control = (
    String,
    &'static str,
    Option<f64>,
    String,
    Option<[f64; 2]>,
    String,
);

/// Choices with which a mechanism is made from its text.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Choices {
    /// Name of the motion; `None` for the only one.
    motion: Option<String>,
    /// Assignments of the language: `rod = 0.13`.
    assignments: Vec<String>,
    /// Label of the assembly at the start; `None` for that of the design configuration.
    assembly: Option<String>,
    /// Parameters by which positions and rates are differentiated, in place of those of the description; `None` for these.
    along: Option<Vec<String>>,
    /// True to add driving forces to what the description requests.
    efforts: bool,
}

impl Mechanism {
    /// Returns a copy of the solution.
    pub fn view(&self) -> Interpreted {
        let locked = self.interpreted.lock();
        locked
            .unwrap_or_else(std::sync::PoisonError::into_inner)
            .clone()
    }

    /// Returns pose and modes of the chosen assembly at `t` (s); `None` for the design configuration.
    ///
    /// # Errors
    /// The mechanism cannot be assembled so.
    pub fn chosen(&self, view: &Interpreted, t: f64) -> PyResult<Option<(Instant, Modes)>> {
        let label = self.assembly.as_deref();
        let chosen = label.map(|label| linkwright_page::labeled(view, label, t));
        chosen.transpose().map_err(refused)
    }

    /// Label of the chosen assembly; `None` for that of the design configuration.
    pub fn assembly_label(&self) -> Option<&str> {
        self.assembly.as_deref()
    }

    fn open(py: Python<'_>, source: Source, choices: Choices) -> PyResult<Mechanism> {
        let mut warnings = Diagnostics::new();
        let opened = py.detach(|| opened(&source, &choices, &mut warnings));
        let (derived, interpreted) = match opened {
            Ok(opened) => opened,
            Err(Unopen::Reason(reason)) => return Err(unopened(py, &reason, &source)),
            Err(Unopen::Findings(findings)) => {
                let findings = findings.iter().map(|it| Finding::of(it, &source));
                return Err(raised(py, findings.collect()));
            }
            Err(Unopen::Value(text)) => return Err(refused(text)),
        };
        Ok(Mechanism {
            warnings: warnings.iter().map(|it| Finding::of(it, &source)).collect(),
            motion: choices.motion,
            assembly: choices.assembly,
            interpreted: Mutex::new(interpreted),
            derived,
            source,
        })
    }
}

/// Reason that no mechanism is made.
enum Unopen {
    Reason(Unopened),
    Findings(Diagnostics),
    Value(String),
}

fn opened(
    source: &Source,
    choices: &Choices,
    warnings: &mut Diagnostics,
) -> Result<(Derived, Interpreted), Unopen> {
    let motion = choices.motion.as_deref();
    let mut derived = determined(source, motion, warnings).map_err(Unopen::Reason)?;
    if choices.along.is_some() || choices.efforts {
        let names = choices.along.as_ref();
        let names: Option<Vec<&str>> = names.map(|it| it.iter().map(String::as_str).collect());
        let requests = Requests {
            along: names.as_deref(),
            efforts: choices.efforts,
            tolerances: false,
        };
        let read = Read::requesting(source, requests).map_err(Unopen::Findings)?;
        let requested = match motion {
            Some(name) => read.motion(name).cloned(),
            None => read.only(),
        };
        // The motion exists: it was determined before.
        derived = requested.ok_or(Unopen::Reason(Unopened::NoOrder))?;
    }
    for assignment in &choices.assignments {
        let Derived { pool, system } = &mut derived;
        set(pool, &mut system.mechanism, "value", assignment).map_err(Unopen::Value)?;
    }
    let interpreted = solvable(&derived, warnings).map_err(Unopen::Reason)?;
    Ok((derived, interpreted))
}

#[pymethods]
impl Mechanism {
    /// Reads the description at a path, with the tables beside it.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, choices: Choices) -> PyResult<Mechanism> {
        let name = path.display().to_string();
        let bytes = files::read(&path, Source::MAX_BYTES).map_err(|error| {
            let reason = files::reason(&error);
            PyOSError::new_err(format!("cannot read `{name}`: {reason}"))
        })?;
        let source = Source::from_bytes(name, &bytes).map_err(|refused| {
            let (source, found) = *refused;
            raised(
                py,
                found.iter().map(|it| Finding::of(it, &source)).collect(),
            )
        })?;
        let source = files::attach_files(source, files::folder_of(&path));
        Mechanism::open(py, source, choices)
    }

    /// Reads a description from its text and the contents of its tables.
    #[staticmethod]
    fn loads(
        py: Python<'_>,
        text: String,
        name: String,
        tables: Vec<(String, Vec<u8>)>,
        choices: Choices,
    ) -> PyResult<Mechanism> {
        let mut source = Source::new(name, text);
        for (path, bytes) in tables {
            source = source.with_attachment(path, Ok(bytes));
        }
        Mechanism::open(py, source, choices)
    }

    /// Text of the description.
    #[getter]
    fn text(&self) -> &str {
        &self.source.text
    }

    /// Name of the file in messages.
    #[getter]
    fn file(&self) -> &str {
        &self.source.name
    }

    /// Contents of the tables that the description names and that could be read.
    #[getter]
    fn tables(&self) -> Vec<(String, Vec<u8>)> {
        let tables = self.source.attachments.iter();
        tables
            .filter_map(|it| Some((it.path.clone(), it.bytes.as_ref().ok()?.to_vec())))
            .collect()
    }

    /// Name of the mechanism.
    #[getter]
    fn name(&self) -> &str {
        &self.derived.system.mechanism.name
    }

    /// Requested motion; `None` for the only one.
    #[getter]
    fn motion(&self) -> Option<&str> {
        self.motion.as_deref()
    }

    /// Label of the chosen assembly; `None` for that of the design configuration.
    #[getter]
    fn assembly(&self) -> Option<&str> {
        self.assembly_label()
    }

    /// Documentation of the description.
    #[getter]
    fn docs(&self) -> String {
        joined(&self.derived.system.mechanism.docs)
    }

    /// Warnings of the description.
    #[getter]
    fn warnings(&self) -> Vec<Finding> {
        self.warnings.clone()
    }

    /// Names of the coordinates, in the order of q.
    #[getter]
    fn coordinates(&self) -> Vec<String> {
        let coordinates = self.derived.system.coordinates.iter();
        coordinates.map(|it| it.name.clone()).collect()
    }

    /// Names of the points.
    #[getter]
    fn points(&self) -> Vec<String> {
        let points = self.derived.system.outputs.iter();
        points.map(|it| it.name.clone()).collect()
    }

    /// True if forces move the mechanism.
    #[getter]
    fn is_free(&self) -> bool {
        !self.derived.system.mechanism.forces.free.is_empty()
    }

    /// Parameters and inputs in the order of the description.
    #[getter]
    fn controls(&self) -> Vec<Control> {
        let Derived { pool, system } = &self.derived;
        let mechanism = &system.mechanism;
        let control = |kind, name: &str, value, dimension, range, docs: &[String]| -> Control {
            let unit = Dimension::unit_if_known(dimension);
            (name.to_string(), kind, value, unit, range, joined(docs))
        };
        let parameters = mechanism.parameters.iter().map(|it| {
            let value = pool.graph.nominal(it.symbol);
            control(
                "parameter",
                &it.name,
                value,
                it.dimension,
                it.range,
                &it.docs,
            )
        });
        let inputs = mechanism.inputs.iter().map(|it| {
            let value = pool.graph.constant_value(it.signal[0]);
            control("input", &it.name, value, it.dimension, it.range, &it.docs)
        });
        parameters.chain(inputs).collect()
    }

    /// Pose of the design configuration, in the order of the coordinates.
    #[getter]
    fn drawn_pose(&self) -> Vec<f64> {
        let view = self.view();
        view.drawn_pose(&view.nominal_parameters()).0
    }
}

fn joined(lines: &[String]) -> String {
    let lines = lines.iter().map(|it| it.trim());
    lines.collect::<Vec<_>>().join("\n").trim().to_string()
}
