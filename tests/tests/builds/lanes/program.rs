// Moves a group and the same mechanisms one by one; prints the numbers of what was compared.

use std::collections::BTreeMap;
use std::fmt::Debug;

use linkwright::lanes::{Group, InLanes, ReadLanes};
use linkwright::math::Real;
use linkwright::{Blocks, Failure, Settings, Shell, Signal, Values};

/// Numbers of frames and of failures by kind.
#[derive(Default)]
struct Counted {
    frames: usize,
    failures: BTreeMap<String, usize>,
}

/// Signals that move in a way of their own in each lane; some jump far.
fn signals<B: Blocks>(blocks: &B, lane: usize, step: usize, t: f64) -> B::Inputs {
    let mut inputs = blocks.initial_inputs();
    for index in 0..inputs.count() {
        let drawn = inputs.value(index).expect("a signal").value.to_f64();
        let phase = t + index as f64 + 0.3 * lane as f64;
        let jump = match (lane, step % 37) {
            (2, 36) => 5.0,
            (4, 30) => f64::NAN,
            _ => 0.0,
        };
        let [value, rate, acceleration] = [
            drawn + 0.03 * (phase.sin() - (phase - t).sin()) + jump,
            0.03 * phase.cos(),
            -0.03 * phase.sin(),
        ]
        .map(B::Scalar::from_f64);
        inputs.set(index, Signal { value, rate, acceleration });
    }
    inputs
}

/// Assembles a mechanism whose parameters differ from those of the description, if that has a pose.
fn assembled<B: Blocks + Copy>(blocks: B, lane: usize, t: f64) -> Option<Shell<B>>
where
    Settings<B::Scalar>: Default,
{
    let inputs = signals(&blocks, lane, 0, t);
    let factors = [1.0 + 0.004 * lane as f64, 1.0];
    factors.into_iter().find_map(|factor| {
        let mut parameters = blocks.nominal_parameters();
        for index in 0..parameters.count() {
            let value = parameters.value(index).expect("a parameter");
            parameters.set(index, value * B::Scalar::from_f64(factor));
        }
        let pose = blocks.drawn_pose(&parameters);
        let (modes, t) = (blocks.drawn_branches(), B::Scalar::from_f64(t));
        Shell::assemble(blocks, &parameters, &pose, modes, t, &inputs, Settings::default()).ok()
    })
}

/// Time of a lane: small steps, jumps forward and back, NaN and infinity.
fn time(lane: usize, step: usize) -> f64 {
    let ahead = match (lane, step) {
        (1, 30..) => 3.0,
        (5, 36) => 40.0,
        (6, 38) => f64::NAN,
        (6, 39) => f64::INFINITY,
        (7, 26..30) => -1.0,
        _ => 0.0,
    };
    let pace = if step > 50 { 0.2 } else { 0.01 };
    0.001 * lane as f64 + pace * step as f64 + ahead
}

/// Compares N mechanisms in a group with the same mechanisms alone.
fn compare<B, const N: usize>(name: &str, counted: &mut Counted)
where
    B: InLanes<N> + Copy + Default,
    B::Frame: Debug + PartialEq,
    Settings<B::Scalar>: Default,
{
    let blocks = B::default();
    let shells: Vec<Shell<B>> = (0..N).filter_map(|lane| assembled(blocks, lane, time(lane, 0))).collect();
    let Ok(mut alone) = <[Shell<B>; N]>::try_from(shells) else {
        println!("{name}: not every lane can be assembled");
        return;
    };
    let mut group = Group::new(blocks);
    for (lane, shell) in alone.iter().enumerate() {
        group.put(lane, shell.clone());
    }
    let mut frame = alone[0].frame().clone();
    for step in 1..56 {
        let times: [f64; N] = std::array::from_fn(|lane| time(lane, step));
        let inputs: [B::Inputs; N] = std::array::from_fn(|lane| signals(&blocks, lane, step, times[lane]));
        let times = times.map(B::Scalar::from_f64);
        match step {
            20 => {
                let taken = group.take(3).expect("a mechanism");
                assert!(same(taken.frame(), alone[3].frame(), step), "{name}: another one");
                assert!(group.take(3).is_none(), "{name}: a lane has two mechanisms");
            }
            25 => group.put(3, alone[3].clone()),
            _ => {}
        }
        let inputs = inputs.each_ref();
        if step % 10 == 7 {
            let (failed, frames) = group.frames_at(&times, &inputs);
            for lane in 0..N {
                let expected = alone[lane].frame_at(times[lane], inputs[lane]);
                assert_eq!(expected.is_err(), failed.has(lane), "{name}, lane {lane}, step {step}");
                frames.get_lane(lane, &mut frame);
                let is_same = expected.map_or(true, |it| same(&frame, &it, 0));
                assert!(is_same, "{name}, lane {lane}, step {step}: frames at a time differ");
            }
        }
        let failed = group.advance(&times, &inputs);
        for lane in 0..N {
            if lane == 3 && (20..25).contains(&step) {
                assert!(!failed.has(3), "{name}: an empty lane fails");
                continue;
            }
            let result = alone[lane].advance(times[lane], inputs[lane]).map(|_| ());
            let of_group = match failed.has(lane) {
                true => Err(group.failure(lane).expect("a reason")),
                false => Ok(()),
            };
            // NaN in a failure is equal to itself here.
            assert!(
                result == of_group || format!("{result:?}") == format!("{of_group:?}"),
                "{name}, lane {lane}, step {step}: {result:?} {of_group:?}"
            );
            group.frames().get_lane(lane, &mut frame);
            let expected = alone[lane].frame();
            assert!(
                same(&frame, expected, step),
                "{name}, lane {lane}, step {step}:\n{frame:?}\n{expected:?}"
            );
            match result {
                Ok(()) => {
                    assert!(times[lane].to_f64().is_finite(), "{name}: a frame at no time");
                    counted.frames += 1;
                }
                Err(failure) => *counted.failures.entry(kind(&failure)).or_default() += 1,
            }
        }
    }
}

/// True if all numbers of two frames have the same bits; the signs of zeros are compared in every eighth step.
fn same<F: Debug + PartialEq>(one: &F, other: &F, step: usize) -> bool {
    // Text takes long, but tells the zeros apart, and NaN is equal to itself in it.
    one == other && step % 8 != 0 || format!("{one:?}") == format!("{other:?}")
}

/// Name of the kind of a failure.
fn kind<T: Real>(failure: &Failure<T>) -> String {
    let text = format!("{:?}", failure.kind);
    text.split([' ', '{', '(']).next().unwrap_or_default().to_string()
}

fn main() {
    let mut counted = Counted::default();
    all(&mut counted);
    println!("frames {}", counted.frames);
    for (kind, count) in counted.failures {
        println!("{kind} {count}");
    }
}
