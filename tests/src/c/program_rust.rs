//! Writes a package of Rust that runs the scripts on the generated modules, from the declarations of headers.

use std::fmt::Write as _;

use super::case::INPUTS;
use super::header::{Declared, Returned};

/// Code of every program.
const COMMON: &str = r#"
use linkwright::{Blocks, Failure, FailureKind, PointMotion, Values};
use linkwright::math::Real;
use linkwright::generated::Mode;

pub fn number<T: Real>(text: &mut String, value: T) {
    let value = value.to_f64();
    if value.is_nan() {
        text.push_str(" nan");
    } else {
        text.push_str(&format!(" {:x}", value.to_bits()));
    }
}

pub fn numbers<T: Real>(text: &mut String, values: &[T]) {
    values.iter().for_each(|value| number(text, *value));
}

pub fn motion<T: Real>(text: &mut String, motion: PointMotion<T>) {
    [motion.position, motion.velocity, motion.acceleration].iter().for_each(|it| numbers(text, it));
}

pub fn failed<T: Real>(failure: &Failure<T>) -> String {
    let (status, value, column) = match failure.kind {
        FailureKind::Singular { pivot_ratio, column } => (1, pivot_ratio, column),
        FailureKind::Diverged => (2, T::ZERO, 0),
        FailureKind::Cycling => (3, T::ZERO, 0),
        FailureKind::Stalled => (4, T::ZERO, 0),
        FailureKind::IterationLimit => (5, T::ZERO, 0),
        FailureKind::OutOfReach { by } => (6, by, 0),
        FailureKind::WrongBranch => (7, T::ZERO, 0),
        FailureKind::StepTooLarge => (8, T::ZERO, 0),
        FailureKind::NotPositive { value } => (9, value, 0),
        FailureKind::NotFinite => (10, T::ZERO, failure.input.map_or(0, |input| input + 1)),
        FailureKind::Undecided => (11, T::ZERO, 0),
        FailureKind::LoadNotFinite { load } => (12, T::ZERO, load),
        FailureKind::FrictionUnsettled { change } => (14, change, 0),
        FailureKind::OutsideRange { value } => (13, value, failure.input.map_or(0, |input| input + 1)),
        _ => panic!("a kind of failure that is unknown in C"),
    };
    let mut text = format!("no {status}");
    number(&mut text, failure.time);
    text += &format!(" {} {}", failure.block, failure.iterations);
    number(&mut text, failure.residual);
    text += &format!(" {}", failure.row);
    number(&mut text, value);
    text + &format!(" {column}\n")
}

pub fn exchange<M: Mode + Copy>(mode: &mut M) {
    if let Some(other) = mode.other() {
        *mode = other;
    }
}

pub fn coordinates<B: Blocks>(blocks: &B, text: &mut String, frame: &B::Frame) {
    for level in 0..3 {
        let all = (0..).map_while(|index| blocks.coordinate(frame, index));
        all.for_each(|it| number(text, it[level]));
    }
}

pub fn scaled<T: Real, P: Values<T>>(mut parameters: P, factor: T) -> P {
    for index in (0..parameters.count()).step_by(2) {
        let value = parameters.value(index).expect("a parameter");
        parameters.set(index, value * factor);
    }
    parameters
}

pub fn moved<T: Real, I: Values<linkwright::Signal<T>>>(mut inputs: I, given: &[T]) -> I {
    for index in 0..inputs.count() {
        let mut signal = inputs.value(index).expect("a signal");
        signal.value += given[(3 * index) % GIVEN];
        signal.rate += given[(3 * index + 1) % GIVEN];
        signal.acceleration += given[(3 * index + 2) % GIVEN];
        inputs.set(index, signal);
    }
    inputs
}

pub struct Call {
    pub letter: char,
    pub t: f64,
    pub value: f64,
    pub given: Vec<f64>,
}

fn calls(script: &str) -> Vec<Call> {
    let bits = |word: &str| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"));
    let call = |line: &str| {
        let mut words = line.split(' ');
        let letter = words.next().and_then(|it| it.chars().next()).expect("a letter");
        let mut numbers = words.map(bits);
        let (t, value) = (numbers.next().expect("a time"), numbers.next().expect("a number"));
        Call { letter, t, value, given: numbers.collect() }
    };
    script.lines().map(call).collect()
}
"#;

/// Motion of a case in a scalar: the module that holds it, and the declarations of its header.
#[derive(Clone, Debug)]
pub struct Motion {
    /// `four_bar_f64`: the file.
    pub module: String,
    /// `four_bar_f64` or `excavator_motions_f64_dig`: prefix of the files of its answers.
    pub answers: String,
    /// Type of the mechanism in its module.
    pub type_name: String,
    pub real: &'static str,
    pub declared: Declared,
}

/// `main.rs` for all motions.
pub fn main(motions: &[Motion]) -> String {
    let mut text = String::from("#![allow(warnings)]\n");
    let mut modules: Vec<&str> = motions.iter().map(|it| it.module.as_str()).collect();
    modules.dedup();
    for module in modules {
        let _ = writeln!(text, "mod {module};");
    }
    let _ = writeln!(text, "const GIVEN: usize = {INPUTS};");
    text.push_str(COMMON);
    for motion in motions {
        text.push_str(&runner(motion));
    }
    text.push_str(
        "\nfn main() {\n    let folder = std::env::args().nth(1).expect(\"a folder\");\n",
    );
    for Motion { answers, .. } in motions {
        let _ = writeln!(
            text,
            "    let script = std::fs::read_to_string(format!(\"{{folder}}/{answers}.script\")).expect(\"a script\");\n    std::fs::write(format!(\"{{folder}}/{answers}.rust\"), run_{answers}(&calls(&script))).expect(\"written\");"
        );
    }
    text.push_str("}\n");
    text
}

/// Function that runs a script on one motion.
fn runner(motion: &Motion) -> String {
    let Motion {
        module,
        answers,
        type_name,
        real,
        declared,
    } = motion;
    let path = match &declared.motion {
        Some(name) => format!("crate::{module}::{name}"),
        None => format!("crate::{module}"),
    };
    let inputs = if declared.inputs > 0 { ", &inputs" } else { "" };
    let moved = match declared.inputs > 0 {
        true => "let inputs = moved(Inputs::default(), &given);",
        false => "",
    };
    let mut functions = String::new();
    for function in &declared.of_frame {
        let name = &function.name;
        functions.push_str(&match &function.returned {
            Returned::Number => format!("number(text, frame.{name}());"),
            Returned::Pair => format!("numbers(text, &frame.{name}());"),
            Returned::Motion => format!("motion(text, frame.{name}());"),
            Returned::Optional => format!("match frame.{name}() {{ Some(it) => number(text, it), None => text.push_str(\" none\") }}"),
            Returned::Matrix(rows, columns) => format!("let it = frame.{name}(); for r in 0..{rows} {{ for c in 0..{columns} {{ number(text, it[(r, c)]); }} }}"),
            Returned::Forces(true, _) => format!("numbers(text, frame.{name}([1.5, -0.25]).as_slice());"),
            Returned::Forces(false, _) => format!("numbers(text, frame.{name}(1.5).as_slice());"),
            Returned::Sensitivity => format!("let it = frame.{name}(); numbers(text, &it.position.to_array()); numbers(text, &it.velocity.to_array());"),
            Returned::PointSensitivity => format!("let it = frame.{name}(); numbers(text, &it.position); numbers(text, &it.velocity);"),
            Returned::Determinant => format!("let it = frame.{name}(); text.push_str(&format!(\" {{}}\", it.block)); number(text, it.determinant); number(text, it.reciprocal_condition);"),
            Returned::Determinants(_) => format!("for it in frame.{name}() {{ text.push_str(&format!(\" {{}}\", it.block)); number(text, it.determinant); number(text, it.reciprocal_condition); }}"),
        });
        functions.push_str("\n            ");
    }
    let (mut book, mut modes) = (String::new(), String::new());
    if declared.holds_coordinates && !declared.textbook.is_empty() {
        book.push_str("text.push_str(\"book\");");
        for function in &declared.textbook {
            let mut arguments = vec!["&frame.q"];
            if function.name == "gamma" {
                arguments.push("&frame.qd");
            }
            if declared.parameters > 0 {
                arguments.push("m.parameters()");
            }
            if declared.inputs > 0 {
                arguments.push("&last_inputs");
            }
            let call = format!("{}({}, frame.t)", function.name, arguments.join(", "));
            book.push_str(&match function.sizes.as_slice() {
                [rows, columns] => format!("let it = {call}; for r in 0..{rows} {{ for c in 0..{columns} {{ number(text, it[(r, c)]); }} }}"),
                _ if function.name == "monitored" => format!("numbers(text, &{call});"),
                _ => format!("numbers(text, {call}.as_slice());"),
            });
        }
        book.push_str("text.push('\\n');");
    }
    for (place, mode) in declared.modes.iter().enumerate() {
        let _ = write!(
            modes,
            "if call.value as usize == {place} {{ exchange(&mut branches.{mode}); }}"
        );
    }
    if declared.stores_assemblies {
        modes.push_str(
            "if call.value >= 4.0 { branches = Branches::ASSEMBLIES[(call.value as usize - 4) % Branches::ASSEMBLIES.len()]; }",
        );
    }
    let parameters = match declared.parameters > 0 {
        true => format!(
            "'p' => {{ if let Err(failure) = held.as_mut().expect(\"it is assembled\").set_parameters(&scaled({path}::Parameters::default(), call.value as {real})) {{ text.push_str(&failed(&failure)); }} continue; }}
                'f' => {type_name}::assemble_for(&scaled({path}::Parameters::default(), call.value as {real}), t{inputs}).map(|it| {{ held = Some(it); }}),"
        ),
        false => "'p' | 'f' => continue,".to_string(),
    };
    let jumped = match declared.holds_coordinates {
        true => {
            "let jump = jump.expect(\"all coordinates\"); text.push_str(\"jump\"); numbers(text, &jump.to_array()); text.push('\\n');"
        }
        false => "assert!(jump.is_none());",
    };
    let last_inputs = match declared.inputs > 0 {
        true => "let mut last_inputs = Inputs::default();",
        false => "",
    };
    let keep_inputs = if declared.inputs > 0 {
        "last_inputs = inputs;"
    } else {
        ""
    };
    format!(
        r#"
fn run_{answers}(calls: &[Call]) -> String {{
    use {path}::*;
    let mut all = String::new();
    let text = &mut all;
    let mut held: Option<{type_name}> = None;
    {last_inputs}
    fn print(frame: &Frame, text: &mut String) {{
            text.push_str("ok");
            number(text, frame.t);
            coordinates(&Loops, text, frame);
            {functions}text.push('\n');
    }}
    for call in calls {{
        let t = call.t as {real};
        let given: Vec<{real}> = call.given.iter().map(|it| *it as {real}).collect();
        {moved}
        if held.is_none() && matches!(call.letter, 'v' | 'j' | 'n' | 'x' | 'p' | 'r' | 'd') {{
            continue;
        }}
        let result = match call.letter {{
                'a' => {type_name}::assemble(t{inputs}).map(|it| {{ held = Some(it); }}),
                'v' | 'j' | 'n' => held.as_mut().expect("it is assembled").advance(t{inputs}).map(|_| ()),
                'd' => held.as_mut().expect("it is assembled").advance_by(call.value as {real}{inputs}).map(|_| ()),
                'r' => held.as_mut().expect("it is assembled").recover(t{inputs}).map(|jump| {{ {jumped} }}),
                'x' => {{
                    match held.as_ref().expect("it is assembled").frame_at(t{inputs}) {{
                        Ok(frame) => print(&frame, text),
                        Err(failure) => text.push_str(&failed(&failure)),
                    }}
                    continue;
                }}
                'b' => {{
                    let mut branches = Branches::DESIGN;
                    {modes}
                    {type_name}::assemble_on(branches, t{inputs}).map(|it| {{ held = Some(it); }})
                }}
                'e' => {{
                    let mut values = Coordinates::DESIGN.to_array();
                    for (k, value) in values.iter_mut().enumerate() {{
                        *value += if k % 3 == 0 {{ call.value as {real} }} else {{ -(call.value as {real}) }};
                    }}
                    {type_name}::assemble_from(&Coordinates::from_array(values), t{inputs}, Default::default()).map(|it| {{ held = Some(it); }})
                }}
                {parameters}
                other => panic!("a call that is not known: {{other}}"),
        }};
        match result {{
            Ok(()) => {{
                let m = held.as_ref().expect("it is assembled");
                {keep_inputs}
                let frame = m.frame();
                print(frame, text);
                {book}
            }}
            Err(failure) => text.push_str(&failed(&failure)),
        }}
    }}
    all
}}
"#
    )
}
