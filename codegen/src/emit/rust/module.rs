//! The parts of the module in their order.

use proc_macro2::TokenStream;
use quote::quote;

use super::coordinates::{coordinates, frame};
use super::docs::docs;
use super::equations::equations;
use super::expression::identifier;
use super::layout::laid_out;
use super::lints;
use super::literal::float;
use super::solved;
use super::solver::{mechanism, textbook};
use crate::emit::{report, text};
use crate::model::Role;
use crate::program::Program;
use crate::program::solved::Action;
use crate::system::System;

/// The formatted source of the generated module, with a header of comments.
pub fn module(system: &System, program: &Program) -> String {
    let items = [
        imports(program),
        constants(system, program),
        coordinates(system),
        equations(system, program),
        frame(system, program),
        textbook(system),
        solver(system, program),
    ];
    let file: Result<syn::File, _> = syn::parse2(items.into_iter().collect());
    // Everything above is made of whole items, so this is a matter of our own code alone.
    let file = file.unwrap_or_else(|error| panic!("generated code does not parse: {error}"));
    format!(
        "{}\n{}",
        header(system, program),
        laid_out(&prettyplease::unparse(&file))
    )
}

/// The blocks and the type that a user holds; without a solved view the dense system alone.
fn solver(system: &System, program: &Program) -> TokenStream {
    match &program.solved {
        Some(blocks) => {
            let branches = solved::branches(blocks);
            let newton = solved::newton_blocks(system, program, blocks);
            let functions = solved::blocks(system, program, blocks);
            let mechanism = solved::mechanism(system, blocks);
            quote!(#branches #newton #functions #mechanism)
        }
        None => mechanism(system),
    }
}

fn imports(program: &Program) -> TokenStream {
    let functions = [
        &program.residual,
        &program.jacobian,
        &program.time_derivative,
        &program.gamma,
    ];
    let calls_math = functions
        .into_iter()
        .chain(&program.points)
        .any(|straight| {
            let operations = &straight.operations;
            operations.sines
                + operations.arctangents
                + operations.square_roots
                + operations.exponentials
                > 0
        });
    let solved_math = program
        .solved
        .iter()
        .flat_map(|solved| solved.report.operations)
        .any(|operations| {
            operations.sines
                + operations.arctangents
                + operations.square_roots
                + operations.exponentials
                > 0
        });
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
        .any(|solved| !solved.branches.is_empty());
    let branch = if has_branches {
        quote!(Branch,)
    } else {
        TokenStream::new()
    };
    quote! {
        #closed
        #math
        use ::linkwright::nalgebra::{Const, SMatrix, SVector};
        use ::linkwright::{#branch Equations, Failure, #kind Motion, Settings, Step, #kinematics newton};
    }
}

fn constants(system: &System, program: &Program) -> TokenStream {
    let constants = program.constants.list().iter().map(|constant| {
        let text = docs([format!("`{}`", text::constant(system, &constant.part))]);
        let (name, value) = (identifier(&constant.name), float(constant.value));
        let allow = lints::approximate(&value);
        quote!(#text #allow const #name: f64 = #value;)
    });
    quote!(#(#constants)*)
}

/// Comments that say what the module is and what it costs.
fn header(system: &System, program: &Program) -> String {
    let mechanism = &system.mechanism;
    let drivers = system
        .rows
        .iter()
        .filter(|row| mechanism.joints[row.joint].role == Role::Driver)
        .count();
    let mut lines = vec![
        format!(
            "Generated by linkwright-codegen {} from the description of `{}`. Do not edit.",
            env!("CARGO_PKG_VERSION"),
            mechanism.name
        ),
        String::new(),
        format!(
            "{} bodies, {} coordinates, {} equations ({} of joints, {} of drivers).",
            mechanism.moving_bodies().len(),
            system.coordinates.len(),
            system.rows.len(),
            system.rows.len() - drivers,
            drivers,
        ),
    ];
    match &program.solved {
        Some(solved) => lines.extend(report::lines(&solved.report)),
        None => lines.push(format!(
            "Solved as one dense block of {} unknowns by Newton-Raphson.",
            system.coordinates.len()
        )),
    }
    lines
        .iter()
        .map(|line| format!("// {line}").trim_end().to_string() + "\n")
        .collect()
}
