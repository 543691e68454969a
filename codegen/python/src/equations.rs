//! Evaluates the textbook formulation, and writes equations and code as text.

use linkwright::Equations as _;
use linkwright::nalgebra::{DMatrix, DVector, Dim as _};
use linkwright_codegen::stages::emit::derivation::Derivation;
use linkwright_codegen::stages::emit::{self, Notation};
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::{Language, Options, Scalar, generate};
use linkwright_solver::View as _;
use linkwright_solver::textbook::TextbookEquations;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, ToPyArray as _};
use pyo3::prelude::*;

use crate::findings::{Finding, raised, refused};
use crate::mechanism::Mechanism;

/// Φ, Φ_q, Φ_t and γ at a pose.
type Evaluated<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

#[pymethods]
impl Mechanism {
    /// Evaluates Φ, Φ_q, Φ_t and γ at a pose, its rates and a time (s).
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        pose: PyReadonlyArray1<'py, f64>,
        rates: PyReadonlyArray1<'py, f64>,
        t: f64,
    ) -> PyResult<Evaluated<'py>> {
        let view = self.view();
        let equations = TextbookEquations::new(view.pool(), view.system());
        let count = equations.dimension().value();
        let vector = |array: &PyReadonlyArray1<'_, f64>, name: &str| {
            let vector: Vec<f64> = array.as_array().iter().copied().collect();
            match vector.len() == count {
                true => Ok(DVector::from_vec(vector)),
                false => Err(refused(format!(
                    "{name} has {} numbers for {count} coordinates",
                    vector.len()
                ))),
            }
        };
        let (q, qd) = (vector(&pose, "the pose")?, vector(&rates, "the rate")?);
        let mut jacobian = DMatrix::zeros(count, count);
        equations.jacobian(&q, t, &mut jacobian);
        let empty = || DVector::zeros(count);
        let (mut residual, mut time_derivative, mut gamma) = (empty(), empty(), empty());
        equations.residual(&q, t, &mut residual);
        equations.time_derivative(&q, t, &mut time_derivative);
        equations.gamma(&q, &qd, t, &mut gamma);
        let rows: Vec<Vec<f64>> = jacobian
            .row_iter()
            .map(|it| it.iter().copied().collect())
            .collect();
        Ok((
            residual.as_slice().to_pyarray(py),
            PyArray2::from_vec2(py, &rows).map_err(|error| refused(error.to_string()))?,
            time_derivative.as_slice().to_pyarray(py),
            gamma.as_slice().to_pyarray(py),
        ))
    }

    /// Names of the equations, in the order of Φ.
    #[getter]
    fn rows(&self) -> Vec<String> {
        let rows = self.derived.system.rows.iter();
        rows.map(|it| it.name.clone()).collect()
    }

    /// Writes Φ, Φ_q, Φ_t and γ: as `text`, as `unicode`, or as a fragment of `latex`.
    fn equations_as(&self, py: Python<'_>, form: &str) -> String {
        py.detach(|| match form {
            "latex" => emit::latex::inspect_fragment(&[(&self.derived, Vec::new())]),
            "unicode" => emit::text::inspect(&self.derived, Notation::Unicode),
            _ => emit::text::inspect(&self.derived, Notation::Ascii),
        })
    }

    /// Writes the derivation of the solution: as `text`, as `unicode`, as a document of `latex`, as its `fragment`, or as `html` with MathML.
    fn derivation_as(&self, py: Python<'_>, form: &str) -> PyResult<String> {
        let derived = self.derived.clone();
        py.detach(|| {
            let derivation = Derivation::of(derived, Shift::Efforts)
                .map_err(|_| refused("the equations have no order of solution"))?;
            Ok(match form {
                "latex" => derivation.latex(),
                "fragment" => derivation.latex_fragment(),
                "unicode" => derivation.text(Notation::Unicode),
                "html" => {
                    let page = derivation.html();
                    let sections = page.sections.iter();
                    let sections =
                        sections.map(|it| format!("<h4>{}</h4>\n{}", it.heading, it.body));
                    sections.collect::<Vec<_>>().join("\n")
                }
                _ => derivation.text(Notation::Ascii),
            })
        })
    }

    /// Generates code: pairs of a file name and its text. The code has the values of the description.
    fn code(
        &self,
        py: Python<'_>,
        language: &str,
        single: bool,
    ) -> PyResult<Vec<(String, String)>> {
        let mut languages = Language::ALL.into_iter();
        let language_of_name = languages.find(|it| it.conventions().option == language);
        let language = language_of_name
            .ok_or_else(|| refused(format!("no code is generated in `{language}`")))?;
        let options = Options {
            language,
            scalar: if single { Scalar::F32 } else { Scalar::F64 },
            ..Options::default()
        };
        match py.detach(|| generate(&self.source, &options)) {
            Ok(generated) => Ok(generated
                .files
                .into_iter()
                .map(|it| (it.name, it.text))
                .collect()),
            Err(findings) => {
                let findings = findings.iter().map(|it| Finding::of(it, &self.source));
                Err(raised(py, findings.collect()))
            }
        }
    }
}
