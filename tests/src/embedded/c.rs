//! Builds the program of a mechanism in C, for a board or for this machine. The generated runtime is compiled once
//! for all programs of a machine.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language as Output, Options, Scalar as Precision};

use super::build::Built;
use super::program::{Language, MECHANISMS, Processor, Program, Scalar};
use super::tools::{folder, output};
use crate::files;

const FLAGS: [&str; 8] = [
    "-std=c99",
    "-O2",
    "-fno-math-errno",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Werror",
    "-ffunction-sections",
];

/// The compiler of a machine, with the runtime that it has compiled.
pub struct Compiler {
    processor: Option<Processor>,
    /// The text of the runtime, and its object.
    runtime: Option<(String, PathBuf)>,
}

/// The files of a mechanism, and what the compiler is told of them.
struct Sources {
    mechanism: PathBuf,
    /// None where the mechanism is written by hand.
    runtime: Option<PathBuf>,
    flags: Vec<String>,
}

impl Compiler {
    /// For boards with a processor.
    pub fn for_board(processor: Processor) -> Self {
        Compiler {
            processor: Some(processor),
            runtime: None,
        }
    }

    /// For the machine that this runs on.
    pub fn for_host() -> Self {
        Compiler {
            processor: None,
            runtime: None,
        }
    }

    /// The folder of its objects.
    fn place(&self) -> PathBuf {
        folder()
            .join("c")
            .join(self.processor.map_or("host", Processor::name))
    }

    fn command(&self) -> Command {
        let Some(processor) = self.processor else {
            let mut command = Command::new("cc");
            command.args(FLAGS);
            return command;
        };
        let mut command = Command::new("arm-none-eabi-gcc");
        command.arg(format!("-mcpu={}", processor.name()));
        command.arg("-mthumb");
        command.arg(format!("-mfpu={}", processor.unit()));
        command.arg("-mfloat-abi=hard");
        command.args(FLAGS).arg("-fdata-sections");
        command
    }

    fn object(&self, source: &Path, flags: &[String], object: PathBuf) -> io::Result<PathBuf> {
        let mut command = self.command();
        output(
            command
                .args(flags)
                .arg("-c")
                .arg(source)
                .arg("-o")
                .arg(&object),
        )?;
        Ok(object)
    }

    /// The object of a runtime, compiled if its text is not that of the one before.
    fn runtime(&mut self, source: &Path) -> io::Result<PathBuf> {
        let text = fs::read_to_string(source)?;
        match &self.runtime {
            Some((known, object)) if *known == text => Ok(object.clone()),
            _ => {
                let object = self.object(source, &[], self.place().join("linkwright.o"))?;
                self.runtime = Some((text, object.clone()));
                Ok(object)
            }
        }
    }

    /// The objects of a mechanism, of the program that moves it, and of a file with the machine's part.
    fn objects(&mut self, sources: &Sources, place: &Path, part: &str) -> io::Result<Vec<PathBuf>> {
        fs::create_dir_all(place)?;
        let harness = files::package("embedded/c");
        let mut objects = Vec::new();
        for source in [
            &sources.mechanism,
            &harness.join("motion.c"),
            &harness.join(part),
        ] {
            let object = place.join(files::stem(source)).with_extension("o");
            objects.push(self.object(source, &sources.flags, object)?);
        }
        if let Some(runtime) = &sources.runtime {
            objects.push(self.runtime(runtime)?);
        }
        Ok(objects)
    }

    /// Firmware.
    ///
    /// # Errors
    /// It is not compiled or not linked.
    pub fn firmware(&mut self, program: &Program) -> io::Result<Built> {
        let sources = Sources::of(program.mechanism, program.language, program.scalar)?;
        let place = self.place().join(program.to_string().replace(' ', "-"));
        let objects = self.objects(&sources, &place, "board.c")?;
        let (elf, map) = (place.join("firmware"), place.join("map"));
        let mut command = self.command();
        command
            .args(objects)
            .arg("-nostartfiles")
            .arg("-T")
            .arg(files::package("embedded/c/board.ld"));
        command
            .arg("-Wl,--gc-sections")
            .arg(format!("-Wl,-Map={}", map.display()));
        output(command.args(["--specs=nosys.specs", "-lm", "-o"]).arg(&elf))?;
        let map = Some(fs::read_to_string(map)?);
        Ok(Built { elf, map })
    }

    /// The output of a mechanism's program on this machine.
    ///
    /// # Errors
    /// It is not compiled, or does not run.
    pub fn answers(&mut self, mechanism: usize, scalar: Scalar) -> io::Result<String> {
        let sources = Sources::of(mechanism, Language::C, scalar)?;
        let (name, _) = MECHANISMS[mechanism];
        let place = self.place().join(format!("{name}_{}", scalar.name()));
        let objects = self.objects(&sources, &place, "host.c")?;
        let program = place.join("program");
        let mut command = self.command();
        output(command.args(objects).args(["-lm", "-o"]).arg(&program))?;
        output(&mut Command::new(program))
    }
}

impl Sources {
    fn of(mechanism: usize, language: Language, scalar: Scalar) -> io::Result<Sources> {
        let (name, type_name) = MECHANISMS[mechanism];
        let harness = files::package("embedded/c");
        let place = match language {
            Language::ByHand => harness.join("by_hand"),
            _ => generate(name, scalar)?,
        };
        let (real, word, suffix) = match scalar {
            Scalar::F32 => ("float", "uint32_t", "f"),
            Scalar::F64 => ("double", "uint64_t", ""),
        };
        let failure = match language {
            Language::ByHand => format!("{type_name}Failure"),
            _ => format!("linkwright{suffix}_failure"),
        };
        let include = |folder: &Path| format!("-I{}", folder.display());
        Ok(Sources {
            mechanism: place.join(format!("{name}.c")),
            runtime: (language != Language::ByHand).then(|| place.join("linkwright.c")),
            flags: vec![
                include(&harness),
                include(&place),
                format!("-DHEADER=\"{name}.h\""),
                format!("-DMECHANISM={type_name}"),
                format!("-DPREFIX={name}"),
                format!("-DREAL={real}"),
                format!("-DWORD={word}"),
                format!("-DFAILURE={failure}"),
            ],
        })
    }
}

/// Writes the generated C of a mechanism and gives its folder.
fn generate(mechanism: &str, scalar: Scalar) -> io::Result<PathBuf> {
    let place = folder()
        .join("c")
        .join(format!("{mechanism}_{}", scalar.name()));
    fs::create_dir_all(&place)?;
    let description = files::repository()
        .join("mechanisms")
        .join(mechanism)
        .with_extension("mech");
    let source = Source::new(
        format!("{mechanism}.mech"),
        fs::read_to_string(description)?,
    );
    let scalar = match scalar {
        Scalar::F32 => Precision::F32,
        Scalar::F64 => Precision::F64,
    };
    let options = Options {
        language: Output::C,
        scalar,
        stem: Some(mechanism.to_string()),
        ..Options::default()
    };
    let generated = linkwright_codegen::generate(&source, &options);
    let generated = generated.map_err(|found| io::Error::other(found.render(&source)))?;
    for file in generated.files {
        fs::write(place.join(file.name), file.text)?;
    }
    Ok(place)
}
