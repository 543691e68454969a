//! How close generated mechanisms say they are to a singular pose: against closed forms, 384 bits, the interpreter's
//! determinants, singular values and single precision.

use linkwright::{Closeness, Failure};
use linkwright_cli::closeness;
use linkwright_cli::monitor::Monitor;
use linkwright_cli::solved_interpreter::SolvedInterpreter;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::expr::Tape;
use linkwright_codegen::structure::{Step, determinant};
use linkwright_tests::description;
use linkwright_tests::stability::precise::Precise;
use nalgebra::DMatrix;

/// The measures of every loop at these times, or why there are none.
type Measured = Result<Vec<Vec<Closeness>>, Failure>;

/// A mechanism's function for them.
type Measures = fn(&[f64]) -> Measured;

macro_rules! monitored {
    ($name:ident, $module:ident, $mechanism:ident) => {
        #[allow(dead_code)]
        pub mod $name {
            linkwright::include_mechanism!($module);

            pub fn measures(times: &[f64]) -> super::Measured {
                let mut mechanism = $mechanism::assemble(times[0])?;
                let mut found = Vec::new();
                for &t in times {
                    let frame = mechanism.advance(t)?;
                    found.push(frame.closeness_of_each().to_vec());
                    assert_eq!(
                        frame.closeness(),
                        super::Closeness::closest(&frame.closeness_of_each())
                    );
                }
                Ok(found)
            }
        }
    };
}

mod all {
    use super::*;

    include!(concat!(env!("OUT_DIR"), "/monitoring.rs"));
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

/// The measures of a mechanism by its name, and those of the interpreter.
fn both(name: &str, measures: Measures) -> (Vec<Vec<Closeness>>, Monitor) {
    let found = measures(&times()).unwrap_or_else(|failure| panic!("{name}: {failure}"));
    let solved = SolvedInterpreter::new(&description::system(name)).expect("a plan");
    (found, Monitor::over(&solved, &times()))
}

/// Blocks with two and more unknowns, and angles that are measured along a line.
#[test]
fn what_generated_code_says_is_what_the_interpreter_monitors() {
    let compared: [(&str, Measures); 10] = [
        ("double_wishbone", all::double_wishbone::measures),
        ("excavator", all::excavator::measures),
        ("excavator_tool", all::excavator_tool::measures),
        ("folding", all::folding::measures),
        ("four_bar", all::four_bar::measures),
        ("sensed_four_bar", all::sensed_four_bar::measures),
        (
            "inverted_slider_crank",
            all::inverted_slider_crank::measures,
        ),
        ("platform_3rpr", all::platform_3rpr::measures),
        ("turning_guide", all::turning_guide::measures),
        ("two_guides", all::two_guides::measures),
    ];
    for (name, measures) in compared {
        let (found, monitor) = both(name, measures);
        let mut largest = 0.0_f64;
        for (loops, wanted) in found.iter().zip(&monitor.measures) {
            let wanted = wanted.as_ref().expect("a pose");
            assert_eq!(loops.len(), wanted.len(), "{name}");
            for (own, wanted) in loops.iter().zip(wanted) {
                largest = largest.max((own.determinant.abs() - wanted).abs());
            }
        }
        println!("{name}: {largest:.1e}");
        assert!(largest < 1e-13, "{name}: {largest:e}");
    }
}

/// Of one equation the interpreter knows the largest slope on the way, so it differs by a factor.
#[test]
fn one_equation_has_the_slope_that_the_interpreter_monitors() {
    let compared: [(&str, Measures); 2] = [
        ("disc_cam", all::disc_cam::measures),
        ("leveled_slider", all::leveled_slider::measures),
    ];
    for (name, measures) in compared {
        let (found, monitor) = both(name, measures);
        let ratios = found.iter().zip(&monitor.measures).map(|(own, wanted)| {
            let wanted = wanted.as_ref().expect("a pose");
            own[0].reciprocal_condition / wanted[0]
        });
        let ratios: Vec<f64> = ratios.collect();
        let spread = ratios.iter().map(|it| (it / ratios[0] - 1.0).abs());
        assert!(spread.fold(0.0, f64::max) < 1e-12, "{name}: {ratios:?}");
        assert!(0.0 < ratios[0] && ratios[0] <= 1.0, "{name}");
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
        let Ok(found) = all::folding::measures(&[0.5, t]) else {
            println!("refused at 1e-{exponent}");
            assert!(exponent > 10);
            continue;
        };
        let root = precise(3.0).sqrt();
        let cosine = precise(t).cos().over(&root);
        let cosine = precise(1.0).minus(&cosine);
        let square = precise(1.0).minus(&cosine.times(&cosine));
        let truth = square.sqrt().to_f64();
        let own = found[1][0];
        let error = (own.reciprocal_condition - truth).abs();
        // sin φ2 falls like the root of cos t, which is known to rounding of 1.
        let bound = 8.0 * f64::EPSILON / truth;
        println!("1e-{exponent}: {truth:e}, error {error:.1e} of {bound:.1e}");
        assert!(
            error <= bound,
            "{error:e} beyond {bound:e} at 1e-{exponent}"
        );
        assert_eq!(own.determinant.abs(), own.reciprocal_condition);
        assert_eq!(own.block, 1);
        assert!(own.to_string().starts_with("revolute P(1, 2): "), "{own}");
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
        let wanted = (1.0 - cosine * cosine).sqrt();
        let error = (frame.closeness().reciprocal_condition - wanted).abs();
        assert!(error < 1e-14, "{error:e} at {t}");
    }
}

/// The reciprocal condition of Newton blocks by the singular values of the Jacobian that the plan names.
#[test]
fn a_newton_block_has_the_condition_of_its_jacobian() {
    let compared: [(&str, Measures); 2] = [
        ("double_wishbone", all::double_wishbone::measures),
        ("platform_3rpr", all::platform_3rpr::measures),
    ];
    for (name, measures) in compared {
        let found = measures(&times()).expect("it moves");
        let solved = SolvedInterpreter::new(&description::system(name)).expect("a plan");
        let steps = solved.plan.blocks.iter().flat_map(|block| &block.steps);
        let step = steps
            .clone()
            .find(|step| matches!(step, Step::Newton { .. }));
        let mut graph = solved.system.mechanism.graph.clone();
        let jacobian = determinant(
            step.expect("a Newton block"),
            &solved.system.vector_form,
            &mut graph,
        )
        .jacobian;
        let size = jacobian.len();
        let tape = Tape::new(&graph, &jacobian.concat());
        let mut values = solved.begin(0.0);
        for (t, own) in times().into_iter().zip(found) {
            solved
                .solve(t, &solved.drawn_signs(), &mut values)
                .expect("a pose");
            let mut entries = vec![0.0; size * size];
            tape.evaluate(&values.symbols, &mut Vec::new(), &mut entries);
            let mut unit = DMatrix::from_row_slice(size, size, &entries);
            for mut column in unit.column_iter_mut() {
                let length = column.norm();
                column /= length;
            }
            let squares = unit.singular_values().map(|it| 1.0 / (it * it)).sum();
            let wanted = (size as f64 / squares).sqrt();
            let error = (own[0].reciprocal_condition - wanted).abs();
            assert!(error < 1e-12, "{name}: {error:e} at {t}");
        }
    }
}

#[test]
fn outputs_leave_the_measures_as_they_are() {
    let whole = all::excavator::measures(&times()).expect("it moves");
    let tool = all::excavator_tool::measures(&times()).expect("it moves");
    for (whole, tool) in whole.iter().zip(&tool) {
        for (one, other) in whole.iter().zip(tool) {
            assert!((one.determinant - other.determinant).abs() < 1e-15);
            assert_eq!(one.name, other.name);
        }
    }
    let closest = Closeness::closest(&whole[0]);
    let text = closest.to_string();
    assert!(
        text.starts_with("loop L-G-H: ")
            && text.ends_with("from singular, where c3 and the actuator c10-c9 are in line"),
        "{text}"
    );
}

#[test]
fn single_precision_measures_the_same() {
    let double = all::platform_3rpr::measures(&[0.0, 0.5]).expect("it moves");
    let mut platform = single::platform::MonitoringPlatform3rpr::assemble(0.0).expect("as drawn");
    let own = platform.advance(0.5).expect("it moves").closeness();
    let gap = (f64::from(own.reciprocal_condition) - double[1][0].reciprocal_condition).abs();
    assert!(gap < 1e-5, "{gap:e}");
    let exam = single::folding::MonitoringFolding::assemble(0.5).expect("as drawn");
    let double = all::folding::measures(&[0.5]).expect("as drawn");
    let own = exam.frame().closeness();
    let gap = (f64::from(own.determinant) - double[0][0].determinant).abs();
    assert!(
        gap < 1e-6 && own.is_below(1.0) && !own.is_below(0.1),
        "{gap:e}"
    );
}

#[test]
fn what_cannot_be_singular_says_so() {
    let mechanism = all::planetary_gear::MonitoringPlanetaryGear::assemble(0.0).expect("as drawn");
    let closeness = mechanism.frame().closeness();
    assert_eq!(closeness.reciprocal_condition, 1.0);
    assert_eq!(closeness.to_string(), "the mechanism: never singular");
}

/// Nothing is generated for it, and the module without the statement is the same but for it.
#[test]
fn without_the_statement_nothing_is_computed() {
    for name in description::names() {
        let source = description::source(&name);
        let module = linkwright_codegen::generate(&source)
            .expect("a module")
            .code;
        assert!(
            !module.contains("loseness") && !module.contains("Measure"),
            "{name}"
        );
        let end = source.text.rfind('}').expect("a brace");
        let text = format!("{}\nmonitor;\n{}", &source.text[..end], &source.text[end..]);
        let folder = linkwright_tests::files::repository().join("mechanisms");
        let source = linkwright_codegen::attach_files(Source::new(name.as_str(), text), &folder);
        let monitored = linkwright_codegen::generate(&source)
            .expect("a module")
            .code;
        assert!(
            monitored.contains("pub fn closeness(&self) -> Closeness"),
            "{name}"
        );
    }
}

#[test]
fn the_smallest_value_comes_near_what_check_finds() {
    let solved = SolvedInterpreter::new(&description::system("four_bar")).expect("a plan");
    let times: Vec<f64> = (0..=2000).map(|frame| 0.001 * f64::from(frame)).collect();
    let found = closeness::Closeness::new(&solved).approaches(&times);
    let own = all::four_bar::measures(&times).expect("it turns");
    let smallest = own.iter().map(|it| it[0].reciprocal_condition);
    let smallest = smallest.fold(f64::INFINITY, f64::min);
    // Sampled beside refined: a parabola at half a millisecond from its bottom.
    let gap = smallest - found[0].measure;
    assert!((0.0..1e-5).contains(&gap), "{gap:e}");
}
