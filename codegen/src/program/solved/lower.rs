//! Every block of the plan → its function.

use super::builder::Builder;
use super::fields::fields;
use super::liveness::prune;
use super::outputs::outputs;
use super::{Action, BlockProgram, Level, Output, Report, SolvedProgram};
use std::collections::HashSet;

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
    let coordinates = system.coordinates.len();
    let is_coordinate = |symbol: SymbolId, system: &System| match system.roles[symbol.index()] {
        SymbolRole::Position(unknown)
        | SymbolRole::Rate(unknown)
        | SymbolRole::Acceleration(unknown) => unknown < coordinates,
        _ => false,
    };
    let wanted = outputs(system, constants);
    let system = &*system;
    let mut report = Report::default();
    let mut all = blocks.clone();
    prune(&mut all, &|symbol| is_coordinate(symbol, system), system);
    report.all_operations = operations(&all, system);
    let (outputs, asked) = match wanted {
        None => {
            blocks = all;
            (None, HashSet::new())
        }
        Some((outputs, last)) => {
            note_constants(
                &last
                    .actions
                    .iter()
                    .flat_map(Action::values)
                    .collect::<Vec<_>>(),
                system,
                &last.time,
                constants,
            );
            blocks.push(last);
            let asked: HashSet<SymbolId> = outputs.iter().flat_map(Output::fields).collect();
            prune(&mut blocks, &|symbol| asked.contains(&symbol), system);
            (Some(outputs), asked)
        }
    };
    let is_empty = |block: &BlockProgram| block.actions.is_empty();
    report.left_out = blocks
        .iter()
        .filter(|block| is_empty(block))
        .map(|block| block.name.clone())
        .collect();
    blocks.retain(|block| !is_empty(block));
    report.kept = blocks.iter().map(|block| block.name.clone()).collect();
    report.operations = operations(&blocks, system);
    let angles = |blocks: &[BlockProgram]| -> HashSet<usize> {
        let actions = blocks.iter().flat_map(|block| &block.actions);
        actions
            .filter_map(|action| match action {
                Action::Angle { unknown, .. } => Some(*unknown),
                _ => None,
            })
            .collect()
    };
    let computed = angles(&blocks);
    let closed = plan
        .blocks
        .iter()
        .flat_map(|block| &block.steps)
        .filter(|step| !matches!(step, Step::Newton { .. }));
    let left_out = closed.flat_map(Step::unknowns).filter(|unknown| {
        let is_angle =
            system.vector_form.unknowns[*unknown].quantity == crate::joint::Quantity::Angle;
        is_angle && !computed.contains(unknown)
    });
    report.angles_left_out = left_out
        .map(|unknown| system.unknown_name(unknown).to_string())
        .collect();
    for block in &mut blocks {
        let actions = &block.actions;
        let time = block
            .time
            .for_results(&evaluated(actions, block.newton.as_ref()), system);
        block.time = time;
    }
    let used: HashSet<SymbolId> = blocks
        .iter()
        .flat_map(|block| evaluated(&block.actions, block.newton.as_ref()))
        .flat_map(|expr| system.mechanism.graph.symbols(expr).to_vec())
        .collect();
    branches.retain(|branch| used.contains(&branch.symbol));
    let fields = fields(&blocks, &asked, outputs.is_none(), system);
    for block in &mut blocks {
        let reads_branch = evaluated(&block.actions, None).into_iter().any(|expr| {
            branches
                .iter()
                .any(|branch| system.mechanism.graph.depends_on(expr, branch.symbol))
        });
        block.reads_branch = reads_branch;
    }
    SolvedProgram {
        blocks,
        fields,
        branches,
        outputs,
        report,
    }
}

/// Every expression that a block writes out.
fn evaluated(actions: &[Action], newton: Option<&super::NewtonBlock>) -> Vec<ExprId> {
    let mut expressions: Vec<ExprId> = actions.iter().flat_map(Action::values).collect();
    if let Some(newton) = newton {
        expressions.extend(newton.geometry.iter().flat_map(Action::values));
        expressions.extend(newton.expressions());
    }
    expressions
}

/// The operations of each level in all blocks.
fn operations(blocks: &[BlockProgram], system: &System) -> [Operations; 3] {
    let mut levels = [Operations::default(); 3];
    for block in blocks {
        let mut level = 0;
        let time = block
            .time
            .for_results(&evaluated(&block.actions, None), system);
        // Functions of time serve all levels; they count with the first.
        levels[0] += time.operations(&system.mechanism.graph);
        for action in &block.actions {
            if let Action::Section(section) = action {
                level = *section as usize;
            }
            levels[level] += operations_of(action, system, &block.time);
        }
    }
    levels
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

/// What a step's rates are found from, kept until all positions of the block are.
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

/// The same with what both levels share.
enum Motion {
    TwoRotations(super::two_rotations::DyadMotion),
    OneAngle(super::one_angle::Root),
    Slide(super::slides::SlideMotion),
    TwoSlides(super::slides::Lines, super::two_rotations::Closing),
    Linear {
        unknown: usize,
        coefficient: ExprId,
        equation: ExprId,
    },
}

impl Builder<'_> {
    fn motion(&mut self, pending: Pending) -> Motion {
        match pending {
            Pending::TwoRotations(triangle) => {
                Motion::TwoRotations(self.two_rotation_motion(&triangle))
            }
            Pending::OneAngle(root) => Motion::OneAngle(root),
            Pending::Slide(slide) => Motion::Slide(self.slide_motion(&slide)),
            Pending::TwoSlides(lines) => {
                let (lines, closing) = self.two_slide_motion(&lines);
                Motion::TwoSlides(lines, closing)
            }
            Pending::Linear {
                unknown,
                coefficient,
                equation,
            } => Motion::Linear {
                unknown,
                coefficient,
                equation,
            },
        }
    }

    fn rates(&mut self, motion: &Motion, level: Level) {
        match motion {
            Motion::TwoRotations(dyad) => self.two_rotation_rates(dyad, level),
            Motion::OneAngle(root) => self.one_angle_rates(root, level),
            Motion::Slide(slide) => self.slide_rates(slide, level),
            Motion::TwoSlides(lines, closing) => self.two_slide_rates(lines, closing, level),
            Motion::Linear {
                unknown,
                coefficient,
                equation,
            } => {
                self.linear_rates(*unknown, *coefficient, *equation, level);
            }
        }
    }
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
    for definition in &block.definitions {
        let symbol = builder.system.vector_form.unknowns[definition.unknown].position;
        builder.assign(symbol, definition.value);
        builder.explicit_angle(definition.unknown);
    }
    builder.actions.push(Action::Section(Level::Velocity));
    let motions: Vec<Motion> = pending
        .into_iter()
        .map(|step| builder.motion(step))
        .collect();
    for level in [Level::Velocity, Level::Acceleration] {
        if level == Level::Acceleration {
            builder.actions.push(Action::Section(level));
        }
        for motion in &motions {
            builder.rates(motion, level);
        }
        for definition in &block.definitions {
            let target = builder.target(definition.unknown, level);
            let rate = builder.rate_at(definition.value, level);
            builder.assign(target, rate);
        }
    }
    let actions = builder.actions;
    let expressions = evaluated(&actions, newton.as_ref());
    let time = functions_of_time(&expressions, system, constants);
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
        reads_branch: branches.len() > first_branch,
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
    let mut seen = HashSet::new();
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
