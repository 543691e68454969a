//! Writes kernels of CUDA, and programs for the host with the text for devices.

use linkwright_codegen::diagnostic::Source;

use super::header::{Declared, motions};

/// Kernel, and the name of its entry.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// Name of the entry.
    pub entry: String,
    /// Its text.
    pub text: String,
}

/// Kernels that assemble and move a mechanism in each thread, one for each motion in the header.
pub fn kernels(source: &Source, header: &str) -> Vec<Kernel> {
    motions(source, header).iter().map(kernel).collect()
}

/// Kernel that assembles and moves a mechanism in each thread.
fn kernel(motion: &Declared) -> Kernel {
    let Declared {
        prefix, type_name, ..
    } = motion;
    let inputs = match motion.inputs {
        0 => String::new(),
        _ => format!(", &{}_INITIAL", prefix.to_uppercase()),
    };
    let text = format!(
        "
extern \"C\" __global__ void move_{prefix}({type_name}Frame *found, int *status, int count)
{{
    const int set = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (set < count) {{
        {type_name} it;
        linkwright_status ended = {prefix}_assemble(&it, 0.0{inputs});
        if (ended == LINKWRIGHT_OK) {{
            ended = {prefix}_advance(&it, 1e-6 * set{inputs});
        }}
        if (ended == LINKWRIGHT_OK) {{
            found[set] = *{prefix}_frame(&it);
        }}
        status[set] = (int)ended;
    }}
}}
"
    );
    Kernel {
        entry: format!("move_{prefix}"),
        text,
    }
}

/// Program that moves a mechanism, and prints the bits of all coordinates and the status of each step.
///
/// # Panics
/// The description has several motions.
pub fn moved(name: &str, source: &Source, header: &str) -> String {
    let [motion] = &motions(source, header)[..] else {
        panic!("{name} has several motions");
    };
    let Declared {
        prefix,
        type_name,
        coordinates,
        ..
    } = motion;
    format!(
        "#include \"{name}.h\"
#include <stdio.h>
#include <string.h>

int main(void)
{{
    static {type_name} it;
    linkwright_status status = {prefix}_assemble(&it, 0.0);
    for (int step = 1; (step <= 120) && (status == LINKWRIGHT_OK); step++) {{
        uint64_t bits[3 * {coordinates}];
        (void){prefix}_advance(&it, 0.05 * step);
        (void)memcpy(bits, &{prefix}_frame(&it)->q, sizeof(bits));
        for (int k = 0; k < 3 * {coordinates}; k++) {{
            printf(\"%llx \", (unsigned long long)bits[k]);
        }}
        printf(\"%d\\n\", (int)it.failure.status);
    }}
    return (int)status;
}}
",
    )
}
