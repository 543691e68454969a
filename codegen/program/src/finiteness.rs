//! A system, and the program that solves it → what in them is infinite, undefined, or past a bound, with its place.
//!
//! The front end refuses such numbers where they are written. What is derived from the description multiplies and divides what it
//! wrote: the square of a length may be too large although the length is not, and a distance that is zero may be divided by.
//! [Graphs](crate::expr::Graph) let no such number into an expression, but make the whole expression undefined; so every expression
//! that is to be written is looked at once, and afterwards every constant of the program is a number of its scalar. Deliberately
//! unknown here: how an expression became undefined.

use crate::closing;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};
use crate::expr::ExprId;
use crate::model::beyond_bounds;
use crate::program::{Block, Found, Function, Program, Sensitivity};
use crate::structure::LARGEST_TOGETHER;
use crate::system::{Bound, Exceeded, System};

/// How many places a finding points at.
const SHOWN: usize = 6;

/// What scalars hold: magnitudes from the least but zero to the largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least with all its digits.
    pub least: f64,
    /// The largest.
    pub largest: f64,
}

/// Expressions and where they come from.
struct Part {
    /// What a message calls them.
    subject: String,
    /// The statements, never none.
    spans: Vec<Span>,
    exprs: Vec<ExprId>,
}

/// What is infinite or undefined in the equations of a system.
pub fn of_system(system: &System) -> Diagnostics {
    let mut found = Diagnostics::new();
    match passed(system) {
        Some(passed) => found.push(passed),
        None => found.extend(undefined(&of_equations(system), system)),
    }
    found
}

/// What is infinite or undefined in the program of a system, or no number of its scalar. Without a program only the bound that
/// was passed is looked for.
pub fn of_program(system: &System, program: Option<&Program>, range: Range) -> Diagnostics {
    let mut found = Diagnostics::new();
    let Some(program) = program else {
        found.extend(passed(system));
        return found;
    };
    let open = closing::of_blocks(system, &program.blocks);
    if passed(system).is_none() && open.has_errors() {
        return open;
    }
    let path = program.path.iter().map(|path| Part {
        subject: "what shows that frames lie on their path".to_string(),
        spans: vec![system.mechanism.span],
        exprs: path.functions().flat_map(Function::values).collect(),
    });
    let blocks = program.blocks.iter().map(|block| of_block(block, system));
    let blocks: Vec<Part> = blocks.chain(path).collect();
    let (is_within, of_blocks) = of_parts(&blocks, system);
    found.extend(of_blocks);
    if !is_within {
        return found;
    }
    for sensitivity in &program.sensitivities {
        found.extend(undefined_sensitivity(sensitivity, system));
    }
    let constants = program.constants.list().iter();
    let are_finite = constants.clone().all(|constant| constant.value.is_finite());
    if range != Range::F64 {
        let parts = blocks.into_iter().chain(of_equations(system));
        found.extend(parts.filter_map(|part| out_of_range(&part, system, range)));
    }
    if !are_finite && !found.has_errors() {
        let message = "a number that follows from the drawing is infinite or undefined";
        found.push(Diagnostic::error(
            Code::NotFinite,
            system.mechanism.span,
            message,
        ));
    }
    found
}

/// The same of blocks alone.
pub fn of_blocks(system: &System, blocks: &[Block]) -> Diagnostics {
    let open = closing::of_blocks(system, blocks);
    if passed(system).is_none() && open.has_errors() {
        return open;
    }
    let parts = blocks.iter().map(|block| of_block(block, system));
    of_parts(&parts.collect::<Vec<_>>(), system).1
}

/// Whether the bounds have been kept, and the one that was passed or else what is undefined in the parts of a program.
fn of_parts(parts: &[Part], system: &System) -> (bool, Diagnostics) {
    let undefined: Vec<Diagnostic> = undefined(parts, system).collect();
    let first = undefined.first().map(|first| first.primary.span);
    let in_program = system.mechanism.graph.excess();
    let in_program =
        in_program.map(|excess| beyond_bounds(excess, first.unwrap_or(system.mechanism.span)));
    let mut found = Diagnostics::new();
    match passed(system).or(in_program) {
        Some(passed) => {
            found.push(passed);
            (false, found)
        }
        None => {
            let cause = coaxial(system).filter(|_| !undefined.is_empty());
            match cause {
                Some(cause) => found.push(cause),
                None => found.extend(undefined),
            }
            (true, found)
        }
    }
}

/// The first gear whose axes parameters bring to one place, which leaves its pitch radii undefined.
fn coaxial(system: &System) -> Option<Diagnostic> {
    let mechanism = &system.mechanism;
    mechanism.forces.teeth.iter().find_map(|teeth| {
        let [from, to] = teeth.axes.each_ref().map(|axis| {
            let place = axis.place.local;
            place.map(|part| mechanism.graph.constant_value(part))
        });
        let gear = &mechanism.joints[teeth.gear];
        let span = gear.pressure_angle.map_or(gear.span, |angle| angle.span);
        (from == to).then(|| {
            let message = format!("the wheels of `{}` turn about one axis", gear.label);
            Diagnostic::error(Code::DegenerateGeometry, span, message)
                .label("the pitch radii have no distance to divide")
                .help("give the parameters of the axes other values, or remove `pressure_angle`")
        })
    })
}

impl Range {
    /// Of `f64`: what an expression holds is one.
    pub const F64: Range = Range {
        least: 0.0,
        largest: f64::MAX,
    };
    /// Of `f32`.
    pub const F32: Range = Range {
        least: f32::MIN_POSITIVE as f64,
        largest: f32::MAX as f64,
    };
}

/// The bound that the equations or their plan passed.
fn passed(system: &System) -> Option<Diagnostic> {
    let Exceeded { at, bound } = (*system.exceeded)?;
    Some(match bound {
        Bound::Graph(excess) => beyond_bounds(excess, at),
        Bound::Together(unknowns) => Diagnostic::error(
            Code::TooMuchWork,
            at,
            format!(
                "{unknowns} unknowns would have to be found together, more than {LARGEST_TOGETHER}"
            ),
        )
        .label("one of the joints that depend on one another")
        .help("drive more of the bodies, or describe the mechanism in parts"),
    })
}

/// The equations of every joint, the drawing of every body and the motion of every point.
fn of_equations(system: &System) -> Vec<Part> {
    let mechanism = &system.mechanism;
    let part = |subject: String, span: Span, exprs: Vec<ExprId>| Part {
        subject,
        spans: vec![span],
        exprs,
    };
    let joints = mechanism.joints.iter();
    let mut parts: Vec<Part> = joints
        .map(|it| {
            part(
                format!("the equations of `{}`", it.label),
                it.span,
                Vec::new(),
            )
        })
        .collect();
    let parameters = mechanism.parameters.iter();
    let parameters = parameters.map(|it| (&it.name, it.span, it.nominal));
    let inputs = mechanism.inputs.iter();
    let inputs = inputs.map(|it| (&it.name, it.span, it.initial));
    parts.extend(parameters.chain(inputs).map(|(name, span, default)| {
        part(format!("the default of `{name}`"), span, vec![default])
    }));
    for row in system.rows.iter().chain(&system.monitored) {
        let entries = row.jacobian.iter().map(|entry| entry.value);
        let own = &mut parts[row.joint].exprs;
        own.extend([row.residual, row.time_derivative, row.gamma]);
        own.extend(entries);
    }
    for row in &system.vector_form.rows {
        parts[row.joint].exprs.push(row.residual);
    }
    for it in &system.pressures {
        let own = &mut parts[it.joint].exprs;
        own.extend([it.along, it.across, it.sliding]);
    }
    for direction in &system.directions {
        for column in [&direction.column, &direction.rate_column] {
            for (row, &entry) in system.rows.iter().zip(column) {
                parts[row.joint].exprs.push(entry);
            }
        }
    }
    for (row, entries) in system.rows.iter().zip(&system.rate_jacobian) {
        let own = &mut parts[row.joint].exprs;
        own.extend(entries.iter().map(|entry| entry.value));
    }
    parts.extend(mechanism.moving_bodies().iter().map(|body| {
        let subject = format!("the drawing of body `{}`", body.name);
        part(subject, body.span, body.estimate().to_vec())
    }));
    for unknown in &system.vector_form.unknowns[system.coordinates.len()..] {
        if !mechanism.graph.is_sound(unknown.estimate) {
            let rows = &system.vector_form.rows;
            let mentions = |residual| mechanism.graph.depends_on(residual, unknown.position);
            let row = rows.iter().find(|row| mentions(row.residual));
            let joint = row.map(|row| &mechanism.joints[row.joint]);
            let span = joint.map_or(mechanism.span, |joint| joint.span);
            let subject = format!("the drawing of `{}`", unknown.name);
            parts.push(part(subject, span, vec![unknown.estimate]));
        }
    }
    let points = mechanism.points.iter().zip(&system.outputs);
    parts.extend(points.map(|(point, it)| {
        let subject = format!("the motion of point `{}`", point.name);
        let levels = [it.position, it.velocity, it.acceleration];
        part(subject, point.span, levels.concat())
    }));
    parts
}

/// What a block computes.
fn of_block(block: &Block, system: &System) -> Part {
    let exprs: Vec<ExprId> = block.functions().flat_map(Function::values).collect();
    let joints = &system.mechanism.joints;
    let own: Vec<_> = block.joints.iter().map(|&joint| &joints[joint]).collect();
    let Some(first) = own.first() else {
        return Part {
            subject: "what follows from the pose".to_string(),
            spans: vec![system.mechanism.span],
            exprs,
        };
    };
    let subject = match own.len() {
        1 => format!("what solves `{}`", first.label),
        2 => format!("what solves `{}` and `{}`", first.label, own[1].label),
        more => format!("what solves `{}` and {} more", first.label, more - 1),
    };
    Part {
        subject,
        spans: own.iter().map(|joint| joint.span).collect(),
        exprs,
    }
}

/// The parts with a number that is none.
fn undefined(parts: &[Part], system: &System) -> impl Iterator<Item = Diagnostic> {
    let graph = &system.mechanism.graph;
    let undefined = |part: &Part| {
        let mut exprs = part.exprs.iter().copied();
        exprs.find(|&expr| !graph.is_sound(expr))
    };
    let undefined = parts
        .iter()
        .filter_map(move |part| Some((part, undefined(part)?)));
    undefined.map(|(part, expr)| {
        if let Some(of_value) = undefined_at_value(part, expr, system) {
            return of_value;
        }
        let message = format!("a number in {} is infinite or undefined", part.subject);
        finding(part, message)
            .label("follows from this")
            .help("look for a distance that is zero in every pose, and for a length whose square is beyond 1.8e308 or below 5e-324: check the unit and the exponent")
    })
}

/// Returns the finding about the parameter whose value makes an expression infinite or undefined; `None` if constants alone do.
fn undefined_at_value(part: &Part, expr: ExprId, system: &System) -> Option<Diagnostic> {
    let graph = &system.mechanism.graph;
    let mut cause = expr;
    while let Some(operand) = graph
        .operands(cause)
        .into_iter()
        .find(|&operand| !graph.is_sound(operand))
    {
        cause = operand;
    }
    let symbols = graph.symbols(cause);
    let mut parameters = system.mechanism.parameters.iter();
    let own = parameters.find(|it| symbols.contains(&it.symbol))?;
    let value = graph.nominal(own.symbol)?;
    // Such a value is zero, or far from what is read without an exponent.
    let value = match value == 0.0 {
        true => value.to_string(),
        false => format!("{value:e}"),
    };
    let message = format!(
        "a number in {} is infinite or undefined with `{}` = {value}",
        part.subject, own.name
    );
    Some(
        Diagnostic::error(Code::NotFinite, own.span, message)
            .label(format!("its value is {value} here"))
            .help("give it a value that is not zero, and of which the square is neither beyond 1.8e308 nor below 5e-324"),
    )
}

/// A sensitivity that is a number, but none.
fn undefined_sensitivity(sensitivity: &Sensitivity, system: &System) -> Option<Diagnostic> {
    let coordinates = sensitivity.coordinates.iter().flatten().flatten();
    let quantities = sensitivity.quantities.iter().flat_map(|it| &it.levels);
    let mut all = coordinates.chain(quantities.flatten());
    let is_none = |found: &Found| matches!(found, Found::Constant(it) if !it.is_finite());
    let own = &system.mechanism.parameters[sensitivity.parameter];
    all.any(is_none).then(|| {
        let message = format!("a sensitivity to `{}` is infinite or undefined", own.name);
        Diagnostic::error(Code::NotFinite, own.span, message)
            .label("at this default")
            .help("what depends on it has no slope there; choose another default")
    })
}

/// A part with a number that the scalar does not hold.
fn out_of_range(part: &Part, system: &System, range: Range) -> Option<Diagnostic> {
    let found = system.mechanism.graph.magnitudes(&part.exprs);
    let beyond = if found.largest > range.largest {
        found.largest
    } else if found.least < range.least {
        found.least
    } else {
        return None;
    };
    let message = format!("a number in {} does not fit the scalar", part.subject);
    let (least, largest) = (range.least, range.largest);
    let finding = finding(part, message).label(format!("{beyond:.1e} follows from this"));
    Some(finding.help(format!(
        "numbers of this scalar are zero or between {least:.1e} and {largest:.1e}; check the unit and the exponent"
    )))
}

fn finding(part: &Part, message: String) -> Diagnostic {
    let error = Diagnostic::error(Code::NotFinite, part.spans[0], message);
    let others = part.spans.iter().skip(1).take(SHOWN - 1);
    others.fold(error, |error, &span| error.also(span, "together with this"))
}
