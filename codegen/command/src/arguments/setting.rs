//! Defines the arguments by which a motion departs from its description.

use clap::Args;

/// Values and assembly modes other than those of the description.
#[derive(Args, Debug)]
pub struct Setting {
    /// Value of a parameter, or motion of an input as an expression of t, in SI units or with a unit; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Assembly mode of a loop: `positive`, `negative`, or `other` than that of the design configuration; of a loop
    /// without a closed form the letter of a pose that `check` lists. May be repeated; a wrong name lists the loops
    #[arg(long, value_name = "LOOP=MODE")]
    pub branch: Vec<String>,
}
