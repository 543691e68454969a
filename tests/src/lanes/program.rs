// Times mechanisms alone and in lanes; prints the name of the module and both times (ns a pose).

use std::hint::black_box;
use std::time::Instant;

use linkwright::lanes::{Group, InLanes};
use linkwright::math::Real;
use linkwright::{Settings, Shell};

/// Number of instants of a sweep, which goes forth and back.
const INSTANTS: usize = 500;

/// Number of sweeps, of which the fastest counts.
const SWEEPS: usize = 60;

/// Instants of a sweep in order, without a jump at its ends.
fn instants() -> impl Iterator<Item = usize> {
    (0..INSTANTS).chain((0..INSTANTS).rev())
}

fn measure<B, const N: usize>(name: &str, step: f64)
where
    B: InLanes<N> + Copy + Default,
    Settings<B::Scalar>: Default,
{
    let blocks = B::default();
    let inputs = blocks.initial_inputs();
    let time = |lane: usize, instant: usize| B::Scalar::from_f64(step * (instant as f64 + lane as f64 / N as f64));
    let mut group = Group::new(blocks);
    let assembled = |lane: usize| {
        let parameters = blocks.nominal_parameters();
        let pose = blocks.drawn_pose(&parameters);
        let (modes, settings) = (blocks.drawn_branches(), Settings::default());
        let shell = Shell::assemble(blocks, &parameters, &pose, modes, time(lane, 0), &inputs, settings);
        shell.unwrap_or_else(|_| panic!("{name} has no pose"))
    };
    for lane in 0..N {
        group.put(lane, assembled(lane));
    }
    let mut alone = assembled(0);
    let all_inputs = [&inputs; N];
    let mut fastest = [f64::INFINITY; 2];
    for _ in 0..SWEEPS {
        let begun = Instant::now();
        for instant in instants() {
            let frame = alone.advance(black_box(time(0, instant)), &inputs);
            assert!(black_box(frame).is_ok(), "{name}");
        }
        let of_one = begun.elapsed().as_secs_f64() / (2 * INSTANTS) as f64;
        let begun = Instant::now();
        for instant in instants() {
            let times = std::array::from_fn(|lane| time(lane, instant));
            let failed = group.advance(black_box(&times), &all_inputs);
            assert!(failed.is_empty(), "{name}");
        }
        let of_lanes = begun.elapsed().as_secs_f64() / (2 * INSTANTS * N) as f64;
        for (fastest, time) in fastest.iter_mut().zip([of_one, of_lanes]) {
            *fastest = fastest.min(1e9 * time);
        }
    }
    println!("{name} {} {}", fastest[0], fastest[1]);
}

fn main() {
    // Frames of many lanes are large, and lie on the stack.
    let thread = std::thread::Builder::new().stack_size(64 << 20).spawn(all);
    thread.expect("a thread").join().expect("its end");
}
