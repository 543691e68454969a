//! The parts of the module in their order.

use std::collections::HashSet;

use proc_macro2::{TokenStream, TokenTree};
use quote::quote;

use super::coordinates::{coordinates, frame};
use super::docs::docs;
use super::equations::equations;
use super::expression::identifier;
use super::given::{Given, length_of_parameters, only, structures};
use super::lints;
use super::literal::float;
use super::solved;
use super::solver::{characteristic_length, mechanism, textbook};
use super::tables::tables;
use crate::emit::{Notation, derivation, report, text};
use crate::model::Role;
use crate::program::Program;
use crate::program::solved::{Action, Output};
use crate::system::System;

/// The items of the module of a mechanism or of one of its motions.
pub(super) fn items(system: &System, program: &Program) -> TokenStream {
    let has_newton = program
        .solved
        .iter()
        .flat_map(|solved| &solved.blocks)
        .any(|block| block.newton.is_some());
    let needs_length = has_newton || program.textbook.is_some();
    let mut items = [
        TokenStream::new(),
        TokenStream::new(),
        coordinates(system),
        structures(system, program),
        program
            .textbook
            .as_ref()
            .map(|textbook| equations(system, program, textbook))
            .unwrap_or_default(),
        frame(system, program),
        if needs_length {
            let (length, found) = (
                characteristic_length(system),
                length_of_parameters(system, program),
            );
            quote!(#length #found)
        } else {
            TokenStream::new()
        },
        if program.textbook.is_some() {
            textbook(system)
        } else {
            TokenStream::new()
        },
        solver(system, program),
    ];
    let written = items.iter().cloned().collect();
    let mentioned = identifiers(written);
    let tables = tables(system, &mentioned);
    items[0] = imports(system, program, has_newton, !tables.is_empty());
    let constants = constants(system, program, &mentioned);
    items[1] = quote!(#constants #tables);
    items.into_iter().collect()
}

/// Every identifier of a piece of code.
fn identifiers(code: TokenStream) -> HashSet<String> {
    let mut found = HashSet::new();
    let mut open = vec![code];
    while let Some(tokens) = open.pop() {
        for token in tokens {
            match token {
                TokenTree::Group(group) => open.push(group.stream()),
                TokenTree::Ident(ident) => {
                    found.insert(ident.to_string());
                }
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    found
}

/// The blocks and the type that a user holds; without a solved view the dense system alone.
fn solver(system: &System, program: &Program) -> TokenStream {
    match &program.solved {
        Some(blocks) => {
            let poses = derivation::singular_poses(system, &blocks.plan, Notation::Unicode);
            let branches = solved::branches(system, blocks);
            let newton = solved::newton_blocks(system, program, blocks);
            let functions = solved::blocks(system, program, blocks, &poses);
            let mechanism = solved::mechanism(system, program, blocks);
            let explained = solved::explained(blocks, &poses);
            quote!(#branches #explained #newton #functions #mechanism)
        }
        None => mechanism(system, program),
    }
}

fn imports(system: &System, program: &Program, has_newton: bool, has_tables: bool) -> TokenStream {
    let textbook = program.textbook.iter();
    let functions = textbook.flat_map(|own| {
        [
            &own.residual,
            &own.jacobian,
            &own.time_derivative,
            &own.gamma,
        ]
        .into_iter()
        .chain(&own.monitored)
    });
    let mut straight = functions.chain(&program.points).chain(&program.drawn);
    let calls_math = straight.any(|straight| straight.operations.calls_math());
    let solved_math = program
        .solved
        .iter()
        .flat_map(|solved| solved.report.operations)
        .any(|operations| operations.calls_math());
    let math = if calls_math || solved_math {
        quote!(
            use ::linkwright::math;
        )
    } else {
        TokenStream::new()
    };
    let blocks = program.solved.iter().flat_map(|solved| &solved.blocks);
    let (mut kinematics, mut closed) = (program.solved.is_none(), Vec::new());
    let has =
        |wanted: fn(&Action) -> bool| blocks.clone().flat_map(|block| &block.actions).any(wanted);
    if program.solved.is_some() {
        kinematics = has(|action| *action == Action::Newton);
        closed.push(quote!(all_finite));
        closed.push(quote!(failed));
        if has(|action| matches!(action, Action::Angle { .. })) {
            closed.push(quote!(angle_near));
        }
        if has(|action| matches!(action, Action::Reach { .. })) {
            closed.push(quote!(no_span));
        }
        if has(|action| matches!(action, Action::Reach { .. } | Action::Nonzero { .. })) {
            closed.push(quote!(spans));
        }
    }
    let given = Given::of(system);
    if program.solved.is_none() && given.any() {
        closed.push(quote!(all_finite));
        closed.push(quote!(failed));
    }
    let kind = if closed.is_empty() {
        TokenStream::new()
    } else {
        quote!(FailureKind,)
    };
    let kinematics = if kinematics {
        quote!(kinematics,)
    } else {
        TokenStream::new()
    };
    let closed = if closed.is_empty() {
        TokenStream::new()
    } else {
        quote!(use ::linkwright::closed_form::{#(#closed),*};)
    };
    let has_branches = program
        .solved
        .iter()
        .any(|solved| !solved.branches.is_empty())
        || has_newton;
    let branch = if has_branches {
        quote!(Branch,)
    } else {
        TokenStream::new()
    };
    let has_textbook = program.textbook.is_some();
    let transmits = program
        .solved
        .iter()
        .any(|solved| !solved.transmissions.is_empty());
    let (matrices, equations) = if has_textbook || has_newton {
        (
            quote!(
                use ::linkwright::nalgebra::{Const, SMatrix, SVector};
            ),
            quote!(Equations,),
        )
    } else if transmits {
        (
            quote!(
                use ::linkwright::nalgebra::{SMatrix, SVector};
            ),
            TokenStream::new(),
        )
    } else {
        Default::default()
    };
    let step = if has_textbook {
        quote!(Step, newton,)
    } else {
        TokenStream::new()
    };
    let motion = if has_motion(system, program) {
        quote!(Motion,)
    } else {
        TokenStream::new()
    };
    let signal = only(given.inputs, quote!(Signal,));
    let start = only(has_newton, quote!(Start,));
    let block = only(has_newton, quote!(block,));
    let explained = only(program.solved.is_some(), quote!(BlockName, Explained,));
    let in_steps = only(program.solved.is_some(), quote!(in_steps,));
    let table = only(has_tables, quote!(Table,));
    let length = only(
        given.lengths && (has_textbook || has_newton),
        quote!(
            use ::linkwright::scale::largest_length;
        ),
    );
    let monitored = program.solved.is_some() && system.mechanism.monitor;
    let measures = program.solved.iter().flat_map(|solved| &solved.blocks);
    let measures = measures.flat_map(|block| &block.measured).next().is_some();
    let closeness = only(monitored, quote!(Closeness,));
    let measure = only(monitored && measures, quote!(Measure,));
    quote! {
        #closed
        #math
        #matrices
        #length
        use ::linkwright::{#branch #closeness #explained #equations Failure, #kind #measure #motion Settings, #signal #start #step #table #block #in_steps #kinematics};
    }
}

/// Whether some function returns the motion of a point.
fn has_motion(system: &System, program: &Program) -> bool {
    match program
        .solved
        .as_ref()
        .and_then(|solved| solved.outputs.as_ref())
    {
        Some(outputs) => outputs
            .iter()
            .any(|output| matches!(output, Output::Point { fields, .. } if fields.len() == 3)),
        None => !system.outputs.is_empty(),
    }
}

/// The named constants that the code mentions; what of the solved view is left out may have been all that needed one.
fn constants(system: &System, program: &Program, mentioned: &HashSet<String>) -> TokenStream {
    let list = program.constants.list().iter();
    let used = list.filter(|constant| mentioned.contains(&constant.name));
    let constants = used.map(|constant| {
        let text = docs([format!("`{}`", text::constant(system, &constant.part))]);
        let (name, value) = (identifier(&constant.name), float(constant.value));
        let allow = lints::approximate(&value);
        quote!(#text #allow const #name: f64 = #value;)
    });
    quote!(#(#constants)*)
}

/// Lines of text that say what the module computes and what it costs.
pub(super) fn facts(system: &System, program: &Program) -> Vec<String> {
    let mechanism = &system.mechanism;
    let drivers = system
        .rows
        .iter()
        .filter(|row| mechanism.joints[row.joint].role == Role::Driver)
        .count();
    let mut lines = vec![format!(
        "{} bodies, {} coordinates, {} equations ({} of joints, {} of drivers).",
        mechanism.moving_bodies().len(),
        system.coordinates.len(),
        system.rows.len(),
        system.rows.len() - drivers,
        drivers,
    )];
    if !system.monitored.is_empty() {
        let names: Vec<&str> = system
            .monitored
            .iter()
            .map(|row| row.name.as_str())
            .collect();
        lines.push(format!(
            "Redundant equations, not solved: {}.",
            names.join(", ")
        ));
    }
    lines.extend(text::given(system).lines().map(capitalized));
    match &program.solved {
        Some(solved) => {
            lines.extend(report::lines(&solved.report));
            if program.textbook.is_none() {
                lines.push(
                    "Left out: the textbook view, whose dense matrices would not fit a stack."
                        .to_string(),
                );
            }
        }
        None => lines.push(format!(
            "Solved as one dense block of {} unknowns by Newton-Raphson.",
            system.coordinates.len()
        )),
    }
    lines
}

/// `Parameter L = 0.05 m.` of `parameter L = 0.05 m`.
fn capitalized(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).chain(['.']).collect()
}
