//! *Wishes like `phi2=other`* → *the modes in which a mechanism is assembled, and a pose of them*.

use linkwright::{Blocks, Branch, Failure};
use linkwright_codegen::diagnostic::nearest;

use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::search::Sought;
use crate::supplied::{ModeName, Modes};
use crate::view::View;

/// The modes that are wanted of some loops; those of the others are the drawing's.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wishes(Vec<(ModeName, Sought)>);

impl Wishes {
    /// Reads `LOOP=positive`, `LOOP=negative` or `LOOP=other`.
    ///
    /// # Errors
    /// A sentence where a wish cannot be read, or names no loop.
    pub fn read(interpreted: &Interpreted, texts: &[String]) -> Result<Wishes, String> {
        let known = interpreted.mode_names();
        let mut found: Vec<(ModeName, Sought)> = Vec::new();
        for text in texts {
            let Some((name, mode)) = text.split_once('=') else {
                return Err(format!(
                    "`{text}` is not of the form LOOP=positive, LOOP=negative or LOOP=other"
                ));
            };
            let Some(own) = known.iter().find(|it| it.name == name) else {
                return Err(unknown(name, &known));
            };
            let modes = ["positive", "negative", "other"];
            let wish = match mode {
                "positive" => Sought::Sign(Branch::Positive),
                "negative" => Sought::Sign(Branch::Negative),
                "other" => Sought::Other,
                _ => {
                    return Err(format!(
                        "no assembly mode is named `{mode}`{}\n  the modes are: {}",
                        guess(mode, modes.into_iter()),
                        modes.join(", ")
                    ));
                }
            };
            if found.iter().any(|(taken, _)| taken == own) {
                return Err(format!("the mode of `{name}` is chosen twice"));
            }
            found.push((own.clone(), wish));
        }
        Ok(Wishes(found))
    }

    /// Assembles the mechanism at time `t` (s) as wished, block by block, with its nominal parameters and inputs.
    ///
    /// # Errors
    /// The first block that cannot be solved; [`WrongBranch`](linkwright::FailureKind::WrongBranch) where no pose of the wanted mode was found.
    pub fn assembled(
        &self,
        interpreted: &Interpreted,
        t: f64,
    ) -> Result<(Instant, Modes), Failure> {
        let mut modes = interpreted.drawn_branches();
        for (name, wish) in self.0.iter().filter(|(name, _)| name.is_closed) {
            let mode = &mut modes.closed[name.place];
            *mode = match wish {
                Sought::Near => *mode,
                Sought::Sign(sign) => *sign,
                Sought::Other => mode.opposite(),
            };
        }
        let mut state = interpreted.before_assembly(t);
        for (index, block) in interpreted.compiled().blocks.iter().enumerate() {
            let own = self
                .0
                .iter()
                .find(|(name, _)| !name.is_closed && name.place == block.iterated);
            let sought = own
                .filter(|_| block.newton.is_some())
                .map_or(Sought::Near, |(_, wish)| *wish);
            let assembled = interpreted.assemble_block(index, &mut state, &mut modes, sought);
            assembled
                .map_err(|failure| failure.in_block(u16::try_from(index).unwrap_or(u16::MAX)))?;
        }
        Ok((interpreted.instant(&state), modes))
    }
}

fn unknown(name: &str, known: &[ModeName]) -> String {
    let names: Vec<&str> = known.iter().map(|it| it.name.as_str()).collect();
    let list = match names.as_slice() {
        [] => "every loop can be assembled in one way only".to_string(),
        names => format!("the loops with several modes are: {}", names.join(", ")),
    };
    format!(
        "no loop is named `{name}`{}\n  {list}",
        guess(name, names.iter().copied())
    )
}

fn guess<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    nearest(name, known).map_or(String::new(), |guess| format!("; did you mean `{guess}`?"))
}
