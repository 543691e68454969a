//! Ranges of parameters and inputs: generated modules, the interpreter and lanes refuse the same values at the same frame.

use linkwright::lanes::Group;
use linkwright::{Blocks, Failure, FailureKind, Mechanism, Settings, Shell, Signal, Values};
use linkwright_codegen::stages::expr::LANES;
use linkwright_solver::{InputSignals, Interpreted};
use linkwright_tests::description;

mod limited_slider {
    linkwright::include_mechanism!(limited_slider);
}

use limited_slider::{INPUT_RANGES, Inputs, LimitedSlider, PARAMETER_RANGES, Parameters, describe};

/// Time between frames (s).
const STEP: f64 = 0.01;

/// An extension that exceeds 75 mm after arcsin(25/30)/3 s.
fn pushed(t: f64) -> Signal {
    let (sine, cosine) = (3.0 * t).sin_cos();
    Signal::new(0.05 + 0.03 * sine, 0.09 * cosine, -0.27 * sine)
}

fn interpreted() -> Interpreted {
    let derived = description::motions("limited_slider").remove(0);
    Interpreted::new(&derived).expect("a plan")
}

fn assembled(blocks: &Interpreted, inputs: &InputSignals) -> Shell<Interpreted> {
    let parameters = blocks.nominal_parameters();
    let (pose, modes) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
    let settings = Settings::default();
    let shell = Shell::assemble(
        blocks.clone(),
        &parameters,
        &pose,
        modes,
        0.0,
        inputs,
        settings,
    );
    shell.expect("as drawn")
}

#[test]
fn a_motion_ends_at_the_first_frame_outside_of_a_range() {
    let blocks = interpreted();
    let of = |t: f64| InputSignals(vec![pushed(t)]);
    let mut one = LimitedSlider::assemble(
        0.0,
        &Inputs {
            extension: pushed(0.0),
        },
    )
    .expect("drawn");
    let mut other = assembled(&blocks, &of(0.0));
    // The last lane stays in its range.
    let mut group: Group<Interpreted, LANES> = Group::new(blocks.clone());
    for lane in [0, LANES - 1] {
        group.put(lane, assembled(&blocks, &of(0.0)));
    }
    let rest = InputSignals(vec![Signal::constant(0.05)]);
    let end = (25.0_f64 / 30.0).asin() / 3.0;
    let last = (end / STEP).floor();
    for step in 1..=last as u32 {
        let t = f64::from(step) * STEP;
        let frame = one
            .advance(
                t,
                &Inputs {
                    extension: pushed(t),
                },
            )
            .expect("in the range");
        let instant = other.advance(t, &of(t)).expect("in the range");
        assert_eq!(frame.q.to_array()[..], *instant.frame().q.as_slice());
        let inputs = of(t);
        let supplied: [&InputSignals; LANES] =
            std::array::from_fn(|lane| if lane == 0 { &inputs } else { &rest });
        assert!(group.advance(&[t; LANES], &supplied).is_empty());
    }
    let t = (last + 1.0) * STEP;
    let (before, outside) = (*one.frame(), pushed(t));
    let failure = one
        .advance(t, &Inputs { extension: outside })
        .expect_err("outside");
    let expected = Failure {
        kind: FailureKind::OutsideRange {
            value: outside.value,
        },
        time: t,
        block: 0,
        iterations: 0,
        residual: 0.0,
        row: 0,
        input: Some(0),
    };
    assert_eq!(failure, expected);
    assert_eq!(*one.frame(), before);
    assert_eq!(other.advance(t, &of(t)).expect_err("outside"), expected);
    let inputs = of(t);
    let supplied: [&InputSignals; LANES] =
        std::array::from_fn(|lane| if lane == 0 { &inputs } else { &rest });
    assert_eq!(
        group
            .advance(&[t; LANES], &supplied)
            .lanes()
            .collect::<Vec<_>>(),
        [0]
    );
    assert_eq!(
        (group.failure(0), group.failure(LANES - 1)),
        (Some(expected), None)
    );
    let (failed, _) = group.frames_at(&[t; LANES], &supplied);
    assert_eq!(failed.lanes().collect::<Vec<_>>(), [0]);
    let words = format!(
        "input extension: {} m is outside of its range from 0.025 m to 0.075 m, at t = {t} s",
        outside.value
    );
    assert_eq!(describe(&failure).to_string(), words);
    assert_eq!(blocks.explained(&expected).to_string(), words);
    // Other calls refuse it as well; back in the range, the motion goes on.
    let inputs = Inputs { extension: outside };
    assert_eq!(
        one.frame_at(t, &inputs).expect_err("outside").kind,
        expected.kind
    );
    assert_eq!(
        one.recover(t, &inputs).expect_err("outside").kind,
        expected.kind
    );
    assert_eq!(LimitedSlider::assemble(t, &inputs).err(), Some(expected));
    let end = Signal::constant(0.075);
    one.advance(t, &Inputs { extension: end })
        .expect("the end belongs to the range");
}

/// In between, the polynomial through both ends exceeds 75 mm.
#[test]
fn inputs_between_two_frames_may_leave_the_range() {
    let at = |rate: f64| Inputs {
        extension: Signal::new(0.074, rate, 0.0),
    };
    let (first, last) = (at(0.02), at(-0.02));
    assert!(first.extension.towards(&last.extension, 2.0, 0.5).value > 0.08);
    let mut slider = LimitedSlider::assemble(0.0, &first).expect("as drawn");
    let frame = slider
        .advance(2.0, &last)
        .expect("both ends are in the range");
    assert!((frame.q.phi_crank - (std::f64::consts::FRAC_PI_3 + 6.0)).abs() < 1e-12);
}

#[test]
fn parameters_outside_of_their_ranges_are_refused_and_the_old_ones_kept() {
    let blocks = interpreted();
    let nominal = Parameters::default();
    let mut slider = LimitedSlider::assemble(0.0, &Inputs::default()).expect("as drawn");
    let mut shell = assembled(&blocks, &blocks.initial_inputs());
    for (place, range) in PARAMETER_RANGES.iter().enumerate() {
        assert_eq!(blocks.parameter_range(place), *range);
        let Some(range) = range else { continue };
        for (end, out) in range
            .ends
            .into_iter()
            .zip([f64::next_down as fn(f64) -> f64, f64::next_up])
        {
            let set = |value: f64| {
                let mut parameters = nominal;
                parameters.set(place, value);
                parameters
            };
            slider
                .set_parameters(&set(end))
                .expect("the end belongs to the range");
            slider.set_parameters(&nominal).expect("as drawn");
            let value = out(end);
            let failure = slider.set_parameters(&set(value)).expect_err("outside");
            assert_eq!(failure.kind, FailureKind::OutsideRange { value });
            assert_eq!((usize::from(failure.block), failure.input), (place, None));
            assert_eq!(*slider.parameters(), nominal);
            let again = LimitedSlider::assemble_for(&set(value), 0.0, &Inputs::default());
            assert_eq!(again.err(), Some(failure));
            let mut parameters = blocks.nominal_parameters();
            parameters.set(place, value);
            assert_eq!(shell.set_parameters(&parameters), Err(failure));
            let name = slider
                .shell()
                .blocks()
                .parameter_name(place)
                .expect("a name");
            let words = describe(&failure).to_string();
            assert!(
                words.starts_with(&format!("parameter {name}: {value} ")),
                "{words}"
            );
            assert!(
                words.contains(&format!("to {} {}", range.ends[1], range.unit)),
                "{words}"
            );
        }
    }
    let wrong = Parameters {
        r: f64::NAN,
        ..nominal
    };
    assert_eq!(
        slider.set_parameters(&wrong).expect_err("NaN").kind,
        FailureKind::NotFinite
    );
    let wrong = Parameters { l: 1e3, ..nominal };
    slider
        .set_parameters(&wrong)
        .expect("a rod without a range");
    assert_eq!(PARAMETER_RANGES[1], None);
    assert_eq!(INPUT_RANGES[0], blocks.input_range(0));
}

#[test]
fn the_modules_state_the_ranges() {
    let source = description::source("limited_slider");
    for (language, lines) in [
        (
            linkwright_codegen::Language::Rust,
            [
                "/// `r`, in m: 0.04 unless it is set. From 0.03 to 0.045 m.",
                "/// `extension`, in m: 0.05 and at rest unless it is supplied. From 0.025 to 0.075 m.",
            ],
        ),
        (
            linkwright_codegen::Language::C,
            [
                "`r`, in m: 0.04 unless it is set. From 0.03 to 0.045 m.",
                "`extension`, in m: 0.05 and at rest unless it is supplied. From 0.025 to 0.075 m.",
            ],
        ),
    ] {
        let options = linkwright_codegen::Options {
            language,
            ..Default::default()
        };
        let module = linkwright_codegen::generate(&source, &options).expect("a module");
        let files = module.files.iter().map(|it| it.text.as_str());
        let text: Vec<&str> = files.collect();
        let text = text.join("\n");
        for line in lines {
            assert!(text.contains(line), "{language:?}: {line}");
        }
    }
    // A description without ranges has no code for them.
    let options = linkwright_codegen::Options::default();
    let plain = linkwright_codegen::generate(&description::source("slider_given"), &options);
    let plain = plain.expect("a module");
    assert!(!plain.code().contains("RANGES"));
}
