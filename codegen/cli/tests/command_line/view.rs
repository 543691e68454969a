//! `view`: contents of the page, and that the page is a single file without references.

use std::fs;
use std::path::{Path, PathBuf};

use super::draw_loads::numbers;
use super::folder::{EXAM, Folder, driven_by};
use super::printed::json;

/// Descriptions of the gallery.
fn gallery() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mechanisms");
    let entries = fs::read_dir(folder).expect("a folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|it| it.expect("it can be read").path())
        .filter(|path| path.extension().is_some_and(|it| it == "mech"))
        .collect();
    paths.sort();
    assert!(paths.len() > 15);
    paths
}

/// Elements without an end.
const VOID: [&str; 5] = ["meta", "link", "input", "br", "img"];

/// Elements whose text holds no tags.
const RAW: [&str; 2] = ["script", "style"];

/// Names of the elements. Requires that every element that begins ends, in the right order, and that every attribute is
/// in quotes.
#[track_caller]
fn elements(html: &str) -> Vec<String> {
    let mut rest = html
        .strip_prefix("<!DOCTYPE html>")
        .expect("it is declared what it is");
    let (mut open, mut all): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    while let Some(at) = rest.find('<') {
        assert!(!rest[..at].contains('>'), "a bare > in {}", &rest[..at]);
        rest = &rest[at + 1..];
        let end = rest.find('>').expect("a tag ends");
        let tag = &rest[..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            let last = open.pop();
            assert_eq!(last.as_deref(), Some(name), "</{name}> after {open:?}");
            continue;
        }
        let is_closed = tag.ends_with('/');
        let tag = tag.trim_end_matches('/');
        let name = tag.split_whitespace().next().expect("a name");
        assert!(
            name.chars().all(|it| it.is_ascii_alphanumeric()),
            "no element is called {name}"
        );
        assert!(tag.matches('"').count().is_multiple_of(2), "<{tag}>");
        all.push(name.to_string());
        if RAW.contains(&name) {
            let close = format!("</{name}>");
            let end = rest.find(&close).expect("it ends");
            rest = &rest[end + close.len()..];
        } else if !is_closed && !VOID.contains(&name) {
            open.push(name.to_string());
        }
    }
    assert!(open.is_empty(), "{open:?} do not end");
    all
}

/// Data that the page plays.
fn played(html: &str) -> serde_json::Value {
    let start = "<script type=\"application/json\" id=\"data\">";
    let from = html.find(start).expect("data") + start.len();
    let length = html[from..].find("</script>").expect("it ends");
    json(&html[from..from + length])
}

/// Equations and the rest of the page, without data and scripts.
fn article(html: &str) -> &str {
    let from = html.find("id=\"equations\"").expect("equations");
    let length = html[from..].find("</article>").expect("they end");
    &html[from..from + length]
}

/// Visible text of a part of the page.
fn words(html: &str) -> String {
    let mut text = String::new();
    let mut is_tag = false;
    for letter in html.chars() {
        match letter {
            '<' => is_tag = true,
            '>' => is_tag = false,
            letter if !is_tag => text.push(letter),
            _ => {}
        }
    }
    text
}

#[test]
fn pages_of_the_gallery_are_whole_files_that_need_nothing_else() {
    let folder = Folder::new("view_gallery", "");
    for path in gallery() {
        let mut arguments = vec!["view".to_string(), path.display().to_string()];
        let motion = match path.file_stem().and_then(|it| it.to_str()) {
            Some("excavator_motions") => Some("forward"),
            Some("ankle" | "differential_wrist") => Some("to_joint"),
            _ => None,
        };
        if let Some(motion) = motion {
            arguments.extend(["--motion".to_string(), motion.to_string()]);
        }
        let run = |out: &str| {
            let mut command = folder.command();
            command.args(&arguments);
            command.args(["--force", "--to", "0.5", "--out", out]);
            let ran = command.output().expect("the command starts");
            assert_eq!(
                ran.status.code(),
                Some(0),
                "{}: {}",
                path.display(),
                String::from_utf8_lossy(&ran.stderr)
            );
        };
        run("a.html");
        run("b.html");
        let html = folder.read("a.html");
        assert_eq!(html, folder.read("b.html"), "{} differs", path.display());
        let elements = elements(&html);
        for wanted in ["svg", "math", "article", "table"] {
            assert!(elements.iter().any(|it| it == wanted), "no {wanted}");
        }
        // A namespace is a name and loads nothing.
        let loads = html.replace("http://www.w3.org/2000/svg", "");
        for address in ["http:", "https:", "//www.", " src=", "@import", "url("] {
            assert!(!loads.contains(address), "{address} in {}", path.display());
        }
        assert!(html.contains("default-src 'none'"));
        let page = played(&html);
        assert!(!page["assemblies"][0]["times"][1].is_null(), "{page}");
        // Formulas are typeset.
        let text = words(article(&html));
        for wrong in ["sqrt(", "\\frac", "\\varphi", "NaN", "$"] {
            assert!(!text.contains(wrong), "{wrong} in {}", path.display());
        }
    }
}

#[test]
fn the_page_of_the_excavator_is_small() {
    let folder = Folder::new("view_size", "");
    let excavator = gallery()
        .into_iter()
        .find(|it| it.ends_with("excavator.mech"))
        .expect("the excavator");
    folder
        .run(&format!("view {} --out a.html", excavator.display()))
        .exits_with(0);
    let html = folder.read("a.html");
    assert!(html.len() < 1_500_000, "{} bytes", html.len());
    let page = played(&html);
    let assemblies = page["assemblies"].as_array().expect("a list");
    assert_eq!(assemblies.len(), 16);
    assert_eq!(assemblies[0]["times"].as_array().map(Vec::len), Some(501));
    // Each has a motion, or the reason for none, or for its end.
    for own in assemblies {
        let times = own["times"].as_array().map_or(0, Vec::len);
        assert!(times > 20 || own["error"].is_string(), "{own}");
    }
}

/// The page answers the exam: constraints in words, degrees of freedom, q and q̇ at 0, the point Q, the first step, the determinant.
#[test]
fn the_page_of_the_exam_answers_it() {
    let folder = Folder::new("view_exam", EXAM);
    let ran = folder.run("view a.mech").exits_with(0);
    assert_eq!(ran.stdout, "wrote two_body.html\n");
    let html = folder.read("two_body.html");
    let text = words(html.split("<script").next().expect("a page"));
    for wanted in [
        "The x of the origin of body 1 is always 0.",
        "P of body 1 and P of body 2 always coincide.",
        "The x of the origin of body 2 is always 3.",
        "KDOF = 6 coordinates − 5 equations of joints = 1. As many independent driver equations",
        "NDOF = 1 − 1 driver equation = 0",
        // q and q̇.
        "φ10.52359930°20",
        "y221.1547",
        "φ21.047260°−0.666667",
        // Q with its velocity.
        "Q(1.29904, 1.25)(−0.5, 1.44338)",
        "Newton-Raphson starts at the pose q0 of t = 0 s and seeks that of t = 0.01 s",
        "The determinant of this matrix is 1.5. It is not zero",
        "the line from P to the origin of body 2 is parallel to the x axis",
        "From t = 0 s to 5 s it is not zero",
    ] {
        assert!(text.contains(wanted), "no {wanted:?} in {text}");
    }
    // The matrix of the first step, row by row, and sin 0.02 on the right.
    let from = html.find("id=\"first-step\"").expect("the step");
    let step = &html[from..html[from..].find("</math>").expect("it ends") + from];
    let rows: Vec<String> = step
        .split("</mtr>")
        .map(|row| words(&format!("<{row}")))
        .collect();
    for (row, wanted) in [
        "100000",
        "010000",
        "10−0.5−10−1.5",
        "010.8660250−10.866025",
        "000100",
        "001000",
    ]
    .iter()
    .enumerate()
    {
        assert!(rows[row].ends_with(wanted), "{wanted} in {:?}", rows[row]);
    }
    assert!(
        rows.iter().any(|row| row.ends_with("0.0199987")),
        "{rows:?}"
    );
}

#[test]
fn texts_of_a_description_are_escaped_everywhere() {
    let hostile = "</script><img src=x onerror=alert(1)> \"quoted' &amp; <!--";
    let text = EXAM
        .replace("//! ME 451", &format!("//! {hostile}\n//! ME 451"))
        .replace("    body 1", &format!("    /// {hostile}\n    body 1"))
        .replace("    revolute", &format!("    /// {hostile}\n    revolute"))
        .replace(
            "    drive",
            &format!("    /// {hostile}\n    param rate = 2;\n    drive"),
        )
        .replace("sin(2*t)", "sin(rate*t)");
    let folder = Folder::new("view_hostile", text);
    folder.run("view a.mech --set rate=3").exits_with(0);
    let html = folder.read("two_body.html");
    let all = elements(&html);
    assert!(!all.iter().any(|it| it == "img"));
    assert_eq!(all.iter().filter(|it| *it == "script").count(), 2);
    let escaped =
        "&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt; &quot;quoted&#39; &amp;amp; &lt;!--";
    assert_eq!(
        html.matches(escaped).count(),
        4,
        "of the file, a body, a joint and a parameter"
    );
    assert!(
        html.contains("<td>parameter</td><td><b>rate</b></td><td>3</td>"),
        "{html}"
    );
}

#[test]
fn a_motion_that_ends_is_an_outcome_that_the_page_says() {
    let folder = Folder::new("view_ends", driven_by("t"));
    let ran = folder.run("view a.mech").exits_with(1);
    assert!(ran.stderr.contains("error: `two_body`"), "{}", ran.stderr);
    let html = folder.read("two_body.html");
    elements(&html);
    assert!(html.contains("<p class=\"error\"><b>Error:</b>"), "{html}");
    assert!(played(&html)["assemblies"][0]["error"].is_string());
    // A mechanism that cannot be assembled is drawn as described.
    let folder = Folder::new(
        "view_apart",
        EXAM.replace("absolute_x(2) = sqrt(3)", "absolute_x(2) = 5"),
    );
    let ran = folder.run("view a.mech").exits_with(1);
    assert!(ran.stderr.contains("error: `two_body`"), "{}", ran.stderr);
    let html = folder.read("two_body.html");
    elements(&html);
    assert!(html.contains("id=\"body-2\""));
    assert!(played(&html)["assemblies"][0]["times"].is_null());
}

#[test]
fn only_pages_of_ours_are_replaced_and_options_are_checked() {
    let folder = Folder::new("view_replaced", EXAM);
    fs::write(
        folder.file("two_body.html"),
        "<!DOCTYPE html>\n<p>mine</p>\n",
    )
    .expect("a file");
    let ran = folder.run("view a.mech").exits_with(2);
    assert!(ran.stderr.contains("it is not a page"), "{}", ran.stderr);
    folder.run("view a.mech --force").exits_with(0);
    folder.run("view a.mech").exits_with(0);
    let printed = folder.run("view a.mech --out -").exits_with(0).stdout;
    // On stdout, the page has no path to its source.
    let named = "<meta name=\"linkwright-source\" content=\"a.mech\">\n";
    assert!(!printed.contains(named));
    assert_eq!(printed, folder.read("two_body.html").replacen(named, "", 1));
    let other = folder
        .run("view a.mech --branch phi2=other --from 0.2 --to 1 --out -")
        .exits_with(0)
        .stdout;
    let page = played(&other);
    assert_eq!(page["assemblies"][0]["label"], "−");
    assert_eq!(page["assemblies"][0]["times"][0], 0.2);
    for (wrong, words) in [
        ("--branch phi2=up", "no assembly mode"),
        ("--set length=2", "length"),
        (
            "--to -1",
            "error: the end, t = -1 s, lies before the start, t = 0 s\n",
        ),
        ("--watch --out a.html", "cannot be used with"),
        ("--port 80", "--watch"),
    ] {
        let ran = folder.run(&format!("view a.mech {wrong}")).exits_with(2);
        assert!(ran.stderr.contains(words), "{wrong}: {}", ran.stderr);
    }
    assert_eq!(folder.list("."), ["a.mech", "two_body.html"]);
}

/// In the assembly "−" the end of the rod is below the crank: y = sin φ − √(3 − (√3 − cos φ)²), and φ = 30° ± 1 rad.
#[test]
fn a_guide_goes_with_the_assembly() {
    let folder = Folder::new("view_guide", EXAM);
    folder.run("view a.mech").exits_with(0);
    let html = folder.read("two_body.html");
    let scale = html.split("data-scale=\"").nth(1).expect("a scale");
    let scale = numbers(scale.split('"').next().expect("a number"))[0];
    let reach = |sign: f64| {
        let angles = (0..=1000).map(|it| std::f64::consts::PI / 6.0 - 1.0 + 0.002 * f64::from(it));
        let heights = angles.map(|angle: f64| {
            let beside = 3.0_f64.sqrt() - angle.cos();
            angle.sin() + sign * (3.0 - beside * beside).sqrt()
        });
        heights.fold((f64::MAX, f64::MIN), |(low, high), it| {
            (low.min(it), high.max(it))
        })
    };
    let guide = |element: &str| {
        let path = element.split("class=\"edge\" d=\"").nth(1).expect("a line");
        let line = numbers(path.split('"').next().expect("a path"));
        let heights = [-line[1] / scale, -line[3] / scale];
        let x = line[0] / scale;
        assert!((x - 3.0_f64.sqrt()).abs() < 0.1, "at {x}");
        (heights[0].min(heights[1]), heights[0].max(heights[1]))
    };
    let id = "joint-absolute_x_2-below";
    let page = played(&html);
    let others = page["assemblies"].as_array().expect("a list");
    let other = others
        .iter()
        .position(|it| it["label"] == "−")
        .expect("the other");
    let replaced = others[other]["elements"][id].as_str();
    let replaced = replaced.unwrap_or_else(|| panic!("no {id} in {}", others[other]["elements"]));
    let start = html
        .find(&format!("<g id=\"{id}\""))
        .expect("the guide of the drawing");
    for (element, sign) in [(&html[start..], 1.0), (replaced, -1.0)] {
        let ((low, high), (least, most)) = (guide(element), reach(sign));
        // The guide has the length that the slider needs, and a little more.
        assert!(low < least && least - low < 0.4, "{low} for {least}");
        assert!(high > most && high - most < 0.4, "{high} for {most}");
    }
}

/// A crank of 0.1 m, a coupler and a rocker of 0.3 m between pins 0.9 m apart.
const OPEN: &str = "\
mechanism open_bar {
    param length = 0.3;
    point A = (0, 0), D = (0.9, 0);
    body crank at A { A, B: (0.1, 0) }
    body coupler at (0.1, 0) { B: (0, 0), C: (length, 0) }
    body rocker at D { D, C: (-0.3, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = angle0 + t;
}
";

/// Two links of constant length beside an arm that turns.
const FIXED: &str = "\
mechanism fixed {
    point A = (0, 0), D = (0.9, 0);
    body one at A { A, B: (0.3, 0) }
    body two at D { D, B: (-0.4, 0) }
    body arm at (0, 1);
    revolute A(ground, one);
    revolute D(ground, two);
    revolute (one.B, two.B);
    absolute_x(arm) = 0;
    absolute_y(arm) = 1;
    drive phi(arm) = 2*t;
}
";

#[test]
fn a_loop_that_cannot_close_is_shown_with_its_gap() {
    for (angle, name) in [(0.0_f64, "view_open_0"), (1.2, "view_open_1")] {
        let folder = Folder::new(name, OPEN.replace("angle0", &angle.to_string()));
        folder.run("view a.mech").exits_with(1);
        let html = folder.read("open_bar.html");
        elements(&html);
        // From the end of the crank to D, minus both links.
        let apart = (0.9 - 0.1 * angle.cos()).hypot(0.1 * angle.sin());
        let gap = html.split("id=\"gap\"").nth(1).expect("a gap");
        let (title, rest) = gap.split_once("</title>").expect("a title");
        assert!(
            title.ends_with("the loop does not close at revolute C(coupler, rocker)"),
            "{title}"
        );
        let path = rest.split("class=\"gap\" d=\"").nth(1).expect("a line");
        let [x0, y0, x1, y1] = numbers(path.split('"').next().expect("a path"))[..] else {
            panic!("a line in {path}")
        };
        let scale = html.split("data-scale=\"").nth(1).expect("a scale");
        let scale = numbers(scale.split('"').next().expect("a number"))[0];
        let drawn = (x1 - x0).hypot(y1 - y0) / scale;
        assert!(
            (drawn - (apart - 0.6)).abs() < 1e-3,
            "{drawn} for {}",
            apart - 0.6
        );
        let label = html.split("class=\"gap-name\"").nth(1).expect("a label");
        let label = label.split(['>', '<']).nth(1).expect("its text");
        let told: f64 = label
            .strip_suffix(" m")
            .expect("a length")
            .parse()
            .expect("a number");
        assert!(
            (told - (apart - 0.6)).abs() < 1e-6,
            "{label} for {}",
            apart - 0.6
        );
    }
    // A tie of 0.2 m without a body from the end of the crank to a rocker of 0.3 m.
    let tied = OPEN
        .replace(
            "    body coupler at (0.1, 0) { B: (0, 0), C: (length, 0) }\n",
            "",
        )
        .replace("    revolute B(crank, coupler);\n", "")
        .replace(
            "revolute C(coupler, rocker)",
            "revolute_revolute (crank.B, rocker.C) = length",
        )
        .replace("length = 0.3", "length = 0.2")
        .replace("angle0", "0");
    let folder = Folder::new("view_open_tie", tied);
    folder.run("view a.mech").exits_with(1);
    let html = folder.read("open_bar.html");
    let label = html.split("class=\"gap-name\"").nth(1).expect("a label");
    let label = label.split(['>', '<']).nth(1).expect("its text");
    assert_eq!(label, "0.3 m");
    // Fixed lengths: 0.9 m between pins, and 0.3 m + 0.4 m of links.
    let folder = Folder::new("view_open_fixed", FIXED);
    folder.run("view a.mech").exits_with(1);
    let html = folder.read("fixed.html");
    let label = html.split("class=\"gap-name\"").nth(1).expect("a label");
    let label = label.split(['>', '<']).nth(1).expect("its text");
    assert_eq!(label, "0.2 m");
    // A mechanism that closes has none.
    let folder = Folder::new("view_closed", EXAM);
    folder.run("view a.mech").exits_with(0);
    assert!(!folder.read("two_body.html").contains("id=\"gap\""));
}
