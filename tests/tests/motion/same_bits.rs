//! The interpreter computes the values of generated code, bit by bit: every motion of every description that is
//! compiled, along its path, with other parameters and inputs, back and forth and to its limits.

use linkwright::math::Real;
use linkwright::{Blocks, Failure, Mechanism, Settings, Shell, Values};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{InputSignals, Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::values::{assembled_from, filled, numbers};

/// Kinds of compared numbers.
const KINDS: [&str; 7] = [
    "pose",
    "velocity",
    "acceleration",
    "point",
    "force",
    "derivative",
    "failure",
];

/// Number of values of points under `output` that differ. Generated code computes these points in their own block, and the interpreter
/// from coordinates.
const DIFFERENT: usize = 1_419;

/// Numbers of compared and of different values, for each kind.
type Tally = [[usize; 2]; KINDS.len()];

/// Motion of a description that is compiled.
pub struct Compared {
    name: &'static str,
    motion: usize,
    compare: fn(&Derived) -> Tally,
}

type Frame<M> = <<M as Mechanism>::Blocks as Blocks>::Frame;

/// Values of frames that `output` limits: names of coordinates, 0 to 2 for the levels, and values.
type Outputs = Vec<(&'static str, usize, f64)>;

/// Compiled mechanism and interpreted one, which are moved together.
struct Both<'a, M: Mechanism> {
    generated: Option<Shell<M::Blocks>>,
    interpreted: Option<Shell<Interpreted>>,
    view: &'a Interpreted,
    outputs: fn(&Frame<M>) -> Outputs,
    forces: fn(&Frame<M>) -> Vec<f64>,
    derivatives: fn(&Frame<M>) -> Vec<f64>,
    tally: Tally,
}

impl<M> Both<'_, M>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    /// Assembles both for these parameters.
    fn assemble(&mut self, parameters: &[f64], inputs: &InputSignals, t: f64) {
        let blocks = M::Blocks::default();
        let values = filled(blocks.nominal_parameters(), parameters);
        let generated = Shell::assemble(
            M::Blocks::default(),
            &values,
            &blocks.drawn_pose(&values),
            blocks.drawn_branches(),
            t,
            &supplied(&blocks, inputs),
            Settings::default(),
        );
        let values = filled(self.view.nominal_parameters(), parameters);
        let interpreted = Shell::assemble(
            self.view.clone(),
            &values,
            &self.view.drawn_pose(&values),
            self.view.drawn_branches(),
            t,
            inputs,
            Settings::default(),
        );
        let failures = [generated.as_ref().err(), interpreted.as_ref().err()];
        let has_both = self.failed(failures);
        (self.generated, self.interpreted) = (generated.ok(), interpreted.ok());
        if has_both {
            self.frames();
        }
    }

    /// Moves both.
    fn advance(&mut self, inputs: &InputSignals, t: f64) {
        let (Some(generated), Some(interpreted)) = (&mut self.generated, &mut self.interpreted)
        else {
            return;
        };
        let compiled_inputs = supplied(generated.blocks(), inputs);
        let failures = [
            generated.advance(t, &compiled_inputs).err(),
            interpreted.advance(t, inputs).err(),
        ];
        if self.failed(failures.each_ref().map(Option::as_ref)) {
            self.frames();
        }
    }

    /// Changes the parameters of both during the motion.
    fn change(&mut self, parameters: &[f64]) {
        let (Some(generated), Some(interpreted)) = (&mut self.generated, &mut self.interpreted)
        else {
            return;
        };
        let compiled_parameters = filled(generated.parameters().clone(), parameters);
        let same = filled(interpreted.parameters().clone(), parameters);
        let failures = [
            generated.set_parameters(&compiled_parameters).err(),
            interpreted.set_parameters(&same).err(),
        ];
        self.failed(failures.each_ref().map(Option::as_ref));
    }

    /// Compares failures; true if there is none.
    fn failed(&mut self, failures: [Option<&Failure>; 2]) -> bool {
        let [own, other] = failures.map(|it| it.map(|failure| format!("{failure:?}")));
        if own.is_some() || other.is_some() {
            self.tally[6][0] += 1;
            self.tally[6][1] += usize::from(own != other);
        }
        own.is_none() && other.is_none()
    }

    /// Compares the last frames.
    fn frames(&mut self) {
        let (Some(generated), Some(interpreted)) = (&self.generated, &self.interpreted) else {
            return;
        };
        let (frame, instant) = (generated.frame(), interpreted.frame());
        let (blocks, view) = (generated.blocks(), interpreted.blocks());
        let mut pairs: [Vec<[f64; 2]>; 6] = Default::default();
        pairs[0].push([M::Blocks::time(frame), Interpreted::time(instant)]);
        let coordinates = (0..).map_while(|place| blocks.coordinate(frame, place));
        for (place, own) in coordinates.enumerate() {
            let same = view.coordinate(instant, place).expect("a coordinate");
            for level in 0..3 {
                pairs[level].push([own[level], same[level]]);
            }
        }
        for (name, level, own) in (self.outputs)(frame) {
            let mut names = (0..).map_while(|it| view.coordinate_name(it));
            let place = names.position(|it| it == name).expect("a coordinate");
            let same = view.coordinate(instant, place).expect("a coordinate");
            pairs[level].push([own, same[level]]);
        }
        let points = (0..).map_while(|place| blocks.point(frame, place));
        for (place, own) in points.enumerate() {
            let name = blocks.point_name(place).expect("a name");
            let mut names = (0..).map_while(|it| view.point_name(it));
            // Names of outputs are those of fields.
            let same = names.position(|it| it.eq_ignore_ascii_case(name));
            let same = same.and_then(|place| view.point(instant, place));
            let same = same.expect("a point of the same name");
            for (own, same) in [
                (own.position, same.position),
                (own.velocity, same.velocity),
                (own.acceleration, same.acceleration),
            ] {
                pairs[3].extend([0, 1].map(|axis| [own[axis], same[axis]]));
            }
        }
        let requests = [
            ((self.forces)(frame), view.forces(instant)),
            ((self.derivatives)(frame), view.derivatives(instant)),
        ];
        for (pairs, (own, same)) in pairs[4..].iter_mut().zip(requests) {
            if !own.is_empty() {
                let same = same.expect("columns");
                assert_eq!(own.len(), same.len());
                pairs.extend(own.into_iter().zip(same).map(|(own, same)| [own, same]));
            }
        }
        for (tally, pairs) in self.tally.iter_mut().zip(pairs) {
            let differs = |[own, same]: &&[f64; 2]| own.to_bits() != same.to_bits();
            tally[0] += pairs.len();
            tally[1] += pairs.iter().filter(differs).count();
        }
    }
}

/// Inputs of a compiled mechanism.
fn supplied<B: Blocks<Scalar = f64>>(blocks: &B, inputs: &InputSignals) -> B::Inputs {
    let mut supplied = blocks.initial_inputs();
    assert_eq!(supplied.count(), inputs.count());
    for place in 0..inputs.count() {
        supplied.set(place, inputs.value(place).expect("an input"));
    }
    supplied
}

/// Moves a compiled mechanism and an interpreted one, and compares both.
fn compare<M>(
    derived: &Derived,
    outputs: fn(&Frame<M>) -> Outputs,
    forces: fn(&Frame<M>) -> Vec<f64>,
    derivatives: fn(&Frame<M>) -> Vec<f64>,
) -> Tally
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let view = Interpreted::new(derived).expect("a plan");
    let laws = view.input_laws();
    let nominal = numbers(&view.nominal_parameters());
    let mut both = Both::<M> {
        generated: None,
        interpreted: None,
        view: &view,
        outputs,
        forces,
        derivatives,
        tally: Tally::default(),
    };
    // Inputs that follow laws, and inputs of a caller that follow none.
    let other = |t: f64| {
        let mut inputs = laws.at(t);
        for (place, signal) in (0..).zip(&mut inputs.0) {
            let phase = 3.0 * t + f64::from(place);
            signal.value += 0.02 * phase.sin();
            signal.rate += 0.06 * phase.cos();
            signal.acceleration -= 0.18 * phase.sin();
        }
        inputs
    };
    both.assemble(&nominal, &laws.at(0.0), 0.0);
    for frame in 1..=200 {
        let t = 0.01 * f64::from(frame);
        both.advance(&laws.at(t), t);
    }
    // Large steps, back, and beyond the range.
    for t in [2.5, 1.0, 1.3, 4.0, 0.0, -0.7, 30.0] {
        both.advance(&laws.at(t), t);
    }
    both.assemble(&nominal, &other(0.0), 0.0);
    for frame in 1..=50 {
        let t = 0.01 * f64::from(frame);
        both.advance(&other(t), t);
    }
    for factor in [1.01, 0.97, 1.3, -1.0] {
        let changed: Vec<f64> = (0..)
            .zip(&nominal)
            .map(|(place, value)| match place % 2 {
                0 => factor * value,
                _ => *value,
            })
            .collect();
        both.assemble(&changed, &other(0.1), 0.1);
        both.assemble(&nominal, &laws.at(0.0), 0.0);
        both.change(&changed);
        for frame in 1..=20 {
            let t = 0.02 * f64::from(frame);
            both.advance(&laws.at(t), t);
        }
    }
    both.tally
}

#[test]
fn interpreted_and_generated_numbers_are_the_same() {
    let mut all = [0; KINDS.len()];
    let mut of_outputs = 0;
    for Compared {
        name,
        motion,
        compare,
    } in ALL
    {
        let derived = &description::motions(name)[*motion];
        let mut tally = compare(derived);
        let [pose, _, _, point, ..] = &mut tally;
        assert!(pose[0] > 100, "{name}: hardly any frame");
        if !derived.system.mechanism.requests.is_empty() {
            of_outputs += std::mem::take(&mut point[1]);
        }
        for (kind, (sum, [count, different])) in KINDS.iter().zip(all.iter_mut().zip(tally)) {
            *sum += count;
            assert_eq!(different, 0, "{name} {motion}, {kind}: of {count}");
        }
    }
    for (kind, count) in KINDS.iter().zip(all) {
        println!("{kind}: {count} compared");
        assert!(count > 200, "{kind}: hardly any number");
    }
    println!("{of_outputs} of points that are asked for differ");
    assert!(of_outputs <= DIFFERENT, "{of_outputs}");
}

/// Powers, roots and logarithms of generated code, which no description above has.
#[test]
fn interpreted_powers_and_logarithms_are_those_of_generated_code() {
    type Written = fn(f64) -> f64;
    let laws: [(&str, Written); 7] = [
        ("(1 + t^2)^(1/3)", |t| {
            Real::powf(1.0 + t * t, 0.3333333333333333)
        }),
        ("(1 + t^2)^(-1/3)", |t| {
            1.0 / Real::powf(1.0 + t * t, 0.3333333333333333)
        }),
        ("(1 + t^2)^(5/2)", |t| {
            (1.0 + t * t) * (1.0 + t * t) * Real::sqrt(1.0 + t * t)
        }),
        ("2*t/(1 + t^2)^(5/2)", |t| {
            2.0 * t / ((1.0 + t * t) * (1.0 + t * t) * Real::sqrt(1.0 + t * t))
        }),
        ("ln(2 + t)", |t| Real::ln(2.0 + t)),
        ("exp(t)", Real::exp),
        ("-0.3*t^3", |t| -0.3 * t * t * t),
    ];
    for (law, written) in laws {
        let derived = description::written(&format!(
            "mechanism lone {{ point A = (0, 0); body crank at A {{ A, B: (1, 0) }} revolute A(ground, crank); drive phi(crank) = {law}; }}"
        ));
        let view = Interpreted::new(&derived).expect("a plan");
        let mut shell = assembled_from(view, &[], 0.1, Settings::default()).expect("as drawn");
        for step in 1..=200 {
            let t = 0.1 + 0.013 * f64::from(step);
            let frame = shell
                .advance(t, &InputSignals::default())
                .expect("explicit");
            let (found, expected) = (frame.q()[2], written(t));
            assert_eq!(
                found.to_bits(),
                expected.to_bits(),
                "{law} at {t}: {found} {expected}"
            );
        }
    }
}

include!(concat!(env!("OUT_DIR"), "/comparing.rs"));
