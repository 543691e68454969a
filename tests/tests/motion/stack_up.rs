//! Spreads of measures by tolerances: against closed forms of a slider-crank and of a chain of lengths, with the same samples.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::model::Distribution;
use linkwright_codegen::{Options, generate};
use linkwright_solver::stack_up::{
    Moments, Prepared, SampledSpread, Sampling, StackUp, ToleranceSamples, Unprepared, departures,
    prepared,
};
use linkwright_tests::description;

/// Crank and rod (m), and rate of the crank (rad/s).
const CRANK: f64 = 0.04;
const ROD: f64 = 0.12;
const RATE: f64 = 2.0;

/// Half width of the crank's uniform tolerance and standard deviation of the rod (m).
const CRANK_TOLERANCE: f64 = 1e-4;
const ROD_DEVIATION: f64 = 5e-5;

/// Slider-crank in line with its guide.
fn slider_crank(crank: &str, rod: &str) -> String {
    format!(
        "mechanism slider {{
            param r = {crank};
            param l = {rod};
            point O = (0, 0);
            body arm at O {{ O, A: (r, 0) }}
            body link at (r, 0) {{ A: (0, 0), B: (l, 0) }}
            body ram at (r + l, 0) {{ B: (0, 0) }}
            revolute O(ground, arm);
            revolute A(arm, link);
            revolute B(link, ram);
            absolute_y(ram) = 0;
            absolute_angle(ram) = 0;
            drive phi(arm) = {RATE}*t;
            measure place = B.x;
            measure speed = rate(B.x);
            measure surge = rate(rate(B.x));
        }}"
    )
}

fn usual() -> Prepared {
    opened(&slider_crank("40mm tolerance 0.1mm", "120mm sigma 0.05mm"))
}

fn opened(text: &str) -> Prepared {
    read(text, &[]).expect("tolerances and measures")
}

fn read(text: &str, assignments: &[&str]) -> Result<Prepared, Unprepared> {
    let source = Source::new("slider.mech", text);
    let assignments: Vec<String> = assignments.iter().map(ToString::to_string).collect();
    prepared(
        &source,
        None,
        "--set",
        &assignments,
        &mut Diagnostics::new(),
    )
}

fn times(count: u32) -> Vec<f64> {
    (0..count).map(|step| 0.02 * f64::from(step)).collect()
}

/// Place, speed and acceleration of the ram at a time.
fn ram(crank: f64, rod: f64, t: f64) -> [f64; 3] {
    let (sine, cosine) = (RATE * t).sin_cos();
    let root = (rod * rod - crank * crank * sine * sine).sqrt();
    let of_root = -crank * crank * sine * cosine / root;
    let bend = -crank * crank * (cosine * cosine - sine * sine) / root - of_root * of_root / root;
    [
        crank * cosine + root,
        RATE * (-crank * sine + of_root),
        RATE * RATE * (-crank * cosine + bend),
    ]
}

/// Derivatives of [`ram`] by crank and rod, by differences of the fourth order.
fn slopes(t: f64) -> [[f64; 2]; 3] {
    let step = 1e-4;
    let along = |quantity: usize, by: usize| {
        let at = |steps: f64| {
            let mut values = [CRANK, ROD];
            values[by] += steps * step;
            ram(values[0], values[1], t)[quantity]
        };
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
    };
    [0, 1, 2].map(|quantity| [along(quantity, 0), along(quantity, 1)])
}

#[test]
fn first_order_is_that_of_the_closed_form() {
    let times = times(160);
    let spread = StackUp::new(&usual(), &times, 2).expect("it is assembled");
    assert!(spread.ended.is_none());
    let distributions: Vec<Distribution> =
        spread.toleranced.iter().map(|it| it.distribution).collect();
    let half_width = CRANK_TOLERANCE;
    let deviation = ROD_DEVIATION;
    let expected = [
        Distribution::Uniform { half_width },
        Distribution::Normal { deviation },
    ];
    assert_eq!(distributions, expected);
    let exact: Vec<bool> = spread.measures.iter().map(|it| it.is_exact).collect();
    assert_eq!(exact, [true, true, false]);
    let mut largest = [0.0_f64; 3];
    for (place, &t) in times.iter().enumerate() {
        let (sine, cosine) = (RATE * t).sin_cos();
        let root = (ROD * ROD - CRANK * CRANK * sine * sine).sqrt();
        let closed = [cosine - CRANK * sine * sine / root, ROD / root];
        let expected = slopes(t);
        let values = ram(CRANK, ROD, t);
        for (quantity, measure) in spread.measures.iter().enumerate() {
            assert!((measure.nominal[place] - values[quantity]).abs() < 1e-12);
            for by in 0..2 {
                let slope = measure.slopes[place][by];
                let error = (slope - expected[quantity][by]).abs();
                largest[quantity] = largest[quantity].max(error);
                if quantity == 0 {
                    assert!((slope - closed[by]).abs() < 1e-13, "{t}: {slope}");
                }
            }
            let [crank, rod] = expected[quantity];
            let worst = crank.abs() * CRANK_TOLERANCE + rod.abs() * 3.0 * ROD_DEVIATION;
            assert!((measure.worst[place] - worst).abs() < 1e-8 * worst.max(1e-4));
            let squares = (crank * CRANK_TOLERANCE).powi(2) / 3.0 + (rod * ROD_DEVIATION).powi(2);
            assert!((measure.deviation[place] - squares.sqrt()).abs() < 1e-8 * worst.max(1e-4));
            let shares = measure.shares(place, &spread.toleranced);
            if squares > 1e-30 {
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                let share = (rod * ROD_DEVIATION).powi(2) / squares;
                assert!((shares[1] - share).abs() < 1e-7, "{t}: {shares:?}");
            }
        }
    }
    println!("largest errors of derivatives: {largest:?}");
    assert!(largest[0] < 1e-9 && largest[1] < 1e-9 && largest[2] < 1e-7);
}

/// Of a chain of lengths, the worst case is the sum of the tolerances, and the variance the sum of the variances.
#[test]
fn lengths_in_a_chain_add_up() {
    let text = "mechanism chain {
        param a = 20mm tolerance 0.1mm;
        param b = 30mm tolerance 0.2mm;
        param c = 45mm sigma 0.05mm;
        param d = 1mm;
        point O = (0, 0);
        body slide at O { O, A: (a + b + d - c, 0) }
        drive slide.x = t*1mm;
        absolute_y(slide) = 0;
        absolute_angle(slide) = 0;
        measure gap = A.x;
    }";
    let prepared = opened(text);
    let spread = StackUp::new(&prepared, &times(3), 1).expect("it is assembled");
    let parameters: Vec<usize> = spread.toleranced.iter().map(|it| it.parameter).collect();
    assert_eq!(parameters, [0, 1, 2]);
    let gap = &spread.measures[0];
    for place in 0..3 {
        assert_eq!(gap.slopes[place], [1.0, 1.0, -1.0]);
        assert!((gap.worst[place] - 0.45e-3).abs() < 1e-18);
        let variance = (0.01 + 0.04) / 3.0 + 0.0025;
        assert!((gap.deviation[place] - 1e-3 * f64::sqrt(variance)).abs() < 1e-18);
    }
    let limits = gap.limits(0, &spread.toleranced);
    assert!((limits[2] - 0.15e-3).abs() < 1e-18);
    // The sampled spread is that of the sum, for which the first order is exact.
    for sampling in [Sampling::Sobol, Sampling::Random] {
        let sampled = sampled(&prepared, &spread, sampling, 3, 4096, 2);
        assert_eq!(departures(gap, &sampled.measures[0]), []);
        let moments = sampled.measures[0].moments[0];
        let error = (moments.deviation - gap.deviation[0]).abs();
        assert!(error < 4.0 * moments.error_of_deviation, "{moments:?}");
    }
}

/// The offset of any pin of a slider-crank acts along the rod: its worst case is c l/S with S = √(l² − r² sin²), and its variance a
/// quarter of the square.
#[test]
fn loose_pins_act_along_the_rod() {
    let radius = 2e-4;
    let text = slider_crank("40mm", "120mm");
    let loose =
        "clearance O = 0.2mm; clearance A = 0.2mm; clearance B = 0.2mm; measure place = ram.x";
    // The pin of the rod's end is not where that of the ram is.
    let prepared = opened(&text.replace("measure place = B.x", loose));
    let times = times(100);
    let spread = StackUp::new(&prepared, &times, 2).expect("it is assembled");
    let place = &spread.measures[0];
    for (frame, &t) in times.iter().enumerate() {
        assert!((place.nominal[frame] - ram(CRANK, ROD, t)[0]).abs() < 1e-15);
        let root = (ROD * ROD - (CRANK * (RATE * t).sin()).powi(2)).sqrt();
        let limits = place.limits(frame, &spread.toleranced);
        assert_eq!(limits.len(), 3);
        for limit in limits {
            assert!((limit - radius * ROD / root).abs() < 1e-15, "{t}: {limit}");
        }
        let deviation = 3.0_f64.sqrt() * 0.5 * radius * ROD / root;
        assert!((place.deviation[frame] - deviation).abs() < 1e-15);
        let shares = place.shares(frame, &spread.toleranced);
        assert!(shares.iter().all(|it| (it - 1.0 / 3.0).abs() < 1e-12));
    }
    // Sampled pins, against the closed form with the same offsets, which turn with the first body.
    let count = 2000;
    for sampling in [Sampling::Sobol, Sampling::Random] {
        let solved = sampled(&prepared, &spread, sampling, 5, count, 2);
        assert_eq!(departures(place, &solved.measures[0]), []);
        let samples = ToleranceSamples::new(&spread.toleranced, sampling, 5).expect("six");
        for (frame, &t) in times.iter().enumerate().step_by(9) {
            let values = (0..count).map(|index| {
                let mut drawn = [CRANK, ROD, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
                samples.write(index, &mut drawn);
                let [_, _, ox, oy, ax, ay, bx, by] = drawn;
                assert!(ox.hypot(oy) <= radius && ax.hypot(ay) <= radius);
                let (sine, cosine) = (RATE * t).sin_cos();
                let pin = [CRANK + ax, ay];
                let x = ox + cosine * pin[0] - sine * pin[1];
                let y = oy + sine * pin[0] + cosine * pin[1];
                let rod = (ROD + bx).hypot(by);
                x + (rod * rod - y * y).sqrt()
            });
            let mut values: Vec<f64> = values.collect();
            let expected = Moments::of(&mut values, place.nominal[frame]);
            let moments = solved.measures[0].moments[frame];
            assert!((moments.mean - expected.mean).abs() < 1e-13);
            assert!((moments.deviation - expected.deviation).abs() < 1e-13);
        }
    }
}

fn sampled(
    prepared: &Prepared,
    spread: &StackUp,
    sampling: Sampling,
    seed: u64,
    count: u32,
    threads: usize,
) -> SampledSpread {
    let samples = ToleranceSamples::new(&spread.toleranced, sampling, seed);
    let samples = samples.expect("few parameters");
    SampledSpread::new(prepared, spread, &samples, count, threads, |_| true)
}

#[test]
fn sampled_mechanisms_are_those_of_the_closed_form() {
    let (prepared, times, count) = (usual(), times(40), 3000);
    let spread = StackUp::new(&prepared, &times, 2).expect("it is assembled");
    for sampling in [Sampling::Sobol, Sampling::Random] {
        let solved = sampled(&prepared, &spread, sampling, 7, count, 2);
        assert_eq!((solved.unassembled, solved.ended), (0, 0));
        let samples = ToleranceSamples::new(&spread.toleranced, sampling, 7).expect("two");
        let mut drawn = Vec::new();
        for index in 0..count {
            let mut parameters = [CRANK, ROD];
            samples.write(index, &mut parameters);
            assert!((parameters[0] - CRANK).abs() < CRANK_TOLERANCE);
            drawn.push(parameters);
        }
        let beyond = |limit: f64| {
            let far = drawn
                .iter()
                .filter(|it| (it[1] - ROD).abs() > limit * ROD_DEVIATION);
            far.count() as f64 / f64::from(count)
        };
        // Shares of a normal distribution outside of one and of two standard deviations, within four standard errors.
        assert!(
            (beyond(1.0) - 0.3173).abs() < 4.0 * (0.3173_f64 * 0.6827 / f64::from(count)).sqrt()
        );
        assert!(
            (beyond(2.0) - 0.0455).abs() < 4.0 * (0.0455_f64 * 0.9545 / f64::from(count)).sqrt()
        );
        for (place, &t) in times.iter().enumerate() {
            for (quantity, measure) in spread.measures.iter().enumerate() {
                let values = drawn.iter().map(|it| ram(it[0], it[1], t)[quantity]);
                let mut values: Vec<f64> = values.collect();
                let expected = Moments::of(&mut values, measure.nominal[place]);
                let moments = solved.measures[quantity].moments[place];
                let pairs = [
                    (moments.mean, expected.mean),
                    (moments.deviation, expected.deviation),
                    (moments.quantiles[0], expected.quantiles[0]),
                    (moments.quantiles[1], expected.quantiles[1]),
                    (moments.quantiles[2], expected.quantiles[2]),
                ];
                for (value, expected) in pairs {
                    assert!((value - expected).abs() < 1e-12, "{t}: {value} {expected}");
                }
            }
        }
        for (linear, sampled) in spread.measures.iter().zip(&solved.measures) {
            assert_eq!(departures(linear, sampled), []);
        }
    }
}

/// Only the study uses tolerances and clearances; the head of a module names tolerances of parameters.
#[test]
fn generated_code_is_the_same_without_tolerances() {
    let source = description::source("toleranced_press");
    let exact = source
        .text
        .replace(" tolerance 0.05mm", "")
        .replace(" sigma 0.04mm", "");
    let exact = exact.replace("    clearance A = 0.05mm;\n", "");
    assert!(!exact.contains("sigma") && exact.len() + 50 < source.text.len());
    let exact = Source::new(source.name.clone(), exact);
    let module = |source: &Source| {
        let generated = generate(source, &Options::default()).expect("no errors");
        let lines = generated.code().lines();
        let lines = lines.filter(|it| !it.starts_with("// Parameter "));
        lines.collect::<Vec<_>>().join("\n")
    };
    assert!(module(&source) == module(&exact));
}

#[test]
fn seeds_and_threads() {
    let (prepared, times) = (usual(), times(5));
    let spread = StackUp::new(&prepared, &times, 1).expect("it is assembled");
    let bits = |sampling, seed, threads| -> Vec<u64> {
        let sampled = sampled(&prepared, &spread, sampling, seed, 2100, threads);
        let moments = sampled.measures.iter().flat_map(|it| &it.moments);
        moments.map(|it| it.deviation.to_bits()).collect()
    };
    for sampling in [Sampling::Sobol, Sampling::Random] {
        let first = bits(sampling, 1, 1);
        assert!(first == bits(sampling, 1, 3));
        assert!(first != bits(sampling, 2, 1));
    }
}

/// A rod that is hardly longer than its crank: near the crank's vertical pose, the ram depends on the root of their difference.
#[test]
fn first_order_is_not_enough_near_a_dead_point() {
    let text = slider_crank("40mm tolerance 0.01mm", "40.1mm sigma 0.03mm");
    let prepared = opened(&text);
    let times: Vec<f64> = (0..42).map(|it| 0.019 * f64::from(it)).collect();
    let spread = StackUp::new(&prepared, &times, 2).expect("it is assembled");
    assert!(spread.ended.is_none());
    let sampled = sampled(&prepared, &spread, Sampling::Sobol, 0, 10_000, 2);
    let all = departures(&spread.measures[0], &sampled.measures[0]);
    let departure = all.first().expect("not enough");
    println!("{departure:?} at t = {}", times[departure.place]);
    assert!(times[departure.place] > 0.65, "{departure:?}");
    // Far from the dead point, it is.
    let early = StackUp::new(&prepared, &times[..25], 2).expect("it is assembled");
    let sampled = SampledSpread::new(
        &prepared,
        &early,
        &ToleranceSamples::new(&early.toleranced, Sampling::Sobol, 0).expect("two"),
        10_000,
        2,
        |_| true,
    );
    assert_eq!(departures(&early.measures[0], &sampled.measures[0]), []);
}

/// At the dead point of a crank with a normal error σ, the ram departs by r (1 + r/l) ε²/2: its mean by σ², its deviation by √2 σ².
#[test]
fn an_error_at_a_dead_point_is_of_second_order() {
    let text = slider_crank("40mm", "120mm").replace(&format!("{RATE}*t"), "error + 0.2*(t - 1)");
    let text = text.replace("param r", "param error = 0deg sigma 1deg; param r");
    let prepared = opened(&text);
    let times: Vec<f64> = (0..=10).map(|it| 0.1 * f64::from(it)).collect();
    let spread = StackUp::new(&prepared, &times, 2).expect("it is assembled");
    assert!(spread.measures[0].deviation[10].abs() < 1e-15);
    let sampled = sampled(&prepared, &spread, Sampling::Sobol, 0, 10_000, 2);
    let moments = &sampled.measures[0].moments[10];
    let variance = 1.0_f64.to_radians().powi(2);
    let bend = 0.5 * CRANK * (1.0 + CRANK / ROD) * variance;
    let mean = spread.measures[0].nominal[10] - moments.mean;
    assert!((mean / bend - 1.0).abs() < 2e-3, "{mean} {bend}");
    let deviation = moments.deviation / (2.0_f64.sqrt() * bend);
    assert!((deviation - 1.0).abs() < 0.01, "{deviation}");
    let departures = departures(&spread.measures[0], &sampled.measures[0]);
    assert_eq!(departures.len(), 2);
    assert!(
        !departures[1].is_of_mean && departures[1].place == 10,
        "{departures:?}"
    );
}

/// Mechanisms that cannot be assembled, or whose motion ends early, are counted.
#[test]
fn failures_are_counted() {
    let text = slider_crank(
        "40mm tolerance 1mm",
        "40.5mm tolerance 0.1mm from 40.45mm to 41mm",
    );
    assert!(matches!(read(&text, &[]), Err(Unprepared::Unopened(_))));
    let text = slider_crank(
        "40mm tolerance 1mm",
        "40.5mm from 40.4mm to 41mm sigma 0.1mm",
    );
    let prepared = opened(&text);
    let spread = StackUp::new(&prepared, &times(50), 2).expect("it is assembled");
    let count = 4000;
    let sampled = sampled(&prepared, &spread, Sampling::Sobol, 0, count, 2);
    // A rod below its range by more than one standard deviation, and a crank that is longer than its rod.
    let share = |it: usize| it as f64 / f64::from(count);
    assert!(
        (share(sampled.unassembled) - 0.1587).abs() < 0.01,
        "{}",
        sampled.unassembled
    );
    let samples = ToleranceSamples::new(&spread.toleranced, Sampling::Sobol, 0).expect("two");
    let ends = (0..count).filter(|&index| {
        let mut parameters = [0.04, 0.0405];
        samples.write(index, &mut parameters);
        let [crank, rod] = parameters;
        // The crank passes its vertical pose.
        (0.0404..=0.041).contains(&rod) && crank > rod
    });
    assert_eq!(sampled.ended, ends.count());
    assert!(sampled.failure.is_some());
    let last = sampled.measures[0].moments.last().expect("times");
    assert_eq!(
        last.count,
        count as usize - sampled.unassembled - sampled.ended
    );
}

#[test]
fn studies_that_cannot_begin() {
    let plain = slider_crank("40mm", "120mm");
    assert!(matches!(read(&plain, &[]), Err(Unprepared::NoTolerance)));
    let stated = slider_crank("40mm tolerance 0.1mm", "120mm");
    let unmeasured: Vec<&str> = stated
        .lines()
        .filter(|it| !it.contains("measure"))
        .collect();
    let unmeasured = unmeasured.join("\n");
    assert!(matches!(read(&unmeasured, &[]), Err(Unprepared::NoMeasure)));
    assert!(matches!(
        read(&stated, &["r = 1kg"]),
        Err(Unprepared::Assignment(_))
    ));
    let moved = read(&stated, &["r = 41mm"]).expect("a length");
    let spread = StackUp::new(&moved, &times(2), 1).expect("it is assembled");
    assert!((spread.measures[0].nominal[0] - 0.161).abs() < 1e-15);
}
