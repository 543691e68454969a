//! Evaluates formulas printed in ASCII, with values for their names.
//!
//! Reads the output of `linkwright plan` and `linkwright inspect`: sums, products, quotients, powers, functions,
//! names with primes, lengths in bars, and choices `if a < b { c } else { d }`. It shares no code with the printer.

use std::collections::BTreeMap;

/// Values by name; a function of a name, such as `cos(phi2)`, may be named too.
pub type Values = BTreeMap<String, f64>;

/// Value of a formula; `None` if a name has no value, or if the text is not a formula.
pub fn value(formula: &str, values: &Values) -> Option<f64> {
    let mut reader = Reader {
        rest: formula,
        values,
    };
    let value = reader.sum()?;
    reader.rest.trim().is_empty().then_some(value)
}

struct Reader<'a> {
    rest: &'a str,
    values: &'a Values,
}

impl<'a> Reader<'a> {
    fn take(&mut self, token: &str) -> bool {
        match self.rest.trim_start().strip_prefix(token) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn sum(&mut self) -> Option<f64> {
        let negative = self.take("-");
        let first = self.product()?;
        let mut total = if negative { -first } else { first };
        loop {
            if self.take("+") {
                total += self.product()?;
            } else if self.take("-") {
                total -= self.product()?;
            } else {
                return Some(total);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut total = self.power()?;
        loop {
            if self.take("*") {
                total *= self.power()?;
            } else if self.take("/") {
                total /= self.power()?;
            } else {
                return Some(total);
            }
        }
    }

    fn power(&mut self) -> Option<f64> {
        let base = self.operand()?;
        if self.take("^") {
            return Some(base.powf(self.operand()?));
        }
        Some(base)
    }

    /// Value of a choice, behind its `if`. Every arm must be a formula, whether or not it counts.
    fn choice(&mut self) -> Option<f64> {
        let left = self.sum()?;
        let is_less = self.take("<");
        if !is_less && !self.take(">") {
            return None;
        }
        let right = self.sum()?;
        let below = self.arm()?;
        if !self.take("else ") {
            return None;
        }
        let otherwise = if self.take("if ") {
            self.choice()?
        } else {
            self.arm()?
        };
        let holds = if is_less { left < right } else { left > right };
        Some(if holds { below } else { otherwise })
    }

    fn arm(&mut self) -> Option<f64> {
        if !self.take("{") {
            return None;
        }
        let value = self.sum()?;
        self.take("}").then_some(value)
    }

    fn operand(&mut self) -> Option<f64> {
        if self.take("if ") {
            return self.choice();
        }
        if self.take("(") {
            let value = self.sum()?;
            return self.take(")").then_some(value);
        }
        let text = self.rest.trim_start();
        let is_name = |it: char| it.is_alphanumeric() || matches!(it, '_' | '\'' | '.' | '|');
        let end = text.find(|it| !is_name(it)).unwrap_or(text.len());
        let (name, rest) = text.split_at(end);
        let called = rest.starts_with('(');
        if called && let Some(close) = rest.find(')') {
            // A named value of a function takes the place of the function.
            let whole = format!("{name}{}", &rest[..=close]);
            if let Some(&value) = self.values.get(&whole) {
                self.rest = &rest[close + 1..];
                return Some(value);
            }
        }
        self.rest = rest;
        if called {
            return self.function(name);
        }
        match name {
            "pi" => Some(std::f64::consts::PI),
            _ => name.parse().ok().or_else(|| self.values.get(name).copied()),
        }
    }

    fn function(&mut self, name: &str) -> Option<f64> {
        self.take("(");
        let first = self.sum()?;
        let second = if self.take(",") {
            Some(self.sum()?)
        } else {
            None
        };
        if !self.take(")") {
            return None;
        }
        match (name, second) {
            ("sin", None) => Some(first.sin()),
            ("cos", None) => Some(first.cos()),
            ("floor", None) => Some(first.floor()),
            ("sqrt", None) => Some(first.sqrt()),
            ("atan2", Some(second)) => Some(first.atan2(second)),
            _ => None,
        }
    }
}
