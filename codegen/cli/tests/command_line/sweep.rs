//! `linkwright sweep` from the outside: closed forms, failures, pictures and bad input.

use std::f64::consts::PI;

use crate::folder::{Folder, Ran};

/// A crank that turns by half a turn in a second, a rod and a ram in line.
pub const RAM: &str = "mechanism ram {
    param radius = 50mm;
    param rod = 200mm;
    input tilt = 0;
    input lift = 0;
    point O = (0, 0);
    body crank at O { O, A: (radius, 0) }
    body link at (50mm, 0, 0) { A: (0, 0), B: (rod, 0) }
    body slide at (250mm, 0, 0) { B: (0, 0) }
    revolute O(ground, crank);
    revolute A(crank, link);
    revolute B(link, slide);
    drive y(slide) = lift;
    absolute_angle(slide) = 0;
    drive phi(crank) = pi*t + tilt;
}
";

/// A four-bar whose lengths are parameters.
pub const LIFT: &str = "mechanism lift {
    param G = 100mm;
    param L2 = 40mm;
    param L3 = 120mm;
    param L4 = 80mm;
    point A = (0, 0), D = (G, 0);
    body crank   at (0, 0, 40deg)       { A: (0, 0), B: (L2, 0) }
    body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (L3, 0) }
    body rocker  at (G, 0, 57deg)       { D: (0, 0), C: (L4, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 40deg + 3*t;
}
";

/// Table of a sweep.
pub struct Table {
    pub names: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn of(text: &str) -> Table {
        let mut lines = text.lines();
        let cells = |line: &str| -> Vec<String> {
            // Cells with commas are in quotes.
            let parts = line.split('"').enumerate();
            let parts = parts.map(|(place, part)| match place % 2 {
                0 => part.replace(',', "\n"),
                _ => part.to_string(),
            });
            let parts: String = parts.collect();
            parts.split('\n').map(String::from).collect()
        };
        let names = cells(lines.next().expect("a header"));
        let rows: Vec<Vec<String>> = lines.map(cells).collect();
        assert!(rows.iter().all(|it| it.len() == names.len()), "{text}");
        Table { names, rows }
    }

    pub fn column(&self, name: &str) -> Vec<&str> {
        let place = self.names.iter().position(|it| it == name);
        let place = place.unwrap_or_else(|| panic!("{name}: {:?}", self.names));
        self.rows.iter().map(|row| row[place].as_str()).collect()
    }

    /// Numbers of a column; NaN for empty cells.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        let number = |text: &str| match text {
            "" => f64::NAN,
            text => text.parse().unwrap_or_else(|_| panic!("{text}")),
        };
        self.column(name).into_iter().map(number).collect()
    }
}

pub fn table(folder: &Folder, options: &str) -> Table {
    let ran = folder
        .run(&format!("sweep a.mech {options} --csv -"))
        .exits_with(0);
    Table::of(&ran.stdout)
}

#[test]
fn the_stroke_of_a_ram_is_twice_the_radius() {
    let folder = Folder::new("sweep_stroke", RAM);
    let options = "--vary radius=20mm..60mm:5 --vary rod=100mm..300mm:21 --show x_slide --to 2";
    let table = table(&folder, options);
    assert_eq!(
        table.names,
        [
            "set",
            "radius (mm)",
            "rod (mm)",
            "x_slide_min (m)",
            "x_slide_min_t (s)",
            "x_slide_max (m)",
            "x_slide_max_t (s)",
            "failure",
            "failure_kind",
            "failure_block",
            "failure_t (s)"
        ]
    );
    let [radius, rod] = ["radius (mm)", "rod (mm)"].map(|it| table.numbers(it));
    let [min, max] = ["x_slide_min (m)", "x_slide_max (m)"].map(|it| table.numbers(it));
    let [min_t, max_t] = ["x_slide_min_t (s)", "x_slide_max_t (s)"].map(|it| table.numbers(it));
    assert_eq!(table.rows.len(), 5 * 21);
    for set in 0..table.rows.len() {
        // The last range varies fastest; values in its unit are round.
        assert_eq!(table.column("set")[set], set.to_string());
        assert_eq!(radius[set], 20.0 + 10.0 * (set / 21) as f64);
        assert_eq!(rod[set], 100.0 + 10.0 * (set % 21) as f64);
        let [radius, rod] = [radius[set], rod[set]].map(|it| it * 1e-3);
        assert!((min[set] - (rod - radius)).abs() < 1e-13, "{set}");
        assert!((max[set] - (rod + radius)).abs() < 1e-13, "{set}");
        assert!((max[set] - min[set] - 2.0 * radius).abs() < 1e-13, "{set}");
        assert_eq!((min_t[set], max_t[set] % 2.0), (1.0, 0.0), "{set}");
    }
    assert!(table.column("failure").iter().all(|it| it.is_empty()));
}

/// A crank turns all the way round if its pins can be as near and as far from the rocker's support as it takes them.
#[test]
fn sets_that_do_not_turn_round_fail_where_they_open() {
    let folder = Folder::new("sweep_grashof", LIFT);
    let options = "--vary L3=51mm..191mm:15 --vary L4=23mm..143mm:7 --show phi_rocker --to 2.2";
    let table = table(&folder, options);
    let [coupler, rocker] = ["L3 (mm)", "L4 (mm)"].map(|it| table.numbers(it));
    let (ground, crank) = (100.0_f64, 40.0_f64);
    let mut failed = 0;
    for set in 0..table.rows.len() {
        let (longest, shortest) = (
            coupler[set] + rocker[set],
            (coupler[set] - rocker[set]).abs(),
        );
        let fails = ground + crank > longest || ground - crank < shortest;
        let words = table.column("failure")[set];
        assert_eq!(
            words == "out of reach",
            fails,
            "{} {}",
            coupler[set],
            rocker[set]
        );
        assert_eq!(words.is_empty(), !fails);
        let kind = table.column("failure_kind")[set];
        assert_eq!(kind, if fails { "out_of_reach" } else { "" });
        let block = table.column("failure_block")[set];
        assert_eq!(block, if fails { "loop B-C-D" } else { "" });
        let min = table.numbers("phi_rocker_min (rad)")[set];
        assert_eq!(min.is_nan(), fails, "a failed set has no extremes");
        if !fails {
            continue;
        }
        failed += 1;
        // The crank starts at 40° and turns until the diagonal from B to D is too long or too short.
        let diagonal = |angle: f64| {
            let square = ground * ground + crank * crank - 2.0 * ground * crank * angle.cos();
            square.sqrt()
        };
        let start = 40.0_f64.to_radians();
        let is_open = |length: f64| length > longest || length < shortest;
        let cosine = |length: f64| {
            (ground * ground + crank * crank - length * length) / (2.0 * ground * crank)
        };
        // It first swings away from the support, then towards it.
        let far = cosine(longest).acos();
        let near = 2.0 * PI - cosine(shortest).acos();
        let angle = match is_open(diagonal(start)) {
            true => start,
            false if longest < ground + crank => far,
            false => near,
        };
        let t = table.numbers("failure_t (s)")[set];
        assert!((t - (angle - start) / 3.0).abs() < 1e-7, "{set}: {t}");
    }
    assert!((30..75).contains(&failed), "{failed}");
}

#[test]
fn instants_are_those_of_solve() {
    let folder = Folder::new("sweep_instants", LIFT);
    let options = "--to 0.5 --step 0.1 --show phi(rocker),C_vx,x_coupler_dd";
    let rows = table(
        &folder,
        &format!("--vary L3=110mm..130mm:3 --instants {options}"),
    );
    assert_eq!(rows.rows.len(), 3 * 6);
    for (place, length) in ["110mm", "120mm", "130mm"].into_iter().enumerate() {
        let motion = folder.run(&format!(
            "solve a.mech --set L3={length} --to 0.5 --step 0.1 --csv - --no-files"
        ));
        let motion = Table::of(&motion.exits_with(0).stdout);
        for (own, other) in [
            ("t (s)", "t"),
            ("phi_rocker (rad)", "phi_rocker"),
            ("C_vx (m/s)", "C_vx"),
            ("x_coupler_dd (m/s²)", "x_coupler_dd"),
        ] {
            let cells = &rows.column(own)[6 * place..6 * (place + 1)];
            assert_eq!(cells, motion.column(other), "{own}, {length}");
        }
    }
    // A set that opens has its instants until then, and a row with the reason.
    let rows = table(
        &folder,
        "--vary L3=51mm..52mm:2 --instants --to 1 --step 0.1 --show phi_rocker",
    );
    let first: Vec<&Vec<String>> = rows.rows.iter().filter(|it| it[0] == "0").collect();
    let last = first.last().expect("rows");
    let failure = ["", "", "out of reach", "out_of_reach", "loop B-C-D"];
    assert_eq!(last[2..7], failure);
    let until = last[7].parse::<f64>().expect("a time");
    assert_eq!(first.len(), (until / 0.1).floor() as usize + 2);
}

#[test]
fn threads_do_not_change_a_byte() {
    let folder = Folder::new("sweep_threads", LIFT);
    let options = "--vary L3=50mm..150mm:41 --vary L4=60mm..100mm:9 --to 0.5 --step 0.05";
    for more in ["", " --instants"] {
        let run = |threads: usize| {
            let line = format!("sweep a.mech {options}{more} --csv - --threads {threads}");
            folder.run(&line).exits_with(0).stdout
        };
        let one = run(1);
        assert!(one.contains("out of reach") && one.lines().count() > 41 * 9);
        assert!([2, 3, 5].into_iter().all(|threads| run(threads) == one));
    }
}

#[test]
fn one_or_two_varied_values_are_drawn() {
    let folder = Folder::new("sweep_pictures", LIFT);
    let run = |options: &str| -> Ran {
        let line = format!("sweep a.mech {options} --to 2.2 --step 0.05 --show phi_rocker,C_y");
        folder.run(&line).exits_with(0)
    };
    let ran = run("--vary L3=50mm..150mm:21");
    assert_eq!(
        ran.stdout
            .lines()
            .filter(|it| it.starts_with("wrote "))
            .collect::<Vec<_>>(),
        [
            "wrote lift/sweep.csv",
            "wrote lift/sweep_phi_rocker.svg",
            "wrote lift/sweep_C_y.svg"
        ]
    );
    let curves = folder.read("lift/sweep_phi_rocker.svg");
    assert!(curves.contains("L3 (mm)") && curves.contains("phi_rocker (rad)"));
    // Failed sets are hatched by many lines, which continue from one to the next.
    let lines = |text: &str| text.matches("<polyline").count();
    let solved = run("--vary L3=101mm..130mm:21 --plot whole");
    assert!(
        solved
            .stdout
            .starts_with("lift: 45 frames for each set\n21 of 21 sets solved\n")
    );
    let whole = folder.read("whole/sweep_phi_rocker.svg");
    assert!(
        (50..200).contains(&(lines(&curves) - lines(&whole))),
        "{} {}",
        lines(&curves),
        lines(&whole)
    );
    run("--vary L3=50mm..150mm:11 --vary L4=60mm..100mm:5 --plot maps");
    let map = folder.read("maps/sweep_phi_rocker.svg");
    assert!(map.contains("minimum") && map.contains("maximum") && map.contains("L4 (mm)"));
    run("--vary L3=101mm..130mm:11 --vary L4=78mm..82mm:5 --plot solved");
    let solved = folder.read("solved/sweep_phi_rocker.svg");
    assert!(
        lines(&map) > lines(&solved) + 100,
        "{} {}",
        lines(&map),
        lines(&solved)
    );
    run("--vary L3=100mm..120mm --vary L4=60mm..100mm --samples 20 --plot scattered");
    assert!(
        folder
            .read("scattered/sweep_C_y.svg")
            .matches("<circle")
            .count()
            >= 20
    );
    run("--vary L3=100mm..120mm:2 --vary L4=60mm..100mm:2 --vary G=90mm..100mm:2 --plot three");
    assert!(!folder.file("three").exists());
}

#[test]
fn bad_input_has_a_reason_and_leaves_no_files() {
    let folder = Folder::new("sweep_bad", LIFT);
    for (options, said) in [
        ("", "nothing is varied"),
        ("--vary L33=1..2:3", "did you mean `L3`?"),
        ("--vary L3=1..1:3", "the range `--vary L3=1..1:3` is empty"),
        ("--vary L3=1..2:0", "has no values"),
        ("--vary L3=1..2:1", "has two ends, but one value"),
        ("--vary L3=1..2", "has no number of values"),
        (
            "--vary L3=1..2:many",
            "`many` in `--vary L3=1..2:many` is not a number of values",
        ),
        ("--vary L3", "has no range in the description"),
        ("--vary L3=..2:3", "is not a range"),
        (
            "--vary L3=1deg..2deg:3",
            "expected a length, found an angle",
        ),
        (
            "--vary L3=t..2:3",
            "the parameter `L3` cannot depend on `t`",
        ),
        ("--vary L3=1..2:3 --vary L3=1..2:3", "`L3` is varied twice"),
        ("--vary L3=1..2:3 --set L3=1", "`L3` is both set and varied"),
        (
            "--vary L3=1..2:10000000000 --vary L4=1..2:10000000000",
            "more sets than can be counted",
        ),
        (
            "--vary L3=1..2:3 --samples 10",
            "`--samples` chooses the values",
        ),
        (
            "--vary L3=1..2 --samples 0",
            "`--samples 0` is not a number of samples",
        ),
        ("--vary L3=1..2:3 --seed 3", "--samples"),
        (
            "--rows sets.csv",
            "cannot read `sets.csv`: the file does not exist",
        ),
        ("--rows sets.csv --vary L3=1..2:3", "both choose the sets"),
        ("--vary L3=1..2:3 --show C_vz", "did you mean `C_v"),
        (
            "--vary L3=1..2:3 --to -1",
            "error: the end, t = -1 s, lies before the start, t = 0 s\n",
        ),
        ("--vary L3=1..2:3 --threads 0", "--threads"),
        ("--vary L3=1..2:3 --csv - --resume", "`--csv -` is stdout"),
        ("--vary L3=1..2:3 --csv a.mech", "which is an input"),
    ] {
        let ran = folder.run(&format!("sweep a.mech {options}")).exits_with(2);
        assert!(ran.stderr.contains(said), "{options}: {}", ran.stderr);
        assert!(ran.stdout.is_empty(), "{options}");
    }
    assert_eq!(folder.list("."), ["a.mech"]);
}

/// A rod without a length is singular; the sets beside it are solved.
#[test]
fn a_failed_set_does_not_affect_others() {
    let folder = Folder::new("sweep_singular", RAM);
    let solved = table(&folder, "--vary rod=0..400mm:3 --show x_slide --to 1");
    let names = ["failure", "failure_kind", "failure_block", "failure_t (s)"];
    let failures = names.map(|it| solved.column(it));
    let block = "revolute B(link, slide)";
    let singular = ["its Jacobian is singular", "singular", block, "0.0"];
    assert_eq!(failures.clone().map(|it| it[0]), singular);
    assert!(
        failures.iter().all(|it| it[1..] == ["", ""]),
        "{failures:?}"
    );
    let expected = [0.2 + 0.05, 0.4 + 0.05];
    for (x, expected) in solved.numbers("x_slide_max (m)")[1..].iter().zip(expected) {
        assert!((x - expected).abs() < 1e-15, "{x} {expected}");
    }
}
