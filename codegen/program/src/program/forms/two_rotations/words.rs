//! Describes the statements of the RRR dyad: the triangle, its sides, and the choice between two points.

use super::TwoRotations;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::words::{Phrase, Piece, Triangle, phrase};

/// Names of the two links and of their sum.
pub(super) struct TriangleNames {
    pub links: [String; 2],
    pub base: String,
}

impl TwoRotations {
    /// Describes the known parts of the triangle, and returns the names of its sides.
    pub(super) fn open(
        &self,
        triangle: Option<&Triangle>,
        links: [Vector; 2],
        builder: &mut Builder<'_>,
    ) -> TriangleNames {
        let [first, second] = self.angles.map(Piece::Unknown);
        let Some(triangle) = triangle else {
            let source = " from a loop of two turning links";
            builder.heading(phrase![first, " and ", second, source]);
            return TriangleNames {
                links: ["p", "q"].map(str::to_string),
                base: "d".to_string(),
            };
        };
        let [a, b] = [0, 1].map(|side| triangle.outer[side].0.name.clone());
        let apex = triangle.apex.name.clone();
        let mut lengths: Vec<Phrase> = Vec::new();
        let mut driven: Vec<Phrase> = Vec::new();
        for (side, name) in [format!("{a}{apex}"), format!("{b}{apex}")]
            .into_iter()
            .enumerate()
        {
            let Some((value, reason, is_driven)) = builder.known_length(links[side]) else {
                continue;
            };
            let length = Piece::Length(name);
            lengths.push(phrase![length.clone(), " is ", value, ", ", reason]);
            if is_driven {
                driven.push(length.into());
            }
        }
        let condition = match driven.is_empty() {
            true => Phrase::default(),
            false => phrase![
                " with ",
                crate::words::enumerated(&driven),
                " known from the driver"
            ],
        };
        let [a_name, b_name, apex_name] = [&a, &b, &apex].map(|name| Piece::Name(name.clone()));
        let source = phrase![
            " from the triangle ",
            a_name.clone(),
            "-",
            b_name.clone(),
            "-",
            apex_name.clone(),
            condition
        ];
        builder.heading(phrase![first, " and ", second, source]);
        builder.say(|builder| {
            let [here, there] = [0, 1].map(|side| {
                builder
                    .known
                    .whereabouts(&triangle.outer[side].1, builder.system)
            });
            let known = match here == there {
                true => phrase![a_name, " and ", b_name, ", ", here, ", are known."],
                false => phrase![
                    a_name,
                    ", ",
                    here,
                    ", and ",
                    b_name,
                    ", ",
                    there,
                    ", are known."
                ],
            };
            let mut words = phrase![
                known,
                " Sought is ",
                apex_name,
                ", the third point of the triangle."
            ];
            for (place, length) in lengths.into_iter().enumerate() {
                words.push(if place == 0 { " " } else { "; " });
                words.push(length);
            }
            words.push(".");
            words
        });
        TriangleNames {
            links: [format!("{a}{apex}"), format!("{apex}{b}")],
            base: format!("{a}{b}"),
        }
    }

    /// Names the constants of the law of cosines, of the reach, and of both directions.
    pub(super) fn name_quantities(
        &self,
        triangle: Option<&Triangle>,
        links: [Vector; 2],
        names: &TriangleNames,
        builder: &mut Builder<'_>,
    ) {
        let ends = |it: &Triangle| {
            let [a, b] = [&it.outer[0].0, &it.outer[1].0].map(|pin| pin.name.clone());
            let apex = it.apex.name.clone();
            [[a, apex.clone()], [apex, b]]
        };
        let ends = triangle.map(ends);
        let named = [0, 1].map(|side| {
            let pins = ends.as_ref().map(|ends| &ends[side]);
            let pins = pins.map(|[from, to]| [from.as_str(), to.as_str()]);
            builder.name_link(self.angles[side], links[side], pins, &names.links[side])
        });
        if let [Some(first), Some(second)] = &named {
            builder.quantities.add_dyad([first, second]);
        }
        let named = self.angles.into_iter().zip(named);
        let named = named.filter_map(|(angle, name)| Some((angle, name?)));
        builder.paths.names.extend(named);
    }

    /// Returns the loop as vectors and by components.
    pub(super) fn close(
        &self,
        names: &TriangleNames,
        triangle: Option<&Triangle>,
        links: [Vector; 2],
        c: Vector,
        builder: &mut Builder<'_>,
    ) {
        builder.say(|_| {
            let loop_words = match triangle {
                Some(it) => {
                    let pins = [&it.outer[0].0, &it.apex, &it.outer[1].0];
                    let [a, apex, b] = pins.map(|pin| Piece::Name(pin.name.clone()));
                    phrase!["The loop ", a, "-", apex, "-", b]
                }
                None => "The loop".into(),
            };
            phrase![loop_words, " closes, as vectors and by components:"]
        });
        builder.show(|builder| {
            let [first, second] = names.links.clone().map(Piece::Vector);
            let turned = [0, 1].map(|side| Piece::Turned(self.angles[side], links[side]));
            let [along, back] = turned;
            let minus = builder.negated(c);
            let mut equations = vec![
                [
                    phrase![first, " + ", second],
                    Piece::Vector(names.base.clone()).into(),
                    "".into(),
                ],
                [
                    phrase![along, " + ", back],
                    Piece::Sum(minus).into(),
                    "".into(),
                ],
            ];
            let [a, b] = [0, 1].map(|side| builder.turned_by(self.angles[side], links[side]));
            for axis in [0, 1] {
                let sum = builder.graph().add(a[axis], b[axis]);
                equations.push([
                    Piece::Formula(sum).into(),
                    Piece::Formula(minus[axis]).into(),
                    ["x", "y"][axis].into(),
                ]);
            }
            equations
        });
    }

    /// Describes which of the two points is chosen.
    pub(super) fn say_mode(
        &self,
        triangle: Option<&Triangle>,
        drawn: f64,
        builder: &mut Builder<'_>,
    ) {
        builder.say(|_| {
            // The product d × w_a is −h.
            let side = if drawn >= 0.0 { "right" } else { "left" };
            let kept = phrase![
                ", and this assembly mode is kept: it is the sign of ",
                Piece::Local("h".to_string()),
                ", the cross product of both links. With ",
                Piece::Local("k".to_string()),
                " for their dot product, by the law of cosines:"
            ];
            match triangle {
                Some(it) => {
                    let pins = [&it.outer[0].0, &it.apex, &it.outer[1].0];
                    let [a, apex, b] = pins.map(|pin| Piece::Name(pin.name.clone()));
                    phrase![
                        "Two circles about ",
                        a.clone(),
                        " and ",
                        b.clone(),
                        " meet in two points. In the design configuration ",
                        apex,
                        format!(" lies to the {side} of the line from "),
                        a,
                        " to ",
                        b,
                        kept
                    ]
                }
                None => phrase![
                    "The equations have two solutions. In the design configuration the first link points to the ",
                    side,
                    " of the sum of both",
                    kept
                ],
            }
        });
    }
}

/// Describes the factors of the first link in generated code; `divides` is true if the square of the base is not constant.
pub(super) fn components(names: &TriangleNames, divides: bool) -> Phrase {
    let (first, base) = (&names.links[0], &names.base);
    let mut words = phrase![
        "Components of ",
        Piece::Vector(first.clone()),
        " over ",
        Piece::Length(base.clone()),
        ": forward along ",
        Piece::Vector(base.clone()),
        ", sideways to its right"
    ];
    if divides {
        words.push(phrase!["; inverse = 1/", Piece::Square(base.clone())]);
    }
    words
}

/// Returns the first link as a sum along the base and across it, as derivations print it.
pub(super) fn first_link(names: &TriangleNames) -> [Phrase; 3] {
    let (first, base) = (&names.links[0], &names.base);
    let along = phrase![
        "(",
        Piece::Square(first.clone()),
        " + ",
        Piece::Local("k".to_string()),
        ")",
        Piece::Times
    ];
    let across = phrase![
        Piece::Local("h".to_string()),
        Piece::Times,
        Piece::Across(base.clone())
    ];
    let square = Piece::Square(base.clone());
    let sum = phrase![
        "(",
        along,
        Piece::Vector(base.clone()),
        Piece::Minus,
        across,
        ")/",
        square
    ];
    [Piece::Vector(first.clone()).into(), sum, "".into()]
}
