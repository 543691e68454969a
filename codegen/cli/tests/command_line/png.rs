//! Pictures in pixels.

use std::fs;

use crate::draw::replaces_its_own;
use crate::draw_loads::ARM;
use crate::folder::{EXAM, Folder};

#[test]
fn only_a_png_of_ours_is_replaced() {
    let folder = Folder::new("png_replaced", EXAM);
    replaces_its_own(&folder, "a.png");
    // A PNG of another program has the same first line.
    let drawn = fs::read(folder.file("a.png")).expect("a picture");
    assert_eq!(drawn.first_chunk::<8>(), Some(b"\x89PNG\r\n\x1a\n"));
    fs::write(folder.file("a.png"), &drawn[..33]).expect("a file");
    folder.run("draw a.mech --out a.png").exits_with(2);
}

/// Width and height stand in the first chunk.
#[test]
fn a_png_has_the_size_that_is_asked_for_and_letters() {
    let folder = Folder::new("draw_png", EXAM);
    let size = |name: &str| {
        let bytes = fs::read(folder.file(name)).expect("a picture");
        let side = |at: usize| u32::from_be_bytes(*bytes[at..].first_chunk().expect("a number"));
        [side(16), side(20)]
    };
    folder.run("draw a.mech --png --size 640x480").exits_with(0);
    assert_eq!(size("two_body.png"), [640, 480]);
    folder.run("draw a.mech --out b.png").exits_with(0);
    assert!(size("b.png")[0] >= 840, "{:?}", size("b.png"));
}

/// An element that vanishes in a pose has no size, and is drawn without an error.
#[test]
fn loads_are_drawn_in_pixels() {
    let text = ARM.replace("(30N*cos(2*pi*t), -40N)", "(30N*t, 0)");
    let folder = Folder::new("png_loads", text);
    folder.run("draw a.mech --out a.png").exits_with(0);
    folder.run("draw a.mech --at 0.5 --out b.png").exits_with(0);
    let [a, b] = ["a.png", "b.png"].map(|it| fs::read(folder.file(it)).expect("a picture"));
    assert_ne!(a, b);
}
