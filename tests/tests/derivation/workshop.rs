//! Drawings for workshops: the structure of a DXF, and dimensions that are the lengths of the description.

use std::collections::{BTreeMap, BTreeSet};

use linkwright_codegen::stages::emit::drawing::{self, Options, Pose, Undrawable};
use linkwright_codegen::stages::system::Derived;
use linkwright_tests::{description, files};

/// Largest effect of rounding to the digits of a file (mm).
const ROUNDING: f64 = 1e-6;

/// Object of a DXF: its pairs of group code and value, the kind first.
type Object = Vec<(i32, String)>;

/// Design configuration of a description as a DXF.
fn dxf_of(derived: &Derived) -> Result<String, Undrawable> {
    let (pool, system) = (&derived.pool, &derived.system);
    drawing::dxf(
        pool,
        system,
        &Pose::drawn(pool, system),
        &[],
        &[],
        &Options::default(),
    )
}

/// Objects of a file, after a check that group codes and values alternate.
fn objects(text: &str) -> Vec<Object> {
    assert!(text.is_ascii());
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len().is_multiple_of(2), "{} lines", lines.len());
    let mut objects: Vec<Object> = Vec::new();
    for pair in lines.chunks(2) {
        let code: i32 = pair[0]
            .trim()
            .parse()
            .unwrap_or_else(|_| panic!("code {}", pair[0]));
        if code == 0 {
            objects.push(Vec::new());
        }
        match objects.last_mut() {
            Some(object) => object.push((code, pair[1].to_string())),
            None => assert_eq!(code, 999, "{pair:?} before the first section"),
        }
    }
    assert_eq!(objects.last(), Some(&vec![(0, "EOF".to_string())]));
    objects
}

fn value(object: &Object, code: i32) -> &str {
    let pair = object.iter().find(|it| it.0 == code);
    pair.map_or_else(|| panic!("no {code} in {object:?}"), |it| it.1.as_str())
}

fn number(object: &Object, code: i32) -> f64 {
    value(object, code).parse().expect("a number")
}

fn kind(object: &Object) -> &str {
    &object[0].1
}

fn of_kind<'a>(objects: &'a [Object], wanted: &'a str) -> impl Iterator<Item = &'a Object> {
    objects.iter().filter(move |it| kind(it) == wanted)
}

/// Variables of the header with the first value of each.
fn variables(objects: &[Object]) -> BTreeMap<String, String> {
    let header = objects
        .iter()
        .find(|it| it.get(1).is_some_and(|it| it.1 == "HEADER"));
    let pairs = &header.expect("a header")[2..];
    let named = pairs.windows(2).filter(|it| it[0].0 == 9);
    named.map(|it| (it[0].1.clone(), it[1].1.clone())).collect()
}

/// Texts in the blocks of dimensions, with the value that each dimension measures.
fn dimensions(objects: &[Object]) -> Vec<(String, f64)> {
    let mut texts = BTreeMap::new();
    let mut block = String::new();
    for object in objects {
        match kind(object) {
            "BLOCK" => block = value(object, 2).to_string(),
            "TEXT" if block.starts_with("*D") => {
                texts.insert(block.clone(), value(object, 1).to_string());
            }
            "ENDBLK" => block.clear(),
            _ => {}
        }
    }
    let dimensions = of_kind(objects, "DIMENSION");
    dimensions
        .map(|it| (texts[value(it, 2)].clone(), number(it, 42)))
        .collect()
}

/// Motions of the gallery, by their titles.
fn gallery() -> Vec<(String, Derived)> {
    let paths = files::with_extension(&files::repository().join("mechanisms"), "mech");
    let motions = paths
        .iter()
        .flat_map(|path| description::motions(files::stem(path)));
    let motions: Vec<_> = motions
        .map(|it| (it.system.mechanism.title(), it))
        .collect();
    assert!(motions.len() > 20, "{} motions", motions.len());
    motions
}

#[test]
fn a_file_is_consistent() {
    for (title, derived) in gallery() {
        let objects = objects(&dxf_of(&derived).expect("it can be drawn"));
        let variables = variables(&objects);
        for (name, expected) in [
            ("$ACADVER", "AC1015"),
            ("$INSUNITS", "4"),
            ("$MEASUREMENT", "1"),
        ] {
            assert_eq!(variables[name], expected, "{title}: {name}");
        }
        let mut handles = BTreeSet::new();
        for object in &objects {
            let code = if kind(object) == "DIMSTYLE" { 105 } else { 5 };
            let Some((_, handle)) = object.iter().skip(1).find(|it| it.0 == code) else {
                continue;
            };
            if kind(object) == "SECTION" {
                continue;
            }
            let handle = u64::from_str_radix(handle, 16).expect("a handle");
            assert!(handles.insert(handle), "{title}: {handle:X} twice");
        }
        let seed = u64::from_str_radix(&variables["$HANDSEED"], 16).expect("a handle");
        assert!(handles.last().is_some_and(|it| *it < seed), "{title}");
        let named = |kind: &str| -> BTreeSet<&str> {
            let rows = objects.iter().filter(|it| self::kind(it) == kind);
            rows.map(|it| value(it, 2)).collect()
        };
        let layers = named("LAYER");
        let line_types = named("LTYPE");
        assert!(line_types.contains("CENTER"), "{title}");
        let entities = objects
            .iter()
            .filter(|it| it.iter().any(|pair| pair.1 == "AcDbEntity"));
        for entity in entities {
            assert!(layers.contains(value(entity, 8)), "{title}: {entity:?}");
            if let Some((_, line_type)) = entity.iter().find(|it| it.0 == 6) {
                assert!(line_types.contains(line_type.as_str()), "{title}");
            }
        }
        let blocks = named("BLOCK");
        assert_eq!(blocks, named("BLOCK_RECORD"), "{title}");
        for dimension in of_kind(&objects, "DIMENSION") {
            assert!(blocks.contains(value(dimension, 2)), "{title}");
            let [a, b] =
                [13, 14].map(|code| [number(dimension, code), number(dimension, code + 10)]);
            let measured = (a[0] - b[0]).hypot(a[1] - b[1]);
            let off = (measured - number(dimension, 42)).abs();
            assert!(off < ROUNDING * measured.max(1.0), "{title}: {dimension:?}");
        }
    }
}

/// Crank 40, coupler 120 with P at (60, 40), rocker 80, ground 100 mm.
#[test]
fn dimensions_are_the_lengths_of_the_links() {
    let drawn = objects(&dxf_of(&description::system("four_bar")).expect("it can be drawn"));
    let mut texts = dimensions(&drawn);
    texts.sort_by(|a, b| a.1.total_cmp(&b.1));
    let to_p = 60.0_f64.hypot(40.0);
    let expected = [
        ("40", 40.0),
        ("72.11", to_p),
        ("72.11", to_p),
        ("80", 80.0),
        ("100", 100.0),
        ("120", 120.0),
    ];
    assert_eq!(texts.len(), expected.len(), "{texts:?}");
    for ((text, measured), (name, length)) in texts.iter().zip(expected) {
        assert_eq!(text, name);
        // The distances are those of the pose, which has the lengths up to rounding.
        assert!((measured - length).abs() < 1e-9, "{text}: {measured}");
    }
}

/// Pitch circles of the planetary gear: 20 mm and 15 mm in radius inside of 50 mm, on an arm of 35 mm.
#[test]
fn gears_have_the_diameters_of_their_pitch_circles() {
    let drawn = objects(&dxf_of(&description::system("planetary_gear")).expect("it can be drawn"));
    let mut texts: Vec<String> = dimensions(&drawn).into_iter().map(|it| it.0).collect();
    texts.sort();
    assert_eq!(texts, ["%%c100", "%%c30", "%%c40", "35"]);
    // Programs that write the text again put the sign before the measured value.
    let overrides = of_kind(&drawn, "DIMENSION").filter(|it| value(it, 1) == "%%c<>");
    assert_eq!(overrides.count(), 3);
}

/// The cam is a disc of 30 mm, so every vertex has this distance from its center and chords lie within the stated deviation.
#[test]
fn a_curve_lies_within_the_stated_deviation_of_its_polyline() {
    let text = dxf_of(&description::system("disc_cam")).expect("it can be drawn");
    let words = text.lines().find(|it| it.starts_with("Curves lie within"));
    let words: Vec<&str> = words.expect("a statement").split(' ').collect();
    let stated: f64 = words[3].parse().expect("a number");
    let drawn = objects(&text);
    let vertices = |polyline: &Object| -> Vec<[f64; 2]> {
        let values = |code: i32| {
            let pairs = polyline.iter().filter(move |it| it.0 == code);
            pairs.map(|it| it.1.parse::<f64>().expect("a number"))
        };
        values(10).zip(values(20)).map(|(x, y)| [x, y]).collect()
    };
    let longest = of_kind(&drawn, "LWPOLYLINE")
        .map(vertices)
        .max_by_key(Vec::len);
    let points = longest.expect("a polyline");
    // The center lies 10 mm above the axle, which is the origin.
    let from_center = |[x, y]: [f64; 2]| x.hypot(y - 10.0);
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        assert!((from_center(*a) - 30.0).abs() < ROUNDING);
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let deviation = 30.0 - from_center(middle);
        assert!(
            deviation <= stated + ROUNDING,
            "{deviation} beyond {stated}"
        );
    }
    assert!(stated < 0.01, "{stated}");
}

#[test]
fn coordinates_that_a_dxf_cannot_hold_are_refused() {
    let far = |x: &str| {
        description::written(&format!(
            "mechanism far {{ body b at ({x}, 0) {{ A: (0, 0), B: (1, 0) }} absolute_x(b.A) = {x}; absolute_y(b.A) = 0; \
             drive phi(b) = t; }}"
        ))
    };
    assert!(dxf_of(&far("1000")).is_ok());
    match dxf_of(&far("1e10")) {
        Err(Undrawable::TooFar(part, coordinate)) => {
            assert_eq!(part, "body `b`");
            assert!((coordinate - 1e13).abs() <= 1e4);
        }
        other => panic!("{other:?}"),
    }
    let derived = far("1000");
    let lost = Pose::new(
        &derived.pool,
        derived
            .system
            .coordinates
            .iter()
            .map(|it| (it.position, f64::NAN)),
    );
    let (pool, system) = (&derived.pool, &derived.system);
    let drawn = drawing::dxf(pool, system, &lost, &[], &[], &Options::default());
    assert_eq!(drawn, Err(Undrawable::NotFinite("body `b`".to_string())));
    let drawn = drawing::links_dxf(pool, system, &lost, &Options::default());
    assert!(matches!(drawn, Err(Undrawable::NotFinite(_))), "{drawn:?}");
}

/// Texts of dimensions of a picture.
fn written_dimensions(svg: &str) -> Vec<&str> {
    let (_, group) = svg.split_once("<g id=\"dimensions\">").expect("dimensions");
    let (group, _) = group.split_once("</g>").expect("its end");
    let texts = group.split("</text>").filter_map(|it| it.rsplit_once('>'));
    let mut texts: Vec<&str> = texts
        .map(|it| it.1)
        .filter(|it| !it.trim().is_empty())
        .collect();
    texts.sort_unstable();
    texts
}

#[test]
fn links_lie_alone_with_their_distances() {
    let derived = description::system("four_bar");
    let (pool, system) = (&derived.pool, &derived.system);
    let pose = Pose::drawn(pool, system);
    let options = Options::default();
    let svg = drawing::links(pool, system, &pose, &options).expect("links");
    assert_eq!(
        written_dimensions(&svg),
        ["100", "120", "40", "72.11", "72.11", "80"]
    );
    for name in ["crank", "coupler", "rocker", "ground"] {
        assert!(svg.contains(&format!("id=\"link-{name}\"")), "{name}");
    }
    let dxf = drawing::links_dxf(pool, system, &pose, &options).expect("it can be drawn");
    let drawn = objects(&dxf.expect("links"));
    // The longest distance of each link is horizontal.
    for dimension in of_kind(&drawn, "DIMENSION") {
        let [from, to] = [23, 24].map(|code| number(dimension, code));
        let is_longest = number(dimension, 42) != 0.0
            && (number(dimension, 42) - 60.0_f64.hypot(40.0)).abs() > 1.0;
        assert_eq!((from - to).abs() < ROUNDING, is_longest, "{dimension:?}");
    }
    // Two pins for each link, each with a circle.
    assert_eq!(of_kind(&drawn, "CIRCLE").count(), 8);
}

#[test]
fn dimensions_have_the_unit_of_the_description() {
    let text = |units: &str| {
        description::written(&format!(
            "mechanism arm {{ {units} point O = (0, 0); body b at O {{ O, B: (1inch, 0) }} revolute O(ground, b); \
             drive phi(b) = t; }}"
        ))
    };
    for (units, length, name) in [("", "25.4", "mm"), ("units inch;", "1", "inch")] {
        let derived = text(units);
        let (pool, system) = (&derived.pool, &derived.system);
        let options = Options {
            has_dimensions: true,
            ..Options::default()
        };
        let pose = Pose::drawn(pool, system);
        let svg = drawing::draw(pool, system, &pose, &[], &[], &options);
        assert_eq!(written_dimensions(&svg), [length]);
        assert!(svg.contains(&format!("dimensions in {name}<")), "{svg}");
        // A DXF is in mm nevertheless.
        let drawn = objects(&dxf_of(&derived).expect("it can be drawn"));
        assert_eq!(dimensions(&drawn)[0].0, "25.4");
    }
}

#[test]
fn angles_without_bodies_are_no_links() {
    let motions = description::motions("differential_wrist");
    let Derived { pool, system } = &motions[0];
    let pose = Pose::drawn(pool, system);
    assert_eq!(
        drawing::links(pool, system, &pose, &Options::default()),
        None
    );
    let drawn = drawing::links_dxf(pool, system, &pose, &Options::default());
    assert_eq!(drawn, Ok(None));
}
