//! Moves a group of lanes and returns a hash of all bits of its frames.
//!
//! The file imports only the runtime, because the test `builds::lanes` compiles it for this machine.

use linkwright::lanes::{Group, InLanes, ReadLanes};
use linkwright::math::Real;
use linkwright::{Settings, Shell};

/// Number of frames of each lane.
const FRAMES: usize = 400;

/// Time between frames (s).
const STEP: f64 = 0.01;

/// Returns the time of a frame; lanes are apart, and one of them jumps.
fn time<T: Real>(lane: usize, frame: usize) -> T {
    let ahead = match (lane, frame % 100) {
        (2, 60..) => 0.37,
        _ => 0.0,
    };
    T::from_f64(STEP * frame as f64 + 0.003 * lane as f64 + ahead)
}

/// Returns the hash of all coordinates, rates and accelerations, after Fowler, Noll and Vo; 0 if a lane fails.
pub fn hash<B, const N: usize>() -> u64
where
    B: InLanes<N> + Copy + Default,
    Settings<B::Scalar>: Default,
{
    of_frames::<B, N>().unwrap_or(0)
}

fn of_frames<B, const N: usize>() -> Option<u64>
where
    B: InLanes<N> + Copy + Default,
    Settings<B::Scalar>: Default,
{
    let blocks = B::default();
    let (parameters, inputs) = (blocks.nominal_parameters(), blocks.initial_inputs());
    let pose = blocks.drawn_pose(&parameters);
    let assembled = |lane| {
        let (modes, settings) = (blocks.drawn_branches(), Settings::default());
        let t = time(lane, 0);
        Shell::assemble(blocks, &parameters, &pose, modes, t, &inputs, settings).ok()
    };
    let mut frame = assembled(0)?.frame().clone();
    let mut group = Group::new(blocks);
    for lane in 0..N {
        group.put(lane, assembled(lane)?);
    }
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for number in 1..=FRAMES {
        let times = core::array::from_fn(|lane| time(lane, number));
        if !group.advance(&times, &[&inputs; N]).is_empty() {
            return None;
        }
        for lane in 0..N {
            group.frames().get_lane(lane, &mut frame);
            let coordinates = (0..).map_while(|place| blocks.coordinate(&frame, place));
            for value in coordinates.flatten() {
                // Exact, also from f32.
                hash = (hash ^ value.to_f64().to_bits()).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    Some(hash)
}
