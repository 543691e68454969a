//! Writes the line below a figure: scale bar, gravity, caption, and loads without a sign.

use std::fmt::Write as _;

use super::figure::{Figure, Outline};
use super::letters::width;
use super::naming::SIZE;
use super::plane::{Point, RELATIVE_ROUNDING, onward};
use super::scale_bar::scale_bar;
use super::svg::number;
use crate::emit::markup::escaped;
use crate::units::OutputUnit;

/// Room between parts of the legend.
const GAP: f64 = 16.0;

/// The height of a line of the legend.
pub(super) const ROW: f64 = 20.0;

/// Length of the arrow of gravity and of its head, in pixels.
const GRAVITY: [f64; 2] = [20.0, 8.0];

/// The scale bar where lengths are drawn, in `unit` if one is chosen, the caption, and what has no sign.
pub(super) fn legend_text(
    figure: &Figure,
    is_scaled: bool,
    gravity: Option<Point>,
    size: Point,
    (caption, unit): (&str, Option<&OutputUnit>),
) -> String {
    let mut text = String::from("<g id=\"legend\">\n");
    let base = size[1] - 14.0;
    let mut used = 12.0;
    let bar = scale_bar(figure.scale, (0.24 * size[0]).min(150.0), unit);
    if let Some(bar) = bar.filter(|_| is_scaled) {
        let end = 12.0 + bar.length;
        let _ = writeln!(
            text,
            "<path d=\"M12 {0}V{1}H{2}V{0}\"/><text class=\"note\" x=\"{3}\" y=\"{4}\">{5}</text>",
            number(base - 4.0),
            number(base + 1.0),
            number(end),
            number(end + 7.0),
            number(base + 3.0),
            escaped(&bar.text)
        );
        used = end + 7.0 + width(&bar.text, SIZE);
    }
    if let Some(gravity) = gravity {
        let (arrow, right) = falling([used + GAP, base - 3.0], gravity);
        text += &arrow;
        used = right;
    }
    if !caption.is_empty() && used + 12.0 + width(caption, SIZE) < size[0] - 12.0 {
        let _ = writeln!(
            text,
            "<text class=\"caption\" x=\"{}\" y=\"{}\">{}</text>",
            number(size[0] - 12.0),
            number(base + 3.0),
            escaped(caption)
        );
    }
    for (row, note) in figure.notes.iter().rev().enumerate() {
        let mut note = note.clone();
        while width(&note, SIZE) > size[0] - 24.0 && note.pop().is_some() {}
        let y = base + 3.0 - ROW * (row as f64 + 1.0);
        let _ = writeln!(
            text,
            "<text class=\"note\" x=\"12\" y=\"{}\">{}</text>",
            number(y),
            escaped(&note)
        );
    }
    text.push_str("</g>\n");
    text
}

/// The arrow of gravity in the legend right of a point, and where it ends. Here y points downwards.
fn falling([left, middle]: Point, gravity: Point) -> (String, f64) {
    let size = gravity[0].hypot(gravity[1]);
    let along = match size > RELATIVE_ROUNDING {
        true => [gravity[0] / size, -gravity[1] / size],
        false => [0.0, 1.0],
    };
    let half = (0.5 * GRAVITY[0] * along[0].abs()).max(0.4 * GRAVITY[1]);
    let center = [left + half, middle];
    let [from, to] = [-0.5, 0.5].map(|it| onward(center, it * GRAVITY[0], along));
    let neck = onward(to, -0.7 * GRAVITY[1], along);
    let head = Outline::head(to, along, GRAVITY[1]).points();
    let corners: Vec<String> = head
        .iter()
        .map(|[x, y]| format!("{} {}", number(*x), number(*y)))
        .collect();
    let name = left + 2.0 * half + 5.0;
    let mut text = String::from("<g id=\"gravity\"><title>gravity</title>");
    let _ = writeln!(
        text,
        "<path class=\"load\" d=\"M{} {}L{} {}\"/><path class=\"load-head\" d=\"M{}Z\"/><text class=\"note\" x=\"{}\" y=\"{}\">g</text></g>",
        number(from[0]),
        number(from[1]),
        number(neck[0]),
        number(neck[1]),
        corners.join("L"),
        number(name),
        number(middle + 5.0)
    );
    (text, name + 8.0)
}
