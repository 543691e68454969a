// Times mechanisms alone, in lanes, and in lanes on two threads; prints `time`, the name of the module and these times (ns a pose).

use std::hint::black_box;
use std::sync::Barrier;
use std::thread;
use std::time::Instant;

use linkwright::lanes::{Group, InLanes};
use linkwright::math::Real;
use linkwright::{Settings, Shell};

/// Number of instants of a sweep, which goes forth and back.
const INSTANTS: usize = 500;

/// Number of sweeps, of which the fastest counts.
const SWEEPS: usize = 60;

/// Number of runs on two threads, of which the fastest counts. Each run has several sweeps, since threads do not begin at once.
const RUNS: usize = 5;

/// Frames of many lanes are large, and lie on the stack.
const STACK: usize = 64 << 20;

/// Instants of a sweep in order, without a jump at its ends.
fn instants() -> impl Iterator<Item = usize> {
    (0..INSTANTS).chain((0..INSTANTS).rev())
}

/// Returns the time of an instant in a lane; each lane is a little ahead of the one before.
fn time<T: Real, const N: usize>(step: f64, lane: usize, instant: usize) -> T {
    T::from_f64(step * (instant as f64 + lane as f64 / N as f64))
}

fn assembled<B, const N: usize>(name: &str, step: f64, lane: usize) -> Shell<B>
where
    B: InLanes<N> + Copy + Default,
    Settings<B::Scalar>: Default,
{
    let blocks = B::default();
    let (parameters, inputs) = (blocks.nominal_parameters(), blocks.initial_inputs());
    let pose = blocks.drawn_pose(&parameters);
    let (modes, settings) = (blocks.drawn_branches(), Settings::default());
    let shell = Shell::assemble(blocks, &parameters, &pose, modes, time::<_, N>(step, lane, 0), &inputs, settings);
    shell.unwrap_or_else(|_| panic!("{name} has no pose"))
}

fn group<B, const N: usize>(name: &str, step: f64) -> Group<B, N>
where
    B: InLanes<N> + Copy + Default,
    Settings<B::Scalar>: Default,
{
    let mut group = Group::new(B::default());
    for lane in 0..N {
        group.put(lane, assembled::<B, N>(name, step, lane));
    }
    group
}

/// Moves a group forth and back.
fn sweep<B: InLanes<N>, const N: usize>(name: &str, step: f64, group: &mut Group<B, N>, inputs: &B::Inputs) {
    let all_inputs = [inputs; N];
    for instant in instants() {
        let times = std::array::from_fn(|lane| time::<_, N>(step, lane, instant));
        let failed = group.advance(black_box(&times), &all_inputs);
        assert!(failed.is_empty(), "{name}");
    }
}

fn measure<B, const N: usize>(name: &str, step: f64)
where
    B: InLanes<N> + Copy + Default,
    Settings<B::Scalar>: Default,
{
    let inputs = B::default().initial_inputs();
    let mut alone = assembled::<B, N>(name, step, 0);
    let mut in_lanes = group::<B, N>(name, step);
    let mut fastest = [f64::INFINITY; 3];
    for _ in 0..SWEEPS {
        let begun = Instant::now();
        for instant in instants() {
            let frame = alone.advance(black_box(time::<_, N>(step, 0, instant)), &inputs);
            assert!(black_box(frame).is_ok(), "{name}");
        }
        let of_one = begun.elapsed().as_secs_f64() / (2 * INSTANTS) as f64;
        let begun = Instant::now();
        sweep(name, step, &mut in_lanes, &inputs);
        let of_lanes = begun.elapsed().as_secs_f64() / (2 * INSTANTS * N) as f64;
        for (fastest, time) in fastest.iter_mut().zip([of_one, of_lanes]) {
            *fastest = fastest.min(1e9 * time);
        }
    }
    for _ in 0..RUNS {
        let sweeps = SWEEPS / RUNS;
        let elapsed = on_two_threads(|barrier| {
            let inputs = B::default().initial_inputs();
            let mut in_lanes = group::<B, N>(name, step);
            sweep(name, step, &mut in_lanes, &inputs);
            barrier.wait();
            let begun = Instant::now();
            for _ in 0..sweeps {
                sweep(name, step, &mut in_lanes, &inputs);
            }
            [begun, Instant::now()]
        });
        fastest[2] = fastest[2].min(1e9 * elapsed / (2 * sweeps * 2 * INSTANTS * N) as f64);
    }
    println!("time {name} {} {} {}", fastest[0], fastest[1], fastest[2]);
}

/// Runs work on two threads; returns the time (s) from the first beginning to the last end.
fn on_two_threads(work: impl Fn(&Barrier) -> [Instant; 2] + Sync) -> f64 {
    let barrier = Barrier::new(2);
    thread::scope(|scope| {
        let threads = [(); 2].map(|()| {
            let thread = thread::Builder::new().stack_size(STACK);
            thread.spawn_scoped(scope, || work(&barrier)).expect("a thread")
        });
        let [one, other] = threads.map(|thread| thread.join().expect("its times"));
        (one[1].max(other[1]) - one[0].min(other[0])).as_secs_f64()
    })
}

fn main() {
    let thread = thread::Builder::new().stack_size(STACK).spawn(all);
    thread.expect("a thread").join().expect("its end");
}
