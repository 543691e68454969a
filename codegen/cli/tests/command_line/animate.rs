//! `draw --animate`: moving pictures.

use std::fs;

use crate::draw_loads::{ARM, numbers};
use crate::folder::{EXAM, Folder};

/// The values of an element of SMIL behind a tag.
fn values(svg: &str, tag: &str, kind: &str) -> Vec<Vec<f64>> {
    let behind = svg.split(tag).nth(1).unwrap_or_else(|| panic!("no {tag}"));
    let behind = behind.split("</g>").next().expect("a group");
    let element = behind.split(&format!("type=\"{kind}\"")).nth(1);
    let element = element.unwrap_or_else(|| panic!("no {kind} in {behind}"));
    let list = element.split("values=\"").nth(1).expect("values");
    let list = list.split('"').next().expect("values");
    list.split(';').map(numbers).collect()
}

/// φ1 = π/6 + sin 2t, 25 times a second; y points downwards.
#[test]
fn an_svg_goes_through_the_motion() {
    let folder = Folder::new("animate_svg", EXAM);
    let ran = folder.run("draw a.mech --animate --to 2").exits_with(0);
    assert_eq!(ran.stdout, "wrote two_body_animated.svg\n");
    let svg = folder.read("two_body_animated.svg");
    let turned = values(&svg, "<g id=\"body-1\"", "rotate");
    assert_eq!(turned.len(), 51);
    for (frame, value) in turned.iter().enumerate() {
        let t = 0.04 * frame as f64;
        let expected = -(std::f64::consts::FRAC_PI_6 + (2.0 * t).sin()).to_degrees();
        assert!(
            (value[0] - expected).abs() < 0.01,
            "{value:?} for {expected} at {t}"
        );
    }
    // The name of P follows P: cos φ and sin φ, minus their values at the start.
    let scale = svg.split("data-scale=\"").nth(1).expect("a scale");
    let scale = numbers(scale.split('"').next().expect("a number"))[0];
    let names = &svg[svg.find("<g id=\"names\">").expect("names")..];
    let at = |t: f64| (std::f64::consts::FRAC_PI_6 + (2.0 * t).sin()).sin_cos();
    let name = names.split("</g>").find(|it| it.contains(">P</text>"));
    let name = name.expect("P");
    let name = &name[name.rfind("<g").expect("a group")..];
    let moved = values(&format!("{name}</g>"), "<g", "translate");
    for (frame, value) in moved.iter().enumerate() {
        let ((y, x), (y0, x0)) = (at(0.04 * frame as f64), at(0.0));
        let off = [value[0] - scale * (x - x0), value[1] + scale * (y - y0)];
        assert!(off[0].hypot(off[1]) < 0.03, "{value:?} is {off:?} off");
    }
    assert!(svg.matches("dur=\"2s\"").count() > 3, "{svg}");
    assert_eq!(
        svg.matches("dur=").count(),
        svg.matches("dur=\"2s\" repeatCount=\"indefinite\"").count()
    );
    assert!(!svg.contains("<script"));
    // The picture has our mark, and is equal on the second run.
    folder.run("draw a.mech --animate --to 2").exits_with(0);
    assert_eq!(folder.read("two_body_animated.svg"), svg);
}

/// The still picture and the moving one have different names, so that neither replaces the other.
#[test]
fn a_moving_picture_leaves_the_still_one() {
    let folder = Folder::new("animate_beside", EXAM);
    folder.run("draw a.mech").exits_with(0);
    let still = folder.read("two_body.svg");
    folder.run("draw a.mech --animate --to 0.2").exits_with(0);
    assert_eq!(folder.read("two_body.svg"), still);
    assert!(folder.read("two_body_animated.svg").contains("<animate"));
}

/// The inner end of a spring about a pin turns with the first body, and the outer end with the second one, whichever of
/// them moves.
#[test]
fn a_torsion_spring_is_wound_between_its_bodies() {
    let text = "mechanism wound {
    point O = (0, 0);
    body arm at O { O, P: (60cm, 0) }
    revolute O(ground, arm);
    drive phi(arm) = 50deg*sin(2*pi*t);
    mass arm = 5kg at P;
    spring about (BODIES) = 3Nm;
    effort;
}
";
    for (bodies, turns) in [("ground, arm", [0.0, 1.0]), ("arm, ground", [1.0, 0.0])] {
        let folder = Folder::new("animate_wound", text.replace("BODIES", bodies));
        folder
            .run("draw a.mech --animate --to 1 --out a.svg")
            .exits_with(0);
        // A still picture shows the spiral in its pose: at a quarter of the period the arm has turned by 50 degrees.
        folder
            .run("draw a.mech --at 0.25 --out still.svg")
            .exits_with(0);
        let still = folder.read("still.svg");
        let still = &still[still.find(" data-wound=\"").expect("a spiral")..];
        let line = still
            .split(" d=\"")
            .nth(1)
            .and_then(|it| it.split('"').next());
        let line = numbers(line.expect("a path"));
        let [x, y] = [line[line.len() - 2], line[line.len() - 1]];
        let wound = std::f64::consts::PI + (turns[1] - turns[0]) * 50.0_f64.to_radians();
        assert!(
            (-y.atan2(x) - wound).sin().abs() < 5e-3,
            "{bodies}: {x} {y}"
        );
        let svg = folder.read("a.svg");
        let group = &svg[svg.find(" data-wound=\"").expect("a spiral")..];
        let shapes = group.split("attributeName=\"d\" values=\"").nth(1);
        let shapes = shapes.and_then(|it| it.split('"').next()).expect("shapes");
        let shapes: Vec<Vec<f64>> = shapes.split(';').map(numbers).collect();
        assert_eq!(shapes.len(), 26);
        let frame = match turns[0] == 0.0 {
            true => vec![vec![0.0]; shapes.len()],
            false => values(group, " data-wound=\"", "rotate"),
        };
        for (number, (shape, frame)) in shapes.iter().zip(&frame).enumerate() {
            let t = 0.04 * number as f64;
            let angle = 50.0_f64.to_radians() * (2.0 * std::f64::consts::PI * t).sin();
            let ends = [&shape[..2], &shape[shape.len() - 2..]];
            // Three half turns lie between the ends at rest.
            for ((end, turns), at_rest) in
                ends.into_iter().zip(turns).zip([0.0, std::f64::consts::PI])
            {
                let relative = -end[1].atan2(end[0]) - frame[0].to_radians();
                let off = (relative - at_rest - turns * angle).sin().abs();
                assert!(off < 5e-3, "{bodies} at {t}: {off}");
                assert!((relative - at_rest - turns * angle).cos() > 0.0);
            }
        }
    }
}

/// A long motion has 250 pictures at most, and keeps its pace.
#[test]
fn a_long_motion_has_fewer_pictures() {
    let folder = Folder::new("animate_long", EXAM);
    folder
        .run("draw a.mech --animate --to 30 --out a.svg")
        .exits_with(0);
    let svg = folder.read("a.svg");
    let turned = values(&svg, "<g id=\"body-1\"", "rotate");
    assert!((200..=251).contains(&turned.len()), "{}", turned.len());
    let duration = svg.split("dur=\"").nth(1).expect("a duration");
    let duration = numbers(duration.split('s').next().expect("a number"))[0];
    assert!(duration > 29.5 && duration <= 30.0, "{duration}");
}

#[test]
fn forces_and_springs_go_along() {
    let folder = Folder::new("animate_loads", ARM);
    folder
        .run("draw a.mech --animate --to 1 --out a.svg")
        .exits_with(0);
    let svg = folder.read("a.svg");
    let group = &svg[svg.find(" data-force=\"").expect("a force")..];
    let turned = values(group, " data-force=\"", "rotate");
    for (frame, value) in turned.iter().enumerate() {
        let t = 0.04 * frame as f64;
        let expected = (40.0_f64).atan2(30.0 * (2.0 * std::f64::consts::PI * t).cos());
        let off = (value[0].to_radians() - expected).sin().abs();
        assert!(off < 1e-3, "{value:?} for {expected}");
    }
    assert!(svg.contains(" data-length=\""));
}

#[test]
fn refuses_what_cannot_be_animated() {
    let folder = Folder::new("animate_refused", EXAM);
    for (options, words) in [
        ("--out a.png", "animations cannot be written as `.png`"),
        ("--out a.pdf", "`.svg` or `.gif`"),
        ("--png", "cannot be used with"),
        ("--at 1", "cannot be used with"),
        ("--paths Z", "no point `Z`"),
    ] {
        let ran = folder
            .run(&format!("draw a.mech --animate {options}"))
            .exits_with(2);
        assert!(ran.stderr.contains(words), "{options}: {}", ran.stderr);
    }
    assert_eq!(folder.list("."), ["a.mech"]);
    fs::write(folder.file("two_body_animated.svg"), "something else\n").expect("a file");
    folder.run("draw a.mech --animate").exits_with(2);
}

#[cfg(feature = "png")]
#[test]
fn a_gif_is_written_and_only_ours_are_replaced() {
    let folder = Folder::new("animate_gif", EXAM);
    let draw = "draw a.mech --animate --to 0.12 --out a.gif --size 200x160";
    folder.run(draw).exits_with(0);
    let bytes = fs::read(folder.file("a.gif")).expect("a picture");
    assert!(
        bytes.starts_with(b"GIF89a\xc8\x00\xa0\x00"),
        "{:?}",
        &bytes[..10]
    );
    // Endless, in the notation of browsers.
    let loops = b"NETSCAPE2.0\x03\x01\x00\x00\x00";
    assert!(bytes.windows(loops.len()).any(|it| it == loops));
    folder.run(draw).exits_with(0);
    assert_eq!(fs::read(folder.file("a.gif")).expect("a picture"), bytes);
    fs::write(folder.file("a.gif"), &bytes[..700]).expect("a file");
    folder.run(draw).exits_with(2);
}
