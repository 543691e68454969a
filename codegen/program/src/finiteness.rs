//! Finds infinite, undefined or excessive values in a system and its program, with their statements.
//!
//! The front end rejects such numbers in a description. Derived expressions multiply and divide these numbers: the square of a
//! length may overflow although the length does not, and a divisor may be zero. [Graphs](crate::expr::Graph) make the whole
//! expression undefined in such cases. So each expression is examined once; then every constant of the program is a number of its
//! scalar type.

use crate::closing;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};
use crate::expr::ExprId;
use crate::model::beyond_bounds;
use crate::pool::{Bound, Exceeded, Pool};
use crate::program::{Block, Found, Function, Program, Sensitivity};
use crate::structure::{LARGEST_TOGETHER, Unplanned};
use crate::system::System;

/// Largest number of statements that a finding points at.
const MAX_LISTED: usize = 6;

/// Range of a scalar type: magnitudes from the smallest normal number to the largest number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest magnitude with all digits.
    pub least: f64,
    /// Largest magnitude.
    pub largest: f64,
}

/// Expressions and their statements.
struct Part {
    /// Subject in messages.
    subject: String,
    /// Statements; never empty.
    spans: Vec<Span>,
    exprs: Vec<ExprId>,
}

/// Finds infinite or undefined values in the equations of a system.
pub fn of_system(pool: &Pool, system: &System) -> Diagnostics {
    let mut findings = Diagnostics::new();
    match passed(pool) {
        Some(passed) => findings.push(passed),
        None => findings.extend(undefined(&of_equations(pool, system), pool, system)),
    }
    findings
}

/// Reports the limit for which a motion has no plan, if any.
pub fn of_unplanned(unplanned: Unplanned) -> Diagnostics {
    let mut findings = Diagnostics::new();
    if let Unplanned::Exceeded(exceeded) = unplanned {
        findings.push(beyond(exceeded));
    }
    findings
}

/// Finds infinite, undefined or unrepresentable values in the program of a system.
pub fn of_program(pool: &Pool, system: &System, program: &Program, range: Range) -> Diagnostics {
    let mut findings = Diagnostics::new();
    let open = closing::of_blocks(pool, system, &program.blocks);
    if passed(pool).is_none() && open.has_errors() {
        return open;
    }
    let path = program.path.iter().map(|path| Part {
        subject: "the proof of the path".to_string(),
        spans: vec![system.mechanism.span],
        exprs: path.functions().flat_map(Function::values).collect(),
    });
    let blocks = program.blocks.iter().map(|block| of_block(block, system));
    let blocks: Vec<Part> = blocks.chain(path).collect();
    let (is_within, of_blocks) = of_parts(&blocks, pool, system);
    findings.extend(of_blocks);
    if !is_within {
        return findings;
    }
    for sensitivity in &program.sensitivities {
        findings.extend(undefined_sensitivity(sensitivity, system));
    }
    let constants = program.constants.list().iter();
    let are_finite = constants.clone().all(|constant| constant.value.is_finite());
    if range != Range::F64 {
        let parts = blocks.into_iter().chain(of_equations(pool, system));
        findings.extend(parts.filter_map(|part| out_of_range(&part, pool, range)));
    }
    if !are_finite && !findings.has_errors() {
        let message =
            "a number that follows from the design configuration is infinite or undefined";
        findings.push(Diagnostic::error(
            Code::NotFinite,
            system.mechanism.span,
            message,
        ));
    }
    findings
}

/// True if no limit is exceeded, with the exceeded limit or else the undefined values in parts of a program.
fn of_parts(parts: &[Part], pool: &Pool, system: &System) -> (bool, Diagnostics) {
    let undefined: Vec<Diagnostic> = undefined(parts, pool, system).collect();
    let first = undefined.first().map(|first| first.primary.span);
    let in_program = pool.graph.excess();
    let in_program =
        in_program.map(|excess| beyond_bounds(excess, first.unwrap_or(system.mechanism.span)));
    let mut findings = Diagnostics::new();
    match passed(pool).or(in_program) {
        Some(passed) => {
            findings.push(passed);
            (false, findings)
        }
        None => {
            let cause = coaxial(pool, system).filter(|_| !undefined.is_empty());
            match cause {
                Some(cause) => findings.push(cause),
                None => findings.extend(undefined),
            }
            (true, findings)
        }
    }
}

/// Reports the first gear whose axes coincide by parameters, which leaves its pitch radii undefined.
fn coaxial(pool: &Pool, system: &System) -> Option<Diagnostic> {
    let mechanism = &system.mechanism;
    mechanism.forces.teeth.iter().find_map(|teeth| {
        let [from, to] = teeth.axes.each_ref().map(|axis| {
            let place = axis.place.local;
            place.map(|part| pool.graph.constant_value(part))
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
    /// Range of `f64`.
    pub const F64: Range = Range {
        least: 0.0,
        largest: f64::MAX,
    };
    /// Range of `f32`.
    pub const F32: Range = Range {
        least: f32::MIN_POSITIVE as f64,
        largest: f32::MAX as f64,
    };
}

/// Reports the limit that the equations or their plan exceeded.
fn passed(pool: &Pool) -> Option<Diagnostic> {
    pool.exceeded().map(beyond)
}

/// Reports an exceeded limit.
fn beyond(exceeded: Exceeded) -> Diagnostic {
    let Exceeded { at, bound } = exceeded;
    match bound {
        Bound::Graph(excess) => beyond_bounds(excess, at),
        Bound::Together(unknowns) => Diagnostic::error(
            Code::TooMuchWork,
            at,
            format!(
                "{unknowns} unknowns would have to be solved together, more than {LARGEST_TOGETHER}"
            ),
        )
        .label("one of the interdependent joints")
        .help("drive more of the bodies, or describe the mechanism in parts"),
    }
}

/// Returns the equations of every joint, the design pose of every body and the motion of every point.
fn of_equations(pool: &Pool, system: &System) -> Vec<Part> {
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
        let exprs = &mut parts[row.joint].exprs;
        exprs.extend([row.residual, row.time_derivative, row.gamma]);
        exprs.extend(entries);
    }
    for row in &system.vector_form.rows {
        parts[row.joint].exprs.push(row.residual);
    }
    for it in &system.pressures {
        let exprs = &mut parts[it.joint].exprs;
        exprs.extend([it.along, it.across, it.sliding]);
    }
    for direction in &system.directions {
        for column in [&direction.column, &direction.rate_column] {
            for (row, &entry) in system.rows.iter().zip(column) {
                parts[row.joint].exprs.push(entry);
            }
        }
    }
    for (row, entries) in system.rows.iter().zip(&system.rate_jacobian) {
        let exprs = &mut parts[row.joint].exprs;
        exprs.extend(entries.iter().map(|entry| entry.value));
    }
    parts.extend(mechanism.moving_bodies().iter().map(|body| {
        let subject = format!("the estimate of body `{}`", body.name);
        part(subject, body.span, body.estimate().to_vec())
    }));
    for unknown in &system.vector_form.unknowns[system.coordinates.len()..] {
        if !pool.graph.is_sound(unknown.estimate) {
            let rows = &system.vector_form.rows;
            let mentions = |residual| pool.graph.depends_on(residual, unknown.position);
            let row = rows.iter().find(|row| mentions(row.residual));
            let joint = row.map(|row| &mechanism.joints[row.joint]);
            let span = joint.map_or(mechanism.span, |joint| joint.span);
            let subject = format!("the estimate of `{}`", unknown.name);
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

/// Returns the expressions of a block.
fn of_block(block: &Block, system: &System) -> Part {
    let exprs: Vec<ExprId> = block.functions().flat_map(Function::values).collect();
    let joints = &system.mechanism.joints;
    let joints_of_block: Vec<_> = block.joints.iter().map(|&joint| &joints[joint]).collect();
    let Some(first) = joints_of_block.first() else {
        return Part {
            subject: "the values that follow from the pose".to_string(),
            spans: vec![system.mechanism.span],
            exprs,
        };
    };
    let subject = match joints_of_block.len() {
        1 => format!("the solution of `{}`", first.label),
        2 => format!(
            "the solution of `{}` and `{}`",
            first.label, joints_of_block[1].label
        ),
        more => format!("the solution of `{}` and {} more", first.label, more - 1),
    };
    Part {
        subject,
        spans: joints_of_block.iter().map(|joint| joint.span).collect(),
        exprs,
    }
}

/// Reports parts with an undefined expression.
fn undefined(parts: &[Part], pool: &Pool, system: &System) -> impl Iterator<Item = Diagnostic> {
    let graph = &pool.graph;
    let undefined = |part: &Part| {
        let mut exprs = part.exprs.iter().copied();
        exprs.find(|&expr| !graph.is_sound(expr))
    };
    let undefined = parts
        .iter()
        .filter_map(move |part| Some((part, undefined(part)?)));
    undefined.map(|(part, expr)| {
        if let Some(of_value) = undefined_at_value(part, expr, pool, system) {
            return of_value;
        }
        let message = format!("a number in {} is infinite or undefined", part.subject);
        finding(part, message)
            .label("follows from this")
            .help("look for a distance that is zero in every pose, and for a length whose square is beyond 1.8e308 or below 5e-324: check the unit and the exponent")
    })
}

/// Returns the finding about the parameter whose value makes an expression infinite or undefined; `None` if constants alone do.
fn undefined_at_value(
    part: &Part,
    expr: ExprId,
    pool: &Pool,
    system: &System,
) -> Option<Diagnostic> {
    let graph = &pool.graph;
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
    let parameter = parameters.find(|it| symbols.contains(&it.symbol))?;
    let value = graph.nominal(parameter.symbol)?;
    // Such a value is zero, or too large or small for plain notation.
    let value = match value == 0.0 {
        true => value.to_string(),
        false => format!("{value:e}"),
    };
    let message = format!(
        "a number in {} is infinite or undefined with `{}` = {value}",
        part.subject, parameter.name
    );
    Some(
        Diagnostic::error(Code::NotFinite, parameter.span, message)
            .label(format!("its value is {value} here"))
            .help("give it a value other than zero, whose square lies between 5e-324 and 1.8e308"),
    )
}

/// Reports a sensitivity that is infinite or undefined; otherwise `None`.
fn undefined_sensitivity(sensitivity: &Sensitivity, system: &System) -> Option<Diagnostic> {
    let coordinates = sensitivity.coordinates.iter().flatten().flatten();
    let quantities = sensitivity.quantities.iter().flat_map(|it| &it.levels);
    let mut all = coordinates.chain(quantities.flatten());
    let is_none = |found: &Found| matches!(found, Found::Constant(it) if !it.is_finite());
    let parameter = &system.mechanism.parameters[sensitivity.parameter];
    all.any(is_none).then(|| {
        let message = format!(
            "a sensitivity to `{}` is infinite or undefined",
            parameter.name
        );
        Diagnostic::error(Code::NotFinite, parameter.span, message)
            .label("at this default")
            .help("values that depend on it have no slope there; choose another default")
    })
}

/// Reports a part with a number that the scalar type cannot represent.
fn out_of_range(part: &Part, pool: &Pool, range: Range) -> Option<Diagnostic> {
    let magnitudes = pool.graph.magnitudes(&part.exprs);
    let beyond = if magnitudes.largest > range.largest {
        magnitudes.largest
    } else if magnitudes.least < range.least {
        magnitudes.least
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
    let others = part.spans.iter().skip(1).take(MAX_LISTED - 1);
    others.fold(error, |error, &span| error.also(span, "together with this"))
}
