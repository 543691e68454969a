//! Names the quantities of one link and of two links that form a dyad.

use super::of_description::{arm_of, body_stem, is_rod, rods};
use super::{Quantities, upper};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;

/// Statements of a proof that contain lengths of arms.
const TARGETS: &[&str] = &["", "*_input_change", "*_input_deviation"];

/// Largest verified rotation of a link, in rad.
const LARGEST_TURN: f64 = 1.5;

/// Link of constant length with its name.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct LinkName {
    /// Stem of names: `COUPLER`.
    pub stem: String,
    /// Name in formulas: `BC`.
    pub words: String,
    /// Length, in m.
    pub length: f64,
}

impl Quantities {
    /// Adds a length with its square and its inverse.
    pub(in crate::program) fn add_link(&mut self, link: &LinkName) {
        let LinkName {
            stem,
            words,
            length,
        } = link;
        self.within(&["", "*_input_change", "*_input_deviation"]);
        self.add(["", "_LENGTH"], stem, format!("|{words}|"), *length);
        let square = length * length;
        self.within(&["", "forward", "excess"]);
        self.add(
            ["", "_LENGTH_SQUARED"],
            stem,
            format!("|{words}|^2"),
            square,
        );
        self.within(&["cos_*", "sin_*", "*_deviation", "*_radius", "*_bent"]);
        let inverse = format!("1/|{words}|");
        self.add(["INVERSE_", "_LENGTH"], stem, inverse, 1.0 / length);
        let inverse = format!("1/|{words}|^2");
        self.add(["INVERSE_", "_LENGTH_SQUARED"], stem, inverse, 1.0 / square);
    }

    /// Adds the constants of the law of cosines and of the reach of two links.
    pub(in crate::program) fn add_dyad(&mut self, [first, second]: [&LinkName; 2]) {
        let stem = format!("{}_{}", first.stem, second.stem);
        let (a, b) = (first.length, second.length);
        let [p, q] = [first, second].map(|it| format!("|{}|", it.words));
        let product = format!("({p}*{q})");
        let mut add = |targets, both, words, value| {
            self.within(targets);
            self.add(both, &stem, words, value);
        };
        let square = format!("{product}^2");
        add(
            &["", "excess"],
            ["", "_PRODUCT_SQUARED"],
            square,
            a * a * b * b,
        );
        let half = format!("({p}^2 + {q}^2)/2");
        add(&["k"], ["", "_HALF_SQUARES"], half, (a * a + b * b) / 2.0);
        add(&[], ["", "_PRODUCT"], format!("{p}*{q}"), a * b);
        add(&[""], ["", "_LONGEST_REACH"], format!("{p} + {q}"), a + b);
        add(&[""], ["", "_SHORTEST_REACH"], format!("{p} - {q}"), a - b);
    }

    /// Adds the factors of the proof that two links do not become collinear.
    pub(in crate::program) fn add_dyad_bounds(&mut self, [first, second]: [&LinkName; 2]) {
        self.within(&["", "*_cosine", "*_bent"]);
        let stem = format!("{}_{}", first.stem, second.stem);
        let slope = 1.0 / first.length + 1.0 / second.length;
        let sum = format!("1/|{}| + 1/|{}|", first.words, second.words);
        let limit = slope / LARGEST_TURN;
        let limit_words = format!("(({sum})/1.5)^2");
        let product = first.length * second.length;
        let inverse = format!("1/(|{}|*|{}|)", first.words, second.words);
        self.add(["INVERSE_", "_PRODUCT"], &stem, inverse, 1.0 / product);
        self.add(["", "_SLOPE"], &stem, sum, slope);
        self.add(["", "_TURN_LIMIT"], &stem, limit_words, limit * limit);
    }

    /// Adds the factor by which the largest verified rotation enters, and its square.
    pub(in crate::program) fn add_turn_limit(&mut self) {
        self.within(&[""]);
        let inverse = 1.0 / LARGEST_TURN;
        let words = "1/(largest verified rotation, 1.5 rad)";
        self.add(["INVERSE_", ""], "LARGEST_TURN", words.to_string(), inverse);
        let square = inverse * inverse;
        self.add(
            ["INVERSE_", "_SQUARED"],
            "LARGEST_TURN",
            format!("({words})^2"),
            square,
        );
    }

    /// Adds the components of a link over its squared length, which turn the link into a direction.
    fn add_direction(&mut self, link: &LinkName, parts: [f64; 2]) {
        self.within(&["cos_*", "sin_*"]);
        let square = link.length * link.length;
        for (part, (suffix, axis)) in parts.into_iter().zip([
            ("_X_OVER_LENGTH_SQUARED", "x"),
            ("_Y_OVER_LENGTH_SQUARED", "y"),
        ]) {
            let words = format!("{axis}({0})/|{0}|^2", link.words);
            self.add(["", suffix], &link.stem, words, part / square);
        }
    }
}

impl Builder<'_> {
    /// Names the quantities of a link that rotates with an angle, and returns the link; `None` if its length is not constant.
    pub(in crate::program) fn name_link(
        &mut self,
        angle: usize,
        link: Vector,
        pins: Option<[&str; 2]>,
        words: &str,
    ) -> Option<LinkName> {
        let [x, y] = self.constants_of(link)?;
        let stem = self.stem_of(angle, pins);
        let words = pins.map_or(words.to_string(), |[from, to]| super::between(from, to));
        let length = x.hypot(y);
        let link = LinkName {
            stem,
            words,
            length,
        };
        self.quantities.add_link(&link);
        self.quantities.add_direction(&link, [x, y]);
        Some(link)
    }

    /// Names the constant distance between two points that rotate with an angle.
    pub(in crate::program) fn name_arm(&mut self, angle: usize, length: ExprId) {
        let length = self.constant_of(length);
        let arm = length.and_then(|length| arm_of(angle, length, &self.pool.graph, self.system));
        if let Some(LinkName {
            stem,
            words,
            length,
        }) = arm
        {
            let words = format!("|{words}|");
            self.quantities.within(TARGETS);
            self.quantities.add(["", "_LENGTH"], &stem, words, length);
        }
    }

    /// Names the lengths of all rods.
    pub(in crate::program) fn name_rods(&mut self) {
        for LinkName {
            stem,
            words,
            length,
        } in rods(&self.pool.graph, &self.system.mechanism)
        {
            let words = format!("|{words}|");
            self.quantities.within(TARGETS);
            self.quantities.add(["", "_LENGTH"], &stem, words, length);
        }
    }

    /// Returns the stem of names for a link: its body if that has only two pins, otherwise the pins.
    fn stem_of(&self, angle: usize, pins: Option<[&str; 2]>) -> String {
        let unknown = &self.system.vector_form.unknowns[angle];
        let mechanism = &self.system.mechanism;
        let body = unknown.describes.body();
        match (body, pins) {
            (Some(body), _) if is_rod(body, &self.pool.graph, mechanism) => {
                body_stem(body, mechanism)
            }
            (_, Some([from, to])) => super::both(from, to),
            (Some(body), None) => format!("{}_LINK", body_stem(body, mechanism)),
            (None, None) => {
                let name = upper(&unknown.name);
                let ends = name.strip_prefix("PHI_").unwrap_or(&name);
                format!("{ends}_LINK")
            }
        }
    }

    /// Returns the values of a vector; `None` if it is not constant.
    pub(in crate::program) fn constants_of(&self, vector: Vector) -> Option<[f64; 2]> {
        let [x, y] = vector.map(|part| self.constant_of(part));
        Some([x?, y?])
    }

    /// Returns the value of an expression; `None` if the expression is not constant.
    pub(in crate::program) fn constant_of(&self, expr: ExprId) -> Option<f64> {
        let graph = &self.pool.graph;
        graph
            .constant_value(expr)
            .filter(|_| graph.is_constant(expr))
    }
}
