//! Bounds of functions of time and unknowns along a chord through two frames.
//!
//! Every bound is computed in intervals that are rounded outwards, from expressions with the numbers of the description: whatever is not
//! defined, or not known here, has no bounds.

use linkwright_codegen::stages::assemblies::{Enclosed, Enclosing, Interval};
use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::system::System;

/// A chord: unknowns are c + d s at the time t_c + h s, where s goes from about −1 to 1.
#[derive(Clone, Debug)]
pub(super) struct Chord {
    /// t_c and h (s).
    pub time: [f64; 2],
    /// c and d of each unknown.
    pub line: Vec<[f64; 2]>,
    /// All s of the window.
    pub range: Interval,
}

/// Functions of time and of the unknowns of the vector form.
#[derive(Clone, Debug)]
pub(super) struct Functions {
    /// Value and first derivative by s of each.
    taylor: Enclosed,
    /// Its second derivative by s.
    second: Enclosed,
    /// Its derivatives by the unknowns that it mentions.
    gradient: Enclosed,
    /// These unknowns.
    pub mentioned: Vec<Vec<usize>>,
}

/// What functions are made of, in a system of its own that may grow.
pub(super) struct Writing {
    system: System,
    /// s, t_c and h, then c of all unknowns, then d.
    symbols: Vec<SymbolId>,
    /// What stands for inputs and for directions.
    given: Vec<(SymbolId, ExprId)>,
}

impl Writing {
    /// Functions of this system with nominal parameters and the inputs that their laws give.
    pub fn new(mut system: System) -> Writing {
        let zero = system.mechanism.graph.zero();
        let directions = system.directions.iter();
        let directions = directions.filter(|direction| !direction.is_parameter());
        let mut given: Vec<(SymbolId, ExprId)> = directions.map(|it| (it.symbol, zero)).collect();
        for input in &system.mechanism.inputs {
            given.extend(input.symbols.into_iter().zip(input.signal));
        }
        let names = ["s", "middle", "half"].map(|it| format!("chord {it}"));
        let count = system.vector_form.unknowns.len();
        let unknowns = ["at", "along"].into_iter();
        let unknowns = unknowns.flat_map(|it| (0..count).map(move |k| format!("chord {it} {k}")));
        let names: Vec<String> = names.into_iter().chain(unknowns).collect();
        let graph = &mut system.mechanism.graph;
        let symbols = names.iter().map(|name| graph.symbol(name)).collect();
        Writing {
            system,
            symbols,
            given,
        }
    }

    /// An expression of time and unknowns alone: without arms, inputs and directions.
    fn written(&mut self, expr: ExprId) -> ExprId {
        let graph = &mut self.system.mechanism.graph;
        let expr = self.system.vector_form.written_out(expr, graph);
        graph.substitute(expr, &self.given)
    }

    /// `unknown − value`.
    pub fn definition(&mut self, unknown: usize, value: ExprId) -> ExprId {
        let position = self.system.vector_form.unknowns[unknown].position;
        let graph = &mut self.system.mechanism.graph;
        let variable = graph.variable(position);
        graph.subtract(variable, value)
    }

    /// The functions that these expressions are.
    pub fn functions(&mut self, expressions: &[ExprId]) -> Functions {
        let expressions: Vec<ExprId> = expressions.iter().map(|&it| self.written(it)).collect();
        let positions: Vec<SymbolId> = {
            let unknowns = self.system.vector_form.unknowns.iter();
            unknowns.map(|it| it.position).collect()
        };
        let time = self.system.mechanism.time;
        let graph = &mut self.system.mechanism.graph;
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
            let own = line(variables[3 + place], variables[3 + count + place]);
            lines.push((position, own));
        }
        let (mut taylor, mut second) = (Vec::new(), Vec::new());
        let (mut gradient, mut mentioned) = (Vec::new(), Vec::new());
        for &expr in &expressions {
            let own = |unknown: &usize| graph.depends_on(expr, positions[*unknown]);
            let own: Vec<usize> = (0..count).filter(own).collect();
            gradient.extend(own.iter().map(|&it| graph.derivative(expr, positions[it])));
            mentioned.push(own);
            let along = graph.substitute(expr, &lines);
            let first = graph.derivative(along, self.symbols[0]);
            taylor.extend([along, first]);
            second.push(graph.derivative(first, self.symbols[0]));
        }
        let plain: Vec<SymbolId> = std::iter::once(time).chain(positions).collect();
        Functions {
            taylor: self.enclosed(&self.symbols, &taylor),
            second: self.enclosed(&self.symbols, &second),
            gradient: self.enclosed(&plain, &gradient),
            mentioned,
        }
    }

    fn enclosed(&self, arguments: &[SymbolId], expressions: &[ExprId]) -> Enclosed {
        let graph = &self.system.mechanism.graph;
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
    /// The chord from one frame to a later one.
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

    /// The chord that is a single frame.
    pub fn at(t: f64, pose: &[f64]) -> Chord {
        Chord {
            time: [t, 0.0],
            line: pose.iter().map(|&value| [value, 0.0]).collect(),
            range: Interval::point(0.0),
        }
    }

    /// An unknown on the line at these s.
    pub fn unknown(&self, unknown: usize, s: Interval) -> Interval {
        let [at, along] = self.line[unknown];
        Interval::point(at).plus(Interval::point(along).times(s))
    }

    /// Where a time lies on it.
    pub fn place(&self, t: f64) -> Interval {
        place(t, self.time[0], self.time[1])
    }

    /// The arguments of functions along it at these s.
    pub fn arguments(&self, s: Interval) -> Vec<Interval> {
        let time = self.time.map(Interval::point);
        let starts = self.line.iter().map(|it| Interval::point(it[0]));
        let changes = self.line.iter().map(|it| Interval::point(it[1]));
        let given = std::iter::once(s).chain(time);
        given.chain(starts).chain(changes).collect()
    }

    /// The times of the window.
    pub fn times(&self) -> Interval {
        let [middle, half] = self.time.map(Interval::point);
        middle.plus(half.times(self.range))
    }
}

/// s at a time.
fn place(t: f64, middle: f64, half: f64) -> Interval {
    let off = Interval::point(t).minus(Interval::point(middle));
    off.times(Interval::point(half).reciprocal())
}

impl Functions {
    /// The values along the line itself; `arguments` are those of the chord at 0, and over its range.
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

    /// The derivatives of each by the unknowns that it mentions, at these times and unknowns.
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

    /// How many there are.
    pub fn count(&self) -> usize {
        self.mentioned.len()
    }
}

/// Whether bounds say anything.
pub(super) fn is_bounded(value: Interval) -> bool {
    value.defined && value.low.is_finite() && value.high.is_finite() && !value.is_empty()
}

/// The largest size of what lies in it.
pub(super) fn magnitude(value: Interval) -> f64 {
    value.low.abs().max(value.high.abs())
}
