//! `draw`: springs, dampers, forces, torques and gravity stand where closed forms put them.

use std::f64::consts::PI;

use crate::folder::Folder;

/// An arm that swings about O between springs and a damper.
pub const ARM: &str = "\
mechanism swinging {
    point O = (0, 0), W = (60cm, -35cm), C = (30cm, 30cm);
    body arm at O { O, P: (60cm, 0), M: (30cm, 0) }
    revolute O(ground, arm);
    drive phi(arm) = 15deg*sin(2*pi*t);
    mass arm = 5kg at M;
    gravity = (3m/s^2, -4m/s^2);
    spring upper (ground.C, arm.M) = 1N/mm;
    damper lower (ground.W, arm.P) = 100N*s/m;
    force on arm.P = (30N*cos(2*pi*t), -40N);
    torque on arm = 4N*m*sin(2*pi*t + 1);
    force on arm.M = (0.1N*rate(phi(arm)), 0) in arm;
    effort;
}
";

/// A part of a picture that moves as a whole: where its points are, in pixels of the mechanism.
struct Part<'a> {
    text: &'a str,
    moved: [f64; 2],
    turned: f64,
    stretched: [f64; 2],
}

/// Numbers of a path or of a transformation.
pub fn numbers(text: &str) -> Vec<f64> {
    let parts = text.split(|it: char| !(it.is_ascii_digit() || it == '.' || it == '-'));
    parts.filter_map(|it| it.parse().ok()).collect()
}

impl<'a> Part<'a> {
    /// The elements behind a tag, up to the end of their group.
    fn new(svg: &'a str, start: usize) -> Part<'a> {
        let (tag, rest) = svg[start..].split_once('>').expect("a tag");
        let text = rest.split("</g>").next().expect("a group");
        let transform = tag.split("transform=\"").nth(1).unwrap_or_default();
        let of = |word: &str| {
            let inside = transform.split(&format!("{word}(")).nth(1);
            numbers(
                inside
                    .and_then(|it| it.split(')').next())
                    .unwrap_or_default(),
            )
        };
        let pair = |found: Vec<f64>, other: f64| match found[..] {
            [a, b] => [a, b],
            _ => [other; 2],
        };
        Part {
            text,
            moved: pair(of("translate"), 0.0),
            turned: of("rotate").first().copied().unwrap_or(0.0).to_radians(),
            stretched: pair(of("scale"), 1.0),
        }
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [x, y] = [self.stretched[0] * x, self.stretched[1] * y];
        let (sine, cosine) = self.turned.sin_cos();
        [
            self.moved[0] + cosine * x - sine * y,
            self.moved[1] + sine * x + cosine * y,
        ]
    }

    /// The points of its lines, each in its own components.
    fn points(&self) -> Vec<[f64; 2]> {
        let lines = self.text.split(" d=\"").skip(1);
        let all = lines.flat_map(|it| numbers(it.split('"').next().expect("a path")));
        let all: Vec<f64> = all.collect();
        all.chunks_exact(2).map(|it| [it[0], it[1]]).collect()
    }
}

/// The parts of a picture with this word in their tags, and how many pixels a metre has.
fn parts<'a>(svg: &'a str, word: &str) -> (Vec<Part<'a>>, f64) {
    let scale = svg.split("data-scale=\"").nth(1).expect("a scale");
    let scale = numbers(scale.split('"').next().expect("a number"))[0];
    let matches = svg.match_indices(word);
    let parts = matches.map(|(at, _)| Part::new(svg, svg[..at].rfind('<').expect("a tag")));
    (parts.collect(), scale)
}

#[track_caller]
fn is_at(found: [f64; 2], wanted: [f64; 2], scale: f64) {
    let off = (found[0] - scale * wanted[0]).hypot(found[1] + scale * wanted[1]);
    assert!(off < 0.1, "{found:?} is {off} px off");
}

/// Place of a point of the arm at this distance from O.
fn on_arm(t: f64, distance: f64) -> [f64; 2] {
    let angle = (PI / 12.0) * (2.0 * PI * t).sin();
    [distance * angle.cos(), distance * angle.sin()]
}

fn drawn(folder: &Folder, t: f64) -> String {
    let draw = format!("draw a.mech --at {t} --out -");
    folder.run(&draw).exits_with(0).stdout
}

/// The text of the group of a load.
fn load(svg: &str, label: &str) -> String {
    let title = format!("<title>{label}</title>");
    let groups = svg.match_indices(&title).map(|(at, _)| {
        let start = svg[..at].rfind("<g ").expect("a group");
        let rest = &svg[start..];
        let end = rest[1..].find("<g id=").map_or(rest.len(), |it| it + 1);
        rest[..end].to_string()
    });
    let head = &svg[svg.find("<g id=\"mechanism\"").expect("a mechanism")..];
    let head = head.split('>').next().expect("a tag");
    let groups: String = groups.collect();
    assert!(!groups.is_empty(), "no {label} in {svg}");
    format!("{head}>{groups}")
}

#[test]
fn a_spring_is_a_zigzag_from_end_to_end() {
    let folder = Folder::new("draw_spring", ARM);
    for t in [0.0, 0.11, 0.7] {
        let svg = load(&drawn(&folder, t), "spring upper");
        let (found, scale) = parts(&svg, " data-length=");
        let [spring] = &found[..] else {
            panic!("one part in {svg}")
        };
        let points = spring.points();
        let (first, last) = (points[0], points[points.len() - 1]);
        let mut ends = [first, last].map(|it| spring.place(it));
        // Its ends may stand in any order.
        ends.sort_by(|a, b| a[1].total_cmp(&b[1]));
        is_at(ends[0], [0.3, 0.3], scale);
        is_at(ends[1], on_arm(t, 0.3), scale);
        let signs = points.windows(2).filter(|it| it[0][1] * it[1][1] < 0.0);
        assert!(signs.count() >= 6, "{points:?}");
    }
}

#[test]
fn a_damper_is_a_piston_in_a_cylinder() {
    let folder = Folder::new("draw_damper", ARM);
    for t in [0.0, 0.2, 0.75] {
        let svg = load(&drawn(&folder, t), "damper lower");
        let (found, scale) = parts(&svg, " data-from=");
        let [cylinder, piston] = &found[..] else {
            panic!("two parts in {svg}")
        };
        let (lead, rod) = (cylinder.points(), piston.points());
        let mut ends = [cylinder.place(lead[0]), piston.place(rod[0])];
        ends.sort_by(|a, b| b[1].total_cmp(&a[1]));
        is_at(ends[0], [0.6, -0.35], scale);
        is_at(ends[1], on_arm(t, 0.6), scale);
        // The plate is the last line, and lies across the axis between bottom and opening of the cylinder.
        let plate = piston.place(rod[rod.len() - 1]);
        let walls: Vec<[f64; 2]> = lead[3..].iter().map(|it| cylinder.place(*it)).collect();
        let heights = walls.iter().map(|it| it[1]);
        let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), it| {
            (low.min(it), high.max(it))
        });
        assert!(low < plate[1] && plate[1] < high, "{plate:?} in {walls:?}");
    }
}

/// The second element between two points is drawn beside the first one.
#[test]
fn elements_between_the_same_points_do_not_overlap() {
    let text = ARM.replace("(ground.W, arm.P)", "(arm.M, ground.C)");
    let folder = Folder::new("draw_beside", text);
    let svg = drawn(&folder, 0.2);
    let spring = load(&svg, "spring upper");
    let (spring, scale) = parts(&spring, " data-length=");
    let damper = load(&svg, "damper lower");
    let (damper, _) = parts(&damper, " data-from=");
    let reach = |part: &Part, lines: std::ops::Range<usize>| {
        let sides = part.points()[lines].to_vec();
        let sides = sides.iter().map(|it| it[1]);
        sides.fold((f64::MAX, f64::MIN), |(low, high), it| {
            (low.min(it), high.max(it))
        })
    };
    let (low, high) = reach(&spring[0], 0..spring[0].points().len());
    // The walls of its cylinder.
    let (from, to) = reach(&damper[0], 3..7);
    assert!(
        from > high || to < low,
        "{from} to {to} beside {low} to {high}"
    );
    // It begins at one of the ends all the same.
    let [x, y] = damper[0].place(damper[0].points()[0]);
    let ends = [[0.3, 0.3], on_arm(0.2, 0.3)].into_iter();
    let mut off = ends.map(|end| (x - scale * end[0]).hypot(y + scale * end[1]));
    assert!(off.any(|it| it < 0.1), "({x}, {y})");
}

#[test]
fn a_force_is_an_arrow_along_it_at_its_point() {
    let folder = Folder::new("draw_force", ARM);
    for t in [0.0_f64, 0.2, 0.6] {
        let svg = drawn(&folder, t);
        let (forces, scale) = parts(&svg, " data-force=");
        let [on_p, on_m] = &forces[..] else {
            panic!("two arrows in {svg}")
        };
        is_at(on_p.place([0.0; 2]), on_arm(t, 0.6), scale);
        let expected = (40.0_f64).atan2(30.0 * (2.0 * PI * t).cos());
        let off = (on_p.turned - expected).sin().abs();
        assert!(off < 1e-3, "{} for {expected}", on_p.turned);
        // 0.1 N s φ̇ along the arm, which turns back where φ̇ < 0.
        is_at(on_m.place([0.0; 2]), on_arm(t, 0.3), scale);
        let turn = (PI / 12.0) * (2.0 * PI * t).sin();
        let way = if (2.0 * PI * t).cos() < 0.0 { PI } else { 0.0 };
        let expected = -turn - way;
        assert!(
            (on_m.turned - expected).cos() > 1.0 - 1e-6,
            "{}",
            on_m.turned
        );
    }
}

#[test]
fn a_torque_is_an_arc_that_goes_its_way() {
    let folder = Folder::new("draw_torque", ARM);
    for t in [0.0_f64, 0.4, 0.6] {
        let svg = drawn(&folder, t);
        let (found, scale) = parts(&svg, " data-torque=");
        let [arrow] = &found[..] else {
            panic!("one arrow in {svg}")
        };
        is_at(arrow.place([0.0; 2]), [0.0; 2], scale);
        let [start, end] = {
            let points = arrow.points();
            // The head is the last outline, and begins at its tip.
            [points[0], points[points.len() - 3]].map(|it| arrow.place(it))
        };
        // Counterclockwise while y points downwards.
        let way = start[1] * end[0] - start[0] * end[1];
        let torque = (2.0 * PI * t + 1.0).sin();
        assert!(
            way * torque > 0.0,
            "{start:?} to {end:?} for {torque} at {t}"
        );
    }
}

#[test]
fn gravity_is_a_labeled_arrow() {
    let folder = Folder::new("draw_gravity", ARM);
    let svg = drawn(&folder, 0.0);
    let gravity = svg.split("<g id=\"gravity\">").nth(1).expect("gravity");
    let gravity = gravity.split("</g>").next().expect("its end");
    assert!(gravity.contains(">g</text>"), "{gravity}");
    let shaft = gravity.split(" d=\"").nth(1).expect("a line");
    let [x0, y0, x1, y1] = numbers(shaft.split('"').next().expect("a path"))[..] else {
        panic!("a line in {gravity}")
    };
    let along = [x1 - x0, y1 - y0].map(|it| it / (x1 - x0).hypot(y1 - y0));
    assert!(
        (along[0] - 0.6).abs() < 2e-2 && (along[1] - 0.8).abs() < 2e-2,
        "{along:?}"
    );
    let without = Folder::new(
        "draw_weightless",
        ARM.replace("gravity = (3m/s^2, -4m/s^2);", ""),
    );
    assert!(!drawn(&without, 0.0).contains("id=\"gravity\""));
}

/// A force that vanishes has no direction.
#[test]
fn a_force_that_vanishes_has_no_arrow() {
    let text = ARM.replace("(30N*cos(2*pi*t), -40N)", "(30N*t, 0)");
    let folder = Folder::new("draw_no_force", text);
    let svg = drawn(&folder, 0.0);
    let (forces, _) = parts(&svg, " data-force=");
    assert_eq!(forces[0].stretched, [0.0; 2]);
}
