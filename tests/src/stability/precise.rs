//! Evaluates expressions in 384 bits, and solves linear systems in them.
//!
//! Numbers of the description are exact, and so are their square roots as far as the description holds them.

use std::cell::RefCell;
use std::cmp::Ordering;

use astro_float_num::{BigFloat, Consts, RoundingMode};
use linkwright_codegen::stages::expr::{ExprId, Factor, Graph, Node, Number};

/// Bits of a mantissa: 115 digits.
const BITS: usize = 384;
const ROUNDING: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTANTS: RefCell<Consts> =
        RefCell::new(Consts::new().expect("memory for the constants"));
}

/// Number of 384 bits.
#[derive(Clone, Debug)]
pub struct Precise(BigFloat);

impl Precise {
    /// Exact value of a float.
    pub fn from_f64(value: f64) -> Precise {
        if value.is_subnormal() {
            // `from_f64` of astro-float-num 0.3.7 makes half of these.
            const LIFT: f64 = 1.329_227_995_784_916e36;
            let lifted = BigFloat::from_f64(value * LIFT, BITS);
            return Precise(lifted.div(&BigFloat::from_f64(LIFT, BITS), BITS, ROUNDING));
        }
        Precise(BigFloat::from_f64(value, BITS))
    }

    /// Nearest float, except for the last bit; 0 below the normal numbers.
    pub fn to_f64(&self) -> f64 {
        if self.0.is_zero() {
            return 0.0;
        }
        let Some((words, _, sign, exponent, _)) = self.0.as_raw_parts() else {
            return f64::NAN;
        };
        let Some(&top) = words.last() else {
            return f64::NAN;
        };
        let below = words.len().checked_sub(2).map_or(0, |place| words[place]);
        // 0.mantissa · 2^exponent, in two factors, so that neither leaves the range early.
        let fraction = (top as f64 + below as f64 * 2_f64.powi(-64)) * 2_f64.powi(-64);
        let half = exponent / 2;
        let value = fraction * 2_f64.powi(half) * 2_f64.powi(exponent - half);
        if sign.is_negative() { -value } else { value }
    }

    /// Sum.
    pub fn plus(&self, other: &Precise) -> Precise {
        Precise(self.0.add(&other.0, BITS, ROUNDING))
    }

    /// Difference.
    pub fn minus(&self, other: &Precise) -> Precise {
        Precise(self.0.sub(&other.0, BITS, ROUNDING))
    }

    /// Product.
    pub fn times(&self, other: &Precise) -> Precise {
        Precise(self.0.mul(&other.0, BITS, ROUNDING))
    }

    /// Quotient.
    pub fn over(&self, other: &Precise) -> Precise {
        Precise(self.0.div(&other.0, BITS, ROUNDING))
    }

    /// Square root.
    pub fn sqrt(&self) -> Precise {
        Precise(self.0.sqrt(BITS, ROUNDING))
    }

    /// Sine.
    pub fn sin(&self) -> Precise {
        with_constants(|constants| Precise(self.0.sin(BITS, ROUNDING, constants)))
    }

    /// Cosine.
    pub fn cos(&self) -> Precise {
        with_constants(|constants| Precise(self.0.cos(BITS, ROUNDING, constants)))
    }

    /// Angle in [0, π] with this cosine.
    pub fn acos(&self) -> Precise {
        with_constants(|constants| Precise(self.0.acos(BITS, ROUNDING, constants)))
    }

    /// Angle in [-π/2, π/2] with this tangent.
    pub fn atan(&self) -> Precise {
        with_constants(|constants| Precise(self.0.atan(BITS, ROUNDING, constants)))
    }

    /// True if the number is below zero.
    pub fn is_negative(&self) -> bool {
        self.0.is_negative() && !self.0.is_zero()
    }

    /// True if the number is finite.
    pub fn is_finite(&self) -> bool {
        !(self.0.is_nan() || self.0.is_inf())
    }

    fn is_smaller(&self, other: &Precise) -> bool {
        // `abs_cmp` of astro-float-num 0.3.7 compares with the signs.
        let order = self.0.abs().cmp(&other.0.abs());
        order.is_some_and(|order| order < 0)
    }
}

fn with_constants(function: impl FnOnce(&mut Consts) -> Precise) -> Precise {
    CONSTANTS.with(|constants| function(&mut constants.borrow_mut()))
}

/// π.
pub fn pi() -> Precise {
    with_constants(|constants| Precise(constants.pi(BITS, ROUNDING)))
}

/// Value of a number of a description.
pub(super) fn of_number(number: &Number) -> Precise {
    match *number {
        Number::Exact { rational, radicand } => {
            let whole = |value| Precise(BigFloat::from_i128(value, BITS));
            let fraction = whole(rational.numerator()).over(&whole(rational.denominator()));
            if radicand == 1 {
                return fraction;
            }
            fraction.times(&Precise(BigFloat::from_u128(radicand, BITS)).sqrt())
        }
        Number::Float(value) => Precise::from_f64(value),
    }
}

fn power(base: &Precise, factor: &Factor) -> Precise {
    let (above, below) = (factor.exponent.numerator(), factor.exponent.denominator());
    let whole = usize::try_from(above.unsigned_abs()).unwrap_or(usize::MAX);
    let rooted = match below {
        1 => base.clone(),
        2 => base.sqrt(),
        _ => {
            let part = Precise::from_f64(1.0).over(&Precise(BigFloat::from_i128(below, BITS)));
            with_constants(|constants| Precise(base.0.pow(&part.0, BITS, ROUNDING, constants)))
        }
    };
    let value = Precise(rooted.0.powi(whole, BITS, ROUNDING));
    if above < 0 {
        Precise::from_f64(1.0).over(&value)
    } else {
        value
    }
}

/// Argument shifted into the period from `first` on, if there is one.
fn repeated(argument: &Precise, first: f64, period: Option<f64>) -> Precise {
    let Some(period) = period.map(Precise::from_f64) else {
        return argument.clone();
    };
    let turns = argument.minus(&Precise::from_f64(first)).over(&period);
    argument.minus(&period.times(&Precise(turns.0.floor())))
}

/// Derivative of this order of cubic pieces; before the first one its tangent holds.
fn of_pieces(starts: &[f64], pieces: &[[f64; 4]], order: u8, argument: &Precise) -> Precise {
    let has_begun = |start: &&f64| !argument.minus(&Precise::from_f64(**start)).is_negative();
    let begun = starts.iter().take_while(has_begun).count();
    let place = begun.saturating_sub(1);
    let [height, slope, ..] = pieces[0];
    let coefficients = match begun {
        0 => [height, slope, 0.0, 0.0],
        _ => pieces[place],
    };
    let along = argument.minus(&Precise::from_f64(starts[place]));
    let terms = coefficients.iter().zip(0_u32..4).skip(order.into()).rev();
    terms.fold(Precise::from_f64(0.0), |sum, (coefficient, power)| {
        let factor: u32 = (0..u32::from(order)).map(|it| power - it).product();
        let term = Precise::from_f64(*coefficient).times(&Precise::from_f64(factor.into()));
        sum.times(&along).plus(&term)
    })
}

/// Values of the nodes in `order` (operands first), by the node's index; `symbols` holds a value for each symbol.
pub fn values(graph: &Graph, order: &[ExprId], symbols: &[Precise]) -> Vec<Precise> {
    let mut all = vec![Precise::from_f64(0.0); graph.node_count()];
    for &id in order {
        let at = |id: ExprId| &all[id.index()];
        all[id.index()] = value(graph, id, &at, symbols);
    }
    all
}

/// Value of a node whose operands have the values `at`.
fn value<'a>(
    graph: &Graph,
    id: ExprId,
    at: &dyn Fn(ExprId) -> &'a Precise,
    symbols: &[Precise],
) -> Precise {
    match graph.node(id) {
        Node::Number(number) => of_number(number),
        Node::Pi => pi(),
        Node::Symbol(symbol) => symbols[symbol.index()].clone(),
        Node::Sum(terms) => terms.iter().fold(Precise::from_f64(0.0), |sum, term| {
            sum.plus(&of_number(&term.coefficient).times(at(term.expr)))
        }),
        Node::Product(factors) => {
            let one = Precise::from_f64(1.0);
            let powers = factors.iter().map(|factor| power(at(factor.base), factor));
            powers.fold(one, |product, value| product.times(&value))
        }
        Node::Sin(angle) => at(*angle).sin(),
        Node::Cos(angle) => at(*angle).cos(),
        Node::Atan2(y, x) => arctangent(at(*y), at(*x)),
        Node::Exp(exponent) => {
            let exponent = &at(*exponent).0;
            with_constants(|constants| Precise(exponent.exp(BITS, ROUNDING, constants)))
        }
        Node::Ln(argument) => {
            let argument = &at(*argument).0;
            with_constants(|constants| Precise(argument.ln(BITS, ROUNDING, constants)))
        }
        Node::Floor(argument) => Precise(at(*argument).0.floor()),
        Node::Choose {
            condition,
            below,
            otherwise,
        } => at(if at(*condition).is_negative() {
            *below
        } else {
            *otherwise
        })
        .clone(),
        Node::Spline {
            spline,
            order,
            argument,
        } => {
            let spline = graph.spline_of(*spline);
            let repeated = repeated(at(*argument), spline.starts[0], spline.period);
            of_pieces(&spline.starts, &spline.pieces, *order, &repeated)
        }
    }
}

/// Values of nodes at symbols that are fixed once a node has been evaluated with them.
pub struct Nodes {
    precise: Vec<Option<Precise>>,
    /// Rounded values, by the node's index; NaN for nodes that have not been evaluated.
    pub rounded: Vec<f64>,
}

impl Nodes {
    /// Nodes without values.
    pub fn new(graph: &Graph) -> Nodes {
        Nodes {
            precise: vec![None; graph.node_count()],
            rounded: vec![f64::NAN; graph.node_count()],
        }
    }

    /// Evaluates the nodes in `order` (operands first) that have no value yet.
    pub fn evaluate(&mut self, graph: &Graph, order: &[ExprId], symbols: &[Precise]) {
        for &id in order {
            if self.precise[id.index()].is_none() {
                let at = |id: ExprId| self.of(id);
                let node_value = value(graph, id, &at, symbols);
                self.rounded[id.index()] = node_value.to_f64();
                self.precise[id.index()] = Some(node_value);
            }
        }
    }

    /// Value of a node.
    ///
    /// # Panics
    /// If it has not been evaluated.
    pub fn of(&self, id: ExprId) -> &Precise {
        self.precise[id.index()]
            .as_ref()
            .expect("operands come first")
    }
}

/// Angle of the vector (x, y), in (-π, π].
pub(super) fn arctangent(y: &Precise, x: &Precise) -> Precise {
    let zero = Precise::from_f64(0.0);
    if x.0.is_zero() {
        let quarter = pi().over(&Precise::from_f64(2.0));
        return match y.0.cmp(&zero.0).map(|order| order.cmp(&0)) {
            Some(Ordering::Greater) => quarter,
            Some(Ordering::Less) => zero.minus(&quarter),
            _ => zero,
        };
    }
    let quotient = y.over(x);
    let angle = with_constants(|constants| Precise(quotient.0.atan(BITS, ROUNDING, constants)));
    match (x.is_negative(), y.is_negative()) {
        (false, _) => angle,
        (true, false) => angle.plus(&pi()),
        (true, true) => angle.minus(&pi()),
    }
}

/// Square matrix as P A = L U.
pub struct Factors {
    rows: Vec<Vec<Precise>>,
    order: Vec<usize>,
    /// True if the determinant is negative.
    pub is_negative: bool,
}

impl Factors {
    /// Factors by elimination with partial pivoting; `None` for a singular matrix.
    pub fn new(mut rows: Vec<Vec<Precise>>) -> Option<Factors> {
        let n = rows.len();
        let mut order: Vec<usize> = (0..n).collect();
        let mut is_negative = false;
        for k in 0..n {
            let mut pivot = k;
            for row in k + 1..n {
                if rows[pivot][k].is_smaller(&rows[row][k]) {
                    pivot = row;
                }
            }
            let value = &rows[pivot][k];
            if value.0.is_zero() || !value.is_finite() {
                return None;
            }
            is_negative ^= value.is_negative() ^ (pivot != k);
            rows.swap(k, pivot);
            order.swap(k, pivot);
            let (above, rest) = rows.split_at_mut(k + 1);
            let pivot_row = &above[k];
            for row in rest {
                if row[k].0.is_zero() {
                    continue;
                }
                let multiplier = row[k].over(&pivot_row[k]);
                for column in k + 1..n {
                    if !pivot_row[column].0.is_zero() {
                        row[column] = row[column].minus(&multiplier.times(&pivot_row[column]));
                    }
                }
                row[k] = multiplier;
            }
        }
        Some(Factors {
            rows,
            order,
            is_negative,
        })
    }

    /// Solution x of A x = b.
    pub fn solve(&self, b: &[Precise]) -> Vec<Precise> {
        let n = self.rows.len();
        let mut x: Vec<Precise> = self.order.iter().map(|&row| b[row].clone()).collect();
        for k in 0..n {
            for column in 0..k {
                if !self.rows[k][column].0.is_zero() {
                    x[k] = x[k].minus(&self.rows[k][column].times(&x[column]));
                }
            }
        }
        for k in (0..n).rev() {
            for column in k + 1..n {
                if !self.rows[k][column].0.is_zero() {
                    x[k] = x[k].minus(&self.rows[k][column].times(&x[column]));
                }
            }
            x[k] = x[k].over(&self.rows[k][k]);
        }
        x
    }
}
