//! Reports show the numbers of generated code, and a motion that ends for what no output requires alone.

use linkwright::{Blocks, Mechanism, Settings, Shell};
use linkwright_solver::{Interpreted, Modes, Movable, Moved, Schedule, View, follow};
use linkwright_tests::description;
use linkwright_tests::values::assembled_from;

use super::Outputs;
use super::both::{Frame, supplied};

/// Numbers that reports show of outputs and that differ from those of a frame.
pub fn shown<M>(view: &Interpreted, outputs: fn(&Frame<M>) -> Outputs) -> [usize; 2]
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let laws = view.input_laws();
    let mut moved = moved(view, view.drawn_branches());
    let blocks = M::Blocks::default();
    let mut generated = Shell::assemble(
        M::Blocks::default(),
        &blocks.nominal_parameters(),
        &blocks.drawn_pose(&blocks.nominal_parameters()),
        blocks.drawn_branches(),
        0.0,
        &supplied(&blocks, &laws.at(0.0)),
        Settings::default(),
    )
    .expect("as drawn");
    let schedule = Schedule::range(0.0, 1.0, 0.01).expect("a step");
    let [mut count, mut different] = [0, 0];
    let end = follow(&mut moved, &laws, &schedule.forward, |moved, _| {
        let instant = moved.instant();
        let inputs = supplied(&blocks, &laws.at(instant.t()));
        generated.advance(instant.t(), &inputs)?;
        let frame = generated.frame();
        let points = view.points(instant);
        let mut compare = |own: &[f64], same: &[f64]| {
            assert_eq!(own.len(), same.len());
            count += own.len();
            let pairs = own.iter().zip(same);
            different += pairs
                .filter(|(own, same)| own.to_bits() != same.to_bits())
                .count();
        };
        for (name, level, own) in outputs(frame) {
            let unknowns = view.system().vector_form.unknowns.iter();
            let unknown = unknowns.clone().find(|it| it.name == name);
            let same = match unknown {
                Some(unknown) => {
                    let symbol = unknown.symbols()[level];
                    let slot = view.layout().slot(symbol).expect("every unknown");
                    vec![instant.values()[slot]]
                }
                None => {
                    let point = points[place_of(view, name)];
                    [point.position, point.velocity][level].to_vec()
                }
            };
            compare(&own, &same);
        }
        for place in (0..).take_while(|&place| blocks.point_name(place).is_some()) {
            let point = blocks.point(frame, place).expect("a point");
            let name = blocks.point_name(place).expect("a name");
            let same = points[place_of(view, name)];
            compare(&point.position, &same.position);
            compare(&point.velocity, &same.velocity);
            compare(&point.acceleration, &same.acceleration);
        }
        Ok::<(), linkwright::Failure>(())
    });
    assert!(matches!(end, Ok(None)), "the motion is complete");
    [count, different]
}

/// Mechanism with nominal parameters in these modes at t = 0.
fn moved(view: &Interpreted, modes: Modes) -> Moved<Interpreted> {
    let pose = view.drawn_pose(&view.nominal_parameters());
    Moved::assemble(view.clone(), &pose, modes, 0.0).expect("an assembly")
}

/// Index of the point with the name of an output.
fn place_of(view: &Interpreted, name: &str) -> usize {
    let mut names = (0..).map_while(|place| view.point_name(place));
    let place = names.position(|it| it.eq_ignore_ascii_case(name));
    place.expect("a point of the same name")
}

/// Crank of a four-bar whose coupler and rocker reach as far as |BD| = 1.9: cos φ = (1 + 1.5² − 1.9²)/3 = −0.12.
const OUT_OF_REACH: &str = "mechanism reaching {
    point A = (0, 0), D = (1.5, 0);
    body crank   at (0, 0, 40deg)      { A: (0, 0), B: (1, 0) }
    body coupler at (0.77, 0.64, 0deg) { B: (0, 0), C: (1, 0) }
    body rocker  at (1.5, 0, 70deg)    { D: (0, 0), C: (0.9, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 0.7 + t;
";

#[test]
fn only_reports_end_where_omitted_bodies_are_out_of_reach() {
    let end_of = |output: &str| {
        let derived = description::written(&format!("{OUT_OF_REACH}{output}}}"));
        let view = Interpreted::new(&derived).expect("a plan");
        let laws = view.input_laws();
        let mut moved = moved(&view, view.drawn_branches());
        let schedule = Schedule::range(0.0, 2.0, 0.25).expect("a step");
        let see = |_: &_, _| Ok::<(), std::convert::Infallible>(());
        let end = follow(&mut moved, &laws, &schedule.forward, see);
        let end = end.expect("nothing fails").expect("an early end");
        let limit = (-0.12_f64).acos() - 0.7;
        assert!((end.failure.time - limit).abs() < 1e-6, "{end:?}");
        moved.ended(&end)
    };
    let goes_on = "; generated code, which computes its outputs alone, goes on";
    let [whole, part] = ["", "output B;"].map(end_of);
    assert_eq!(part, format!("{whole}{goes_on}"));
    // An output of the loop ends generated code, too.
    assert_eq!(end_of("output position C;"), whole);

    let derived = description::written(&format!("{OUT_OF_REACH}output B;}}"));
    let emitted = Interpreted::emitted(&derived).expect("a plan");
    let shell = assembled_from(emitted.clone(), &[], 0.0, Settings::default());
    let mut shell = shell.expect("as drawn");
    let frame = shell.advance(2.0, &Default::default()).expect("a crank");
    let motion = emitted.point(frame, 0).expect("the output");
    for (found, expected) in motion
        .position
        .into_iter()
        .zip([2.7_f64.cos(), 2.7_f64.sin()])
    {
        assert!((found - expected).abs() < 1e-14, "{motion:?}");
    }
    let rocker = emitted
        .system()
        .coordinates
        .last()
        .expect("phi of the rocker");
    let slots = [rocker.position, rocker.rate].map(|it| emitted.layout().slot(it));
    assert_eq!(slots, [None; 2], "what is not computed has no value");
    assert!(frame.q().is_empty());
}

#[test]
fn outputs_are_those_of_the_chosen_mode() {
    let derived = description::written(&format!("{OUT_OF_REACH}output position C;}}"));
    let view = Interpreted::new(&derived).expect("a plan");
    let drawn = view.drawn_branches();
    let opposite = Modes {
        closed: drawn.closed.iter().map(|it| it.opposite()).collect(),
        ..drawn.clone()
    };
    let place = place_of(&view, "C");
    let [own, other] = [drawn, opposite].map(|modes| {
        let moved = moved(&view, modes);
        view.points(moved.instant())[place].position
    });
    // C is in one distance from B and from D in both modes, on either side of BD.
    let (b, d) = ([0.7_f64.cos(), 0.7_f64.sin()], [1.5, 0.0]);
    let distance = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    for c in [own, other] {
        assert!((distance(b, c) - 1.0).abs() < 1e-14, "{c:?}");
        assert!((distance(d, c) - 0.9).abs() < 1e-14, "{c:?}");
    }
    assert!(distance(own, other) > 1.0, "{own:?} {other:?}");
}
