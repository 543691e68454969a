//! Searches for windows that cover a range of time, with frames that join them.
//!
//! Every window that is kept is verified, and contains both of its frames.

use linkwright::{Blocks, Shell};

use super::claims::{Bounds, Claims};
use super::functions::{self, Chord, Writing};
use super::window::{Cause, Cell, Verified, cells, verify};
use super::{Proof, Unproven};
use crate::checked_part::CheckedPart;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measures::measured;
use crate::supplied::{InputLaws, Modes};
use crate::view::View;

/// Largest number of windows.
const MOST_WINDOWS: usize = 200_000;

/// Largest number of halvings of a window.
const HALVED: u32 = 20;

/// Frame, and its verification.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub instant: Instant,
    modes: Modes,
    pub verified: Verified,
}

/// Proven window.
#[derive(Clone, Debug)]
pub(super) struct Window {
    /// Indices of its frames among the nodes.
    pub ends: [usize; 2],
    halved: u32,
    pub bounds: Vec<Bounds>,
}

/// State of the search.
pub(super) struct Prover<'a> {
    interpreted: &'a Interpreted,
    laws: InputLaws,
    shell: Shell<Interpreted>,
    slots: Vec<usize>,
    cells: Vec<Cell>,
    pub claims: Claims,
    pub nodes: Vec<Node>,
}

impl<'a> Prover<'a> {
    pub fn new(
        interpreted: &'a Interpreted,
        start: f64,
        parts: &[CheckedPart],
        points: &[usize],
    ) -> Result<Prover<'a>, Unproven> {
        let nowhere = |reason: String| Unproven {
            window: [start; 2],
            block: None,
            reason,
        };
        let laws = interpreted.input_laws();
        let parameters = interpreted.nominal_parameters();
        let shell = Shell::assemble(
            interpreted.clone(),
            &parameters,
            &interpreted.drawn_pose(&parameters),
            interpreted.drawn_branches(),
            start,
            &laws.at(start),
            Default::default(),
        );
        let shell = shell.map_err(|failure| nowhere(interpreted.not_assembled(&failure)))?;
        let system = interpreted.system();
        let mut draft = interpreted.pool().draft();
        let (plan, program) = (interpreted.plan(), interpreted.program());
        let measured = measured(&mut draft, system, plan, program);
        let mut writing = Writing::new(draft, system);
        let cells = cells(interpreted.plan(), &mut writing)
            .ok_or_else(|| nowhere("its equations are not solved one after another".to_string()))?;
        let claims = Claims::new(interpreted, measured, parts, points, &mut writing);
        let unknowns = system.vector_form.unknowns.iter();
        let slots = unknowns.map(|it| interpreted.layout().slot(it.position));
        let slots: Option<Vec<usize>> = slots.collect();
        Ok(Prover {
            slots: slots.ok_or_else(|| nowhere("frames lack an unknown".to_string()))?,
            laws,
            shell,
            cells,
            claims,
            nodes: Vec::new(),
            interpreted,
        })
    }

    pub fn time(&self, node: usize) -> f64 {
        self.nodes[node].instant.t()
    }

    fn pose(&self, instant: &Instant) -> Vec<f64> {
        let slots = self.slots.iter();
        slots.map(|&slot| instant.values()[slot]).collect()
    }

    fn unproven(&self, window: [f64; 2], cause: Cause) -> Unproven {
        let (block, reason) = match cause {
            Cause::Unbounded(block) => (
                block,
                "its equations have no bounds there, as with tables, whole parts, and pieces of a law that meet in the window",
            ),
            Cause::NotAlone(block) => (
                block,
                "its equations cannot be proven to have one solution near the frames",
            ),
        };
        Unproven {
            window,
            block: Some(block),
            reason: reason.to_string(),
        }
    }

    /// Verifies the current frame of the mechanism.
    pub fn node(&mut self) -> Result<usize, Unproven> {
        let instant = self.shell.frame().clone();
        let t = instant.t();
        let pose = self.pose(&instant);
        let least = vec![0.0; pose.len()];
        let verified = verify(&self.cells, Chord::at(t, &pose), &least);
        let verified = verified.map_err(|cause| self.unproven([t; 2], cause))?;
        self.nodes.push(Node {
            instant,
            modes: self.shell.branches().clone(),
            verified,
        });
        Ok(self.nodes.len() - 1)
    }

    /// Verifies the frame at a time (s), reached from an earlier one.
    fn node_at(&mut self, from: usize, t: f64) -> Result<usize, Unproven> {
        let Node { instant, modes, .. } = &self.nodes[from];
        let inputs = self.laws.at(instant.t());
        self.shell.resume(instant, modes, &inputs);
        if let Err(failure) = self.shell.advance(t, &self.laws.at(t)) {
            let from = self.time(from);
            return Err(Unproven {
                window: [from, t],
                block: Some(usize::from(failure.block)),
                reason: self.interpreted.ended(&failure, self.shell.frame()),
            });
        }
        let near = self.time(from);
        self.node().map_err(|unproven| Unproven {
            window: [near.min(t), near.max(t)],
            ..unproven
        })
    }

    /// Covers the time from a frame to another time (s) by windows.
    pub fn cover(
        &mut self,
        from: usize,
        t: f64,
        windows: &mut Vec<Window>,
        proof: &mut Proof,
    ) -> Result<(), Unproven> {
        // Nearer times come last.
        let mut open = vec![(t, 0)];
        let mut from = from;
        while let Some((t, halved)) = open.pop() {
            let tried = self.try_window(from, t, halved);
            match tried {
                Ok(window) => {
                    from = window.ends[1];
                    windows.push(window);
                }
                Err(unproven) => {
                    let near = self.time(from);
                    let middle = near + 0.5 * (t - near);
                    let is_last = halved >= HALVED || middle <= near || middle >= t;
                    if is_last || windows.len() >= MOST_WINDOWS {
                        proof.note(windows, self);
                        return Err(unproven);
                    }
                    open.push((t, halved + 1));
                    open.push((middle, halved + 1));
                }
            }
        }
        Ok(())
    }

    fn try_window(&mut self, from: usize, t: f64, halved: u32) -> Result<Window, Unproven> {
        let to = self.node_at(from, t)?;
        let window = self.window([from, to], halved);
        if window.is_err() {
            self.nodes.pop();
        }
        window
    }

    /// Verifies the window between two verified frames.
    fn window(&self, ends: [usize; 2], halved: u32) -> Result<Window, Unproven> {
        let [first, last] = ends.map(|end| &self.nodes[end]);
        let times = [first, last].map(|it| it.instant.t());
        let poses = [first, last].map(|it| self.pose(&it.instant));
        let off = first.verified.off.iter().zip(&last.verified.off);
        let rounded = poses[0].iter().zip(&poses[1]);
        let least = off.zip(rounded).map(|((a, b), (from, to))| {
            let off = functions::magnitude(*a).max(functions::magnitude(*b));
            4.0 * off + 16.0 * f64::EPSILON * from.abs().max(to.abs())
        });
        let least: Vec<f64> = least.collect();
        let chord = Chord::between(times, [&poses[0], &poses[1]]);
        let verified = verify(&self.cells, chord, &least);
        let verified = verified.map_err(|cause| self.unproven(times, cause))?;
        if !(verified.holds(&first.verified) && verified.holds(&last.verified)) {
            return Err(Unproven {
                window: times,
                block: None,
                reason: "its solution cannot be proven to pass through both frames".to_string(),
            });
        }
        Ok(Window {
            bounds: self.claims.bounds(&verified),
            ends,
            halved,
        })
    }

    /// Halves windows until every bound is within its limit.
    pub fn narrowed(
        &mut self,
        mut windows: Vec<Window>,
        proof: &mut Proof,
    ) -> Result<Vec<Window>, Unproven> {
        loop {
            let limits = self.claims.limits(&self.nodes, &windows);
            let is_narrow = |window: &Window| {
                let mut bounds = window.bounds.iter().zip(&limits);
                bounds.all(|(bounds, limit)| limit.holds(*bounds))
            };
            let narrow: Vec<bool> = windows.iter().map(is_narrow).collect();
            let wide = narrow.iter().filter(|it| !**it).count();
            if wide == 0 {
                return Ok(windows);
            }
            let mut all = Vec::with_capacity(windows.len() + wide);
            for (window, is_narrow) in windows.into_iter().zip(narrow) {
                if is_narrow {
                    all.push(window);
                    continue;
                }
                let [from, to] = window.ends;
                let [near, far] = [from, to].map(|it| self.time(it));
                let middle = near + 0.5 * (far - near);
                if window.halved >= HALVED || middle <= near || middle >= far {
                    proof.note(&all, self);
                    return Err(Unproven {
                        window: [near, far],
                        block: None,
                        reason: "its bounds do not become narrow enough".to_string(),
                    });
                }
                if all.len() >= MOST_WINDOWS {
                    proof.note(&all, self);
                    return Err(Unproven {
                        window: [near, far],
                        block: None,
                        reason: format!("more than {MOST_WINDOWS} windows would be needed"),
                    });
                }
                let node = self.node_at(from, middle)?;
                for ends in [[from, node], [node, to]] {
                    all.push(self.window(ends, window.halved + 1)?);
                }
            }
            windows = all;
        }
    }
}
