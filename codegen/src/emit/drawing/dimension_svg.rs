//! Writes dimensions as SVG.

use std::fmt::Write as _;

use super::dimension::{Dimension, HEAD};
use super::figure::Outline;
use super::svg::{number, path_data};
use crate::emit::markup::escaped;

/// Dimensions as one group; empty without any.
pub(super) fn dimensions_text(dimensions: &[Dimension]) -> String {
    if dimensions.is_empty() {
        return String::new();
    }
    let mut text = String::from("<g id=\"dimensions\"><title>dimensions</title>\n");
    for dimension in dimensions {
        let drawn = dimension.lines();
        let segments = drawn.lines.iter();
        let lines: String = segments
            .map(|[from, to]| path_data(&Outline::line(*from, *to)))
            .collect();
        let _ = write!(text, "<path class=\"dimension\" d=\"{lines}\"/>");
        let heads = drawn.feet.iter().zip(drawn.heads);
        let heads: String = heads
            .map(|(foot, along)| path_data(&Outline::head(*foot, along, HEAD)))
            .collect();
        let _ = write!(text, "<path class=\"dimension-head\" d=\"{heads}\"/>");
        let [x, y] = [drawn.text_at[0], -drawn.text_at[1]].map(number);
        let turned = match number(-drawn.text_angle.to_degrees()).as_str() {
            "0" => String::new(),
            degrees => format!(" rotate({degrees})"),
        };
        let _ = writeln!(
            text,
            "<text class=\"dimension-text\" transform=\"translate({x} {y}){turned}\" y=\"{}\">{}</text>",
            number(0.36 * dimension.letters()),
            escaped(&dimension.text)
        );
    }
    text.push_str("</g>\n");
    text
}
