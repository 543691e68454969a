//! Elements of SMIL that move a picture through poses at equal times, forever.

use std::f64::consts::{PI, TAU};

use super::figure::Frame;
use super::plane::Point;
use super::stance::Stance;
use super::svg::number;

/// Poses that a picture goes through at equal times.
#[derive(Debug)]
pub(super) struct Keyframes {
    pub stances: Vec<Stance>,
    /// Time from the first to the last one, in s.
    pub duration: f64,
}

impl Keyframes {
    /// Elements that move a frame; empty for one at rest.
    pub fn motion(&self, frame: Frame) -> String {
        let places: Vec<_> = self.stances.iter().map(|it| it.place(frame)).collect();
        let origins = places.iter().map(|it| pair([it.origin[0], -it.origin[1]]));
        let mut turned = Vec::with_capacity(places.len());
        let mut last = 0.0;
        for place in &places {
            // The smaller angle from the last one.
            last += (place.angle - last + PI).rem_euclid(TAU) - PI;
            turned.push(number(-last.to_degrees()));
        }
        let stretched = self.stances.iter().map(|it| pair(it.stretch(frame)));
        let steps = [
            ("translate", origins.collect::<Vec<_>>()),
            ("rotate", turned),
            ("scale", stretched.collect()),
        ];
        if steps.iter().all(|(_, values)| rests(values)) {
            return String::new();
        }
        let steps = steps.into_iter().enumerate();
        let steps = steps.filter(|(place, (kind, values))| {
            let is_nothing = *kind == "scale" && rests(values) && values[0] == "1 1";
            *place == 0 || !is_nothing
        });
        steps
            .map(|(place, (kind, values))| self.transform(kind, &values, place > 0))
            .collect()
    }

    /// The element that moves something to these places, given by pose.
    pub fn translation(&self, place: impl Fn(&Stance) -> Point) -> String {
        let places = self.stances.iter().map(place);
        let values: Vec<String> = places.map(|[x, y]| pair([x, -y])).collect();
        match rests(&values) {
            true => String::new(),
            false => self.transform("translate", &values, false),
        }
    }

    /// Element that gives a path these shapes, by pose; empty for one that keeps its shape.
    pub fn shape(&self, line: impl Fn(&Stance) -> String) -> String {
        let values: Vec<String> = self.stances.iter().map(line).collect();
        match rests(&values) {
            true => String::new(),
            false => format!(
                "<animate attributeName=\"d\" values=\"{}\" dur=\"{}s\" repeatCount=\"indefinite\"/>",
                values.join(";"),
                number(self.duration)
            ),
        }
    }

    fn transform(&self, kind: &str, values: &[String], is_added: bool) -> String {
        let added = if is_added { " additive=\"sum\"" } else { "" };
        let values = match rests(values) {
            true => values[..1].join(";"),
            false => values.join(";"),
        };
        format!(
            "<animateTransform attributeName=\"transform\" type=\"{kind}\"{added} values=\"{values}\" dur=\"{}s\" repeatCount=\"indefinite\"/>\n",
            number(self.duration)
        )
    }
}

fn pair([x, y]: Point) -> String {
    format!("{} {}", number(x), number(y))
}

fn rests(values: &[String]) -> bool {
    values.iter().all(|it| *it == values[0])
}
