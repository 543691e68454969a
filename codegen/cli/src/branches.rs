//! *A System and wishes like `phi2=other` → the pose that is assembled so.*
//!
//! The blocks of the solved view are evaluated one after the other, as the generated module does it, but for positions
//! alone: the result is an estimate of all coordinates from which the textbook view is assembled. The module does not
//! follow the motion from there.

use std::cell::RefCell;

use linkwright::closed_form::angle_near;
use linkwright::{Branch, Equations, Settings, assemble_from_afar, branch_of};
use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::program::Constants;
use linkwright_codegen::program::solved::{Action, Level, NewtonBlock, SolvedProgram, lower};
use linkwright_codegen::structure;
use linkwright_codegen::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

/// From how many poses at random another mode than that of the drawing is looked for.
const STARTS: u32 = 200;

/// How far these poses are from the drawing at most: half a turn, and this many characteristic lengths.
const SCATTER: f64 = std::f64::consts::PI;

/// A reproducible sequence of numbers in [-1, 1) (xorshift64*, Vigna 2016).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Which assembly mode is wanted of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wish {
    Sign(Branch),
    /// The one in which the loop is not drawn.
    Other,
}

/// The pose at time `t` (s) with every loop in its drawn mode, but for those that `wishes` name: `LOOP=positive`,
/// `LOOP=negative` or `LOOP=other`.
///
/// # Errors
/// A sentence where a wish cannot be read, names no loop, or cannot be met.
pub fn assembled(system: &System, t: f64, wishes: &[String]) -> Result<DVector<f64>, String> {
    let mut system = system.clone();
    // What nothing asks for is part of the pose too.
    system.mechanism.requests.clear();
    let plan = structure::plan(&mut system)
        .ok_or_else(|| "the mechanism is not solved loop by loop".to_string())?;
    let program = lower(&mut system, &plan, &mut Constants::default());
    let wishes = read(&program, wishes)?;
    let system = &system;
    let mut values = start(system, t);
    for branch in &program.branches {
        let drawn = sign_of(branch.positive);
        let chosen = match wish(&wishes, &branch.name) {
            Some(Wish::Sign(sign)) => sign,
            Some(Wish::Other) => drawn.opposite(),
            None => drawn,
        };
        values[branch.symbol.index()] = chosen.sign();
    }
    for block in &program.blocks {
        let positions = block
            .actions
            .iter()
            .take_while(|action| **action != Action::Section(Level::Velocity));
        for action in positions {
            match &block.newton {
                Some(newton) if *action == Action::Newton => {
                    let wish = wish(&wishes, &block.name);
                    iterate(system, newton, wish, t, &mut values)
                        .map_err(|what| format!("{}: {what}", block.spoken))?;
                }
                _ => evaluate(system, action, &mut values)
                    .map_err(|what| format!("{}: {what}", block.spoken))?,
            }
        }
    }
    let pose = system.coordinates.iter();
    let pose: Vec<f64> = pose.map(|it| values[it.position.index()]).collect();
    Ok(DVector::from_vec(pose))
}

/// The names of the loops that have more than one assembly mode, in solve order.
fn names(program: &SolvedProgram) -> Vec<&str> {
    let closed = program.branches.iter().map(|branch| branch.name.as_str());
    let iterated = program
        .blocks
        .iter()
        .filter(|block| block.newton.is_some())
        .map(|block| block.name.as_str());
    closed.chain(iterated).collect()
}

fn wish(wishes: &[(String, Wish)], name: &str) -> Option<Wish> {
    let found = wishes.iter().find(|(wanted, _)| wanted == name);
    found.map(|(_, wish)| *wish)
}

fn read(program: &SolvedProgram, wishes: &[String]) -> Result<Vec<(String, Wish)>, String> {
    let known = names(program);
    let mut found: Vec<(String, Wish)> = Vec::new();
    for text in wishes {
        let Some((name, mode)) = text.split_once('=') else {
            return Err(format!(
                "`{text}` is not of the form LOOP=positive, LOOP=negative or LOOP=other"
            ));
        };
        if !known.contains(&name) {
            let list = match known.as_slice() {
                [] => "every loop can be assembled in one way only".to_string(),
                known => format!("the loops with several modes are: {}", known.join(", ")),
            };
            let guess = nearest(name, known.iter().copied())
                .map_or(String::new(), |guess| format!("; did you mean `{guess}`?"));
            return Err(format!("no loop is named `{name}`{guess}\n  {list}"));
        }
        let modes = ["positive", "negative", "other"];
        let wish = match mode {
            "positive" => Wish::Sign(Branch::Positive),
            "negative" => Wish::Sign(Branch::Negative),
            "other" => Wish::Other,
            _ => {
                let guess = nearest(mode, modes)
                    .map_or(String::new(), |guess| format!("; did you mean `{guess}`?"));
                return Err(format!(
                    "no assembly mode is named `{mode}`{guess}\n  the modes are: {}",
                    modes.join(", ")
                ));
            }
        };
        if found.iter().any(|(taken, _)| taken == name) {
            return Err(format!("the mode of `{name}` is chosen twice"));
        }
        found.push((name.to_string(), wish));
    }
    Ok(found)
}

fn sign_of(positive: bool) -> Branch {
    match positive {
        true => Branch::Positive,
        false => Branch::Negative,
    }
}

/// A value per symbol: the drawing, at time `t`.
fn start(system: &System, t: f64) -> Vec<f64> {
    let graph = &system.mechanism.graph;
    let mut values = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut values);
    values[system.mechanism.time.index()] = t;
    let inputs = &system.mechanism.inputs;
    let signals: Vec<ExprId> = inputs.iter().flat_map(|input| input.signal).collect();
    let mut results = vec![0.0; signals.len()];
    Tape::new(graph, &signals).evaluate(&values, &mut Vec::new(), &mut results);
    let symbols = inputs.iter().flat_map(|input| input.symbols);
    for (symbol, value) in symbols.zip(results) {
        values[symbol.index()] = value;
    }
    for unknown in &system.vector_form.unknowns {
        let drawn = graph.constant_value(unknown.estimate);
        values[unknown.position.index()] = drawn.unwrap_or(f64::NAN);
    }
    values
}

/// Does what an action of a closed form does with the values.
fn evaluate(system: &System, action: &Action, values: &mut [f64]) -> Result<(), String> {
    let graph = &system.mechanism.graph;
    let roots = action.values();
    let mut results = vec![0.0; roots.len()];
    Tape::new(graph, &roots).evaluate(values, &mut Vec::new(), &mut results);
    match (action, results.as_slice()) {
        (Action::Let { target, .. }, &[value]) => values[target.index()] = value,
        (Action::SineCosine { sine, cosine, .. }, &[angle]) => {
            values[sine.index()] = angle.sin();
            values[cosine.index()] = angle.cos();
        }
        (Action::Angle { unknown, .. }, &[sine, cosine]) => {
            let place = system.vector_form.unknowns[*unknown].position.index();
            values[place] = angle_near(sine, cosine, values[place]);
        }
        (Action::Reach { .. }, &[excess, _, distance, longest, shortest]) => {
            // Written so that NaN is refused too.
            let reaches = excess > 0.0;
            if !reaches {
                let by = (distance - longest).max(shortest.abs() - distance);
                return Err(format!("out of reach by {by:.1e} m"));
            }
        }
        _ => {}
    }
    Ok(())
}

/// Finds the tears of a block without a closed form.
fn iterate(
    system: &System,
    newton: &NewtonBlock,
    wish: Option<Wish>,
    t: f64,
    values: &mut [f64],
) -> Result<(), String> {
    let graph = &system.mechanism.graph;
    let unknowns = || {
        newton
            .unknowns
            .iter()
            .map(|&it| &system.vector_form.unknowns[it])
    };
    let equations = Block {
        system,
        newton,
        places: unknowns().map(|it| it.position).collect(),
        row_scales: newton
            .quantities
            .iter()
            .map(|&it| system.scale(it))
            .collect(),
        column_scales: unknowns().map(|it| system.scale(it.quantity)).collect(),
        residual: Tape::new(graph, &newton.residuals),
        jacobian: Tape::new(graph, &newton.jacobian),
        values: RefCell::new(values.to_vec()),
    };
    let drawn = equations.places.iter().map(|it| values[it.index()]);
    let drawn = DVector::from_vec(drawn.collect());
    let settings = Settings::default();
    let near = |start: &DVector<f64>, branch| {
        let found = assemble_from_afar(&equations, start, branch, t, &settings);
        found.map_err(|failure| failure.to_string())
    };
    let wanted = match wish {
        None => None,
        Some(Wish::Sign(sign)) => Some(sign),
        Some(Wish::Other) => {
            let here = near(&drawn, None)?;
            let sign = branch_of(&equations, &here.q, t, &settings);
            Some(sign.map_err(|failure| failure.to_string())?.opposite())
        }
    };
    let mut found = near(&drawn, wanted);
    // The drawing may be far from every pose of another mode.
    let mut random = Random(1);
    for _ in 0..STARTS {
        if wanted.is_none() || found.is_ok() {
            break;
        }
        let scattered = equations.column_scales.iter().zip(&drawn);
        let scattered = scattered.map(|(scale, drawn)| drawn + SCATTER * scale * random.next());
        found = near(&DVector::from_iterator(drawn.len(), scattered), wanted);
    }
    let found = found?;
    for (symbol, value) in equations.places.iter().zip(found.q.iter()) {
        values[symbol.index()] = *value;
    }
    Ok(())
}

/// The equations of a block for its tears, at one time. Rates are not asked for: they are all zero.
struct Block<'a> {
    system: &'a System,
    newton: &'a NewtonBlock,
    places: Vec<SymbolId>,
    row_scales: Vec<f64>,
    column_scales: Vec<f64>,
    residual: Tape,
    jacobian: Tape,
    values: RefCell<Vec<f64>>,
}

impl Block<'_> {
    fn results(&self, tape: &Tape, q: &DVector<f64>, count: usize) -> Vec<f64> {
        let mut values = self.values.borrow_mut();
        for (symbol, value) in self.places.iter().zip(q.iter()) {
            values[symbol.index()] = *value;
        }
        for action in &self.newton.geometry {
            // The geometry of tears is made of sines, cosines and arms, none of which fails.
            if evaluate(self.system, action, &mut values).is_err() {
                return vec![f64::NAN; count];
            }
        }
        let mut results = vec![0.0; count];
        tape.evaluate(&values, &mut Vec::new(), &mut results);
        results
    }
}

impl Equations<f64, Dyn> for Block<'_> {
    fn dimension(&self) -> Dyn {
        Dyn(self.places.len())
    }

    fn residual(&self, q: &DVector<f64>, _t: f64, phi: &mut DVector<f64>) {
        phi.copy_from_slice(&self.results(&self.residual, q, q.len()));
    }

    fn jacobian(&self, q: &DVector<f64>, _t: f64, phi_q: &mut DMatrix<f64>) {
        let rows = self.results(&self.jacobian, q, q.len() * q.len());
        phi_q.copy_from(&DMatrix::from_row_slice(q.len(), q.len(), &rows));
    }

    fn time_derivative(&self, _q: &DVector<f64>, _t: f64, phi_t: &mut DVector<f64>) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, _q: &DVector<f64>, _qd: &DVector<f64>, _t: f64, gamma: &mut DVector<f64>) {
        gamma.fill(0.0);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.row_scales.get(row).copied().unwrap_or(1.0)
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.column_scales.get(column).copied().unwrap_or(1.0)
    }
}
