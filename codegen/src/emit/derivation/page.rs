//! Writes the sections of a derivation from the functions of all blocks.

use std::collections::HashSet;

use super::document::{DisplayedEquation, Document, Item, Section};
use super::outline::{outline, summary};
use super::script::Script;
use super::singular::singular_poses;
use super::spelling::Spelling;
use crate::expr::{ExprId, SymbolId};
use crate::pool::{Draft, SymbolRole};
use crate::program::{Block, Level, PageName, Program, Statement};
use crate::solved::Solved;
use crate::structure::{SolvedBlock, SolvedPlan};
use crate::words::{Phrase, Piece, not_carried};

/// Number of accelerations that are written out; more would fill the page with plain derivatives.
pub(super) const FEW: usize = 3;

/// A derivation in the making.
pub(super) struct Writer<'a> {
    plan: &'a SolvedPlan,
    program: &'a Program,
    spelling: Spelling<'a>,
    items: Vec<Item>,
}

impl<'a> Writer<'a> {
    /// Writer about a motion of which nothing is omitted; formulas extend the draft of its pool.
    pub(super) fn new(draft: &'a mut Draft, solved: &'a Solved, script: Script) -> Writer<'a> {
        Writer {
            plan: solved.plan(),
            program: solved.program(),
            spelling: Spelling::new(draft, solved.system(), script),
            items: Vec::new(),
        }
    }

    /// The whole derivation.
    pub(super) fn document(mut self) -> Document {
        let (plan, program) = (self.plan, self.program);
        let script = self.spelling.script;
        let summary = summary(self.spelling.system, plan, &program.forms);
        let outline = outline(
            self.spelling.pool,
            self.spelling.system,
            plan,
            &program.forms,
            script,
        );
        for branch in &program.branches {
            let graph = self.spelling.graph();
            let one = graph.one();
            let sign = if branch.is_positive() {
                one
            } else {
                graph.negate(one)
            };
            self.spelling.replace(branch.symbol, sign);
        }
        // Shifts of drivers are zero.
        let shifts: Vec<SymbolId> = self
            .spelling
            .system
            .directions
            .iter()
            .filter(|it| !it.is_parameter())
            .map(|it| it.symbol)
            .collect();
        let zero = self.spelling.graph().zero();
        for shift in shifts {
            self.spelling.replace(shift, zero);
        }
        let mut sections: Vec<Section> = Vec::new();
        for (block, solved) in program.blocks.iter().zip(&plan.blocks) {
            let heading = self.block(block, solved);
            let heading = format!("Block {}. {heading}", sections.len() + 1);
            let items = std::mem::take(&mut self.items);
            sections.push(Section { heading, items });
        }
        let nothing = SolvedBlock {
            joints: Vec::new(),
            parts: Vec::new(),
            definitions: Vec::new(),
        };
        for block in program.blocks.iter().skip(plan.blocks.len()) {
            let heading = self.block(block, &nothing);
            let heading = match block.name.as_str() {
                "measures" => "Measures".to_string(),
                "measured_forces" => "Measures of forces".to_string(),
                _ => format!("Forces: {heading}"),
            };
            let items = std::mem::take(&mut self.items);
            sections.push(Section { heading, items });
        }
        sections.extend(self.not_carried_section());
        sections.extend(self.singular_section());
        let title = self.spelling.system.mechanism.title();
        Document {
            name: script.word(&title),
            summary,
            outline,
            sections,
        }
    }

    /// Writes a block's section and returns its heading.
    fn block(&mut self, block: &Block, solved: &SolvedBlock) -> String {
        let skipped = self.skipped(solved);
        let mut headings = Vec::new();
        let mut equations = Vec::new();
        let mut is_asked = true;
        for statement in &block.function.statements {
            if let Statement::Section(level) = statement {
                // Derivatives by drivers and parameters are not derived by hand.
                is_asked = matches!(
                    level,
                    Level::Position | Level::Velocity | Level::Acceleration | Level::Forces
                );
            }
            if !is_asked {
                continue;
            }
            match statement {
                Statement::Heading(words) => headings.push(self.spelling.phrase(words)),
                Statement::Note(words) => {
                    self.equations(&mut equations);
                    let text = self.spelling.phrase(words);
                    self.paragraph(text);
                }
                Statement::Shown {
                    left,
                    right,
                    remark,
                } => {
                    let (left, right) = (self.spelling.side(left), self.spelling.side(right));
                    let note = self.spelling.phrase(remark);
                    equations.push(DisplayedEquation { left, right, note });
                }
                Statement::Let {
                    target,
                    value,
                    remark,
                } => {
                    let equation = self.assignment(block, *target, *value, remark);
                    equations.extend(equation.filter(|_| !skipped.contains(target)));
                }
                Statement::SineCosine {
                    sine,
                    cosine,
                    angle,
                } => {
                    let angle = self.spelling.written(*angle);
                    let graph = self.spelling.graph();
                    let written = [graph.sin(angle), graph.cos(angle)];
                    self.spelling.replace(*sine, written[0]);
                    self.spelling.replace(*cosine, written[1]);
                }
                Statement::Angle {
                    target,
                    sine,
                    cosine,
                } => {
                    let script = self.spelling.script;
                    let [sine, cosine] = [sine, cosine].map(|part| self.spelling.formula(*part));
                    equations.push(DisplayedEquation {
                        left: self.symbol(*target),
                        right: script.atan2(&sine, &cosine),
                        note: String::new(),
                    });
                }
                _ => {}
            }
        }
        self.equations(&mut equations);
        headings.join("; ")
    }

    /// Equation of an assignment; `None` if the page writes its value out.
    fn assignment(
        &mut self,
        block: &Block,
        target: SymbolId,
        value: ExprId,
        remark: &Phrase,
    ) -> Option<DisplayedEquation> {
        self.relate(value);
        let value = self.spelling.written(value);
        if block.written_out.contains(&target) {
            self.spelling.replace(target, value);
            return None;
        }
        let left = match (block.page_names.get(&target), self.role(target)) {
            (Some(name), _) => {
                let name = self.page_name(name);
                self.spelling.replace(target, name);
                self.spelling.formula_as_is(name)
            }
            // A rotated local vector is written as cosines and sines.
            (None, SymbolRole::Arm(_)) => return None,
            (None, role) => {
                let left = self.symbol(target);
                if matches!(role, SymbolRole::Position(_)) && self.spelling.graph().is_fixed(value)
                {
                    self.spelling.replace(target, value);
                }
                left
            }
        };
        Some(DisplayedEquation {
            left,
            right: self.spelling.formula_as_is(value),
            note: self.spelling.phrase(remark),
        })
    }

    fn role(&self, symbol: SymbolId) -> SymbolRole {
        self.spelling.pool.role(symbol)
    }

    /// A symbol as a formula.
    fn symbol(&mut self, symbol: SymbolId) -> String {
        let variable = self.spelling.graph().variable(symbol);
        self.spelling.formula_as_is(variable)
    }

    /// Replacement of a local value on the page.
    fn page_name(&mut self, name: &PageName) -> ExprId {
        match name {
            PageName::Component(vector, axis) => {
                let name = format!("{vector}_{}", ["x", "y"][*axis]);
                let symbol = self.spelling.pool.intermediate(&name);
                self.spelling.graph().variable(symbol)
            }
            PageName::Cosine(unknown) | PageName::Sine(unknown) => {
                let position = self.spelling.system.vector_form.unknowns[*unknown].position;
                let graph = self.spelling.graph();
                let angle = graph.variable(position);
                match name {
                    PageName::Cosine(_) => graph.cos(angle),
                    _ => graph.sin(angle),
                }
            }
        }
    }

    /// Accelerations that are not written out: of many, only those of functions of time are written.
    fn skipped(&self, solved: &SolvedBlock) -> HashSet<SymbolId> {
        let system = &self.spelling.system;
        let graph = &self.spelling.pool.graph;
        let moving = solved
            .definitions
            .iter()
            .filter(|it| !graph.is_fixed(it.value));
        let is_timed = |symbol: &SymbolId| {
            matches!(
                self.spelling.pool.role(*symbol),
                SymbolRole::Time | SymbolRole::Parameter(_) | SymbolRole::Input { .. }
            )
        };
        let unknowns = &system.vector_form.unknowns;
        let fixed = solved
            .definitions
            .iter()
            .filter(|it| graph.is_fixed(it.value));
        // A constant has no rates worth writing.
        let at_rest = fixed.flat_map(|it| {
            let unknown = &unknowns[it.unknown];
            [unknown.rate, unknown.acceleration]
        });
        let mut skipped: HashSet<SymbolId> = at_rest.collect();
        if moving.clone().count() > FEW {
            let many = moving.filter(|it| !graph.symbols(it.value).iter().all(is_timed));
            skipped.extend(many.map(|it| unknowns[it.unknown].acceleration));
        }
        skipped
    }

    fn not_carried_section(&mut self) -> Option<Section> {
        let sentences = not_carried(
            &self.spelling.system.mechanism,
            &mut self.spelling.pool.graph,
        );
        let items = sentences.iter().map(|it| self.spelling.phrase(it));
        let items: Vec<Item> = items.map(Item::Paragraph).collect();
        (!items.is_empty()).then(|| Section {
            heading: "What bearings do not carry".to_string(),
            items,
        })
    }

    fn singular_section(&mut self) -> Option<Section> {
        // A determinant stands alone: only names that the page has defined already may occur.
        let mut draft = self.spelling.pool.clone();
        let mut spelling = Spelling::new(&mut draft, self.spelling.system, self.spelling.script);
        spelling.parts = self.spelling.parts.settled();
        let poses = singular_poses(&mut spelling, self.plan, &self.program.forms);
        let items = poses.iter().map(|pose| {
            let sentence = pose.sentence();
            Item::Paragraph(format!(
                "Block {}, {}: {sentence}",
                pose.block + 1,
                pose.unknowns
            ))
        });
        (!poses.is_empty()).then(|| Section {
            heading: "Singular poses, by the determinant of each block up to its sign".to_string(),
            items: items.collect(),
        })
    }

    fn paragraph(&mut self, text: String) {
        self.define(self.items.len());
        self.items.push(Item::Paragraph(text));
    }

    /// Displays the equations that have gathered.
    fn equations(&mut self, equations: &mut Vec<DisplayedEquation>) {
        if !equations.is_empty() {
            let introduced = matches!(self.items.last(), Some(Item::Paragraph(_)));
            self.define(self.items.len() - usize::from(introduced));
            self.items.push(Item::Equations(std::mem::take(equations)));
        }
    }

    /// Records the choices that are derivatives of those in an expression.
    fn relate(&mut self, expr: ExprId) {
        self.spelling.parts.relate(self.spelling.pool, expr, 2);
    }

    /// Inserts the definitions of the names that were used since the last call.
    fn define(&mut self, place: usize) {
        let spelling = &mut self.spelling;
        let definitions = spelling.parts.definitions(spelling.pool);
        let equations: Vec<DisplayedEquation> = definitions
            .iter()
            .map(|definition| DisplayedEquation {
                left: spelling.formula_as_is(definition.name),
                right: spelling
                    .script
                    .value(spelling.pool, spelling.system, definition.value),
                note: String::new(),
            })
            .collect();
        if equations.is_empty() {
            return;
        }
        let any = |part: &str| {
            equations
                .iter()
                .any(|equation| equation.left.contains(part))
        };
        let words = match any("slope") {
            true => "Given piece by piece, slopes and curvatures as first and second derivatives:",
            false if any("piece") => "Given piece by piece:",
            false => "With these parts:",
        };
        let items = [
            Item::Paragraph(words.to_string()),
            Item::Equations(equations),
        ];
        self.items.splice(place..place, items);
    }
}

/// Unknowns as words.
pub(super) fn names(unknowns: &[usize]) -> Vec<Phrase> {
    unknowns
        .iter()
        .map(|&unknown| Piece::Unknown(unknown).into())
        .collect()
}
