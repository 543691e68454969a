//! Equilibria against closed forms: pendulums, a snapping truss, a linkage by its energy, and a column under a load that follows it.

use std::f64::consts::{PI, TAU};

use linkwright_solver::equilibrium::{
    Coverage, CurveEnd, Equilibria, EquilibriumPath, PathEnd, PathEventKind, Stability, Unbalanced,
    Varied,
};
use linkwright_solver::{Interpreted, View as _};
use linkwright_tests::description;

const STARTS: u32 = 60;

fn equilibria(text: &str) -> Equilibria {
    sought(text).unwrap_or_else(|reason| panic!("{reason:?}"))
}

fn sought(text: &str) -> Result<Equilibria, Unbalanced> {
    let derived = description::written(text);
    let view = Interpreted::new(&derived).expect("the equations determine the motion");
    Equilibria::new(&derived, &view, 0.0, STARTS, |_, _| true)
}

/// Follows an equilibrium over the only parameter, which has the first value in the description.
fn followed(text: &str, of: Option<usize>, ends: [f64; 2]) -> EquilibriumPath {
    let derived = description::written(text);
    let view = Interpreted::new(&derived).expect("the equations determine the motion");
    let parameter = &view.system().mechanism.parameters[0];
    let place = Varied::Parameter(0, parameter.symbol);
    let all = Equilibria::new(&derived, &view, 0.0, STARTS, |_, _| true).expect("equilibria");
    let of = of.or(all.nearest).expect("an equilibrium");
    EquilibriumPath::new(&all, of, place, ends, |_| true).expect("a direction")
}

#[track_caller]
fn near(value: f64, expected: f64, relative: f64) {
    let off = (value - expected).abs();
    assert!(
        off <= relative * expected.abs().max(f64::MIN_POSITIVE),
        "{value}, not {expected}"
    );
}

#[track_caller]
fn stabilities(all: &Equilibria) -> Vec<Stability> {
    all.all.iter().map(|it| it.verdict.stability).collect()
}

use Stability::{Indifferent, Stable, Unstable};

/// Zero of a function between two places of different signs.
fn zero(value: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let before = value(low);
    assert!(before * value(high) < 0.0, "a bracket");
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        match value(middle) * before > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

fn pendulum(length: &str) -> String {
    format!(
        "mechanism pendulum {{
            point O = (0, 0);
            body bob at O {{ O, S: (0, -{length}) }}
            revolute O(ground, bob);
            free swing: phi(bob) = 30deg rate 1.5;
            mass bob = 3kg at S inertia 3kg*({length})^2;
            gravity = (0, -9.81);
            measure height = bob.S.y;
        }}"
    )
}

/// A radius of gyration of one length: ω² = m g l / (m l² + m l²).
#[test]
fn a_pendulum_hangs_and_stands_at_any_scale() {
    for (text, length) in [
        ("2mm", 2e-3_f64),
        ("2m", 2.0),
        ("2e3*1m", 2e3),
        ("2e-6m", 2e-6),
    ] {
        let list = equilibria(&pendulum(text));
        assert_eq!(stabilities(&list), [Stable, Unstable], "{text}");
        assert_eq!(list.coverage, Coverage::Curves(vec![[CurveEnd::Closed; 2]]));
        let [hanging, standing] = &list.all[..] else {
            panic!("{list:?}")
        };
        assert!(hanging.free[0].abs() < 1e-14, "{:?}", hanging.free);
        near(standing.free[0], PI, 1e-14);
        let rate = (9.81 / (2.0 * length)).sqrt();
        near(hanging.verdict.motions[0].frequency, rate / TAU, 1e-12);
        near(standing.verdict.motions[0].growth, rate, 1e-12);
        near(hanging.potential, -3.0 * 9.81 * length, 1e-14);
        near(
            standing.reported.as_ref().expect("a measure")[0],
            length,
            1e-14,
        );
        assert_eq!(list.nearest, Some(0));
    }
}

fn inverted(stiffness: &str) -> String {
    format!(
        "mechanism inverted {{
            param k = {stiffness};
            point O = (0, 0);
            body bob at O {{ O, S: (0, 2) }}
            revolute O(ground, bob);
            spring about (ground, bob) = k free 0;
            free swing: phi(bob) = 0.1;
            mass bob = 3kg at S;
            gravity = (0, -9.81);
        }}"
    )
}

/// Moment of the weight.
const WEIGHT: f64 = 3.0 * 9.81 * 2.0;

#[test]
fn a_sprung_pendulum_leans_where_its_moments_balance() {
    let leaning = zero(|phi| 40.0 * phi - WEIGHT * phi.sin(), [0.5, 3.0]);
    let list = equilibria(&inverted("40Nm"));
    assert_eq!(stabilities(&list), [Stable, Unstable, Stable]);
    near(list.all[0].free[0], -leaning, 1e-13);
    near(list.all[2].free[0], leaning, 1e-13);
    let rate = ((40.0 - WEIGHT * leaning.cos()) / 12.0).sqrt();
    near(list.all[2].verdict.motions[0].frequency, rate / TAU, 1e-12);
    near(
        list.all[1].verdict.motions[0].growth,
        ((WEIGHT - 40.0) / 12.0).sqrt(),
        1e-12,
    );
    assert_eq!(list.nearest, Some(2));
    // The pitchfork itself.
    let list = equilibria(&inverted("3*9.81*2*1Nm"));
    assert_eq!(stabilities(&list), [Indifferent]);
    assert!(!list.all[0].is_of_family);
}

#[test]
fn stability_ends_at_the_pitchfork() {
    let path = followed(&inverted("100Nm"), None, [100.0, 10.0]);
    assert_eq!(path.end, PathEnd::Last);
    let [event] = &path.events[..] else {
        panic!("{:?}", path.events)
    };
    assert_eq!(event.kind, PathEventKind::ChangeOfStability);
    assert_eq!(event.stability, [Stable, Unstable]);
    near(event.row.value, WEIGHT, 1e-12);
    assert!(event.row.equilibrium.free[0].abs() < 1e-12);
    // On the branch that leans, the stiffness turns back at the same value.
    let path = followed(&inverted("10Nm"), None, [10.0, 100.0]);
    assert_eq!(path.end, PathEnd::First);
    let [event] = &path.events[..] else {
        panic!("{:?}", path.events)
    };
    assert_eq!(event.kind, PathEventKind::Fold);
    near(event.row.value, WEIGHT, 1e-12);
    let last = path.rows.last().expect("rows");
    let first = &path.rows[0].equilibrium;
    near(last.equilibrium.free[0], -first.free[0], 1e-12);
}

/// A center of mass beside the rod leads the path to one side, however little: it does not jump to the path across.
#[test]
fn an_imperfect_pitchfork_is_no_crossing() {
    for offset in [1e-2, 1e-6, 1e-9] {
        let text = inverted("100Nm").replace("S: (0, 2)", &format!("S: ({offset:?}, 2)"));
        let path = followed(&text, None, [100.0, 10.0]);
        assert_eq!(path.end, PathEnd::Last);
        assert!(path.events.is_empty(), "{offset}: {:?}", path.events);
        let last = &path.rows.last().expect("rows").equilibrium;
        assert_eq!(last.verdict.stability, Stable);
        let moment = |phi: f64| 10.0 * phi - WEIGHT * (phi.sin() - 0.5 * offset * phi.cos());
        near(last.free[0], zero(moment, [-3.1, -1.0]), 1e-12);
    }
}

/// Two point masses on rods: ω² are the roots of |K − ω² M| in closed form.
#[test]
fn a_double_pendulum_has_four_equilibria() {
    let (masses, lengths, g) = ([2.0, 3.0], [1.5, 0.7], 9.81);
    let list = equilibria(
        "mechanism double {
            point O = (0, 0);
            body one at O { O, P: (0, -1.5) }
            body two at (0, -1.5) { P: (0, 0), S: (0, -0.7) }
            revolute O(ground, one);
            revolute P(one, two);
            free a: phi(one) = 10deg;
            free b: phi(two) = 20deg;
            mass one = 2kg at P;
            mass two = 3kg at S;
            gravity = (0, -9.81);
        }",
    );
    assert_eq!(list.all.len(), 4, "{list:?}");
    let mut expected = Vec::new();
    for upper in [0.0, PI] {
        for lower in [0.0, PI] {
            expected.push([upper, lower]);
        }
    }
    for [upper, lower] in expected {
        let is_it =
            |free: &[f64]| (free[0] - upper).abs() < 1e-12 && (free[1] - lower).abs() < 1e-12;
        let equilibrium = list.all.iter().find(|it| is_it(&it.free));
        let equilibrium = equilibrium.expect("the equilibrium");
        let total = masses[0] + masses[1];
        let stiffness = [
            total * g * lengths[0] * f64::cos(upper),
            masses[1] * g * lengths[1] * f64::cos(lower),
        ];
        let coupling = masses[1] * lengths[0] * lengths[1] * f64::cos(upper - lower);
        let inertia = [
            total * lengths[0] * lengths[0],
            masses[1] * lengths[1] * lengths[1],
        ];
        let square = inertia[0] * inertia[1] - coupling * coupling;
        let linear = inertia[0] * stiffness[1] + inertia[1] * stiffness[0];
        let root = (linear * linear - 4.0 * square * stiffness[0] * stiffness[1]).sqrt();
        let mut squares = [(linear - root), (linear + root)].map(|it| it / (2.0 * square));
        squares.sort_by(f64::total_cmp);
        for (motion, square) in equilibrium.verdict.motions.iter().zip(squares) {
            match square < 0.0 {
                true => near(motion.growth, (-square).sqrt(), 1e-11),
                false => near(motion.frequency, square.sqrt() / TAU, 1e-11),
            }
        }
        let is_stable = upper == 0.0 && lower == 0.0;
        let stability = if is_stable { Stable } else { Unstable };
        assert_eq!(equilibrium.verdict.stability, stability);
        assert!(equilibrium.verdict.is_conservative);
    }
}

/// Half the width and the height of von Mises' truss (m), and the stiffness of each of its springs (N/m).
const TRUSS: [f64; 3] = [0.4, 0.15, 1000.0];

/// The load at a height is 2 k y (ℓ₀/ℓ − 1); it is largest where ℓ³ = ℓ₀ a².
#[test]
fn a_truss_snaps_at_its_limit_loads() {
    let [half, height, stiffness] = TRUSS;
    let text = format!(
        "mechanism truss {{
            param load = -10N;
            point A = (-{half}, 0), B = ({half}, 0);
            body hub at (0, {height}) {{ H: (0, 0) }}
            absolute_x(hub) = 0;
            absolute_angle(hub) = 0;
            spring (ground.A, hub.H) = {stiffness}N/m;
            spring (ground.B, hub.H) = {stiffness}N/m;
            free rise: y(hub) = {height};
            mass hub = 1kg;
            force on hub.H = (0, -load);
        }}"
    );
    let relaxed = half.hypot(height);
    let load = |y: f64| 2.0 * stiffness * y * (relaxed / half.hypot(y) - 1.0);
    let length = (relaxed * half * half).cbrt();
    let limit = (length * length - half * half).sqrt();
    let path = followed(&text, None, [-10.0, 20.0]);
    assert_eq!(path.end, PathEnd::Last);
    assert_eq!(path.events.len(), 2);
    let signs = [1.0, -1.0]
        .into_iter()
        .zip([[Stable, Unstable], [Unstable, Stable]]);
    for (event, (sign, stability)) in path.events.iter().zip(signs) {
        assert_eq!(event.kind, PathEventKind::Fold);
        assert_eq!(event.stability, stability);
        near(event.row.value, sign * load(limit), 1e-12);
        near(event.row.equilibrium.free[0], sign * limit, 1e-6);
    }
    assert_eq!(path.rows[0].value, -10.0);
    for row in &path.rows {
        let value = load(row.equilibrium.free[0]);
        assert!((row.value - value).abs() <= 1e-11 * 10.0, "{row:?}");
    }
    near(path.rows.last().expect("rows").value, 20.0, 1e-15);
    // Without a load, the middle position is the unstable one.
    let list = equilibria(&text.replace("-10N", "0N"));
    assert_eq!(stabilities(&list), [Stable, Unstable, Stable]);
    near(list.all[0].free[0], -height, 1e-12);
    near(list.all[2].free[0], height, 1e-12);
}

/// Lengths of a four-bar (m): ground, crank, coupler, rocker.
const LINKS: [f64; 4] = [0.1, 0.03, 0.09, 0.07];

/// Energy at an angle of the crank, from the intersection of two circles: above the line of centers, or below.
fn four_bar_energy(phi: f64, side: f64) -> f64 {
    let [ground, crank, coupler, rocker] = LINKS;
    let (pin, foot) = ([crank * phi.cos(), crank * phi.sin()], [ground, 0.0]);
    let across = [foot[0] - pin[0], foot[1] - pin[1]];
    let distance = across[0].hypot(across[1]);
    let along = (coupler * coupler - rocker * rocker + distance * distance) / (2.0 * distance);
    let beside = side * (coupler * coupler - along * along).sqrt();
    let unit = across.map(|it| it / distance);
    let joint = [
        pin[0] + along * unit[0] - beside * unit[1],
        pin[1] + along * unit[1] + beside * unit[0],
    ];
    let direction = [0, 1].map(|it| (joint[it] - pin[it]) / coupler);
    let carried = [
        pin[0] + 0.04 * direction[0] - 0.02 * direction[1],
        pin[1] + 0.04 * direction[1] + 0.02 * direction[0],
    ];
    let spring = (carried[0] - 0.02).hypot(carried[1] - 0.09) - 0.03;
    let weights = 0.5 * pin[1] + 1.0 * carried[1] + 0.8 * joint[1];
    9.81 * weights + 0.5 * 500.0 * spring * spring
}

/// Slope of the energy, by differences of order eight.
fn four_bar_slope(phi: f64, side: f64) -> f64 {
    let step = 0.01;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let terms = weights.iter().zip(1..).map(|(weight, count)| {
        let away = step * f64::from(count);
        weight * (four_bar_energy(phi + away, side) - four_bar_energy(phi - away, side))
    });
    terms.sum::<f64>() / step
}

fn four_bar(coupler: &str) -> String {
    format!(
        "mechanism fourbar {{
            units mm;
            param coupler = {coupler};
            point A = (0, 0), D = (100mm, 0), F = (20mm, 90mm);
            body crank at (0, 0, 70deg)       {{ A: (0, 0), B: (30mm, 0) }}
            body rod at (10mm, 28mm, 20deg)   {{ B: (0, 0), C: (coupler, 0), G: (40mm, 20mm) }}
            body rocker at (100mm, 0, 100deg) {{ D: (0, 0), C: (70mm, 0) }}
            revolute A(ground, crank);
            revolute B(crank, rod);
            revolute C(rod, rocker);
            revolute D(ground, rocker);
            free turn: phi(crank) = 70deg;
            mass crank = 0.5kg at B;
            mass rod = 1kg at G inertia 300kg*mm^2;
            mass rocker = 0.8kg at C;
            gravity = (0, -9.81);
            spring (ground.F, rod.G) = 0.5N/mm free 30mm;
            measure lean = phi(rocker);
        }}"
    )
}

/// The search with the last length finds the end of the path.
#[test]
fn a_path_over_a_length_ends_in_an_equilibrium() {
    let path = followed(&four_bar("90mm"), None, [0.09, 0.11]);
    assert_eq!(path.end, PathEnd::Last);
    let last = &path.rows.last().expect("rows").equilibrium;
    let list = equilibria(&four_bar("110mm"));
    let away = |turn: f64| (turn - last.free[0]).rem_euclid(TAU);
    let same = list.all.iter().find(|it| {
        let away = away(it.free[0]);
        away.min(TAU - away) < 1e-12
    });
    let same = same.expect("the equilibrium");
    let [one, other] = [same, last].map(|it| it.reported.as_ref().expect("a measure")[0]);
    let turns = (one - other) / TAU;
    assert!((turns - turns.round()).abs() < 1e-12, "{one} {other}");
    near(same.potential, last.potential, 1e-12);
    let [one, other] = [same, last].map(|it| it.verdict.motions[0].frequency);
    near(one, other, 1e-10);
}

#[test]
fn a_linkage_rests_where_its_energy_is_stationary() {
    let list = equilibria(&four_bar("90mm"));
    let mut expected = Vec::new();
    for side in [1.0, -1.0] {
        let place = |step: i32| 70_f64.to_radians() - PI + TAU * f64::from(step) / 720.0;
        for step in 0..720 {
            let sides = [place(step), place(step + 1)];
            if four_bar_slope(sides[0], side) * four_bar_slope(sides[1], side) < 0.0 {
                let phi = zero(|phi| four_bar_slope(phi, side), sides);
                let is_valley = four_bar_slope(sides[0], side) < 0.0;
                expected.push((phi, is_valley, side));
            }
        }
    }
    expected.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(expected.len() >= 4, "{expected:?}");
    assert_eq!(list.all.len(), expected.len(), "{expected:?}");
    for (equilibrium, (phi, is_valley, side)) in list.all.iter().zip(expected) {
        near(equilibrium.free[0], phi, 1e-9);
        near(equilibrium.potential, four_bar_energy(phi, side), 1e-12);
        let stability = if is_valley { Stable } else { Unstable };
        assert_eq!(equilibrium.verdict.stability, stability);
        assert_eq!(equilibrium.is_connected, Some(side > 0.0));
    }
}

/// Ziegler's column with masses 2 m and m: it flutters from P = (7/2 − √2) k/ℓ on.
#[test]
fn a_column_flutters_under_a_load_that_follows_it() {
    let text = "mechanism column {
        param p = 0N;
        point O = (0, 0);
        body one at O { O, P: (1, 0) }
        body two at (1, 0) { P: (0, 0), S: (1, 0) }
        revolute O(ground, one);
        revolute P(one, two);
        free a: phi(one) = 1deg;
        free b: phi(two) = 2deg;
        mass one = 2kg at P;
        mass two = 1kg at S;
        spring about (ground, one) = 100Nm free 0;
        spring about (one, two) = 100Nm free 0;
        force on two.S = (-p, 0) in two;
    }";
    let path = followed(text, None, [0.0, 300.0]);
    let [event] = &path.events[..] else {
        panic!("{:?}", path.events)
    };
    assert_eq!(event.kind, PathEventKind::ChangeOfStability);
    assert_eq!(event.stability, [Stable, Unstable]);
    near(event.row.value, 100.0 * (3.5 - 2_f64.sqrt()), 1e-9);
    let last = &path.rows.last().expect("rows").equilibrium.verdict;
    assert!(!last.is_conservative);
    assert!(last.motions[0].growth > 0.0 && last.motions[0].frequency > 0.0);
}

/// A torque T against m g l sin φ: two equilibria below m g l, one at it, none beyond.
#[test]
fn equilibria_meet_where_a_torque_is_the_largest_moment() {
    let of = |share: f64| {
        let torque = share * WEIGHT;
        let text = pendulum("2m").replace(
            "measure height",
            &format!("torque on bob = {torque:?}*1Nm; measure height"),
        );
        equilibria(&text)
    };
    let share = 1.0 - 1e-8;
    let list = of(share);
    let angle = f64::asin(share);
    assert_eq!(stabilities(&list), [Stable, Unstable]);
    let reach = 1e-15 / angle.cos();
    assert!((list.all[0].free[0] - angle).abs() <= reach);
    assert!((list.all[1].free[0] - (PI - angle)).abs() <= reach);
    let list = of(1.0);
    assert_eq!(stabilities(&list), [Indifferent]);
    assert!((list.all[0].free[0] - 0.5 * PI).abs() <= 1e-7);
    let list = of(1.0 + 1e-8);
    assert!(list.all.is_empty() && !list.is_everywhere);
}

#[test]
fn free_motion_without_forces_is_no_list() {
    let text = pendulum("2m").replace("gravity = (0, -9.81);", "");
    let list = equilibria(&text);
    assert!(list.is_everywhere && list.all.is_empty());
    let falling = equilibria(
        "mechanism falling {
            body one at (0, 0) { S: (0, 0) }
            absolute_x(one) = 0;
            absolute_angle(one) = 0;
            free height: y(one) = 0;
            mass one = 3kg;
            gravity = (0, -9.81);
        }",
    );
    assert!(falling.all.is_empty() && !falling.is_everywhere);
    // A cart moves freely below a pendulum: one equilibrium stands for a line of them.
    let cart = equilibria(
        "mechanism cart {
            body cart at (0, 0) { O: (0, 0) }
            body bob at (0, 0) { O: (0, 0), S: (0, -1) }
            absolute_y(cart) = 0;
            absolute_angle(cart) = 0;
            revolute O(cart, bob);
            free x: x(cart) = 0;
            free swing: phi(bob) = 10deg;
            mass cart = 3kg;
            mass bob = 2kg at S;
            gravity = (0, -9.81);
        }",
    );
    assert_eq!(cart.all.len(), 2);
    assert!(cart.all.iter().all(|it| it.is_of_family));
    let mut signs = stabilities(&cart);
    signs.sort_by_key(|it| it.name());
    assert_eq!(signs, [Indifferent, Unstable]);
    let hanging = cart.all.iter().find(|it| it.free[1].abs() < 1e-9);
    let hanging = hanging.expect("a hanging pendulum");
    assert_eq!(hanging.verdict.motions[0].frequency, 0.0);
    // ω² = (M + m) g / (M l).
    near(
        hanging.verdict.motions[1].frequency,
        (5.0 * 9.81 / 3.0_f64).sqrt() / TAU,
        1e-11,
    );
}

/// An arm that is driven stands still at its angle at the time; a damper and the drive's rate do nothing.
#[test]
fn drives_stand_still() {
    let derived = description::written(
        "mechanism driven {
            point O = (0, 0);
            body arm at O { O, P: (1, 0) }
            body bob at (1, 0) { P: (0, 0), S: (0, -0.5) }
            revolute O(ground, arm);
            revolute P(arm, bob);
            drive phi(arm) = 30deg + 2*t;
            free swing: relative_angle(arm, bob) = 10deg;
            mass bob = 2kg at S;
            gravity = (0, -9.81);
            damper about (arm, bob) = 3;
        }",
    );
    let view = Interpreted::new(&derived).expect("the equations determine the motion");
    for t in [0.0, 0.4] {
        let list = Equilibria::new(&derived, &view, t, STARTS, |_, _| true).expect("equilibria");
        let hanging = list.all.iter().find(|it| it.verdict.stability == Stable);
        let hanging = hanging.expect("a hanging bob");
        near(hanging.free[0], -(30_f64.to_radians() + 2.0 * t), 1e-12);
        near(
            hanging.verdict.motions[0].frequency,
            (9.81_f64 / 0.5).sqrt() / TAU,
            1e-12,
        );
    }
}

/// A stiff spring beside a soft motion leaves the soft one its digits.
#[test]
fn stiff_springs_hide_nothing() {
    for stiffness in [1e6, 1e9] {
        let list = equilibria(&format!(
            "mechanism stiff {{
                point U = (0, 1);
                body block at (0, 0) {{ O: (0, 0) }}
                body bob at (0, 0) {{ O: (0, 0), S: (0, -1) }}
                absolute_x(block) = 0;
                absolute_angle(block) = 0;
                revolute O(block, bob);
                spring (ground.U, block.O) = {stiffness}N/m free 1;
                free drop: y(block) = 0;
                free swing: phi(bob) = 10deg;
                mass block = 3kg;
                mass bob = 2kg at S;
                gravity = (0, -9.81);
            }}"
        ));
        let hanging = list.nearest.map(|it| &list.all[it]).expect("one");
        assert_eq!(hanging.verdict.stability, Stable);
        let drop = hanging.free[0] + 5.0 * 9.81 / stiffness;
        assert!(drop.abs() <= 1e-15, "{drop}");
        let frequency = hanging.verdict.motions[0].frequency;
        near(frequency, 9.81_f64.sqrt() / TAU, 1e-9);
    }
}

/// The force of a spring jumps past zero as its ends meet: that is not an equilibrium.
#[test]
fn a_force_that_jumps_past_zero_is_left_out() {
    let list = equilibria(
        "mechanism jumping {
            point O = (0, 0);
            body block at (0, -0.5) { P: (0, 0) }
            absolute_x(block) = 0;
            absolute_angle(block) = 0;
            free height: y(block) = -0.5;
            mass block = 3kg;
            gravity = (0, -9.81);
            spring (ground.O, block.P) = 100N/m free 1;
        }",
    );
    assert_eq!(stabilities(&list), [Stable, Stable]);
    let sag = 3.0 * 9.81 / 100.0;
    near(list.all[0].free[0], -1.0 - sag, 1e-13);
    near(list.all[1].free[0], 1.0 - sag, 1e-13);
}

/// Three cranks carry the coupler of a parallelogram: assemblies in which the redundant one is apart do not count.
#[test]
fn redundant_joints_hold() {
    let list = equilibria(
        "mechanism cranks {
            point A = (0, 0), D = (2, 0), G = (1, 0);
            body crank at (0, 0, 40deg)   { A: (0, 0), B: (1, 0) }
            body coupler at (0.766, 0.643) { B: (0, 0), H: (1, 0), C: (2, 0) }
            body rocker at (2, 0, 40deg)  { D: (0, 0), C: (1, 0) }
            body middle at (1, 0, 40deg)  { G: (0, 0), H: (1, 0) }
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, rocker);
            revolute D(ground, rocker);
            revolute G(ground, middle);
            redundant revolute H(middle, coupler);
            free turn: phi(crank) = 40deg;
            mass coupler = 1kg at C;
            gravity = (0, -9.81);
        }",
    );
    assert_eq!(stabilities(&list), [Stable, Unstable]);
    near(list.all[0].free[0], -0.5 * PI, 1e-13);
    near(list.all[1].free[0], 0.5 * PI, 1e-13);
}

#[test]
fn nothing_is_sought_without_free_coordinates() {
    let driven = pendulum("2m").replace(
        "free swing: phi(bob) = 30deg rate 1.5;",
        "drive phi(bob) = 30deg + t;",
    );
    assert!(matches!(sought(&driven), Err(Unbalanced::NothingFree)));
}
