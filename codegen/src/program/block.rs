//! A block of the plan → its function: positions, then rates, then accelerations, then responses to each direction.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::builder::Builder;
use super::directional_derivatives::DirectionalDerivatives;
use super::forms::{DrawnMode, Form, Transposed, recognize};
use super::function::{Function, Level, Statement};
use super::lengths::Lengths;
use super::path::{Path, Paths};
use super::tearing::Tearing;
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::structure::SolvedBlock;
use crate::system::System;
use crate::words::{Known, Phrase, Piece, enumerated, phrase};

/// The function of one block.
#[derive(Clone, Debug)]
pub struct Block {
    /// Its name: how it is solved, and the joints it closes.
    pub name: String,
    /// How its parts are solved, and the statements it uses.
    pub title: String,
    /// The block of the plan that it solves, from 0; `None` for what only follows from the blocks.
    pub place: Option<usize>,
    /// The joints whose equations it uses.
    pub joints: Vec<usize>,
    /// How the parts of the block are solved.
    pub forms: Vec<Arc<dyn Form>>,
    /// What it does.
    pub function: Function,
    /// The equations of its Newton-Raphson, where it needs it.
    pub newton: Option<NewtonBlock>,
    /// How far its parts are from singular, where a `monitor` statement asks for it, in their order.
    pub measured: Vec<Measured>,
    /// The Jacobians of its parts, where somebody asks for multipliers.
    pub(super) transposed: Vec<Option<Transposed>>,
    /// Local values that a page calls otherwise than the code; only looked up.
    pub page_names: HashMap<SymbolId, PageName>,
    /// Local values that a page writes out wherever they occur; only looked up.
    pub written_out: HashSet<SymbolId>,
}

/// What a page calls a local value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PageName {
    /// The component x (0) or y (1) of a vector.
    Component(String, usize),
    /// The cosine of an unknown.
    Cosine(usize),
    /// The sine of an unknown.
    Sine(usize),
}

/// An assembly mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Its name in the generated code.
    pub name: String,
    /// The symbol that is +1 or −1.
    pub symbol: SymbolId,
    /// The block of the plan that it belongs to, from 0.
    pub block: usize,
    /// What has its sign in the drawing: the sine of the angle between what the form turns, or NaN.
    pub drawn: f64,
    /// What its sign tells apart.
    pub meaning: String,
}

impl Branch {
    /// Whether it is positive in the drawing; also where the drawing says nothing.
    pub fn is_positive(&self) -> bool {
        self.drawn.is_nan() || self.drawn >= 0.0
    }
}

/// The equations that Newton-Raphson solves in one block, as functions of the tears and of what is known before.
#[derive(Clone, Debug)]
pub struct NewtonBlock {
    /// The tears.
    pub unknowns: Vec<usize>,
    /// The sign of the determinant in the drawing.
    pub drawn: DrawnMode,
    /// What each residual is measured in.
    pub quantities: Vec<Quantity>,
    /// What lengths are scaled by in the residuals, and in the tears.
    pub scaled_by: [Lengths; 2],
    /// One residual a row.
    pub residual: Function,
    /// Row by row.
    pub jacobian: Function,
    /// The rates of the residuals with the tears held.
    pub time_derivative: Function,
    /// Minus the second rates of the residuals with the tears' accelerations zero.
    pub gamma: Function,
    /// The shortcut by way of fewer unknowns, where there is one.
    pub tearing: Option<Tearing>,
}

/// The fields that hold how far a part is from singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// The sine of the angle between the two vectors of a closed form.
    Sine(SymbolId),
    /// The coefficient of a linear part.
    Slope(SymbolId),
    /// The determinant of a Newton block with columns of length 1, and its reciprocal condition.
    Block([SymbolId; 2]),
}

impl Measured {
    /// Its fields.
    pub fn fields(&self) -> Vec<SymbolId> {
        match self {
            Measured::Sine(field) | Measured::Slope(field) => vec![*field],
            Measured::Block(both) => both.to_vec(),
        }
    }
}

impl NewtonBlock {
    /// Its four functions.
    pub fn equations(&self) -> [&Function; 4] {
        [
            &self.residual,
            &self.jacobian,
            &self.time_derivative,
            &self.gamma,
        ]
    }

    /// All its functions: its equations, and those of its tearing.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let torn = self.tearing.iter().flat_map(Tearing::functions);
        self.equations().into_iter().chain(torn)
    }

    /// The same, to be changed.
    pub(super) fn functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        let torn = self.tearing.iter_mut().flat_map(Tearing::functions_mut);
        let equations = [
            &mut self.residual,
            &mut self.jacobian,
            &mut self.time_derivative,
            &mut self.gamma,
        ];
        equations.into_iter().chain(torn)
    }
}

impl Block {
    /// A block that only follows from those before it.
    pub(super) fn following(name: &str, title: &str, statements: Vec<Statement>) -> Block {
        Block {
            name: name.to_string(),
            title: title.to_string(),
            place: None,
            joints: Vec::new(),
            forms: Vec::new(),
            function: Function {
                statements,
                ..Function::default()
            },
            newton: None,
            measured: Vec::new(),
            transposed: Vec::new(),
            page_names: HashMap::new(),
            written_out: HashSet::new(),
        }
    }

    /// All its functions: its own, and those of its Newton-Raphson.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let newton = self.newton.iter();
        let lengths = newton.clone().flat_map(|it| &it.scaled_by);
        let lengths = lengths.filter_map(|it| it.following.as_ref());
        let newton = newton.flat_map(NewtonBlock::functions);
        [&self.function].into_iter().chain(newton).chain(lengths)
    }

    /// The same without what scales its Newton-Raphson, to be changed.
    pub(super) fn functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        let newton = self.newton.iter_mut().flat_map(NewtonBlock::functions_mut);
        [&mut self.function].into_iter().chain(newton)
    }
}

/// What all blocks of a mechanism are lowered with.
pub(super) struct Lowering<'a> {
    pub system: &'a mut System,
    pub branches: Vec<Branch>,
    pub derivatives: DirectionalDerivatives,
    pub known: Known,
    pub paths: Paths,
    /// Whether a person's words are wanted too.
    pub writes_prose: bool,
    names: Vec<String>,
}

impl<'a> Lowering<'a> {
    pub(super) fn new(system: &'a mut System, writes_prose: bool) -> Lowering<'a> {
        Lowering {
            derivatives: DirectionalDerivatives::new(system),
            known: Known::nothing(system),
            paths: Paths::new(system),
            branches: Vec::new(),
            names: Vec::new(),
            writes_prose,
            system,
        }
    }

    /// The function of the next block, which is the block `place` of the plan.
    pub(super) fn block(&mut self, place: usize, block: &SolvedBlock) -> Block {
        let forms: Vec<Arc<dyn Form>> = block
            .parts
            .iter()
            .map(|part| recognize(part, self.system))
            .collect();
        let name = self.set_apart(block_name(block, self.system));
        let how = match &forms[..] {
            [] => "explicit".to_string(),
            _ => forms
                .iter()
                .map(|form| form.name())
                .collect::<Vec<_>>()
                .join(", then "),
        };
        let labels = block.joints.iter();
        let labels = labels.map(|&joint| self.system.mechanism.joints[joint].label.as_str());
        let title = format!(
            "{}: {}.",
            capitalized(&how),
            labels.collect::<Vec<_>>().join(", ")
        );
        let monitor = self.system.mechanism.monitor;
        let mut builder = Builder::new(self, place);
        let mut solved = Vec::with_capacity(forms.len());
        for form in &forms {
            let found = form.position(&mut builder);
            for unknown in form.unknowns() {
                builder.known.find(unknown, place);
            }
            if monitor {
                builder.measure(form.as_ref(), found.as_ref());
            }
            solved.push(found);
        }
        builder.definitions(block);
        builder.section(Level::Velocity);
        for found in &mut solved {
            found.prepare(&mut builder);
        }
        for level in builder.levels() {
            if level != Level::Velocity {
                builder.section(level);
            }
            for found in &solved {
                found.rates(level, &mut builder);
            }
            builder.definition_rates(block, level);
        }
        let transposed = match builder.system.mechanism.forces.need_multipliers() {
            true => solved
                .iter()
                .map(|it| it.transposed(&mut builder))
                .collect(),
            false => Vec::new(),
        };
        let mut newton = solved.into_iter().find_map(|found| found.newton());
        builder.without_shifts(newton.as_mut());
        let (function, measured, page_names, written_out) = builder.finish();
        Block {
            name,
            title,
            place: Some(place),
            joints: block.joints.clone(),
            forms,
            function,
            newton,
            measured,
            transposed,
            page_names,
            written_out,
        }
    }

    /// What shows that these blocks of the plan have kept to their path.
    pub(super) fn path<'b>(
        &mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)>,
    ) -> Path {
        Builder::new(self, 0).path(blocks)
    }

    /// The same for closed forms one after another; `None` where some are of another form.
    pub(super) fn closed_path<'b>(
        &mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)>,
    ) -> Option<Function> {
        Builder::new(self, 0).two_links(blocks)
    }

    /// A name that no other block has.
    fn set_apart(&mut self, base: String) -> String {
        let mut name = base.clone();
        let mut number = 2;
        while self.names.contains(&name) {
            name = format!("{base}_{number}");
            number += 1;
        }
        self.names.push(name.clone());
        name
    }
}

/// So many accelerations are written out; more would fill a page with what differentiating once more says.
const FEW: usize = 3;

impl Builder<'_> {
    /// The explicit formulas of a block.
    fn definitions(&mut self, block: &SolvedBlock) {
        if block.parts.is_empty() {
            let source = self.explicit_source(block);
            self.heading(source);
        }
        self.say(|_| {
            match (block.parts.is_empty(), block.definitions.len()) {
                (_, 0) => "",
                (true, 1) => "It follows from one equation:",
                (true, _) => "Each follows from one equation:",
                (false, 1) => "What is left follows from one equation:",
                (false, _) => "The rest follows, each from one equation:",
            }
            .into()
        });
        for definition in &block.definitions {
            let symbol = self.system.vector_form.unknowns[definition.unknown].position;
            let remark = self.origin(&block.joints, definition.row);
            self.assign_with(symbol, definition.value, remark);
            self.known.find(definition.unknown, self.place);
            self.explicit_angle(definition.unknown);
        }
    }

    /// What the explicit formulas do at a level.
    fn definition_rates(&mut self, block: &SolvedBlock, level: Level) {
        let graph = &self.system.mechanism.graph;
        let moving = block.definitions.iter();
        let moving = moving.filter(|it| !graph.is_fixed(it.value)).count();
        let follows = !block.parts.is_empty();
        let words = match level {
            _ if moving == 0 => "",
            Level::Velocity if moving > FEW => {
                "Differentiated once; where accelerations are not written, they follow by differentiating once more:"
            }
            Level::Velocity if follows => "Differentiated once:",
            Level::Velocity => "Differentiated once and twice:",
            Level::Acceleration if follows && moving <= FEW => "Differentiated twice:",
            _ => "",
        };
        self.say(|_| words.into());
        for definition in &block.definitions {
            let rate = self.rate_at(definition.value, level);
            self.find(definition.unknown, level, rate);
        }
    }

    /// What a block without a part finds, and what it starts from.
    fn explicit_source(&mut self, block: &SolvedBlock) -> Phrase {
        const NAMED: usize = 6;
        let mechanism = &self.system.mechanism;
        let drives = |symbol: SymbolId| {
            let mut inputs = mechanism.inputs.iter();
            symbol == mechanism.time || inputs.any(|input| input.symbols[0] == symbol)
        };
        let graph = &mechanism.graph;
        let mut values = block.definitions.iter().map(|definition| definition.value);
        let driven = values
            .clone()
            .any(|value| graph.symbols(value).iter().copied().any(drives));
        let source = match (values.any(|value| graph.is_fixed(value)), driven) {
            (true, true) => " from what is fixed and what is driven",
            (false, true) => " from the drivers",
            _ => " from what is fixed",
        };
        let found = block.definitions.iter();
        let found: Vec<Phrase> = found.map(|it| Piece::Unknown(it.unknown).into()).collect();
        match found.len() {
            0..=NAMED => phrase![enumerated(&found), source],
            number => phrase![format!("{number} unknowns"), source],
        }
    }
}

/// `loop_l_g_h`: named joints, or else the first of the others.
fn block_name(block: &SolvedBlock, system: &System) -> String {
    const NAMED: usize = 6;
    if block.parts.is_empty() {
        return "explicit".to_string();
    }
    let joints = || {
        block
            .joints
            .iter()
            .map(|&joint| &system.mechanism.joints[joint])
    };
    let pins: Vec<&str> = joints()
        .filter(|joint| joint.kind.joins_points())
        .map(|joint| joint.slug.as_str())
        .collect();
    let all: Vec<&str> = joints().map(|joint| joint.slug.as_str()).collect();
    let named = if pins.is_empty() { all } else { pins };
    format!("loop_{}", named[..named.len().min(NAMED)].join("_"))
}

fn capitalized(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(characters).collect()
    })
}
