//! The mechanisms of the gallery that move freely, with what is free in them, and those that are left out.
//!
//! Where a coordinate has a dead center, that one is free, so that starts beside it have small determinants.

/// A mechanism of the gallery and what is free in it.
#[derive(Debug)]
pub struct Freed {
    /// Its file.
    pub file: &'static str,
    pub(super) free: &'static [Range],
    /// Joints that lose rank on the way, with what holds the bodies on the smooth path there.
    pub(super) regular: &'static [[&'static str; 2]],
}

/// A free coordinate, and where starts are looked for.
#[derive(Debug)]
pub(super) struct Range {
    /// The coordinate in the language.
    pub coordinate: &'static str,
    /// The value from which starts are looked for; `None` for that of the drawing.
    pub value: Option<&'static str>,
    /// Unit of distances from there (rad or m).
    pub reach: f64,
}

const fn range(coordinate: &'static str, value: &'static str, reach: f64) -> Range {
    Range {
        coordinate,
        value: Some(value),
        reach,
    }
}

/// An angle or a place from where it is drawn.
const fn drawn(coordinate: &'static str, reach: f64) -> Range {
    Range {
        coordinate,
        value: None,
        reach,
    }
}

const fn freed(file: &'static str, free: &'static [Range]) -> Freed {
    Freed {
        file,
        free,
        regular: &[],
    }
}

/// The pantograph stays a parallelogram.
const PANTOGRAPH: [[&str; 2]; 1] = [[
    "revolute P(near, short);",
    "equation phi(near) = phi(far); equation phi(long) = phi(short) + pi;",
]];

/// Both arms of the cell are mirror images in the line from O to P, which turns half as far as the crank; the rhombus stays one.
const PEAUCELLIER: [[&str; 2]; 2] = [
    [
        "revolute B(lower, near_lower);",
        "equation phi(upper) + phi(lower) = phi(crank); equation phi(near_upper) + phi(near_lower) = phi(crank);",
    ],
    [
        "revolute R(far_upper, far_lower);",
        "equation phi(far_upper) = phi(near_lower) + pi; equation phi(far_lower) = phi(near_upper) - pi;",
    ],
];

/// All rising links stay parallel, and all falling ones; in the first stage both have the same slope.
const SCISSOR: [[&str; 2]; 6] = [
    [
        "revolute M1(rising1, falling1);",
        "equation phi(rising1) + phi(falling1) = pi; equation x(rising1) = x(falling1);",
    ],
    [
        "revolute M2(rising2, falling2);",
        "equation phi(rising2) = phi(rising1); equation phi(falling2) = phi(falling1);",
    ],
    [
        "revolute M3(rising3, falling3);",
        "equation phi(rising3) = phi(rising1); equation phi(falling3) = phi(falling1);",
    ],
    [
        "revolute M4(rising4, falling4);",
        "equation phi(rising4) = phi(rising1); equation phi(falling4) = phi(falling1);",
    ],
    [
        "revolute M5(rising5, falling5);",
        "equation phi(rising5) = phi(rising1); equation phi(falling5) = phi(falling1);",
    ],
    [
        "revolute M6(rising6, falling6);",
        "equation phi(rising6) = phi(rising1); equation phi(falling6) = phi(falling1);",
    ],
];

/// The mechanisms, in the order of their files.
pub const MECHANISMS: [Freed; 23] = [
    freed("andrews", &[range("phi(k3)", "0.405", 1.0)]),
    freed("ankle", &[drawn("pitch", 1.0), drawn("roll", 1.0)]),
    freed(
        "arm",
        &[
            range("length(A, D)", "distance(A, D)", 0.2),
            range("length(B, H)", "distance(B, H)", 0.2),
        ],
    ),
    freed("cam_dwell", &[drawn("phi(cam)", 1.0)]),
    freed(
        "differential_wrist",
        &[drawn("left", 1.0), drawn("right", 1.0)],
    ),
    freed("disc_cam", &[drawn("phi(cam)", 1.0)]),
    freed("double_wishbone", &[drawn("W.y", 0.1)]),
    freed(
        "excavator",
        &[
            range("length(N, M)", "distance(N, M)", 0.2),
            range("length(H, G)", "distance(H, G)", 0.2),
        ],
    ),
    freed(
        "excavator_pins",
        &[
            range("length(N, M)", "distance(N, M)", 0.2),
            range("length(H, G)", "distance(H, G)", 0.2),
        ],
    ),
    freed("four_bar", &[drawn("phi(rocker)", 1.0)]),
    freed("inverted_slider_crank", &[drawn("phi(sleeve)", 1.0)]),
    freed("jansen", &[drawn("phi(swing)", 1.0)]),
    Freed {
        regular: &PANTOGRAPH,
        ..freed(
            "pantograph",
            &[drawn("near.P.x", 0.1), drawn("near.P.y", 0.1)],
        )
    },
    Freed {
        regular: &PEAUCELLIER,
        ..freed("peaucellier", &[drawn("phi(crank)", 1.0)])
    },
    freed("planetary_gear", &[drawn("phi(sun)", 1.0)]),
    freed(
        "platform_3rpr",
        &[
            range("length(A, P)", "distance(A, P)", 0.3),
            range("length(B, Q)", "distance(B, Q)", 0.3),
            range("length(C, R)", "distance(C, R)", 0.3),
        ],
    ),
    freed("quick_return", &[drawn("phi(lever)", 1.0)]),
    freed("rack_steering", &[drawn("phi(pinion)", 6.0)]),
    Freed {
        regular: &SCISSOR,
        ..freed("scissor", &[range("length(A, B)", "distance(A, B)", 0.2)])
    },
    freed("scotch_yoke", &[range("x(yoke)", "20mm", 0.1)]),
    freed("slider_crank", &[drawn("x(slider)", 0.1)]),
    freed("stephenson", &[drawn("phi(arm)", 1.0)]),
    freed("two_body", &[drawn("y(2)", 1.0)]),
];

/// Files that are left out, each with the reason.
pub const LEFT_OUT: [(&str, &str); 2] = [
    (
        "excavator_motions",
        "its bodies and joints are those of `excavator`",
    ),
    (
        "excavator_tool",
        "its bodies and joints are those of `excavator`",
    ),
];
