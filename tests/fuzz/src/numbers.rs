//! Assembles mechanisms with random numbers and units. They are refused, fail with a typed failure, or their links
//! meet, as computed here from the numbers themselves.

use arbitrary::{Result, Unstructured};
use linkwright::{Frame, Settings};
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::textbook::TextbookEquations;

use super::outcome::with_codes;

const UNITS: [(&str, f64); 8] = [
    ("", 1.0),
    ("m", 1.0),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("km", 1e3),
    ("inch", 0.0254),
    ("ft", 0.3048),
];

/// Largest gap between links, relative to the largest coordinate. The tolerance is 1e-12 of the coordinate.
const GAP: f64 = 1e-10;

/// Length as text, and its value.
struct Length {
    text: String,
    value: f64,
}

fn length(input: &mut Unstructured<'_>) -> Result<Length> {
    let digits = input.int_in_range(0..=999_999_u32)?;
    let point = input.int_in_range(0..=6_usize)?;
    let exponent = match input.int_in_range(0..=3)? {
        0 => input.int_in_range(-330..=310)?,
        1 => input.int_in_range(-12..=12)?,
        _ => 0,
    };
    let negative = input.ratio(1, 8)?;
    let (unit, factor) = *input.choose(&UNITS)?;
    let digits = format!("{digits:07}");
    let (whole, part) = digits.split_at(digits.len() - point);
    let number = match (whole, part) {
        (whole, "") => format!("{whole}e{exponent}"),
        ("", part) => format!("0.{part}e{exponent}"),
        (whole, part) => format!("{whole}.{part}e{exponent}"),
    };
    let sign = if negative { "-" } else { "" };
    let value: f64 = number.parse().expect("a decimal number");
    Ok(Length {
        text: format!("{sign}{number}{unit}"),
        value: if negative { -value } else { value } * factor,
    })
}

/// Assembles a four-bar linkage or a slider-crank; returns the last stage, with codes.
///
/// # Panics
/// If the library does, or if a frame is wrong.
pub fn run(bytes: &[u8]) -> String {
    let answer = attempt(&mut Unstructured::new(bytes));
    answer.unwrap_or_else(|it| it.to_string())
}

fn attempt(input: &mut Unstructured<'_>) -> Result<String> {
    let slides = input.ratio(1, 2)?;
    let [x, y, g, a, b, c] = [
        length(input)?,
        length(input)?,
        length(input)?,
        length(input)?,
        length(input)?,
        length(input)?,
    ];
    let angle = f64::from(input.int_in_range(-4000..=4000_i32)?) / 1000.0;
    let end = if slides {
        "body slider at (x + a + b, y + c) { C: (0, 0) }
    revolute C(coupler, slider);
    absolute_y(slider) = y + c;
    absolute_angle(slider) = 0;"
    } else {
        "body rocker at D turned 1 { D: (0, 0), C: (c, 0) }
    revolute C(coupler, rocker);
    revolute D(ground, rocker);"
    };
    let text = format!(
        "mechanism fuzzed {{
    const x = {};
    const y = {};
    const g = {};
    const a = {};
    const b = {};
    const c = {};
    point A = (x, y), D = (x + g, y);
    body crank at A turned {angle} {{ A: (0, 0), B: (a, 0) }}
    body coupler at (x + a/2, y + a/2) turned 0.3 {{ B: (0, 0), C: (b, 0) }}
    {end}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    drive phi(crank) = {angle} + t;
}}",
        x.text, y.text, g.text, a.text, b.text, c.text
    );
    let source = Source::new("fuzzed.mech", text);
    let read = match linkwright_codegen::read(&source) {
        Ok(read) => read,
        Err(findings) => {
            assert!(!findings.render(&source).is_empty());
            return Ok(with_codes("refused", &findings));
        }
    };
    let Some(derived) = read.only() else {
        return Ok("without a motion".to_string());
    };
    if let Err(findings) = linkwright_codegen::stages::check(&derived) {
        assert!(!findings.render(&source).is_empty());
        return Ok(with_codes("not solvable", &findings));
    }
    let equations = TextbookEquations::new(&derived.pool, &derived.system);
    let settings = Settings::default();
    let assembled =
        Frame::assemble_from_rough_estimate(&equations, equations.estimate(), None, 0.0, &settings);
    let frame = match assembled {
        Ok(frame) => frame,
        Err(failure) => {
            assert!(!failure.to_string().is_empty());
            let kind = format!("{:?}", failure.kind);
            let name = kind.split(|it: char| !it.is_alphanumeric()).next();
            return Ok(format!("failed {} {slides}", name.unwrap_or_default()));
        }
    };
    let all = frame.q.iter().chain(&frame.qd).chain(&frame.qdd);
    assert!(
        all.clone().all(|value| value.is_finite()),
        "{}",
        source.text
    );
    let q: Vec<f64> = frame.q.iter().copied().collect();
    // End of a link of this length that begins at a body's origin.
    let tip = |body: usize, length: f64| {
        let (sine, cosine) = q[3 * body + 2].sin_cos();
        [
            q[3 * body] + length * cosine,
            q[3 * body + 1] + length * sine,
        ]
    };
    let origin = |body: usize| [q[3 * body], q[3 * body + 1]];
    let mut gaps = vec![
        (origin(0), [x.value, y.value]),
        (tip(0, a.value), origin(1)),
    ];
    if slides {
        gaps.push((tip(1, b.value), origin(2)));
        gaps.push((origin(2), [origin(2)[0], y.value + c.value]));
    } else {
        gaps.push((tip(1, b.value), tip(2, c.value)));
        gaps.push((origin(2), [x.value + g.value, y.value]));
    }
    let lengths = [x.value, y.value, g.value, a.value, b.value, c.value];
    let largest = q.iter().chain(&lengths).enumerate();
    let largest = largest
        .filter(|(place, _)| *place >= q.len() || place % 3 != 2)
        .fold(0.0_f64, |largest, (_, value)| largest.max(value.abs()));
    for (one, other) in gaps {
        for axis in 0..2 {
            let gap = (one[axis] - other[axis]).abs();
            assert!(
                gap <= GAP * largest,
                "{gap:e} of {largest:e}\n{}",
                source.text
            );
        }
    }
    let driven = (q[2] - angle).abs();
    assert!(driven <= 1e-11, "{driven:e}\n{}", source.text);
    Ok(format!("assembled {slides}"))
}
