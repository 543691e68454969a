//! Pulls a point of a mechanism that forces move: its free coordinates follow, and the motion starts at the pose that they give.
//!
//! The motion is held at the pose it has. Free coordinates are inputs of every solution, so that a pull moves them as it moves inputs.

use std::collections::BTreeMap;

use linkwright_codegen::stages::model::{Dimension, Mechanism};
use linkwright_codegen::stages::system::Described;
use linkwright_solver::{Assembly, Instant, Interpreted, Simulation, View as _};

use crate::controls::unit_of;
use crate::forced::{OPTIONS, checked, limited, signals};
use crate::motion::advance;
use crate::moving::Moving;
use crate::players::DRAWN;
use crate::pull::{Pulled, pulled};
use crate::question::{Detail, Pull, Question, Range};
use crate::recorded::at_start;

/// Largest distance of two poses that are one, in characteristic lengths or rad.
const AGREEMENT: f64 = 1e-6;

/// Largest change of an angle by one pull (rad).
const TURN: f64 = std::f64::consts::PI;

/// Returns the mechanism at the start to which a point is pulled, from a pose of its motion under forces, and the values that lead there.
/// While the question is about what moves, the motion is that start alone.
///
/// # Errors
/// A sentence: the motion cannot begin, or cannot start again from the pose.
pub fn restarted(
    described: &Interpreted,
    moving: Moving,
    question: &Question,
    pull: &Pull,
) -> Result<(Moving, Option<Pulled>), String> {
    pull.require_finite()?;
    let reached = at(&moving, pull.t)?;
    let start = Question {
        range: Range {
            to: question.range.from,
            ..question.range
        },
        ..question.with(&starts(&moving.interpreted, &reached))
    };
    let (start, assembly) = in_assembly(described, &start, &reached)?;
    let with = |values: &[(String, f64)]| Moving::of(described, &start.with(values));
    let held = with(&[])?;
    let pull = Pull {
        t: start.range.from,
        ranges: with_ranges(&held.interpreted, pull),
        ..pull.clone()
    };
    let pulled = pulled(&held.scene(), &start, &pull, |values| {
        with(values).map(|it| it.scene())
    })?;
    let held = with(&pulled.values)?;
    let moving = match question.detail {
        Detail::Moving => held,
        _ => Moving {
            schedule: moving.schedule,
            ..held
        },
    };
    let pulled = Pulled {
        starts: true,
        assembly,
        ..pulled
    };
    Ok((moving, Some(pulled)))
}

/// Returns the instant of a motion at a time (s), or the last one before it.
fn at(moving: &Moving, t: f64) -> Result<Instant, String> {
    let view = &moving.interpreted;
    let chosen = moving.chosen.as_ref().map(|it| it.start.clone());
    let visits = moving.schedule.forward.visits();
    let end = visits.last().map_or(0.0, |it| it.t);
    let simulation = Simulation::new(view, chosen, end, OPTIONS);
    let mut simulation = simulation.map_err(|stop| stop.not_begun(view))?;
    // A motion that ends earlier is shown up to its end.
    let _ = advance(&mut simulation, t.clamp(0.0, end), &mut limited);
    Ok(simulation.frame().clone())
}

/// Returns the names of the free coordinates with their values at an instant, in the units of their controls.
fn starts(view: &Interpreted, instant: &Instant) -> Vec<(String, f64)> {
    let signals = signals(view, instant);
    let mechanism = &view.system().mechanism;
    let free = mechanism.forces.free.iter().map(|it| it.input);
    free.map(|index| {
        let input = &mechanism.inputs[index];
        let unit = unit_of(view, input.dimension);
        (input.name.clone(), unit.of_si(signals.0[index].value))
    })
    .collect()
}

/// Returns a question in the assembly of a pose, and the label of this assembly if it is another than that of the question: forces lead
/// through poses in which assemblies meet. Where bodies follow the time, they return to the start.
fn in_assembly(
    described: &Interpreted,
    question: &Question,
    pose: &Instant,
) -> Result<(Question, Option<String>), String> {
    let of_question = Moving::of(described, question).and_then(|it| {
        let chosen = it.chosen.as_ref().map(|it| it.start.clone());
        let start = at_start(&it.interpreted, chosen, question.range.from)?;
        Ok((distance(&it.interpreted, start.fuller().frame(), pose), it))
    });
    match &of_question {
        Ok((distance, _)) if *distance <= AGREEMENT => return Ok((question.clone(), None)),
        Ok((_, moving)) if follows_time(&moving.interpreted) => {
            return Ok((question.clone(), None));
        }
        _ => (),
    }
    let drawn = Question {
        assembly: None,
        ..question.clone()
    };
    let Moving {
        interpreted,
        schedule,
        ..
    } = Moving::of(described, &drawn)?;
    let check = checked(&interpreted, &schedule);
    let distance = |it: &Assembly| distance(&interpreted, &it.instant, pose);
    let all = check.assemblies.found.iter();
    let same = all
        .filter(|it| distance(it) <= AGREEMENT)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let same = same.ok_or("the motion cannot start again from this pose: it is none of the assemblies that the free coordinates tell apart")?;
    let label = match same.drawn {
        true => same.label() + DRAWN,
        false => same.label(),
    };
    let label = label.replace('-', "−");
    let question = Question {
        assembly: Some(label.clone()),
        ..question.clone()
    };
    Ok((question, Some(label)))
}

/// Returns the distance of two poses, in characteristic lengths or rad. Angles that differ by whole turns are the same.
fn distance(view: &Interpreted, one: &Instant, other: &Instant) -> f64 {
    let system = view.system();
    let length = system.mechanism.characteristic_length;
    let coordinates = system.coordinates.iter().zip(one.q().iter().zip(other.q()));
    let apart = coordinates.map(|(coordinate, (one, other))| match coordinate.describes {
        Described::Pose { axis: 2, .. } => 2.0 * (0.5 * (one - other)).sin().abs(),
        _ => (one - other).abs() / length,
    });
    apart.fold(0.0, f64::max)
}

/// True if something besides forces moves the mechanism.
fn follows_time(view: &Interpreted) -> bool {
    let (graph, system) = (&view.pool().graph, view.system());
    let Mechanism {
        inputs,
        forces,
        time,
        ..
    } = &system.mechanism;
    let driven = inputs.iter().enumerate().any(|(index, input)| {
        let is_free = forces.free.iter().any(|it| it.input == index);
        !is_free && graph.constant_value(input.signal[0]).is_none()
    });
    let mut rows = system.rows.iter();
    driven || rows.any(|row| graph.symbols(row.residual).contains(time))
}

/// Returns the ranges of a pull, with those of free coordinates around their values: nothing else limits them than the path.
fn with_ranges(view: &Interpreted, pull: &Pull) -> BTreeMap<String, [f64; 2]> {
    let mechanism = &view.system().mechanism;
    let laws = view.input_laws().at(0.0);
    let mut ranges = pull.ranges.clone();
    for free in &mechanism.forces.free {
        let input = &mechanism.inputs[free.input];
        let (unit, value) = (unit_of(view, input.dimension), laws.0[free.input].value);
        let extent = match input.dimension {
            Dimension::Angle => TURN,
            _ => mechanism.characteristic_length.max(value.abs()),
        };
        let ends = [value - extent, value + extent].map(|it| unit.of_si(it));
        ranges.insert(input.name.clone(), ends);
    }
    ranges
}
