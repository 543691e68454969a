//! Names constants after quantities of the description and of derivations.
//!
//! A quantity is found by its value. The quantities of a function come from the derivation of its block, so that other constants
//! with the same value keep their digits.

mod drivers;
mod links;
mod of_description;
mod rotated;

pub(super) use links::LinkName;
pub use of_description::Described;
pub(super) use rotated::rotated_component;

/// Relative distance of two values that are the same quantity: rounding of a few operations.
const EQUALITY_TOLERANCE: f64 = 16.0 * f64::EPSILON;

/// Largest value that is a plain number if it is a multiple of a quarter.
const LARGEST_PLAIN: f64 = 10.0;

/// Number of links from which on a name no longer lists them.
const UNLISTED_COUNT: usize = 3;

/// Length of the list of links in a name, in characters, up to which the name has the list.
const LONGEST_LIST: usize = 32;

/// Number of equal quantities that a remark lists at most.
const MAX_LISTED: usize = 3;

/// Quantity with the parts of its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    prefix: &'static str,
    stems: Vec<String>,
    suffix: &'static str,
    words: Vec<String>,
    value: f64,
    /// Targets of the statements that contain the quantity, see [`Quantities::within`].
    targets: &'static [&'static str],
}

/// Quantities in order of preference.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quantities {
    list: Vec<Quantity>,
    /// Magnitudes, ascending, with indices of the list.
    by_magnitude: Vec<(f64, usize)>,
    targets: &'static [&'static str],
}

impl Quantity {
    /// Returns the name of a constant: `INVERSE_COUPLER_LENGTH`.
    pub fn name(&self) -> String {
        let list = self.stems.join("_AND_");
        let is_list = self.stems.len() < UNLISTED_COUNT && list.len() <= LONGEST_LIST;
        let stem = match is_list || self.stems.len() == 1 {
            true => list,
            false => "LINK".to_string(),
        };
        format!("{}{stem}{}", self.prefix, self.suffix)
    }

    /// Returns the formula in the points of the description: `1/|BC|`.
    pub fn words(&self) -> String {
        self.words[..self.words.len().min(MAX_LISTED)].join(" = ")
    }
}

impl Quantities {
    /// Adds a quantity; numbers that say no more than their digits are ignored.
    pub(super) fn add(
        &mut self,
        [prefix, suffix]: [&'static str; 2],
        stem: &str,
        words: String,
        value: f64,
    ) {
        if !value.is_finite() || is_plain(value) {
            return;
        }
        let place = self
            .by_magnitude
            .partition_point(|(magnitude, _)| *magnitude <= value.abs());
        self.by_magnitude
            .insert(place, (value.abs(), self.list.len()));
        self.list.push(Quantity {
            prefix,
            stems: vec![stem.to_string()],
            suffix,
            words: vec![words],
            value,
            targets: self.targets,
        });
    }

    /// Sets the statements that contain the next quantities: names of their targets, with `*` for any letters at one end, or an
    /// empty name for statements without a target. Only there, a short decimal is the quantity.
    pub(super) fn within(&mut self, targets: &'static [&'static str]) {
        self.targets = targets;
    }

    /// Adds all quantities of another list.
    pub(super) fn extend(&mut self, other: &Quantities) {
        for it in &other.list {
            let both = [it.prefix, it.suffix];
            self.within(it.targets);
            self.add(both, &it.stems[0], it.words[0].clone(), it.value);
        }
    }

    /// Returns the preferred quantity with this value; links of equal length share it. `None` if there is none.
    pub fn find(&self, value: f64) -> Option<Quantity> {
        self.find_if(value, |_| true)
    }

    /// Returns the preferred quantity with this value in statements with this target.
    pub fn find_within(&self, value: f64, target: &str) -> Option<Quantity> {
        let is_target =
            |pattern: &&str| match (pattern.strip_prefix('*'), pattern.strip_suffix('*')) {
                (Some(end), _) => target.ends_with(end),
                (_, Some(start)) => target.starts_with(start),
                _ => *pattern == target,
            };
        self.find_if(value, |it| it.targets.iter().any(is_target))
    }

    fn find_if(&self, value: f64, accepts: impl Fn(&Quantity) -> bool) -> Option<Quantity> {
        if is_plain(value) {
            return None;
        }
        let least = value.abs() * (1.0 - EQUALITY_TOLERANCE);
        let first = self.by_magnitude.partition_point(|it| it.0 < least);
        let close = self.by_magnitude[first..].iter();
        let close = close.take_while(|it| it.0 <= value.abs() * (1.0 + EQUALITY_TOLERANCE));
        let mut places: Vec<usize> = close.map(|it| it.1).collect();
        places.sort_unstable();
        let places = places.into_iter().map(|place| &self.list[place]);
        let mut places = places.filter(|it| accepts(it));
        let mut quantity = places.next()?.clone();
        let shape = |it: &Quantity| (it.prefix, it.suffix, it.value > 0.0);
        let kind = shape(&quantity);
        for other in places.filter(|it| shape(it) == kind) {
            // Names and remarks list no more, however many are equal.
            if quantity.stems.len() >= UNLISTED_COUNT.max(MAX_LISTED) {
                break;
            }
            if !quantity.stems.contains(&other.stems[0]) {
                quantity.stems.extend(other.stems.iter().cloned());
                quantity.words.extend(other.words.iter().cloned());
            }
        }
        if quantity.value * value < 0.0 {
            for words in &mut quantity.words {
                *words = negated(words);
            }
        }
        Some(quantity)
    }
}

/// True if a number says no more than its digits: zero and small multiples of a quarter.
fn is_plain(value: f64) -> bool {
    let quarters = 4.0 * value.abs();
    quarters.fract() == 0.0 && value.abs() <= LARGEST_PLAIN
}

fn negated(words: &str) -> String {
    match words.contains(" + ") || words.contains(" - ") {
        true => format!("-({words})"),
        false => format!("-{words}"),
    }
}

/// Returns a name of the description as part of a constant's name: ASCII letters and digits in upper case.
pub(super) fn upper(name: &str) -> String {
    let kept = name
        .chars()
        .filter(|it| it.is_ascii_alphanumeric() || *it == '_');
    let kept: String = kept.collect::<String>().to_ascii_uppercase();
    kept.trim_matches('_').to_string()
}

/// Returns two point names as one: `BC`, or `PIVOT_TIP` for longer names.
fn both(first: &str, second: &str) -> String {
    let [first, second] = [first, second].map(upper);
    match first.len() + second.len() {
        0..=2 => format!("{first}{second}"),
        _ => format!("{first}_{second}"),
    }
}

/// Returns two point names as in formulas: `BC`, or `pivot-tip` for longer names.
fn between(first: &str, second: &str) -> String {
    match first.chars().count() + second.chars().count() {
        0..=2 => format!("{first}{second}"),
        _ => format!("{first}-{second}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_quantities_by_value_and_merges_equal_links() {
        let mut list = Quantities::default();
        list.add(["", "_LENGTH"], "CRANK", "|AB|".to_string(), 0.12);
        list.add(["", "_LENGTH"], "ROCKER", "|CD|".to_string(), 0.12);
        list.add(
            ["INVERSE_", "_LENGTH"],
            "CRANK",
            "1/|AB|".to_string(),
            1.0 / 0.12,
        );
        let length = list.find(0.12).expect("a length");
        assert_eq!(length.name(), "CRANK_AND_ROCKER_LENGTH");
        assert_eq!(length.words(), "|AB| = |CD|");
        let inverse = list.find(25.0 / 3.0).map(|it| it.name());
        assert_eq!(inverse.as_deref(), Some("INVERSE_CRANK_LENGTH"));
        assert_eq!(list.find(0.12 + 1e-12), None);
        assert_eq!(
            list.find(-0.12).map(|it| it.words()).as_deref(),
            Some("-|AB| = -|CD|")
        );
    }

    #[test]
    fn finds_short_decimals_in_their_statements() {
        let mut list = Quantities::default();
        list.within(&["k", "cos_*", "*_rounding", ""]);
        list.add(["", "_LENGTH"], "CRANK", "|AB|".to_string(), 0.12);
        let is_in = |target: &str| list.find_within(0.12, target).is_some();
        assert!(["k", "cos_phi", "phi_rounding", ""].into_iter().all(is_in));
        assert!(!["k_2", "forward", "sin_phi"].into_iter().any(is_in));
    }

    #[test]
    fn ignores_plain_numbers() {
        let mut list = Quantities::default();
        list.add(["", "_LENGTH"], "CRANK", "|AB|".to_string(), 0.5);
        assert_eq!(list.find(0.5), None);
    }

    #[test]
    fn names_are_identifiers() {
        assert_eq!(upper("größe_1"), "GRE_1");
        assert_eq!(both("B", "c"), "BC");
        assert_eq!(both("pivot", "tip"), "PIVOT_TIP");
    }
}
