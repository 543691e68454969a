//! Defines the arguments by which a motion departs from its description.

use clap::Args;

/// Other values and other modes than those of the description.
#[derive(Args, Debug)]
pub struct Setting {
    /// Another value of a parameter, or the motion of an input as an expression of t, in SI units or with a unit; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// The assembly mode of a loop: `positive` or `negative`, `other` than drawn, or of a loop without a closed form the letter of a
    /// pose that `check` lists; may be repeated. A wrong name lists the loops
    #[arg(long, value_name = "LOOP=MODE")]
    pub branch: Vec<String>,
}
