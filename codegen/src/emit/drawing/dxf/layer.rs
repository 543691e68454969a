//! Layers of a DXF: the ground, one for each body, and one for each kind of sign.

use super::super::figure::{Frame, Look};

/// Line type that the file defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineType {
    Continuous,
    Center,
    Dashed,
}

impl LineType {
    pub const ALL: [LineType; 3] = [LineType::Continuous, LineType::Center, LineType::Dashed];

    /// Name, description, and lengths of dashes (positive) and gaps in pixels.
    pub fn definition(self) -> (&'static str, &'static str, &'static [f64]) {
        match self {
            LineType::Continuous => ("Continuous", "Solid line", &[]),
            LineType::Center => ("CENTER", "____ _ ____ _ ____", &[12.0, -3.0, 2.5, -3.0]),
            LineType::Dashed => ("DASHED", "__ __ __ __ __ __", &[6.0, -4.0]),
        }
    }
}

/// Contents of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Supports, guides and hatching.
    Ground,
    /// Shape of the body of this number.
    Body(usize),
    /// Links and cylinders without a body.
    Rods,
    Pins,
    CenterLines,
    Springs,
    Drives,
    Loads,
    Paths,
    Frames,
    Dimensions,
    Text,
    /// Measured points, which are not plotted.
    Points,
}

/// Name, color (AutoCAD Color Index), line type and width (hundredths of a millimeter) of the layers that every drawing may have.
const KINDS: [(Content, &str, i64, LineType, i64); 12] = [
    (Content::Ground, "GROUND", 8, LineType::Continuous, 35),
    (Content::Rods, "RODS", 7, LineType::Continuous, 50),
    (Content::Pins, "PINS", 7, LineType::Continuous, 35),
    (Content::CenterLines, "CENTER", 1, LineType::Center, 18),
    (Content::Springs, "SPRINGS", 7, LineType::Continuous, 35),
    (Content::Drives, "DRIVES", 30, LineType::Continuous, 35),
    (Content::Loads, "LOADS", 94, LineType::Continuous, 35),
    (Content::Paths, "PATHS", 5, LineType::Continuous, 25),
    (Content::Frames, "FRAMES", 200, LineType::Continuous, 25),
    (
        Content::Dimensions,
        "DIMENSIONS",
        134,
        LineType::Continuous,
        18,
    ),
    (Content::Text, "TEXT", 7, LineType::Continuous, 25),
    // Programs know this name.
    (Content::Points, "Defpoints", 8, LineType::Continuous, 0),
];

/// Colors of bodies: the nearest to those of pictures.
const TINTS: [i64; 7] = [160, 32, 106, 212, 150, 14, 54];

/// Row in the table of layers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LayerRow {
    pub name: String,
    pub color: i64,
    pub line_type: LineType,
    pub width: i64,
    pub is_plotted: bool,
}

/// Layers in use.
#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    rows: Vec<(Content, LayerRow)>,
}

impl Layers {
    /// Returns the name of a layer, which then exists. `names` are those of bodies.
    pub fn name(&mut self, content: Content, names: &[String]) -> String {
        if let Some((_, row)) = self.rows.iter().find(|(it, _)| *it == content) {
            return row.name.clone();
        }
        let row = match (content, KINDS.iter().find(|it| it.0 == content)) {
            (_, Some((_, name, color, line_type, width))) => LayerRow {
                name: name.to_string(),
                color: *color,
                line_type: *line_type,
                width: *width,
                is_plotted: content != Content::Points,
            },
            (Content::Body(body), _) => LayerRow {
                name: self.unique(names.get(body).map_or("", String::as_str)),
                color: TINTS[body.saturating_sub(1) % TINTS.len()],
                line_type: LineType::Continuous,
                width: 50,
                is_plotted: true,
            },
            (_, None) => return "0".to_string(),
        };
        let name = row.name.clone();
        self.rows.push((content, row));
        name
    }

    /// Layer name of a body. Upper and lower case do not distinguish layers.
    fn unique(&self, body: &str) -> String {
        let letters = body.chars();
        let clean: String = letters
            .map(|it| {
                if "<>/\\\":;?*|=,`' ".contains(it) {
                    '_'
                } else {
                    it
                }
            })
            .collect();
        let is_used = |name: &str| {
            let mut rows = self.rows.iter();
            rows.any(|(_, row)| row.name.to_lowercase() == name.to_lowercase())
        };
        let first = format!("BODY_{clean}");
        if !is_used(&first) {
            return first;
        }
        let mut numbered = (2_usize..).map(|number| format!("{first}_{number}"));
        numbered.find(|it| !is_used(it)).unwrap_or(first)
    }

    pub fn rows(&self) -> impl Iterator<Item = &LayerRow> {
        self.rows.iter().map(|(_, row)| row)
    }
}

/// Layer of an outline. `owner` is the body whose group it belongs to, if any.
pub(super) fn content(look: Look, frame: Frame, owner: Option<usize>) -> Content {
    let carrier = owner.or(match frame {
        Frame::Body(body) => Some(body),
        Frame::Riding(at, _) | Frame::Wound(at, _) => Some(at.body),
        Frame::Toward(..) | Frame::Between(..) => None,
        Frame::Force(..) | Frame::Torque(..) | Frame::Still => Some(0),
    });
    match (look, carrier) {
        (Look::Thought | Look::Mark, _) => Content::CenterLines,
        (Look::Drive | Look::DriveHead, _) => Content::Drives,
        (Look::Load | Look::LoadHead, _) => Content::Loads,
        (Look::Element, _) => Content::Springs,
        (Look::Path | Look::Tick, _) => Content::Paths,
        (Look::Axis | Look::AxisHead, _) => Content::Frames,
        (Look::Massless | Look::Gap, _) | (_, None) => Content::Rods,
        (Look::Hatch, _) | (_, Some(0)) => Content::Ground,
        (_, Some(body)) => Content::Body(body),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_differ_in_more_than_their_case() {
        let names = ["ground", "rod", "ROD", "a:b"].map(String::from);
        let mut layers = Layers::default();
        let made = [1, 2, 3, 1].map(|body| layers.name(Content::Body(body), &names));
        assert_eq!(made, ["BODY_rod", "BODY_ROD_2", "BODY_a_b", "BODY_rod"]);
        assert_eq!(layers.rows().count(), 3);
    }
}
