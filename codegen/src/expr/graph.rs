//! The arena.
use super::node::{ExprId, Node, SymbolId};
use super::number::Number;
use super::rational::Rational;
/// A growing set of hash-consed expressions.
#[derive(Clone, Debug, Default)]
pub struct Graph {}
impl Graph {
    /// A graph that holds the numbers 0 and 1 and π.
    pub fn new() -> Graph {
        unimplemented!()
    }
    /// What an expression is at its top.
    pub fn node(&self, id: ExprId) -> &Node {
        let _ = (id,);
        unimplemented!()
    }
    /// The symbol of this name; it is made when asked for the first time.
    pub fn symbol(&mut self, name: &str) -> SymbolId {
        let _ = (name,);
        unimplemented!()
    }
    /// The name of a symbol.
    pub fn symbol_name(&self, symbol: SymbolId) -> &str {
        let _ = (symbol,);
        unimplemented!()
    }
    /// How many symbols there are.
    pub fn symbol_count(&self) -> usize {
        unimplemented!()
    }
    /// The expression that is this symbol.
    pub fn variable(&mut self, symbol: SymbolId) -> ExprId {
        let _ = (symbol,);
        unimplemented!()
    }
    /// A number.
    pub fn number(&mut self, value: Number) -> ExprId {
        let _ = (value,);
        unimplemented!()
    }
    /// A whole number.
    pub fn integer(&mut self, value: i64) -> ExprId {
        let _ = (value,);
        unimplemented!()
    }
    /// A fraction; with a zero denominator a non-finite number.
    pub fn rational(&mut self, numerator: i64, denominator: i64) -> ExprId {
        let _ = (numerator, denominator);
        unimplemented!()
    }
    /// The number 0.
    pub fn zero(&self) -> ExprId {
        unimplemented!()
    }
    /// The number 1.
    pub fn one(&self) -> ExprId {
        unimplemented!()
    }
    /// The number π.
    pub fn pi(&self) -> ExprId {
        unimplemented!()
    }
    /// `a + b`.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let _ = (a, b);
        unimplemented!()
    }
    /// `a - b`.
    pub fn subtract(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let _ = (a, b);
        unimplemented!()
    }
    /// `a · b`.
    pub fn multiply(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let _ = (a, b);
        unimplemented!()
    }
    /// `a / b`.
    pub fn divide(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let _ = (a, b);
        unimplemented!()
    }
    /// `-a`.
    pub fn negate(&mut self, a: ExprId) -> ExprId {
        let _ = (a,);
        unimplemented!()
    }
    /// The sum of all addends.
    pub fn sum(&mut self, addends: &[ExprId]) -> ExprId {
        let _ = (addends,);
        unimplemented!()
    }
    /// The product of all factors.
    pub fn product(&mut self, factors: &[ExprId]) -> ExprId {
        let _ = (factors,);
        unimplemented!()
    }
    /// `coefficient · expr`, distributed over a sum.
    pub fn scale(&mut self, coefficient: Number, expr: ExprId) -> ExprId {
        let _ = (coefficient, expr);
        unimplemented!()
    }
    /// `base ^ exponent`.
    pub fn power(&mut self, base: ExprId, exponent: Rational) -> ExprId {
        let _ = (base, exponent);
        unimplemented!()
    }
    /// `base ^ exponent` for any exponent.
    pub fn raise(&mut self, base: ExprId, exponent: ExprId) -> ExprId {
        let _ = (base, exponent);
        unimplemented!()
    }
    /// The function `sqrt`.
    pub fn sqrt(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `sin`.
    pub fn sin(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `cos`.
    pub fn cos(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `tan`.
    pub fn tan(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `asin`.
    pub fn asin(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `acos`.
    pub fn acos(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `atan`.
    pub fn atan(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `exp`.
    pub fn exp(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The function `ln`.
    pub fn ln(&mut self, x: ExprId) -> ExprId {
        let _ = (x,);
        unimplemented!()
    }
    /// The angle of the vector (x, y).
    pub fn atan2(&mut self, y: ExprId, x: ExprId) -> ExprId {
        let _ = (y, x);
        unimplemented!()
    }
    /// Whether no symbol occurs.
    pub fn is_constant(&self, expr: ExprId) -> bool {
        let _ = (expr,);
        unimplemented!()
    }
    /// Whether no non-finite number occurs.
    pub fn is_finite(&self, expr: ExprId) -> bool {
        let _ = (expr,);
        unimplemented!()
    }
    /// The value of an expression without symbols.
    pub fn constant_value(&self, expr: ExprId) -> Option<f64> {
        let _ = (expr,);
        unimplemented!()
    }
}
