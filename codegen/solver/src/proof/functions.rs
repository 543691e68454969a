//! Bounds functions of time and unknowns along a chord through two frames.
//!
//! Every bound is computed in intervals that are rounded outwards, from expressions with the numbers of the description. An undefined or
//! unknown value is unbounded.

use linkwright_codegen::stages::assemblies::{Enclosed, Enclosing, Interval};
use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::pool::Draft;
use linkwright_codegen::stages::system::System;

/// Chord: unknowns are c + d s at the time t_c + h s, where s goes from about −1 to 1.
#[derive(Clone, Debug)]
pub(super) struct Chord {
    /// t_c and h (s).
    pub time: [f64; 2],
    /// c and d of each unknown.
    pub line: Vec<[f64; 2]>,
    /// Range of s in the window.
    pub range: Interval,
}

/// Functions of time and of the unknowns of the vector form.
#[derive(Clone, Debug)]
pub(super) struct Functions {
    /// Values and first derivatives by s.
    taylor: Enclosed,
    /// Second derivatives by s.
    second: Enclosed,
    /// Values at times and unknowns.
    direct: Enclosed,
    /// Derivatives by the unknowns that each function mentions.
    gradient: Enclosed,
    /// Unknowns that each function mentions.
    pub mentioned: Vec<Vec<usize>>,
}

/// Symbols and expressions of functions, in a draft.
pub(super) struct Writing<'a> {
    pool: Draft,
    system: &'a System,
    /// s, t_c and h, then c of all unknowns, then d.
    symbols: Vec<SymbolId>,
    /// Expressions that replace inputs and directions.
    given: Vec<(SymbolId, ExprId)>,
}

impl<'a> Writing<'a> {
    /// Creates functions of this system with nominal parameters and the inputs of their laws.
    pub fn new(mut pool: Draft, system: &'a System) -> Writing<'a> {
        let zero = pool.graph.zero();
        let directions = system.directions.iter();
        let directions = directions.filter(|direction| !direction.is_parameter());
        let mut replacements: Vec<(SymbolId, ExprId)> =
            directions.map(|it| (it.symbol, zero)).collect();
        for input in &system.mechanism.inputs {
            replacements.extend(input.symbols.into_iter().zip(input.signal));
        }
        let names = ["s", "middle", "half"].map(|it| format!("chord {it}"));
        let count = system.vector_form.unknowns.len();
        let unknowns = ["at", "along"].into_iter();
        let unknowns = unknowns.flat_map(|it| (0..count).map(move |k| format!("chord {it} {k}")));
        let names: Vec<String> = names.into_iter().chain(unknowns).collect();
        let graph = &mut pool.graph;
        let symbols = names.iter().map(|name| graph.symbol(name)).collect();
        Writing {
            pool,
            system,
            symbols,
            given: replacements,
        }
    }

    /// Returns an expression in time and unknowns alone: without rotated local vectors, inputs and directions.
    fn written(&mut self, expr: ExprId) -> ExprId {
        let expr = self.pool.written_out(expr);
        self.pool.graph.substitute(expr, &self.given)
    }

    /// Returns a measure without symbols of its definitions.
    pub fn without_definitions(&mut self, measure: ExprId) -> ExprId {
        let measures = &self.system.measures;
        measures.expanded(measure, &mut self.pool.graph)
    }

    /// Returns `unknown − value`.
    pub fn definition(&mut self, unknown: usize, value: ExprId) -> ExprId {
        let position = self.system.vector_form.unknowns[unknown].position;
        let graph = &mut self.pool.graph;
        let variable = graph.variable(position);
        graph.subtract(variable, value)
    }

    /// Returns the functions of these expressions.
    pub fn functions(&mut self, expressions: &[ExprId]) -> Functions {
        let expressions: Vec<ExprId> = expressions.iter().map(|&it| self.written(it)).collect();
        let positions: Vec<SymbolId> = {
            let unknowns = self.system.vector_form.unknowns.iter();
            unknowns.map(|it| it.position).collect()
        };
        let time = self.system.mechanism.time;
        let graph = &mut self.pool.graph;
        let count = positions.len();
        let variables: Vec<ExprId> = {
            let symbols = self.symbols.iter();
            symbols.map(|&symbol| graph.variable(symbol)).collect()
        };
        let mut line = |start: ExprId, along: ExprId| {
            let moved = graph.multiply(along, variables[0]);
            graph.add(start, moved)
        };
        let mut lines = vec![(time, line(variables[1], variables[2]))];
        for (place, &position) in positions.iter().enumerate() {
            let chord_of_unknown = line(variables[3 + place], variables[3 + count + place]);
            lines.push((position, chord_of_unknown));
        }
        let (mut taylor, mut second) = (Vec::new(), Vec::new());
        let (mut gradient, mut mentioned) = (Vec::new(), Vec::new());
        for &expr in &expressions {
            let is_mentioned = |unknown: &usize| graph.depends_on(expr, positions[*unknown]);
            let unknowns: Vec<usize> = (0..count).filter(is_mentioned).collect();
            gradient.extend(
                unknowns
                    .iter()
                    .map(|&it| graph.derivative(expr, positions[it])),
            );
            mentioned.push(unknowns);
            let along = graph.substitute(expr, &lines);
            let first = graph.derivative(along, self.symbols[0]);
            taylor.extend([along, first]);
            second.push(graph.derivative(first, self.symbols[0]));
        }
        let plain: Vec<SymbolId> = std::iter::once(time).chain(positions).collect();
        Functions {
            taylor: self.enclosed(&self.symbols, &taylor),
            second: self.enclosed(&self.symbols, &second),
            direct: self.enclosed(&plain, &expressions),
            gradient: self.enclosed(&plain, &gradient),
            mentioned,
        }
    }

    fn enclosed(&self, arguments: &[SymbolId], expressions: &[ExprId]) -> Enclosed {
        let graph = &self.pool.graph;
        let mut enclosing = Enclosing::new(graph, arguments);
        for parameter in &self.system.mechanism.parameters {
            if let Some(value) = graph.nominal(parameter.symbol) {
                enclosing.know(parameter.symbol, Interval::about(value));
            }
        }
        let results = expressions.iter().map(|&it| enclosing.value(it)).collect();
        enclosing.finish(results)
    }
}

impl Chord {
    /// Returns the chord from one frame to a later one.
    pub fn between(times: [f64; 2], poses: [&[f64]; 2]) -> Chord {
        let middle = times[0] + 0.5 * (times[1] - times[0]);
        let half = 0.5 * (times[1] - times[0]);
        let [first, last] = times.map(|t| place(t, middle, half));
        let lines = poses[0].iter().zip(poses[1]);
        Chord {
            time: [middle, half],
            line: lines
                .map(|(a, b)| [a + 0.5 * (b - a), 0.5 * (b - a)])
                .collect(),
            range: first.hull(last),
        }
    }

    /// Returns the chord of a single frame.
    pub fn at(t: f64, pose: &[f64]) -> Chord {
        Chord {
            time: [t, 0.0],
            line: pose.iter().map(|&value| [value, 0.0]).collect(),
            range: Interval::point(0.0),
        }
    }

    /// Returns an unknown on the chord in a range of s.
    pub fn unknown(&self, unknown: usize, s: Interval) -> Interval {
        let [at, along] = self.line[unknown];
        Interval::point(at).plus(Interval::point(along).times(s))
    }

    /// Returns s at a time.
    pub fn place(&self, t: f64) -> Interval {
        place(t, self.time[0], self.time[1])
    }

    /// Returns the arguments of functions along the chord in a range of s.
    pub fn arguments(&self, s: Interval) -> Vec<Interval> {
        let time = self.time.map(Interval::point);
        let starts = self.line.iter().map(|it| Interval::point(it[0]));
        let changes = self.line.iter().map(|it| Interval::point(it[1]));
        let time_and_s = std::iter::once(s).chain(time);
        time_and_s.chain(starts).chain(changes).collect()
    }

    /// Returns the times of the window.
    pub fn times(&self) -> Interval {
        let [middle, half] = self.time.map(Interval::point);
        middle.plus(half.times(self.range))
    }
}

/// Returns s at a time for the middle and half the length of a window.
fn place(t: f64, middle: f64, half: f64) -> Interval {
    let off = Interval::point(t).minus(Interval::point(middle));
    off.times(Interval::point(half).reciprocal())
}

impl Functions {
    /// Returns the values along the chord; `arguments` are those at s = 0, and over the range.
    pub fn along(&self, chord: &Chord, arguments: [&[Interval]; 2]) -> Vec<Interval> {
        let mut registers = Vec::new();
        let taylor = self.taylor.at(arguments[0], &mut registers);
        let second = self.second.at(arguments[1], &mut registers);
        let half_square = chord.range.power(2).times(Interval::point(0.5));
        let values = taylor.chunks_exact(2).zip(second);
        let value = |(own, second): (&[Interval], Interval)| {
            let first = own[0].plus(own[1].times(chord.range));
            first.plus(second.times(half_square))
        };
        values.map(value).collect()
    }

    /// Returns the values at these times and unknowns.
    pub fn at(&self, at: &[Interval]) -> Vec<Interval> {
        self.direct.at(at, &mut Vec::new())
    }

    /// Returns the derivatives of each function by the unknowns that it mentions, at these times and unknowns.
    pub fn derivatives(&self, at: &[Interval]) -> Vec<Vec<Interval>> {
        let all = self.gradient.at(at, &mut Vec::new());
        let mut rest = all.as_slice();
        let rows = self.mentioned.iter().map(|mentioned| {
            let (own, others) = rest.split_at(mentioned.len());
            rest = others;
            own.to_vec()
        });
        rows.collect()
    }

    /// Number of functions.
    pub fn count(&self) -> usize {
        self.mentioned.len()
    }
}

/// True if both bounds are finite.
pub(super) fn is_bounded(value: Interval) -> bool {
    value.defined && value.low.is_finite() && value.high.is_finite() && !value.is_empty()
}

/// Returns the largest magnitude in an interval.
pub(super) fn magnitude(value: Interval) -> f64 {
    value.low.abs().max(value.high.abs())
}
