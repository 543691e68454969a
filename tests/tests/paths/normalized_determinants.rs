//! Distances of generated mechanisms from singular poses, against closed forms, 384 bits, the interpreter's
//! determinants, singular values and single precision.

use linkwright::{Blocks, Failure, Mechanism, NormalizedDeterminant, Settings, Shell};
use linkwright_codegen::Options;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::approach::{Approach, Watch};
use linkwright_solver::reader::Reader;
use linkwright_solver::{Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::stability::precise::Precise;
use linkwright_tests::values::{assembled, assembled_from};
use nalgebra::DMatrix;

/// Normalized determinants of every loop at these times, or the failure.
type Measured = Result<Vec<Vec<NormalizedDeterminant>>, Failure>;

/// A mechanism's function for them.
type Measures = fn(&[f64]) -> Measured;

/// Normalized determinants of all frames of a mechanism at these times; its frames give those of each loop, and the
/// smallest.
fn measures<M>(
    times: &[f64],
    of: impl Fn(&<M::Blocks as Blocks>::Frame) -> (Vec<NormalizedDeterminant>, NormalizedDeterminant),
) -> Measured
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let mut mechanism: M = assembled(times[0])?;
    let shell = mechanism.shell_mut();
    let inputs = shell.blocks().initial_inputs();
    let mut measures = Vec::new();
    for &t in times {
        let (each, closest) = of(shell.advance(t, &inputs)?);
        assert_eq!(closest, NormalizedDeterminant::closest(&each));
        measures.push(each);
    }
    Ok(measures)
}

#[allow(dead_code)]
mod all {
    use super::{Measures, measures};

    include!(concat!(env!("OUT_DIR"), "/monitoring.rs"));
}

/// The measures of a mechanism.
fn of(name: &str) -> Measures {
    let (_, measures) = all::ALL
        .iter()
        .find(|(own, _)| *own == name)
        .expect("it is listed");
    *measures
}

#[allow(dead_code)]
mod single {
    pub mod folding {
        linkwright::include_mechanism!(monitoring_folding_single);
    }
    pub mod platform {
        linkwright::include_mechanism!(monitoring_platform_3rpr_single);
    }
}

/// Frames at a hundredth of a second.
fn times() -> Vec<f64> {
    (0..=120).map(|frame| 0.01 * f64::from(frame)).collect()
}

/// Interpreter of a description of the gallery.
fn interpreted(name: &str) -> Shell<Interpreted> {
    let solved = Interpreted::new(&description::system(name)).expect("a plan");
    assembled_from(solved, &[], 0.0, Settings::default()).expect("as drawn")
}

/// Magnitudes of the interpreter's determinants at these times, and its closest approaches.
fn watched(name: &str, times: &[f64]) -> (Vec<Vec<f64>>, Vec<Approach>) {
    let mut shell = interpreted(name);
    let laws = shell.blocks().input_laws();
    let measures = shell.blocks().measures().expect("it has parts");
    let mut watch = Watch::new(measures, laws.clone());
    let seen = times.iter().map(|&t| {
        shell.advance(t, &laws.at(t)).expect("a pose");
        watch.see(&shell)
    });
    let seen = seen.collect();
    (seen, watch.finish(&shell))
}

/// The measures of generated code, and those of the interpreter.
fn both(name: &str) -> (Vec<Vec<NormalizedDeterminant>>, Vec<Vec<f64>>) {
    let generated = of(name)(&times()).unwrap_or_else(|failure| panic!("{name}: {failure}"));
    let (wanted, _) = watched(name, &times());
    (generated, wanted)
}

/// Blocks with two and more unknowns, and angles that are measured along a line.
#[test]
fn generated_determinants_are_those_of_the_interpreter() {
    let compared = [
        "double_wishbone",
        "excavator",
        "excavator_tool",
        "folding",
        "four_bar",
        "sensed_four_bar",
        "inverted_slider_crank",
        "platform_3rpr",
        "turning_guide",
        "two_guides",
    ];
    for name in compared {
        let (found, wanted) = both(name);
        let mut largest = 0.0_f64;
        for (loops, wanted) in found.iter().zip(&wanted) {
            assert_eq!(loops.len(), wanted.len(), "{name}");
            for (own, wanted) in loops.iter().zip(wanted) {
                largest = largest.max((own.determinant.abs() - wanted).abs());
            }
        }
        println!("{name}: {largest:.1e}");
        assert!(largest < 1e-13, "{name}: {largest:e}");
    }
}

/// A block of one equation has no angle between rows; its slope is scaled, and 1 if larger.
#[test]
fn one_equation_has_the_slope_that_the_interpreter_monitors() {
    for name in ["disc_cam", "leveled_slider"] {
        let (found, wanted) = both(name);
        let measures = interpreted(name).blocks().measures().expect("it has parts");
        let part = &measures.parts()[0];
        assert!(part.is_relative, "{name}");
        for (own, wanted) in found.iter().zip(&wanted) {
            let (own, wanted) = (own[0].reciprocal_condition, part.bounded(wanted[0]));
            assert!((own - wanted).abs() < 1e-12, "{name}: {own} {wanted}");
            assert!(0.0 < own && own <= 1.0, "{name}");
        }
    }
}

/// `a` of 384 bits.
fn precise(a: f64) -> Precise {
    Precise::from_f64(a)
}

/// The exam with φ1 = t: det Φ_q = ±√3 sin φ2 over √3, and cos φ2 = 1 − cos φ1 / √3.
#[test]
fn the_exam_is_as_far_as_the_sine_of_its_rod() {
    for exponent in 1..13 {
        let end = std::f64::consts::FRAC_PI_2;
        let t = end - 10_f64.powi(-exponent);
        let Ok(found) = of("folding")(&[0.5, t]) else {
            println!("refused at 1e-{exponent}");
            assert!(exponent > 10);
            continue;
        };
        let root = precise(3.0).sqrt();
        let cosine = precise(t).cos().over(&root);
        let cosine = precise(1.0).minus(&cosine);
        let square = precise(1.0).minus(&cosine.times(&cosine));
        let truth = square.sqrt().to_f64();
        let loop_determinant = found[1][0];
        let error = (loop_determinant.reciprocal_condition - truth).abs();
        // sin φ2 falls like the root of cos t, which is known to rounding of 1.
        let bound = 8.0 * f64::EPSILON / truth;
        println!("1e-{exponent}: {truth:e}, error {error:.1e} of {bound:.1e}");
        assert!(
            error <= bound,
            "{error:e} beyond {bound:e} at 1e-{exponent}"
        );
        assert_eq!(
            loop_determinant.determinant.abs(),
            loop_determinant.reciprocal_condition
        );
        assert_eq!(loop_determinant.block, 1);
        assert!(
            loop_determinant
                .to_string()
                .starts_with("revolute P(1, 2): "),
            "{loop_determinant}"
        );
    }
}

/// The sine of the transmission angle by the law of cosines, with the lengths of the description.
#[test]
fn a_four_bar_is_as_far_as_the_sine_of_its_transmission_angle() {
    // The lengths of the file, in m.
    let (crank, coupler, rocker, ground) = (0.04, 0.12, 0.08, 0.1_f64);
    let mut mechanism = all::four_bar::MonitoringFourBar::assemble(0.0).expect("as drawn");
    for t in times() {
        let frame = mechanism.advance(t).expect("it turns");
        let (sine, cosine) = frame.q.phi_crank.sin_cos();
        let gap = (crank * cosine - ground).hypot(crank * sine);
        let product = 2.0 * coupler * rocker;
        let cosine = (coupler * coupler + rocker * rocker - gap * gap) / product;
        let transmission_sine = (1.0 - cosine * cosine).sqrt();
        let error = (frame.smallest_determinant().reciprocal_condition - transmission_sine).abs();
        assert!(error < 1e-14, "{error:e} at {t}");
    }
}

/// The reciprocal condition of Newton blocks by the singular values of the Jacobian that the plan names.
#[test]
fn a_newton_block_has_the_condition_of_its_jacobian() {
    for name in ["double_wishbone", "platform_3rpr"] {
        let frames = of(name)(&times()).expect("it moves");
        let mut shell = interpreted(name);
        let solved = shell.blocks().clone();
        let mut forms = solved.program().forms.iter().flatten();
        let newton = forms.find(|form| form.modes().is_none());
        let mut draft = solved.pool().draft();
        let jacobian = newton
            .expect("a Newton block")
            .determinant(&mut draft)
            .jacobian;
        let size = jacobian.len();
        let entries = Reader::new(&draft.graph, solved.layout(), &jacobian.concat());
        let inputs = solved.initial_inputs();
        for (t, own) in times().into_iter().zip(frames) {
            let instant = shell.advance(t, &inputs).expect("a pose");
            let entries = entries.values(instant);
            let mut unit = DMatrix::from_row_slice(size, size, &entries);
            for mut column in unit.column_iter_mut() {
                let length = column.norm();
                column /= length;
            }
            let squares = unit.singular_values().map(|it| 1.0 / (it * it)).sum();
            let reciprocal_condition = (size as f64 / squares).sqrt();
            let error = (own[0].reciprocal_condition - reciprocal_condition).abs();
            assert!(error < 1e-12, "{name}: {error:e} at {t}");
        }
    }
}

#[test]
fn outputs_leave_the_measures_as_they_are() {
    let whole = of("excavator")(&times()).expect("it moves");
    let tool = of("excavator_tool")(&times()).expect("it moves");
    for (whole, tool) in whole.iter().zip(&tool) {
        for (one, other) in whole.iter().zip(tool) {
            assert!((one.determinant - other.determinant).abs() < 1e-15);
            assert_eq!(one.name, other.name);
        }
    }
    let closest = NormalizedDeterminant::closest(&whole[0]);
    let text = closest.to_string();
    assert!(
        text.starts_with("loop L-G-H: ")
            && text.ends_with("from singular, where c3 and the actuator c10-c9 are collinear"),
        "{text}"
    );
}

#[test]
fn single_precision_measures_the_same() {
    let double = of("platform_3rpr")(&[0.0, 0.5]).expect("it moves");
    let mut platform = single::platform::MonitoringPlatform3rpr::assemble(0.0).expect("as drawn");
    let smallest = platform
        .advance(0.5)
        .expect("it moves")
        .smallest_determinant();
    let gap = (f64::from(smallest.reciprocal_condition) - double[1][0].reciprocal_condition).abs();
    assert!(gap < 1e-5, "{gap:e}");
    let exam = single::folding::MonitoringFolding::assemble(0.5).expect("as drawn");
    let double = of("folding")(&[0.5]).expect("as drawn");
    let smallest = exam.frame().smallest_determinant();
    let gap = (f64::from(smallest.determinant) - double[0][0].determinant).abs();
    assert!(
        gap < 1e-6 && smallest.is_below(1.0) && !smallest.is_below(0.1),
        "{gap:e}"
    );
}

#[test]
fn blocks_that_cannot_be_singular_report_it() {
    let mechanism = all::planetary_gear::MonitoringPlanetaryGear::assemble(0.0).expect("as drawn");
    let smallest = mechanism.frame().smallest_determinant();
    assert_eq!(smallest.reciprocal_condition, 1.0);
    assert_eq!(smallest.to_string(), "the mechanism: never singular");
}

/// A module without the statement differs only by the function.
#[test]
fn without_the_statement_nothing_is_computed() {
    for name in description::names() {
        let source = description::source(&name);
        let module = linkwright_codegen::generate(&source, &Options::default())
            .expect("a module")
            .code()
            .to_string();
        assert!(
            !module.contains("loseness") && !module.contains("Measure"),
            "{name}"
        );
        let end = source.text.rfind('}').expect("a brace");
        let text = format!("{}\nmonitor;\n{}", &source.text[..end], &source.text[end..]);
        let folder = linkwright_tests::files::repository().join("mechanisms");
        let source = linkwright_codegen::stages::files::attach_files(
            Source::new(name.as_str(), text),
            &folder,
        );
        let monitored = linkwright_codegen::generate(&source, &Options::default())
            .expect("a module")
            .code()
            .to_string();
        assert!(
            monitored.contains("pub fn smallest_determinant(&self) -> NormalizedDeterminant"),
            "{name}"
        );
    }
}

#[test]
fn the_smallest_value_comes_near_what_check_finds() {
    let times: Vec<f64> = (0..=2000).map(|frame| 0.001 * f64::from(frame)).collect();
    let (_, found) = watched("four_bar", &times);
    let determinants = of("four_bar")(&times).expect("it turns");
    let smallest = determinants.iter().map(|it| it[0].reciprocal_condition);
    let smallest = smallest.fold(f64::INFINITY, f64::min);
    // Sampling against refinement: a parabola half a millisecond from its minimum.
    let gap = smallest - found[0].measure;
    assert!((0.0..1e-5).contains(&gap), "{gap:e}");
}

/// A parallelogram passes through a singular pose in each half turn, whether or not a frame falls on it.
#[test]
fn singular_poses_that_a_motion_passes_are_counted() {
    use std::f64::consts::{FRAC_PI_2, PI};
    for step in [0.1, FRAC_PI_2 / 8.0, 0.7] {
        let frames = (4.25 * PI / step) as u32;
        let times: Vec<f64> = (0..=frames).map(|it| step * f64::from(it)).collect();
        let (_, approaches) = watched("parallelogram", &times);
        let [approach] = &approaches[..] else {
            panic!("{} parts", approaches.len());
        };
        let passed = (f64::from(frames) * step / PI + 0.5).floor() as usize;
        assert!(approach.crosses && approach.measure == 0.0, "step {step}");
        assert_eq!(approach.times, passed, "step {step}");
        let off = approach.instant.t() - FRAC_PI_2;
        assert!(off.abs() < 1e-8, "step {step}: {off:e}");
    }
}
