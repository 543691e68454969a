//! Every block of the plan → its function.

use super::builder::Builder;
use super::fields::fields;
use super::liveness::needed;
use super::{Action, BlockProgram, SolvedProgram};
use crate::expr::{ExprId, Node, SymbolId};
use crate::program::constants::Constants;
use crate::program::operations::is_function;
use crate::program::{Addend, Operations, Straight, addends};
use crate::structure::{SolvedBlock, SolvedPlan, Step};
use crate::system::{SymbolRole, System, WrittenOrder};

/// The functions of all blocks. The system's arena grows by the values that are computed on the way.
pub fn lower(system: &mut System, plan: &SolvedPlan, constants: &mut Constants) -> SolvedProgram {
    let drawn = drawn_values(system);
    let mut branches = Vec::new();
    let mut blocks = Vec::with_capacity(plan.blocks.len());
    let mut names: Vec<String> = Vec::new();
    for block in &plan.blocks {
        let mut lowered = lower_block(system, block, &drawn, &mut branches, constants);
        let base = lowered.name.clone();
        let taken = |name: &str| names.iter().any(|other| other == name);
        let mut number = 2;
        while taken(&lowered.name) {
            lowered.name = format!("{base}_{number}");
            number += 1;
        }
        names.push(lowered.name.clone());
        blocks.push(lowered);
    }
    let fields = fields(&blocks, system);
    for block in &mut blocks {
        let kept = |symbol: SymbolId| {
            fields.contains(&symbol)
                || matches!(system.roles[symbol.index()], SymbolRole::Position(unknown) | SymbolRole::Rate(unknown) | SymbolRole::Acceleration(unknown) if unknown < system.coordinates.len())
        };
        block.actions = needed(std::mem::take(&mut block.actions), [], kept, system);
        for action in &block.actions {
            block.operations += operations_of(action, system, &block.time);
        }
    }
    SolvedProgram {
        blocks,
        fields,
        branches,
    }
}

/// The drawing's value of every unknown and arm, by symbol.
fn drawn_values(system: &System) -> Vec<f64> {
    let graph = &system.mechanism.graph;
    let form = &system.vector_form;
    let mut values = vec![0.0; graph.symbol_count()];
    let constant = |expr: ExprId| graph.constant_value(expr).unwrap_or(0.0);
    for unknown in &form.unknowns {
        values[unknown.position.index()] = constant(unknown.estimate);
    }
    for arm in &form.arms {
        let angle = form.unknowns[form.angle_of(arm.leader)].position;
        let (sine, cosine) = values[angle.index()].sin_cos();
        let [x, y] = arm.local.map(constant);
        values[arm.symbols[0].index()] = cosine * x - sine * y;
        values[arm.symbols[1].index()] = sine * x + cosine * y;
    }
    values
}

/// How a step's rates are found, kept until all positions of the block are.
enum Pending {
    TwoRotations(super::two_rotations::Triangle),
    OneAngle(super::one_angle::Root),
    Slide(super::slides::Slide),
    TwoSlides(super::slides::Lines),
    Linear {
        unknown: usize,
        coefficient: ExprId,
        equation: ExprId,
    },
}

fn lower_block(
    system: &mut System,
    block: &SolvedBlock,
    drawn: &[f64],
    branches: &mut Vec<super::Branch>,
    constants: &mut Constants,
) -> BlockProgram {
    let first_branch = branches.len();
    let mut builder = Builder {
        system,
        actions: Vec::new(),
        branches,
        drawn,
        defined: Vec::new(),
    };
    let mut pending = Vec::new();
    let mut newton = None;
    for step in &block.steps {
        let names: Vec<String> = step
            .unknowns()
            .into_iter()
            .map(|unknown| builder.system.unknown_name(unknown).to_string())
            .collect();
        builder.comment(format!(
            "Position: {} for {}.",
            step.name(),
            names.join(" and ")
        ));
        match step {
            Step::Linear {
                unknown,
                coefficient,
                rest,
            } => {
                let position = builder.position(*unknown);
                let product = builder.graph().multiply(*coefficient, position);
                let equation = builder.graph().add(product, *rest);
                let coefficient = builder.linear(*unknown, *coefficient, *rest);
                pending.push(Pending::Linear {
                    unknown: *unknown,
                    coefficient,
                    equation,
                });
            }
            Step::OneAngle {
                unknown,
                cosine,
                sine,
                rest,
                equation,
            } => {
                pending.push(Pending::OneAngle(
                    builder.one_angle(*unknown, *cosine, *sine, *rest, *equation),
                ));
            }
            Step::TwoRotations {
                first,
                second,
                p,
                q,
                closure,
            } => {
                pending.push(Pending::TwoRotations(builder.two_rotations(
                    [*first, *second],
                    *p,
                    *q,
                    *closure,
                )));
            }
            Step::RotationAndSlide {
                angle,
                slide,
                p,
                direction,
                closure,
            } => {
                pending.push(Pending::Slide(builder.rotation_and_slide(
                    [*angle, *slide],
                    *p,
                    *direction,
                    *closure,
                )));
            }
            Step::TurningSlide {
                angle,
                slide,
                p,
                u,
                closure,
            } => {
                pending.push(Pending::Slide(builder.turning_slide(
                    [*angle, *slide],
                    *p,
                    *u,
                    *closure,
                )));
            }
            Step::TwoSlides {
                first,
                second,
                directions,
                closure,
            } => {
                pending.push(Pending::TwoSlides(builder.two_slides(
                    [*first, *second],
                    *directions,
                    *closure,
                )));
            }
            Step::Newton {
                unknowns,
                residuals,
            } => newton = Some(builder.newton(unknowns, residuals)),
        }
    }
    if !block.steps.is_empty() && !block.definitions.is_empty() {
        builder.comment("What follows from it.");
    }
    for definition in &block.definitions {
        let symbol = builder.system.vector_form.unknowns[definition.unknown].position;
        builder.assign(symbol, definition.value);
        builder.explicit_angle(definition.unknown);
    }
    builder.comment("Rates and accelerations.");
    for step in &pending {
        match step {
            Pending::TwoRotations(triangle) => builder.two_rotation_rates(triangle),
            Pending::OneAngle(root) => builder.one_angle_rates(root),
            Pending::Slide(slide) => builder.slide_rates(slide),
            Pending::TwoSlides(lines) => builder.two_slide_rates(lines),
            Pending::Linear {
                unknown,
                coefficient,
                equation,
            } => builder.linear_rates(*unknown, *coefficient, *equation),
        }
    }
    for definition in &block.definitions {
        let (rate, acceleration) = builder.rates_of(definition.unknown);
        let first = builder.rate(definition.value);
        builder.assign(rate, first);
        let second = builder.rate(first);
        builder.assign(acceleration, second);
    }
    let actions = builder.actions;
    let mut expressions: Vec<ExprId> = actions.iter().flat_map(Action::values).collect();
    if let Some(newton) = &newton {
        expressions.extend(newton.geometry.iter().flat_map(Action::values));
        let lists = [
            &newton.residuals,
            &newton.jacobian,
            &newton.time_derivative,
            &newton.gamma,
        ];
        expressions.extend(lists.into_iter().flatten());
    }
    let time = functions_of_time(&expressions, system, constants);
    let operations = time.operations;
    note_constants(&expressions, system, &time, constants);
    let joints: Vec<&str> = block
        .joints
        .iter()
        .map(|&joint| system.mechanism.joints[joint].slug.as_str())
        .collect();
    let how = block
        .steps
        .first()
        .map_or("explicit".to_string(), Step::name);
    let labels: Vec<&str> = block
        .joints
        .iter()
        .map(|&joint| system.mechanism.joints[joint].label.as_str())
        .collect();
    BlockProgram {
        name: block_name(block, system, &joints),
        title: format!("{}: {}.", capitalized(&how), labels.join(", ")),
        joints: block.joints.clone(),
        time,
        actions,
        newton,
        branch: (branches.len() > first_branch).then_some(first_branch),
        operations,
    }
}

/// `loop_l_g_h`: named joints, or else the first of the others.
fn block_name(block: &SolvedBlock, system: &System, slugs: &[&str]) -> String {
    let pins: Vec<&str> = block
        .joints
        .iter()
        .zip(slugs)
        .filter(|(joint, _)| system.mechanism.joints[**joint].kind.joins_points())
        .map(|(_, slug)| *slug)
        .collect();
    if block.steps.is_empty() {
        return "explicit".to_string();
    }
    let named = if pins.is_empty() { slugs } else { &pins[..] };
    format!("loop_{}", named[..named.len().min(6)].join("_"))
}

fn capitalized(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(characters).collect()
    })
}

/// Sines and the like of t, which every use shares.
fn functions_of_time(
    expressions: &[ExprId],
    system: &System,
    constants: &mut Constants,
) -> Straight {
    let graph = &system.mechanism.graph;
    let only_time = |expr: ExprId| {
        graph
            .symbols(expr)
            .iter()
            .all(|symbol: &SymbolId| system.roles[symbol.index()] == SymbolRole::Time)
    };
    let mut found = Vec::new();
    let mut seen = std::collections::HashSet::new();
    let mut stack: Vec<ExprId> = expressions.iter().rev().copied().collect();
    while let Some(expr) = stack.pop() {
        if graph.is_constant(expr) || !seen.insert(expr) {
            continue;
        }
        if is_function(graph.node(expr)) && only_time(expr) {
            found.push(expr);
            continue;
        }
        match graph.node(expr) {
            Node::Sum(terms) => stack.extend(terms.iter().rev().map(|term| term.expr)),
            Node::Product(factors) => stack.extend(factors.iter().rev().map(|factor| factor.base)),
            Node::Sin(x) | Node::Cos(x) | Node::Exp(x) | Node::Ln(x) => stack.push(*x),
            Node::Atan2(y, x) => stack.extend([*x, *y]),
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
        }
    }
    Straight::new(
        found.into_iter().map(|expr| (expr, Vec::new())).collect(),
        system,
        constants,
    )
}

/// Names the constants that these expressions are written with.
fn note_constants(
    expressions: &[ExprId],
    system: &System,
    time: &Straight,
    constants: &mut Constants,
) {
    visit(expressions, system, time, &mut |parts| {
        for constant in parts.iter().filter_map(|part| part.constant.as_ref()) {
            constants.add(constant, &system.mechanism.graph);
        }
    });
}

fn operations_of(action: &Action, system: &System, time: &Straight) -> Operations {
    let mut operations = Operations::default();
    let counted = match action {
        // What a failure reports is computed only then.
        Action::Reach { excess, scale, .. } => vec![*excess, *scale],
        _ => action.values(),
    };
    visit(&counted, system, time, &mut |parts| {
        operations += Operations::of_addends(parts)
    });
    match action {
        Action::SineCosine { .. } => operations.sines += 2,
        Action::Angle { .. } => operations.arctangents += 1,
        _ => {}
    }
    operations
}

/// Calls `each` with the addends of every expression that is written out.
fn visit(
    expressions: &[ExprId],
    system: &System,
    time: &Straight,
    each: &mut dyn FnMut(&[Addend]),
) {
    let graph = &system.mechanism.graph;
    let order = WrittenOrder::new(system, &[]);
    let mut stack = expressions.to_vec();
    while let Some(expr) = stack.pop() {
        if time.name_of(expr).is_some() || matches!(graph.node(expr), Node::Symbol(_)) {
            continue;
        }
        match *graph.node(expr) {
            Node::Sin(x) | Node::Cos(x) | Node::Exp(x) | Node::Ln(x)
                if !graph.is_constant(expr) =>
            {
                stack.push(x)
            }
            Node::Atan2(y, x) if !graph.is_constant(expr) => stack.extend([y, x]),
            _ => {
                let parts = addends(expr, graph, &order, &|other| time.name_of(other).is_some());
                each(&parts);
                let operands = parts
                    .iter()
                    .flat_map(|part| part.factors.iter().chain(&part.divisors));
                stack.extend(
                    operands
                        .map(|power| power.base)
                        .filter(|&base| base != expr),
                );
            }
        }
    }
}
