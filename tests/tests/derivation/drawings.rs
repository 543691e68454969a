//! Pictures of every described mechanism: names do not overlap, joints are where the solver puts them, and nothing is
//! missing.

use std::collections::BTreeMap;

use linkwright::{Settings, Shell};
use linkwright_codegen::stages::emit::drawing::{self, Options, Panel, Pose};
use linkwright_codegen::stages::joint::geometry::Mark;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::assemblies::assemblies;
use linkwright_solver::drawn::pose;
use linkwright_solver::{Instant, Interpreted};
use linkwright_tests::values::assembled_from;
use linkwright_tests::{description, files};

/// Size of letters in a picture (px).
const LETTERS: f64 = 13.0;

/// Every motion of every description of the repository, by its title.
fn gallery() -> BTreeMap<String, Derived> {
    let folders = [
        files::repository().join("mechanisms"),
        files::package("descriptions"),
    ];
    let paths = folders
        .iter()
        .flat_map(|folder| files::with_extension(folder, "mech"));
    let paths: Vec<_> = paths.collect();
    let systems = paths
        .iter()
        .flat_map(|path| description::motions(files::stem(path)));
    let all: BTreeMap<_, _> = systems
        .map(|it| (it.system.mechanism.title(), it))
        .collect();
    assert!(all.len() > 80, "{} descriptions", all.len());
    all
}

fn assembled(derived: &Derived) -> (Interpreted, Instant) {
    let view = Interpreted::new(derived).expect("its blocks have an order");
    let shell: Shell<Interpreted> = assembled_from(view.clone(), &[], 0.0, Settings::default())
        .unwrap_or_else(|failure| panic!("{}: {failure:?}", derived.system.mechanism.title()));
    let instant = shell.frame().clone();
    (view, instant)
}

fn picture(derived: &Derived) -> (String, Instant) {
    let (view, instant) = assembled(derived);
    let options = Options {
        caption: derived.system.mechanism.title(),
        ..Options::default()
    };
    let posed = pose(&view, &instant);
    (
        drawing::draw(&derived.pool, &derived.system, &posed, &[], &[], &options),
        instant,
    )
}

/// Value of an attribute of a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let begin = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    let rest = &tag[begin..];
    Some(&rest[..rest.find('"')?])
}

fn number(tag: &str, name: &str) -> f64 {
    let value = attribute(tag, name).unwrap_or_else(|| panic!("no {name} in {tag}"));
    value.parse().unwrap_or_else(|_| panic!("{name} in {tag}"))
}

/// Numbers of `translate(…)` and of `rotate(…)`, or zeros.
fn transform(tag: &str) -> ([f64; 2], f64) {
    let text = attribute(tag, "transform").unwrap_or_default();
    let of = |word: &str| -> Vec<f64> {
        let Some((_, rest)) = text.split_once(&format!("{word}(")) else {
            return Vec::new();
        };
        let inside = rest.split(')').next().unwrap_or_default();
        inside
            .split(' ')
            .map(|it| it.parse().expect("a number"))
            .collect()
    };
    let moved = of("translate");
    let turned = of("rotate").first().copied().unwrap_or(0.0);
    let moved = moved.first_chunk::<2>().copied().unwrap_or_default();
    (moved, turned.to_radians())
}

/// Box (px): its left, its upper, its right and its lower edge.
#[derive(Clone, Copy, Debug)]
struct Label([f64; 4]);

impl Label {
    fn meets(&self, other: &Label) -> bool {
        let (a, b) = (self.0, other.0);
        a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
    }
}

/// Boxes of all texts of a picture with their texts; those with a tag have the box of the tag.
fn labels(svg: &str) -> Vec<(String, Label)> {
    let mechanism = svg
        .split('\n')
        .find(|line| line.starts_with("<g id=\"mechanism\""))
        .expect("the mechanism");
    let (origin, _) = transform(mechanism);
    let begin = svg.find("<g id=\"names\">").expect("names");
    let legend = svg.find("<g id=\"legend\">").expect("a legend");
    let mut texts = Vec::new();
    for (place, _) in svg.match_indices("<text ") {
        let rest = &svg[place..];
        let (tag, after) = rest.split_once('>').expect("a tag");
        let text = after.split('<').next().expect("a text").to_string();
        let moved = if place < legend { origin } else { [0.0; 2] };
        assert!(place > begin, "a text outside of the names: {text}");
        let (x, y) = (number(tag, "x") + moved[0], number(tag, "y") + moved[1]);
        let width = drawing::width(&text, LETTERS);
        let left = match attribute(tag, "class") {
            Some("note") => x,
            Some("caption") => x - width,
            _ => x - 0.5 * width,
        };
        // Capitals are 0.72 of the size high, and letters reach 0.2 below the line.
        let edges = [left, y - 0.72 * LETTERS, left + width, y + 0.2 * LETTERS];
        texts.push((text, Label(edges)));
    }
    for (place, _) in svg.match_indices("<rect class=\"tag\"") {
        let tag = svg[place..].split('>').next().expect("a tag");
        let at = ["x", "y", "width", "height"].map(|name| number(tag, name));
        let [x, y] = [at[0] + origin[0], at[1] + origin[1]];
        let text = svg[place..].split("<text").nth(1).expect("its text");
        let text = text.split(['>', '<']).nth(1).expect("its text");
        let tagged = texts.iter_mut().find(|(name, label)| {
            name == text && label.meets(&Label([x, y, x + at[2], y + at[3]]))
        });
        let (_, label) = tagged.expect("the text in a tag");
        assert!(
            x <= label.0[0] && label.0[2] <= x + at[2],
            "{text} in its tag"
        );
        *label = Label([x, y, x + at[2], y + at[3]]);
    }
    texts
}

#[test]
fn names_stand_apart_and_none_leaves_the_picture() {
    for (title, derived) in gallery() {
        let (svg, _) = picture(&derived);
        let first = svg.split('>').next().expect("the first tag");
        let [width, height] = ["width", "height"].map(|name| number(first, name));
        let labels = labels(&svg);
        for (place, (text, label)) in labels.iter().enumerate() {
            let [left, top, right, bottom] = label.0;
            assert!(
                left >= 0.0 && top >= 0.0 && right <= width && bottom <= height,
                "{title}: {text} at {label:?} leaves {width} x {height}"
            );
            for (other, it) in &labels[place + 1..] {
                assert!(
                    !label.meets(it),
                    "{title}: {text} {label:?} covers {other} {it:?}"
                );
            }
        }
        // Every body has its name, every point at least one of its names.
        let has = |wanted: &str| labels.iter().any(|(text, _)| text == wanted);
        for body in derived.system.mechanism.moving_bodies() {
            assert!(has(&body.name), "{title}: no name of body {}", body.name);
        }
        for point in &derived.system.mechanism.points {
            let body = &derived.system.mechanism.bodies[point.mark.frame.body.0];
            let written = body.marks.iter().any(|it| has(&it.name));
            assert!(
                has(&point.name) || written,
                "{title}: no name of point {}",
                point.name
            );
        }
    }
}

/// Elements of a group, up to the next named one.
fn group<'a>(svg: &'a str, id: &str) -> Option<&'a str> {
    let begin = svg.find(&format!("<g id=\"{id}\""))?;
    let rest = &svg[begin + 1..];
    Some(&rest[..rest.find("<g id=").unwrap_or(rest.len())])
}

fn has_ink(group: Option<&str>) -> bool {
    group.is_some_and(|it| it.contains("<path") || it.contains("<circle"))
}

#[test]
fn every_joint_and_every_body_appears_once() {
    for (title, derived) in gallery() {
        let (svg, _) = picture(&derived);
        for joint in &derived.system.mechanism.joints {
            let id = format!("joint-{}", joint.slug);
            assert_eq!(
                svg.matches(&format!("<g id=\"{id}\"")).count(),
                1,
                "{title}: {id}"
            );
            let parts = ["", "-below", "-upon"].map(|layer| group(&svg, &format!("{id}{layer}")));
            let is_noted = svg.contains(&format!(">{}</text>", joint.label));
            assert!(
                parts.into_iter().any(has_ink) || is_noted,
                "{title}: nothing is drawn of {}",
                joint.label
            );
        }
        for (number, body) in derived.system.mechanism.bodies.iter().enumerate().skip(1) {
            let id = format!("body-{}", body.name);
            assert_eq!(
                svg.matches(&format!("<g id=\"{id}\"")).count(),
                1,
                "{title}: {id}"
            );
            // A body may be a block that turns as another does.
            let is_block = svg.contains(&format!("data-at=\"{number} "));
            assert!(has_ink(group(&svg, &id)) || is_block, "{title}: {id}");
        }
    }
}

/// Position of a mark, by the solver's coordinates.
fn solved(derived: &Derived, instant: &Instant, mark: &Mark) -> [f64; 2] {
    let graph = &derived.pool.graph;
    let body = &derived.system.mechanism.bodies[mark.frame.body.0];
    let [x, y, angle] = body
        .coordinates
        .map(|it| it.map_or(0.0, |own| instant.q()[own.place]));
    let [u, v] = mark
        .local
        .map(|part| graph.constant_value(part).expect("a constant"));
    let (sine, cosine) = angle.sin_cos();
    [x + cosine * u - sine * v, y + sine * u + cosine * v]
}

#[test]
fn pins_are_drawn_where_the_solver_puts_them() {
    let mut count = 0;
    for (title, derived) in gallery() {
        let (svg, instant) = picture(&derived);
        let scale = number(
            group(&svg, "mechanism").expect("the mechanism"),
            "data-scale",
        );
        for joint in &derived.system.mechanism.joints {
            if joint.kind.keyword != "revolute" {
                continue;
            }
            let drawn = group(&svg, &format!("joint-{}", joint.slug)).expect("a group");
            let (origin, turned) = transform(drawn.split('>').next().expect("a tag"));
            let circle = drawn.split("<circle").nth(1).expect("a circle");
            let [x, y] = ["cx", "cy"].map(|name| number(circle, name));
            let (sine, cosine) = turned.sin_cos();
            let there = [
                origin[0] + cosine * x - sine * y,
                origin[1] + sine * x + cosine * y,
            ];
            // A third mark is the point about which an arm turns.
            for mark in joint.operands.marks.iter().take(2) {
                let [x, y] = solved(&derived, &instant, mark);
                let off = (there[0] - scale * x).hypot(there[1] + scale * y);
                // A hundredth of a degree across a picture is a tenth of a pixel.
                assert!(off < 0.15, "{title}: {} is off by {off} px", joint.label);
                count += 1;
            }
        }
    }
    assert!(count > 400, "{count} marks");
}

#[test]
fn a_picture_is_the_same_on_every_run() {
    for (title, derived) in gallery() {
        let drawn = Pose::drawn(&derived.pool, &derived.system);
        let draw = || {
            drawing::draw(
                &derived.pool,
                &derived.system,
                &drawn,
                &[],
                &[],
                &Options::default(),
            )
        };
        let svg = draw();
        assert_eq!(svg, draw(), "{title}");
        let (_, drawn) = svg.split_once("</style>").expect("a style sheet");
        for wrong in ["NaN", "inf", "-0 ", "\"-0\""] {
            assert!(!drawn.contains(wrong), "{title}: {wrong}");
        }
        for outside in ["http://www.w3.org/1999/xlink", "href", "<script", "url("] {
            assert!(!svg.contains(outside), "{title}: {outside}");
        }
    }
}

#[test]
fn a_size_that_is_asked_for_is_kept() {
    let derived = description::system("scissor");
    let (view, instant) = assembled(&derived);
    for size in [[300, 900], [1200, 300]] {
        let options = Options {
            size: Some(size),
            frames: vec![0, 1],
            ..Options::default()
        };
        let svg = drawing::draw(
            &derived.pool,
            &derived.system,
            &pose(&view, &instant),
            &[],
            &[],
            &options,
        );
        let first = svg.split('>').next().expect("the first tag");
        let size_px = ["width", "height"].map(|name| number(first, name));
        assert_eq!(size_px, size.map(f64::from));
        assert!(has_ink(group(&svg, "frame-ground")) && has_ink(group(&svg, "frame-shoe")));
    }
}

/// The sixteen assemblies of the excavator, each four times: the largest number of panels in a picture.
#[test]
fn sixty_four_assemblies_have_one_scale_and_a_panel_each() {
    let derived = description::system("excavator");
    let view = Interpreted::new(&derived).expect("its blocks have an order");
    let list = assemblies(&view, 0.0).found;
    let panels: Vec<Panel> = list
        .iter()
        .cycle()
        .take(64)
        .map(|assembly| Panel {
            title: assembly.label(),
            pose: pose(&view, &assembly.instant),
        })
        .collect();
    let svg = drawing::sheet(&derived.pool, &derived.system, &panels);
    let first = svg.split('>').next().expect("the first tag");
    let [width, height] = ["width", "height"].map(|name| number(first, name));
    let side = width / 8.0;
    assert!(side >= 120.0 && height < 2.0 * width, "{width} x {height}");
    let lines: Vec<&str> = svg
        .lines()
        .filter(|it| it.starts_with("<g id=\"assembly-") && it.contains("data-scale"))
        .collect();
    assert_eq!(lines.len(), 64);
    let scale = number(lines[0], "data-scale");
    for (place, line) in lines.iter().enumerate() {
        assert_eq!(number(line, "data-scale"), scale);
        let ([x, y], _) = transform(line);
        let corner = [side * (place % 8) as f64, height / 8.0 * (place / 8) as f64];
        // Every pin lies in its panel.
        for joint in derived
            .system
            .mechanism
            .joints
            .iter()
            .filter(|it| it.kind.keyword == "revolute")
        {
            let mark = &joint.operands.marks[0];
            let instant = &list[place % list.len()].instant;
            let [u, v] = solved(&derived, instant, mark);
            let at = [x + scale * u - corner[0], y - scale * v - corner[1]];
            assert!(
                at[0] > 0.0 && at[0] < side,
                "{} of {place}: {at:?}",
                joint.label
            );
            assert!(
                at[1] > 20.0 && at[1] < height / 8.0,
                "{} of {place}: {at:?}",
                joint.label
            );
        }
    }
}

/// Picture without its style sheet, which is equal in all.
fn snapshot(name: &str) {
    let (svg, _) = picture(&description::system(name));
    let (head, rest) = svg.split_once("<style>").expect("a style sheet");
    let (_, body) = rest.split_once("</style>").expect("its end");
    let text = format!("{head}{}", body.trim_start());
    crate::assert_snapshot("drawings", name, &text);
}

#[test]
fn small_pictures_are_as_before() {
    for name in ["four_bar", "slider_crank", "disc_cam"] {
        snapshot(name);
    }
}
