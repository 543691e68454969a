//! Resolves `measure` statements.
//!
//! A measure may name everything that is declared above it, earlier measures included. Its name is a column in tables of frames, so it
//! differs from all others.

use std::collections::{HashMap, HashSet};

use super::dimension::Dimension;
use super::expression::Value;
use super::kinematic::KinematicTerms;
use super::measurement::ArmSymbols;
use super::resolve::Resolver;
use super::{ForceTerm, MeasureTerm, Measurement, Point, field_name};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::Mark;
use crate::syntax::{Constant, Name};

/// Terms of the measure being resolved, besides its points.
#[derive(Debug, Default)]
pub(super) struct MeasureTerms {
    /// Symbols with their meanings, in order of first use.
    pub terms: Vec<(SymbolId, MeasureTerm)>,
    /// Order of differentiation of each symbol that stands for a value; never iterated.
    pub orders: HashMap<SymbolId, usize>,
}

/// Order of formulas that contain forces, which are not differentiated.
const ORDER_OF_FORCES: usize = 3;

/// Prefixes of the columns of requested forces.
const COLUMNS_OF_FORCES: [&str; 3] = ["effort_", "power_", "reaction_"];

/// Columns of powers in mechanisms with friction.
const COLUMNS_OF_FRICTION: [&str; 2] = ["frictionless_power", "backward_power"];

/// Columns of the time and of requested energies.
const FIXED_COLUMNS: [&str; 4] = ["t", "kinetic_energy", "potential_energy", "added_power"];

impl Resolver<'_> {
    pub(super) fn add_measure(&mut self, written: &Constant) {
        let name = &written.name;
        if let Some(duplicate) = self.declared.measures.duplicate(name) {
            self.diagnostics.push(duplicate);
            return;
        }
        let help = "give one of them another name";
        let is_named = self.may_be_declared(name) && self.means_nothing_else(name, "measure", help);
        self.begin_measure(&name.text);
        let value = self.value(&written.value);
        let terms = self.formulas.kinematic.take();
        let terms = terms.and_then(KinematicTerms::into_measure);
        if let (Some(value), Some(terms), true) = (value, terms, is_named) {
            self.push_measurement(name.clone(), written.docs.clone(), value, terms);
        } else {
            self.diagnostics
                .extend(self.declared.measures.declare(name, None));
        }
    }

    /// Begins the formula of a measure with this name.
    pub(super) fn begin_measure(&mut self, name: &str) {
        // The symbol of a measure precedes those in its formula in every order of symbols.
        self.graph.symbol(&format!("{name} measure"));
        self.formulas.kinematic = Some(KinematicTerms::of_measure(self.terms_of_measures()));
    }

    /// Declares and adds a measure with its terms and points, and returns its index.
    pub(super) fn push_measurement(
        &mut self,
        name: Name,
        docs: Vec<String>,
        (value, dimension): Value,
        (terms, marks): (MeasureTerms, Vec<(Mark, ArmSymbols)>),
    ) -> Option<usize> {
        let number = self.declared.measurements.len();
        let declared = self.declared.measures.declare(&name, Some(number));
        if let Some(duplicate) = declared {
            self.diagnostics.push(duplicate);
            return None;
        }
        let symbol = self.graph.symbol(&format!("{} measure", name.text));
        let order = order_of(self.graph.symbols(value), &terms.orders);
        self.declared.measurements.push(Measurement {
            name: name.text,
            docs,
            value,
            symbol,
            dimension,
            order,
            marks,
            terms: terms.terms,
            span: name.span,
        });
        Some(number)
    }

    /// Returns terms that know the orders of earlier measures.
    fn terms_of_measures(&self) -> MeasureTerms {
        let measures = self.declared.measurements.iter();
        let orders = measures.map(|it| (it.symbol, it.order)).collect();
        MeasureTerms {
            orders,
            ..MeasureTerms::default()
        }
    }

    /// Returns an earlier measure in a later one; `None` for other names, and outside measures.
    pub(super) fn measure_named(&mut self, name: &Name) -> Option<Option<Value>> {
        self.formulas.kinematic.as_mut()?.measure()?;
        let (declaration, place) = self.declared.measures.found(&name.text)?;
        self.note_use(name, declaration);
        self.note_motor(name);
        // A measure with an error has been reported.
        let measure = place.and_then(|place| self.declared.measurements.get(place));
        let value = measure.map(|it| (it.symbol, it.dimension));
        Some(value.map(|(symbol, dimension)| (self.graph.variable(symbol), dimension)))
    }

    /// Reports measures whose names are those of other columns, or differ only in case.
    pub(super) fn reject_columns(&mut self, points: &[Point]) {
        let mut columns: HashSet<String> = FIXED_COLUMNS.map(str::to_string).into();
        if self.declared.has_friction {
            columns.extend(COLUMNS_OF_FRICTION.map(str::to_string));
        }
        let coordinates = self.linkage.bodies.iter().flat_map(|it| it.coordinates);
        for symbol in coordinates.flatten().map(|it| it.symbol) {
            let name = self.graph.symbol_name(symbol);
            columns.extend(["", "_d", "_dd"].map(|suffix| format!("{name}{suffix}")));
        }
        for point in points {
            let components = ["x", "y", "vx", "vy", "ax", "ay"];
            columns.extend(components.map(|component| format!("{}_{component}", point.name)));
        }
        let mut fields: HashMap<String, (String, Span)> = HashMap::new();
        let measures = self.declared.measurements.iter();
        let names: Vec<(String, Span)> = measures.map(|it| (it.name.clone(), it.span)).collect();
        for (name, span) in names {
            let is_force = COLUMNS_OF_FORCES.iter().any(|it| name.starts_with(it))
                || (self.declared.has_friction && name.starts_with("friction_"));
            if is_force || columns.contains(&name) {
                let message = format!("`{name}` is another column in tables of frames");
                let mut motors = self.declared.motors.iter();
                let help = match motors.any(|it| it.span.range().contains(&span.range().start)) {
                    true => "give the driver another name",
                    false => "give the measure another name",
                };
                let finding = Diagnostic::error(Code::NameNotAllowed, span, message);
                self.diagnostics.push(finding.help(help));
                continue;
            }
            let earlier = fields
                .entry(field_name(&name))
                .or_insert((name.clone(), span));
            if earlier.0 != name {
                let message = format!("measures `{}` and `{name}` differ only in case", earlier.0);
                let finding = Diagnostic::error(Code::NameNotAllowed, span, message)
                    .also(earlier.1, "the other one")
                    .help("give one of them another name");
                self.diagnostics.push(finding);
            }
        }
    }

    /// Returns the symbol of a rate in a measure; `None` after an error. `written` is the location of the formula.
    pub(super) fn rate_in_measure(
        &mut self,
        (value, dimension): Value,
        written: Span,
    ) -> Option<Value> {
        let terms = self.formulas.kinematic.as_mut()?.measure()?;
        let order = order_of(self.graph.symbols(value), &terms.orders);
        if order >= 2 {
            let (message, help) = match order {
                2 => (
                    "a measure cannot contain the rate of an acceleration",
                    "equations are differentiated twice: write positions, rates or accelerations",
                ),
                _ => (
                    "a measure cannot contain the rate of a force",
                    "write the force itself; its change over time is in the table of frames",
                ),
            };
            let finding = Diagnostic::error(Code::OutsideGrammar, written, message).help(help);
            self.diagnostics.push(finding);
            return None;
        }
        let symbol = self.term_of_measure(MeasureTerm::Rate(value), order + 1)?;
        Some((self.graph.variable(symbol), dimension.rate()))
    }

    /// Returns the length of a vector in a measure. `name` is the stem of its names in generated code.
    pub(super) fn length_in_measure(
        &mut self,
        name: String,
        components: Vec<ExprId>,
    ) -> Option<ExprId> {
        let terms = self.formulas.kinematic.as_mut()?.measure()?;
        let parts = components.iter();
        let orders = parts.map(|it| order_of(self.graph.symbols(*it), &terms.orders));
        let order = orders.max().unwrap_or(0);
        let symbol = self.term_of_measure(MeasureTerm::Length { name, components }, order)?;
        Some(self.graph.variable(symbol))
    }

    /// Returns the symbol of a term of a measure.
    fn term_of_measure(&mut self, term: MeasureTerm, order: usize) -> Option<SymbolId> {
        let number = self.declared.measurements.len();
        let terms = self.formulas.kinematic.as_mut()?.measure()?;
        let known = terms.terms.iter().find(|(_, own)| *own == term);
        if let Some((symbol, _)) = known {
            return Some(*symbol);
        }
        let place = terms.terms.len();
        let symbol = self.graph.symbol(&format!("{number} measure term {place}"));
        terms.terms.push((symbol, term));
        terms.orders.insert(symbol, order);
        Some(symbol)
    }

    /// Returns the symbol of a force in a measure.
    pub(super) fn force_in_measure(
        &mut self,
        force: ForceTerm,
        dimension: Dimension,
    ) -> Option<Value> {
        let symbol = self.term_of_measure(MeasureTerm::Force(force), ORDER_OF_FORCES)?;
        Some((self.graph.variable(symbol), dimension))
    }
}

/// Returns the highest order of differentiation among these symbols.
fn order_of(symbols: &[SymbolId], orders: &HashMap<SymbolId, usize>) -> usize {
    let orders = symbols.iter().filter_map(|it| orders.get(it));
    orders.max().copied().unwrap_or(0)
}
