//! Finds drivers by their names.

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::model::{Mechanism, Role};

/// Driver whose value may be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Driven quantity, or its name if it has one: `phi(crank)`, `tilt`.
    pub name: String,
    /// True for an angle (rad), false for a length (m).
    pub is_angle: bool,
}

impl Drive {
    /// SI unit of its values.
    pub fn si(&self) -> &'static str {
        match self.is_angle {
            true => "rad",
            false => "m",
        }
    }

    /// Returns all drivers, in the order of the description.
    pub fn all(mechanism: &Mechanism) -> Vec<Drive> {
        let joints = mechanism.joints.iter().enumerate();
        let drivers = joints.filter(|(_, own)| own.role == Role::Driver);
        let drives = drivers.filter_map(|(joint, own)| {
            let quantity = own.kind.value.quantity()?;
            own.operands.value?;
            let driven = driven(&own.label);
            Some(Drive {
                joint,
                name: own.name.clone().unwrap_or_else(|| driven.to_string()),
                is_angle: quantity == Quantity::Angle,
            })
        });
        drives.collect()
    }

    /// Returns the driver of this name, label or driven quantity; blanks do not matter.
    ///
    /// # Errors
    /// A sentence and its help, which lists the drivers.
    pub fn named(mechanism: &Mechanism, name: &str) -> Result<Drive, [String; 2]> {
        let plain = |text: &str| text.split_whitespace().collect::<String>();
        let sought = plain(name);
        let drives = Drive::all(mechanism);
        let is_named = |drive: &&Drive| {
            let joint = &mechanism.joints[drive.joint];
            let labels = [&drive.name, &joint.label, driven(&joint.label), &joint.slug];
            labels.into_iter().any(|it| plain(it) == sought)
        };
        if let Some(drive) = drives.iter().find(is_named) {
            return Ok(drive.clone());
        }
        let names = drives.iter().map(|it| it.name.as_str());
        let help = match (nearest(name, names.clone()), drives.is_empty()) {
            (_, true) => "add a driver: `drive phi(crank) = 30deg;`".to_string(),
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, _) => {
                let quoted = names.map(|it| format!("`{it}`"));
                let quoted: Vec<String> = quoted.collect();
                format!("the drivers are {}", quoted.join(", "))
            }
        };
        let title = mechanism.title();
        Err([format!("`{title}` has no driver named `{name}`"), help])
    }
}

/// Returns the driven quantity in the label of a driver: `phi(crank)` of `drive tilt: phi(crank)`.
fn driven(label: &str) -> &str {
    let behind_word = label.split_once(' ').map_or(label, |(_, rest)| rest);
    behind_word
        .split_once(": ")
        .map_or(behind_word, |(_, rest)| rest)
}
