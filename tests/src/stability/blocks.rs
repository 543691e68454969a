//! Bounds the error of the solved formulation's statements in floating point, around the exact motion.
//!
//! The statements of every block are run in 384 bits with the branches of the design configuration, which must lead
//! to the exact motion. Each of them adds its roundings to the errors of its operands ([`super::bounded`]); a block
//! without a closed form is bounded as in [`super::dense`]. So these bounds hold for the operations of a generated
//! module, in any order of sums and products.

use linkwright_codegen::stages::structure::Shift;
use std::cell::RefCell;

use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::program::{Function, Kept, Level, NewtonBlock, Statement};
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::system::Derived;

use super::bounded::{Margin, errors};
use super::dense::{Dense, Evaluated};
use super::precise::{Factors, Nodes, Precise, arctangent, pi};
use super::truth::{Exact, Given, Levels};
use super::verdict::Scalar;
use crate::magnitude::needed;

/// Solved formulation of a mechanism.
pub struct Blocks {
    solved: Solved,
}

/// Values and errors of all symbols so far.
struct State<'a> {
    derived: &'a Derived,
    nodes: RefCell<Nodes>,
    symbols: Vec<Precise>,
    margins: Vec<Margin>,
    scalar: Scalar,
}

impl Blocks {
    /// Solved formulation with all values; `None` if the system has none.
    pub fn new(derived: &Derived) -> Option<Blocks> {
        let derived = Derived {
            pool: derived.pool.clone(),
            system: derived.system.without_directions(),
        };
        let solved = Solved::of(derived, Shift::Efforts, Kept::Everything).ok()?;
        Some(Blocks { solved })
    }

    /// Bounds on the error of q, q̇ and q̈ in a scalar; `length` is the scale of residuals in m.
    ///
    /// # Errors
    /// The statements do not lead to the exact motion.
    pub fn bounds(
        &self,
        given: &Given,
        exact: &Exact,
        length: f64,
        scalar: Scalar,
    ) -> Result<Levels<Margin>, String> {
        let graph = &self.solved.pool().graph;
        let mut state = State {
            derived: self.solved.derived(),
            nodes: RefCell::new(Nodes::new(graph)),
            symbols: given.symbols(self.solved.derived(), Precise::from_f64),
            margins: vec![Margin::NONE; graph.symbol_count()],
            scalar,
        };
        for branch in &self.solved.program().branches {
            let sign = if branch.is_positive() { 1.0 } else { -1.0 };
            state.symbols[branch.symbol.index()] = Precise::from_f64(sign);
        }
        for block in &self.solved.program().blocks {
            for statement in &block.function.statements {
                if let Statement::Section(Level::Response(_) | Level::ResponseRate(_)) = statement {
                    break;
                }
                match (statement, &block.newton) {
                    (Statement::Newton { torn, .. }, Some(newton)) => {
                        state.iterate(newton, exact, length)?;
                        if let Some(torn) = torn {
                            state.point(newton, &torn.directions);
                        }
                    }
                    _ => state.run(statement, exact),
                }
            }
        }
        state.compare(exact)?;
        let coordinates = || self.solved.system().coordinates.iter();
        let of = |symbol: SymbolId| state.margins[symbol.index()];
        Ok([
            coordinates().map(|it| of(it.position)).collect(),
            coordinates().map(|it| of(it.rate)).collect(),
            coordinates().map(|it| of(it.acceleration)).collect(),
        ])
    }
}

/// Results of a function.
fn results(function: &Function) -> Vec<ExprId> {
    function.results.iter().map(|it| it.expr).collect()
}

/// Bound on a difference that is zero in 384 bits.
const LOST: f64 = 1e-60;

impl State<'_> {
    /// Errors of expressions if symbols have the errors `margins`.
    fn errors(&self, roots: &[ExprId], margins: &[Margin]) -> Vec<Margin> {
        let graph = &self.derived.pool.graph;
        let order = needed(graph, roots);
        let mut nodes = self.nodes.borrow_mut();
        nodes.evaluate(graph, &order, &self.symbols);
        let all = errors(graph, &order, &nodes.rounded, margins, self.scalar);
        roots.iter().map(|root| all[root.index()]).collect()
    }

    fn value(&self, expr: ExprId) -> Precise {
        self.nodes.borrow().of(expr).clone()
    }

    fn set(&mut self, symbol: SymbolId, value: Precise, margin: Margin) {
        self.symbols[symbol.index()] = value;
        self.margins[symbol.index()] = margin;
    }

    /// Runs one statement in the order of the program.
    fn run(&mut self, statement: &Statement, exact: &Exact) {
        let roots = match statement {
            Statement::Let { .. } | Statement::SineCosine { .. } | Statement::Angle { .. } => {
                statement.values()
            }
            _ => return,
        };
        let argument_errors = self.errors(&roots, &self.margins);
        let epsilon = self.scalar.epsilon();
        match statement {
            Statement::Let { target, value, .. } => {
                self.set(*target, self.value(*value), argument_errors[0])
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let angle = self.value(*angle);
                let [s, c] = [angle.sin(), angle.cos()];
                let [to_sine, to_cosine] = turned(&s, &c, argument_errors[0], epsilon);
                self.set(*sine, s, to_sine);
                self.set(*cosine, c, to_cosine);
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let (y, x) = (self.value(*sine), self.value(*cosine));
                let size = y.to_f64().hypot(x.to_f64());
                let moved = argument_errors[0]
                    .times(x.to_f64() / size)
                    .plus(argument_errors[1].times(y.to_f64() / size))
                    .times(1.0 / size);
                let mut unknowns = self.derived.system.vector_form.unknowns.iter();
                let unknown = unknowns.position(|it| it.position == *target);
                let near = unknown.and_then(|unknown| exact.levels[0].get(unknown));
                let angle = wound(&arctangent(&y, &x), near);
                // The promise of `linkwright::math::Real::angle_near`: 2 ε of the angle, or of π/4 where that is larger.
                let rounding =
                    2.0 * epsilon * angle.to_f64().abs().max(std::f64::consts::FRAC_PI_4);
                self.set(*target, angle, moved.plus(Margin::even(rounding)));
            }
            _ => {}
        }
    }

    /// Tearing variables of a block without a closed form, with their rates and accelerations.
    fn iterate(&mut self, newton: &NewtonBlock, exact: &Exact, length: f64) -> Result<(), String> {
        let unknowns: Vec<_> = newton
            .unknowns
            .iter()
            .map(|&place| {
                (
                    place,
                    self.derived.system.vector_form.unknowns[place].clone(),
                )
            })
            .collect();
        let mut levels: [Vec<f64>; 3] = Default::default();
        for (place, unknown) in &unknowns {
            let symbols = [unknown.position, unknown.rate, unknown.acceleration];
            for (level, symbol) in symbols.into_iter().enumerate() {
                let value = exact.levels[level].get(*place);
                let value =
                    value.ok_or("a tearing variable without a coordinate has no exact value")?;
                levels[level].push(value.to_f64());
                self.set(symbol, value.clone(), Margin::NONE);
            }
        }
        // The geometry comes first.
        for function in newton.equations() {
            for statement in &function.statements {
                self.run(statement, exact);
            }
        }
        let n = unknowns.len();
        let entries = results(&newton.jacobian);
        self.errors(&entries, &self.margins);
        let rows: Vec<Vec<Precise>> = entries
            .chunks(n)
            .map(|row| row.iter().map(|&entry| self.value(entry)).collect())
            .collect();
        let jacobian = rows
            .iter()
            .map(|row| row.iter().map(Precise::to_f64).collect());
        let jacobian = jacobian.collect();
        let factors = Factors::new(rows).ok_or("the block is singular")?;
        let columns: Vec<Vec<Precise>> = (0..n)
            .map(|column| {
                let unit = (0..n).map(|row| f64::from(u8::from(row == column)));
                factors.solve(&unit.map(Precise::from_f64).collect::<Vec<_>>())
            })
            .collect();
        let inverse = (0..n)
            .map(|row| columns.iter().map(|it| it[row].to_f64()).collect())
            .collect();
        let power = |quantity: linkwright_codegen::stages::joint::Quantity| {
            length.powi(quantity.power_of_length())
        };
        let dense = Dense {
            jacobian,
            inverse,
            rows: newton.quantities.iter().map(|&it| power(it)).collect(),
            columns: unknowns.iter().map(|(_, it)| power(it.quantity)).collect(),
            levels,
        };
        let of = |function: &Function, mut margins: Vec<Margin>| {
            for statement in &function.statements {
                match statement {
                    Statement::Let { target, value, .. } => {
                        margins[target.index()] = self.errors(&[*value], &margins)[0];
                    }
                    Statement::SineCosine {
                        sine,
                        cosine,
                        angle,
                    } => {
                        let off = self.errors(&[*angle], &margins)[0];
                        let [s, c] = [sine, cosine].map(|it| &self.symbols[it.index()]);
                        let [to_sine, to_cosine] = turned(s, c, off, self.scalar.epsilon());
                        margins[sine.index()] = to_sine;
                        margins[cosine.index()] = to_cosine;
                    }
                    _ => {}
                }
            }
            self.errors(&results(function), &margins)
        };
        let evaluate = |pose: &[Margin], rates: &[Margin]| {
            let mut margins = self.margins.clone();
            for (((_, unknown), pose), rate) in unknowns.iter().zip(pose).zip(rates) {
                margins[unknown.position.index()] = *pose;
                margins[unknown.rate.index()] = *rate;
            }
            let of = |function: &Function| of(function, margins.clone());
            Evaluated {
                residuals: of(&newton.residual),
                jacobian: of(&newton.jacobian)
                    .chunks(n)
                    .map(<[Margin]>::to_vec)
                    .collect(),
                drift: of(&newton.time_derivative),
                gamma: of(&newton.gamma),
            }
        };
        let bounds = dense.bounds(self.scalar, &evaluate);
        for (at, (_, unknown)) in unknowns.iter().enumerate() {
            let symbols = [unknown.position, unknown.rate, unknown.acceleration];
            for (symbol, level) in symbols.into_iter().zip(&bounds.levels) {
                self.margins[symbol.index()] = level[at];
            }
        }
        Ok(())
    }

    /// Sines and cosines of angles that a torn block computes in between. All its equations hold as accurately as if
    /// solved at once, and the angle is that of both, except for its rounding.
    fn point(&mut self, newton: &NewtonBlock, directions: &[Option<[SymbolId; 2]>]) {
        let epsilon = self.scalar.epsilon();
        for (&unknown, direction) in newton.unknowns.iter().zip(directions) {
            let Some([sine, cosine]) = *direction else {
                continue;
            };
            let position = self.derived.system.vector_form.unknowns[unknown]
                .position
                .index();
            let angle = self.symbols[position].clone();
            let [s, c] = [angle.sin(), angle.cos()];
            let rounding = 2.0 * epsilon * angle.to_f64().abs().max(std::f64::consts::FRAC_PI_4);
            let off = self.margins[position].plus(Margin::even(rounding));
            let [to_sine, to_cosine] = turned(&s, &c, off, epsilon);
            self.set(sine, s, to_sine);
            self.set(cosine, c, to_cosine);
        }
    }

    /// Checks that the statements have led to the exact motion.
    fn compare(&self, exact: &Exact) -> Result<(), String> {
        for (place, coordinate) in self.derived.system.coordinates.iter().enumerate() {
            let symbols = [
                coordinate.position,
                coordinate.rate,
                coordinate.acceleration,
            ];
            for (level, symbol) in symbols.into_iter().enumerate() {
                let scale = exact.levels[level].iter().map(|it| it.to_f64().abs());
                let scale = scale.fold(0.0, f64::max);
                let off = self.symbols[symbol.index()].minus(&exact.levels[level][place]);
                // NaN counts as different.
                let same = off.to_f64().abs() <= LOST * scale;
                if !same {
                    return Err(format!(
                        "the solved view's {} is another at level {level}",
                        coordinate.name
                    ));
                }
            }
        }
        Ok(())
    }
}

/// Errors of sine and cosine of an angle with this error.
fn turned(sine: &Precise, cosine: &Precise, off: Margin, epsilon: f64) -> [Margin; 2] {
    let (s, c) = (sine.to_f64(), cosine.to_f64());
    [(s, c), (c, s)].map(|(value, slope)| {
        let steepest = (slope.abs() + off.worst).min(1.0);
        let moved = Margin {
            worst: off.worst * steepest,
            expected: off.expected * slope.abs(),
        };
        moved.plus(Margin::even(epsilon * value))
    })
}

/// Angle wound up by whole turns until it is next to another.
fn wound(angle: &Precise, near: Option<&Precise>) -> Precise {
    let Some(near) = near else {
        return angle.clone();
    };
    let turn = pi().times(&Precise::from_f64(2.0));
    let turns = near.minus(angle).over(&turn).to_f64().round();
    angle.plus(&turn.times(&Precise::from_f64(turns)))
}
