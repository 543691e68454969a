//! Collects the equations of a system, section by section, with formulas in the spelling of a page.
//!
//! Long parts of formulas get their names in the order of the sections, so every page defines the names that it uses.

use super::formula::{Printer, Spelling};
use super::named_parts::NamedParts;
use crate::expr::ExprId;
use crate::pool::{Pool, SymbolRole};
use crate::system::{Cause, Derived, Row, System};

/// Equations of a system.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// Coordinates, their rates and their accelerations.
    pub coordinates: Vec<[String; 3]>,
    /// Sections in reading order.
    pub sections: Vec<Section>,
}

/// Entries of one quantity; those that are zero are omitted, except for residuals.
#[derive(Clone, Debug)]
pub struct Section {
    /// Quantity of the entries.
    pub quantity: Quantity,
    /// Entries, ordered by row.
    pub entries: Vec<Entry>,
}

/// Quantity of which a section lists the entries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Φ.
    Residual,
    /// Φ_q.
    Jacobian,
    /// Φ_t.
    TimeDerivative,
    /// γ.
    Gamma,
    /// ∂Φ/∂s for the value s of each driver.
    Drivers,
    /// ∂Φ/∂p for the parameter of this name.
    Parameter(String),
    /// Residuals of redundant equations.
    Monitored,
    /// Coordinates of points.
    Points,
    /// Named parts of the other formulas.
    Definitions,
}

/// Formula with its subject.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Subject of the formula.
    pub subject: Subject,
    /// Formula.
    pub value: String,
}

/// Subject of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Index of an equation.
    Row(usize),
    /// Indices of an equation and of a coordinate in Φ_q.
    Slope(usize, usize),
    /// Index of the joint of a redundant equation.
    Redundant(usize),
    /// Index of a point and of an axis.
    Point(usize, usize),
    /// Name of a part of other formulas.
    Name(String),
}

impl Section {
    fn new(quantity: Quantity, entries: impl IntoIterator<Item = Entry>) -> Section {
        Section {
            quantity,
            entries: entries.into_iter().collect(),
        }
    }

    /// Returns the coordinates and values of the entries of Φ_q in a row.
    pub fn slopes(&self, row: usize) -> impl Iterator<Item = (usize, &str)> {
        let is_before = |it: &Entry| matches!(it.subject, Subject::Slope(own, _) if own < row);
        let rest = &self.entries[self.entries.partition_point(is_before)..];
        rest.iter().map_while(move |it| match it.subject {
            Subject::Slope(own, coordinate) if own == row => Some((coordinate, it.value.as_str())),
            _ => None,
        })
    }
}

impl Inspection {
    /// Collects the equations of a system in a spelling.
    pub(super) fn of(derived: &Derived, spelling: impl Spelling) -> Inspection {
        let system = &derived.system;
        let mut pool = derived.pool.draft();
        let parts = NamedParts::of_rows(&mut pool, system);
        let mut sections = sections(&Formulas {
            pool: &pool,
            system,
            parts: &parts,
            spelling,
        });
        let definitions = parts.definitions(&mut pool);
        let printer = Printer::new(&pool, system, &[], spelling);
        let definitions = definitions.iter().map(|it| Entry {
            subject: Subject::Name(printer.expression(it.name)),
            value: printer.expression(it.value),
        });
        sections.push(Section::new(Quantity::Definitions, definitions));
        sections.retain(|it| !it.entries.is_empty() || !it.quantity.is_optional());
        let levels = [
            SymbolRole::Position,
            SymbolRole::Rate,
            SymbolRole::Acceleration,
        ];
        let coordinates = 0..system.coordinates.len();
        Inspection {
            coordinates: coordinates
                .map(|index| levels.map(|level| printer.symbol(level(index))))
                .collect(),
            sections,
        }
    }
}

impl Quantity {
    /// True if a section without entries is omitted.
    fn is_optional(&self) -> bool {
        use Quantity::{Definitions, Drivers, Monitored, Points};
        matches!(self, Drivers | Monitored | Points | Definitions)
    }
}

/// Returns all sections except for the definitions.
fn sections(formulas: &Formulas<'_, impl Spelling>) -> Vec<Section> {
    let System {
        mechanism,
        rows,
        directions,
        monitored,
        outputs,
        ..
    } = formulas.system;
    let residuals = rows.iter().enumerate();
    let residuals = residuals.map(|(at, it)| formulas.row(Subject::Row(at), it, it.residual));
    let slopes = rows.iter().enumerate().flat_map(|(at, row)| {
        let entries = row.jacobian.iter();
        entries.map(move |it| formulas.row(Subject::Slope(at, it.coordinate), row, it.value))
    });
    let column = |of: fn(&Row) -> ExprId| formulas.nonzero(rows.iter().map(of));
    let mut sections = vec![
        Section::new(Quantity::Residual, residuals),
        Section::new(Quantity::Jacobian, slopes),
        Section::new(Quantity::TimeDerivative, column(|row| row.time_derivative)),
        Section::new(Quantity::Gamma, column(|row| row.gamma)),
    ];
    let (mut drivers, mut parameters) = (Vec::new(), Vec::new());
    for direction in directions {
        let entries = formulas.nonzero(direction.column.iter().copied());
        match direction.cause {
            Cause::Driver { .. } => drivers.extend(entries),
            Cause::Parameter(index) => {
                let name = Quantity::Parameter(mechanism.parameters[index].name.clone());
                parameters.push(Section::new(name, entries));
            }
        }
    }
    sections.push(Section::new(Quantity::Drivers, drivers));
    sections.extend(parameters);
    let monitored = monitored.iter();
    let monitored = monitored.map(|it| formulas.row(Subject::Redundant(it.joint), it, it.residual));
    sections.push(Section::new(Quantity::Monitored, monitored));
    let points = outputs.iter().enumerate().flat_map(|(point, output)| {
        let axes = output.position.into_iter().enumerate();
        axes.map(move |(axis, value)| formulas.entry(Subject::Point(point, axis), &[], value))
    });
    sections.push(Section::new(Quantity::Points, points));
    sections
}

/// Formulas of a system in a spelling.
struct Formulas<'a, S> {
    pool: &'a Pool,
    system: &'a System,
    parts: &'a NamedParts,
    spelling: S,
}

impl<S: Spelling> Formulas<'_, S> {
    /// Returns a formula that names bodies in this order.
    fn entry(&self, subject: Subject, bodies: &[usize], value: ExprId) -> Entry {
        let is_long = self.parts.meet(&self.pool.graph, value);
        let printer = Printer::new(self.pool, self.system, bodies, self.spelling);
        Entry {
            subject,
            value: printer.naming(self.parts, is_long).expression(value),
        }
    }

    fn row(&self, subject: Subject, row: &Row, value: ExprId) -> Entry {
        self.entry(subject, &row.bodies, value)
    }

    /// Returns the nonzero entries of a column with one value per equation.
    fn nonzero(&self, column: impl Iterator<Item = ExprId>) -> Vec<Entry> {
        let zero = self.pool.graph.zero();
        let rows = self.system.rows.iter().zip(column).enumerate();
        rows.filter(|(_, (_, value))| *value != zero)
            .map(|(at, (row, value))| self.row(Subject::Row(at), row, value))
            .collect()
    }
}
