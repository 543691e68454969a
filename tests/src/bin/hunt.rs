//! scratch
use linkwright_tests::hunt::{self, judge::{judge, Outcome}, known::{known, Unused}, interpreted};
use linkwright_tests::stability::verdict::Scalar;
use std::collections::BTreeMap;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let from: u64 = args[1].parse().unwrap();
    let to: u64 = args[2].parse().unwrap();
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let mut example: BTreeMap<String, (usize, u64, usize)> = BTreeMap::new();
    let (mut a, mut b, mut c) = (0.0, 0.0, 0.0);
    for number in from..to {
        let m = hunt::mechanism(1, number, 8);
        if args.len() > 3 { println!("{}", m.text()); }
        let s = Instant::now();
        let k = known(&m, hunt::seed_of(1, number));
        a += s.elapsed().as_secs_f64();
        let k = match k {
            Ok(k) => k,
            Err(e) => {
                let key = match &e { Unused::Refused(c, _) => format!("refused {c}"), Unused::Singular => "singular".into(), Unused::Undecided(_) => "undecided".into(), Unused::Contradiction(_) => "contradiction".into() };
                if args.len() > 3 { println!("{e:?}"); }
                if key.contains("contradiction") || key.contains("undecided") { println!("{number}: {e:?} {:?}", m.groups); }
                let bodies = m.bodies.len();
                let best = example.entry(key.clone()).or_insert((bodies, number, 0));
                if bodies < best.0 { *best = (bodies, number, 0); }
                *counts.entry(key).or_default() += 1;
                continue;
            }
        };
        *counts.entry(format!("used {:?}", k.end)).or_default() += 1;
        let s = Instant::now();
        let answers = interpreted::answers(&k);
        b += s.elapsed().as_secs_f64();
        let s = Instant::now();
        for answers in &answers {
            for (answered, outcome) in answers.iter().zip(judge(&k, answers, Scalar::F64)) {
                let key = match &outcome {
                    Outcome::Correct { .. } => "correct".to_string(),
                    Outcome::Wrong(why) => { println!("{number} {:?} {}: {why} {:?}", answered.call, answered.instant, m.groups); "WRONG".to_string() },
                    other => format!("{other:?}"),
                };
                let key = format!("{:?} {key}", answered.call);
                let bodies = m.bodies.len();
                let best = example.entry(key.clone()).or_insert((bodies, number, answered.instant));
                if bodies < best.0 { *best = (bodies, number, answered.instant); }
                if args.len() > 3 && !key.contains("correct") { println!("{} {key}", answered.instant); }
                *counts.entry(key).or_default() += 1;
            }
        }
        c += s.elapsed().as_secs_f64();
    }
    for (k, v) in counts { println!("{v:8} {k}  {:?}", example.get(&k)); }
    println!("{a:.1} {b:.1} {c:.1}");
}
