//! Writes a program in C that runs scripts on the mechanism of a header.

use std::fmt::Write as _;

use super::case::INPUTS;
use super::header::{Declared, Returned};

/// Code of every program.
const COMMON: &str = r#"#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static REAL of_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof(value));
    return (REAL)value;
}

static void number(REAL value)
{
    const double exact = (double)value;
    uint64_t bits;
    memcpy(&bits, &exact, sizeof(bits));
    if (exact != exact) {
        printf(" nan");
    } else {
        printf(" %" PRIx64, bits);
    }
}

static void numbers(const void *values, size_t count)
{
    REAL copy[4096];
    memcpy(copy, values, count * sizeof(REAL));
    for (size_t k = 0; k < count; k += 1) {
        number(copy[k]);
    }
}

static void failed(const FAILURE *failure)
{
    printf("no %d", (int)failure->status);
    number(failure->time);
    printf(" %u %u", (unsigned)failure->block, (unsigned)failure->iterations);
    number(failure->residual);
    printf(" %u", (unsigned)failure->row);
    number(failure->value);
    printf(" %u\n", (unsigned)failure->column);
}
"#;

/// Program of one motion in a scalar.
pub fn main(header: &str, declared: &Declared, real: &str) -> String {
    let suffix = if real == "float" { "f" } else { "" };
    let Declared {
        prefix, type_name, ..
    } = declared;
    let capitals = prefix.to_uppercase();
    let mut text = format!(
        "#include \"{header}\"\n#include <string.h>\n#define REAL {real}\n#define FAILURE linkwright{suffix}_failure\n{COMMON}\n"
    );
    let (has_parameters, has_inputs) = (declared.parameters > 0, declared.inputs > 0);
    let _ = writeln!(
        text,
        "static void frame_numbers(const {type_name}Frame *frame)\n{{"
    );
    let _ = writeln!(text, "    printf(\"ok\");\n    number(frame->t);");
    if declared.holds_coordinates {
        for level in ["q", "qd", "qdd"] {
            let _ = writeln!(
                text,
                "    numbers(&frame->{level}, {});",
                declared.coordinates
            );
        }
    }
    for function in &declared.of_frame {
        let _ = writeln!(
            text,
            "    {{\n{}    }}",
            called(prefix, type_name, function, suffix, real, declared)
        );
    }
    let _ = writeln!(text, "    printf(\"\\n\");\n}}\n");
    let _ = writeln!(
        text,
        "static {type_name} mechanism;\nstatic {type_name} fresh;\nstatic bool is_held = false;\n"
    );
    if has_parameters {
        let _ = writeln!(
            text,
            "typedef {type_name}Parameters Given;\nstatic Given scaled(REAL factor)\n{{\n    Given given;\n    REAL values[{0}];",
            declared.parameters
        );
        let _ = writeln!(
            text,
            "    memcpy(values, &{capitals}_NOMINAL, sizeof(values));\n    for (size_t k = 0; k < {}; k += 2) {{\n        values[k] *= factor;\n    }}\n    memcpy(&given, values, sizeof(given));\n    return given;\n}}\n",
            declared.parameters
        );
    }
    if has_inputs {
        let _ = writeln!(
            text,
            "static {type_name}Inputs moved(const REAL given[])\n{{\n    {type_name}Inputs inputs;\n    REAL values[{0}];\n    memcpy(values, &{capitals}_INITIAL, sizeof(values));\n    for (size_t k = 0; k < {0}; k += 1) {{\n        values[k] += given[k % {INPUTS}];\n    }}\n    memcpy(&inputs, values, sizeof(inputs));\n    return inputs;\n}}\n",
            3 * declared.inputs
        );
    }
    text.push_str(&textbook(declared, real));
    text.push_str(
        "static void report(linkwright_status status)\n{\n    if (status == LINKWRIGHT_OK) {\n",
    );
    let _ = writeln!(text, "        frame_numbers({prefix}_frame(&mechanism));");
    if !declared.textbook.is_empty() && declared.holds_coordinates {
        let _ = writeln!(text, "        textbook({prefix}_frame(&mechanism));");
    }
    text.push_str("    } else {\n        failed(&mechanism.failure);\n    }\n}\n\n");
    text.push_str("static void assembled(linkwright_status status)\n{\n    if (status == LINKWRIGHT_OK) {\n        mechanism = fresh;\n        is_held = true;\n        report(status);\n    } else {\n        failed(&fresh.failure);\n");
    // A mechanism that is not assembled has no frame, but accepts parameters.
    let _ = writeln!(
        text,
        "        if ({prefix}_frame(&fresh) != NULL) {{\n            printf(\"a frame\\n\");\n        }}"
    );
    if has_parameters {
        let _ = writeln!(
            text,
            "        (void){prefix}_set_parameters(&fresh, &{capitals}_NOMINAL);"
        );
    }
    text.push_str("    }\n}\n\n");
    text.push_str(&calls(declared, suffix));
    text
}

/// Call of a function of a frame, and its numbers.
fn called(
    prefix: &str,
    type_name: &str,
    function: &super::header::OfFrame,
    suffix: &str,
    real: &str,
    declared: &Declared,
) -> String {
    let name = format!("{prefix}_{}", function.name);
    let n = declared.coordinates;
    match &function.returned {
        Returned::Number => format!("        number({name}(frame));\n"),
        Returned::Pair => format!(
            "        {real} found[2];\n        {name}(frame, found);\n        numbers(found, 2);\n"
        ),
        Returned::Motion => format!(
            "        const linkwright{suffix}_point_motion found = {name}(frame);\n        numbers(&found, 6);\n"
        ),
        Returned::Optional => format!(
            "        {real} found = 0;\n        if ({name}(frame, &found)) {{\n            number(found);\n        }} else {{\n            printf(\" none\");\n        }}\n"
        ),
        Returned::Matrix(rows, columns) => format!(
            "        {real} found[{rows}][{columns}];\n        {name}(frame, found);\n        numbers(found, {});\n",
            rows * columns
        ),
        Returned::Forces(true, count) => format!(
            "        const {real} force[2] = {{(REAL)1.5, (REAL)-0.25}};\n        {real} found[{count}];\n        {name}(frame, force, found);\n        numbers(found, {count});\n"
        ),
        Returned::Forces(false, count) => format!(
            "        {real} found[{count}];\n        {name}(frame, (REAL)1.5, found);\n        numbers(found, {count});\n"
        ),
        Returned::Sensitivity => format!(
            "        const {type_name}Sensitivity found = {name}(frame);\n        numbers(&found, {});\n",
            2 * n
        ),
        Returned::PointSensitivity => format!(
            "        const {type_name}PointSensitivity found = {name}(frame);\n        numbers(&found, 4);\n"
        ),
        Returned::Determinant => format!(
            "        const linkwright{suffix}_normalized_determinant found = {name}(frame);\n        printf(\" %u\", (unsigned)found.block);\n        number(found.determinant);\n        number(found.reciprocal_condition);\n"
        ),
        Returned::Determinants(count) => format!(
            "        linkwright{suffix}_normalized_determinant found[{count}];\n        {name}(frame, found);\n        for (size_t k = 0; k < {count}; k += 1) {{\n            printf(\" %u\", (unsigned)found[k].block);\n            number(found[k].determinant);\n            number(found[k].reciprocal_condition);\n        }}\n"
        ),
    }
}

/// The functions of the textbook view at a frame.
fn textbook(declared: &Declared, real: &str) -> String {
    let Declared {
        prefix, type_name, ..
    } = declared;
    if declared.textbook.is_empty() || !declared.holds_coordinates {
        return String::new();
    }
    let mut text =
        format!("static void textbook(const {type_name}Frame *frame)\n{{\n    printf(\"book\");\n");
    for function in &declared.textbook {
        let brackets: String = function.sizes.iter().map(|it| format!("[{it}]")).collect();
        let count: usize = function.sizes.iter().product();
        let mut arguments = vec!["&frame->q".to_string()];
        if function.name == "gamma" {
            arguments.push("&frame->qd".to_string());
        }
        if declared.parameters > 0 {
            arguments.push("&mechanism.parameters".to_string());
        }
        if declared.inputs > 0 {
            arguments.push("&mechanism.inputs".to_string());
        }
        let _ = writeln!(
            text,
            "    {{\n        {real} found{brackets};\n        {prefix}_{}({}, frame->t, found);\n        numbers(found, {count});\n    }}",
            function.name,
            arguments.join(", ")
        );
    }
    text.push_str("    printf(\"\\n\");\n}\n\n");
    text
}

/// `main`: reads the calls.
fn calls(declared: &Declared, suffix: &str) -> String {
    let Declared {
        prefix, type_name, ..
    } = declared;
    let capitals = prefix.to_uppercase();
    let inputs = if declared.inputs > 0 { ", &inputs" } else { "" };
    let settings = format!("&LINKWRIGHT{}_SETTINGS", suffix.to_uppercase());
    let mut modes = String::new();
    for (place, mode) in declared.modes.iter().enumerate() {
        let _ = writeln!(
            modes,
            "                if ((k == {place}) && (branches.{mode} != LINKWRIGHT_NEAREST)) {{\n                    branches.{mode} = (branches.{mode} == LINKWRIGHT_POSITIVE) ? LINKWRIGHT_NEGATIVE : LINKWRIGHT_POSITIVE;\n                }}"
        );
    }
    if declared.stores_assemblies {
        let _ = writeln!(
            modes,
            "                if (k >= 4) {{\n                    branches = {capitals}_ASSEMBLIES[(unsigned)(k - 4) % {capitals}_ASSEMBLY_COUNT];\n                }}"
        );
    }
    let inputs_line = match declared.inputs > 0 {
        true => format!("        const {type_name}Inputs inputs = moved(given);\n"),
        false => "        (void)given;\n".to_string(),
    };
    let parameters = match declared.parameters > 0 {
        true => format!(
            "            }} else if ((letter == 'p') && is_held) {{
                const Given parameters = scaled(value);
                const linkwright_status status = {prefix}_set_parameters(&mechanism, &parameters);
                if (status != LINKWRIGHT_OK) {{
                    failed(&mechanism.failure);
                }}
            }} else if (letter == 'f') {{
                const Given parameters = scaled(value);
                assembled({prefix}_assemble_for(&fresh, &parameters, t{inputs}));
"
        ),
        false => String::new(),
    };
    let n = declared.coordinates;
    let recovered = match declared.holds_coordinates {
        true => format!(
            "            }} else if ((letter == 'r') && is_held) {{
                {type_name}Coordinates jump;
                const linkwright_status status = {prefix}_recover(&mechanism, t{inputs}, &jump);
                if (status == LINKWRIGHT_OK) {{
                    printf(\"jump\");
                    numbers(&jump, {n});
                    printf(\"\\n\");
                }}
                report(status);
"
        ),
        false => format!(
            "            }} else if ((letter == 'r') && is_held) {{
                report({prefix}_recover(&mechanism, t{inputs}));
"
        ),
    };
    let frame = match declared.inputs > 0 {
        true => format!("{prefix}_frame_at(&mechanism, t, &inputs, &found)"),
        false => format!("{prefix}_frame_at(&mechanism, t, &found)"),
    };
    format!(
        r#"int main(int count, char **words)
{{
    FILE *const script = (count > 1) ? fopen(words[1], "r") : NULL;
    char letter;
    uint64_t time_bits;
    uint64_t value_bits;
    if (script == NULL) {{
        return 1;
    }}
    while (fscanf(script, " %c %" SCNx64 " %" SCNx64, &letter, &time_bits, &value_bits) == 3) {{
        REAL given[{INPUTS}];
        const REAL t = of_bits(time_bits);
        const REAL value = of_bits(value_bits);
        for (size_t k = 0; k < {INPUTS}; k += 1) {{
            uint64_t bits;
            if (fscanf(script, " %" SCNx64, &bits) != 1) {{
                return 1;
            }}
            given[k] = of_bits(bits);
        }}
        {{
{inputs_line}            if (letter == 'a') {{
                assembled({prefix}_assemble(&fresh, t{inputs}));
            }} else if (((letter == 'v') || (letter == 'j') || (letter == 'n')) && is_held) {{
                report({prefix}_advance(&mechanism, t{inputs}));
            }} else if ((letter == 'd') && is_held) {{
                report({prefix}_advance_by(&mechanism, value{inputs}));
{recovered}            }} else if ((letter == 'x') && is_held) {{
                {type_name}Frame found;
                if ({frame} == LINKWRIGHT_OK) {{
                    frame_numbers(&found);
                }} else {{
                    failed(&mechanism.failure);
                }}
            }} else if (letter == 'b') {{
                {type_name}Branches branches = {capitals}_DESIGN_BRANCHES;
                const int k = (int)value;
                (void)k;
{modes}                assembled({prefix}_assemble_on(&fresh, &branches, t{inputs}));
            }} else if (letter == 'e') {{
                {type_name}Coordinates estimate;
                REAL values[{n}];
                memcpy(values, &{capitals}_DESIGN, sizeof(values));
                for (size_t k = 0; k < {n}; k += 1) {{
                    values[k] += ((k % 3) == 0) ? value : -value;
                }}
                memcpy(&estimate, values, sizeof(estimate));
                assembled({prefix}_assemble_from(&fresh, &estimate, t{inputs}, {settings}));
{parameters}            }}
        }}
    }}
    (void)fclose(script);
    return 0;
}}
"#
    )
}
