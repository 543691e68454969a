//! Sentences about singular poses against the points that they name: a sentence is true where the determinant is
//! zero, and only there, if the quantity that it names equals the determinant at every pose.

use linkwright::{Blocks, Settings, Shell};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_solver::reader::Reader;
use linkwright_solver::{Instant, Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::random::Random;
use nalgebra::{DMatrix, Matrix3};

/// Positions of the points of a mechanism at one pose.
struct Points<'a> {
    solved: &'a Interpreted,
    instant: &'a Instant,
}

impl Points<'_> {
    fn value(&self, expr: ExprId) -> f64 {
        let mut draft = self.solved.pool().draft();
        let written = draft.written_out(expr);
        Reader::new(&draft.graph, self.solved.layout(), &[written]).values(self.instant)[0]
    }

    /// Positions of all points with this name: bodies may carry different ones.
    fn places(&self, name: &str) -> Vec<[f64; 2]> {
        let system = self.solved.system();
        if let Some(body) = name.strip_prefix("the origin of body ") {
            let bodies = &system.mechanism.bodies;
            let place = bodies
                .iter()
                .position(|it| it.name == body)
                .expect("a body");
            let q = self.instant.q();
            return vec![[q[3 * place - 3], q[3 * place - 2]]];
        }
        let points = system.mechanism.points.iter();
        let named = points.zip(&system.vector_form.points).filter(|(point, _)| {
            let body = &system.mechanism.bodies[point.mark.frame.body.0];
            point.name == name || point.name == format!("{name}_{}", body.name)
        });
        named
            .map(|(_, place)| place.map(|part| self.value(part)))
            .collect()
    }

    /// Determinant of the coordinates of three lines `A-P, B-Q and C-R`: zero if they belong to one pencil.
    fn lines_in_one_point(&self, lines: &str) -> Option<Vec<f64>> {
        let names: Vec<&str> = lines
            .split([',', ' '])
            .filter(|it| it.contains('-'))
            .collect();
        let coordinates = names.iter().map(|line| {
            let (from, to) = line.split_once('-')?;
            let ([x, y], [x1, y1]) = (*self.places(from).first()?, *self.places(to).first()?);
            let [u, v] = [x1 - x, y1 - y];
            Some([u, v, x * v - y * u])
        });
        let coordinates: Vec<[f64; 3]> = coordinates.collect::<Option<_>>()?;
        let [a, b, c] = coordinates.try_into().ok()?;
        Some(vec![Matrix3::from([a, b, c]).determinant()])
    }

    /// Quantities that vanish by a sentence, in every reading of its names; `None` if it names no points.
    fn measures(&self, sentence: &str) -> Option<Vec<f64>> {
        let vectors = |text: &str| -> Option<Vec<[f64; 2]>> {
            let origin = text.strip_prefix("the line from ");
            let (from, to) = match origin {
                Some(rest) => rest.split_once(" to ")?,
                None => text.split_once('-')?,
            };
            let mut differences = Vec::new();
            for a in self.places(from) {
                for b in self.places(to) {
                    differences.push([b[0] - a[0], b[1] - a[1]]);
                }
            }
            (!differences.is_empty()).then_some(differences)
        };
        let pairs = |one: &str, other: &str, measure: fn([f64; 2], [f64; 2]) -> f64| {
            let (one, other) = (vectors(one)?, vectors(other)?);
            let all = one
                .iter()
                .flat_map(|a| other.iter().map(move |b| measure(*a, *b)));
            Some(all.collect())
        };
        let single = |text: &str, axis: usize| {
            let components = vectors(text)?;
            Some(components.into_iter().map(|it| it[axis]).collect())
        };
        if let Some(lines) = sentence.strip_suffix(" meet in one point or are parallel") {
            return self.lines_in_one_point(lines.strip_prefix("the lines ")?);
        }
        if let Some(links) = sentence.strip_suffix(" are collinear") {
            let (one, other) = links.split_once(" and ")?;
            return pairs(one, other, |a, b| a[0] * b[1] - a[1] * b[0]);
        }
        if let Some(lines) = sentence.strip_prefix("the lines ") {
            let (one, other) = lines.strip_suffix(" are parallel")?.split_once(" and ")?;
            return pairs(one, other, |a, b| {
                (a[0] * b[1] - a[1] * b[0]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]))
            });
        }
        if let Some((link, line)) = sentence.split_once(" is perpendicular to the line ") {
            return pairs(link, line, |a, b| {
                (a[0] * b[0] + a[1] * b[1]) / b[0].hypot(b[1])
            });
        }
        if let Some(points) = sentence.strip_suffix(" coincide") {
            let (one, other) = points.split_once(" and ")?;
            let pair = vectors(&format!("{one}-{other}"))?;
            return Some(pair.into_iter().map(|it| it[0].hypot(it[1])).collect());
        }
        if let Some(link) = sentence.strip_suffix(" is parallel to the x axis") {
            return single(link, 1);
        }
        if let Some(link) = sentence.strip_suffix(" is parallel to the y axis") {
            return single(link, 0);
        }
        None
    }
}

/// Checks every mechanism of the repository and of the tests, at random times of its motion, in the branches of the
/// design configuration.
#[test]
fn quantities_reported_to_vanish_are_the_determinant() {
    let (mut checked, mut silent) = (0, Vec::new());
    for name in description::whole().into_iter().chain(description::small()) {
        let solved = Interpreted::new(&description::system(&name)).expect("a plan");
        let laws = solved.input_laws();
        for pose in solved.singular_poses() {
            let Some(sentence) = &pose.meaning else {
                continue;
            };
            let part = &solved.program().forms[pose.block][pose.part];
            let mut draft = solved.pool().draft();
            let evaluated = part.determinant(&mut draft);
            let order = evaluated.jacobian.len();
            let entries = match evaluated.value {
                Some(value) => vec![value],
                None => evaluated.jacobian.concat(),
            };
            let determinant = Reader::new(&draft.graph, solved.layout(), &entries);
            let mut random = Random::new(11);
            let mut seen = 0;
            for _ in 0..20 {
                let t = random.between(0.0, 2.0);
                let parameters = solved.nominal_parameters();
                let assembled = Shell::assemble(
                    solved.clone(),
                    &parameters,
                    &solved.drawn_pose(&parameters),
                    solved.drawn_branches(),
                    t,
                    &laws.at(t),
                    Settings::default(),
                );
                let Ok(shell) = assembled else { continue };
                let points = Points {
                    solved: &solved,
                    instant: shell.frame(),
                };
                let Some(said) = points.measures(sentence) else {
                    continue;
                };
                let entries = determinant.values(shell.frame());
                let expected = match evaluated.value {
                    Some(_) => entries[0].abs(),
                    None => DMatrix::from_row_slice(order, order, &entries)
                        .determinant()
                        .abs(),
                };
                let is_said = said
                    .iter()
                    .any(|it| (it.abs() - expected).abs() < 1e-9 * (1.0 + expected));
                assert!(
                    is_said,
                    "{name}: {sentence}: {said:?} instead of {expected} at {t}"
                );
                seen += 1;
            }
            match seen {
                0 => silent.push(format!("{name}: {sentence}")),
                _ => checked += 1,
            }
        }
    }
    for sentence in &silent {
        println!("names no points: {sentence}");
    }
    println!("sentences checked: {checked}");
    assert!(checked >= 60, "only {checked} sentences");
}
