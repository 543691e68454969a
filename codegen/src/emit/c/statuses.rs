//! Failures of the C runtime: numbers, words and comments.
//!
//! They follow `FailureKind` of the Rust runtime, kind by kind. The number of a status never changes.

/// Failure that a call returns.
struct Status {
    name: &'static str,
    number: u8,
    /// Lines of the comment.
    about: &'static [&'static str],
    /// Words for messages.
    words: &'static str,
}

/// All failures.
const STATUSES: [Status; 14] = [
    Status {
        name: "LINKWRIGHT_SINGULAR",
        number: 1,
        about: &[
            "The Jacobian is singular, or so close to singular that no digit of a solution can be trusted. The failure's",
            "value is the pivot ratio, its column the coordinate at which elimination stopped.",
        ],
        words: "singular Jacobian",
    },
    Status {
        name: "LINKWRIGHT_DIVERGED",
        number: 2,
        about: &["The iterates of Newton-Raphson diverge."],
        words: "Newton-Raphson diverges",
    },
    Status {
        name: "LINKWRIGHT_CYCLING",
        number: 3,
        about: &["The iterates of Newton-Raphson cycle."],
        words: "Newton-Raphson cycles",
    },
    Status {
        name: "LINKWRIGHT_STALLED",
        number: 4,
        about: &["A step was shorter than rounding, and the residual still exceeds the tolerance."],
        words: "Newton-Raphson stalls",
    },
    Status {
        name: "LINKWRIGHT_ITERATION_LIMIT",
        number: 5,
        about: &["None of the other failures occurred within the steps that the settings allow."],
        words: "Newton-Raphson does not converge",
    },
    Status {
        name: "LINKWRIGHT_OUT_OF_REACH",
        number: 6,
        about: &[
            "The links of a closed-form block do not span the distance between their far pins. The value is the missing",
            "distance in m.",
        ],
        words: "out of reach",
    },
    Status {
        name: "LINKWRIGHT_WRONG_BRANCH",
        number: 7,
        about: &["The computed pose belongs to another assembly mode."],
        words: "only another assembly mode is found",
    },
    Status {
        name: "LINKWRIGHT_STEP_TOO_LARGE",
        number: 8,
        about: &[
            "The motion could not be followed to the requested time in as many steps as the settings allow.",
        ],
        words: "the step is too large for the motion to be followed",
    },
    Status {
        name: "LINKWRIGHT_UNDECIDED",
        number: 11,
        about: &[
            "The motion comes to a change point, and nothing tells in which mode it continues: it rests there, or is equally",
            "smooth in both. A shorter step does not help.",
        ],
        words: "two assembly modes meet, and the motion does not tell them apart",
    },
    Status {
        name: "LINKWRIGHT_NOT_POSITIVE",
        number: 9,
        about: &[
            "A quantity that must be positive is not, because of parameters, inputs or t. The value is that quantity, the",
            "block its index among those that must be positive.",
        ],
        words: "not positive",
    },
    Status {
        name: "LINKWRIGHT_NOT_FINITE",
        number: 10,
        about: &[
            "A number is infinite or NaN. For an input, the failure's column is its index, counted from 1.",
        ],
        words: "a number is not finite",
    },
    Status {
        name: "LINKWRIGHT_LOAD_NOT_FINITE",
        number: 12,
        about: &[
            "A load, such as an applied force or a spring, is infinite or NaN; the pose that it follows from is finite. The",
            "failure's column is the index of the load in the table LOADS of the mechanism.",
        ],
        words: "a load is not finite",
    },
    Status {
        name: "LINKWRIGHT_OUTSIDE_RANGE",
        number: 13,
        about: &[
            "A parameter or an input is outside of its range. The value is that number. For an input, the failure's column",
            "is its index, counted from 1; for a parameter the column is 0, and the block is its index.",
        ],
        words: "a value is outside of its range",
    },
    Status {
        name: "LINKWRIGHT_FRICTION_UNSETTLED",
        number: 14,
        about: &[
            "The forces of friction in joints do not settle: the reactions grow with the friction that they cause, as in a",
            "mechanism that jams. The value is the change in the last step, relative to the largest force.",
        ],
        words: "the forces of friction do not settle",
    },
];

/// Returns the constants of the enumeration, ordered by number.
pub(super) fn constants() -> String {
    let mut statuses: Vec<&Status> = STATUSES.iter().collect();
    statuses.sort_by_key(|it| it.number);
    let constants = statuses.iter().map(|it| {
        let about = it.about.join("\n       ");
        format!("    /* {about} */\n    {} = {}", it.name, it.number)
    });
    constants.collect::<Vec<_>>().join(",\n") + "\n"
}

/// Returns the cases of a `switch` that sets the words.
pub(super) fn cases() -> String {
    let case = |it: &Status| {
        format!(
            "    case {}:\n        text = \"{}\";\n        break;\n",
            it.name, it.words
        )
    };
    STATUSES.iter().map(case).collect()
}

#[cfg(test)]
mod tests {
    use super::STATUSES;

    #[test]
    fn every_number_from_one_is_that_of_one_failure() {
        let mut numbers = STATUSES.map(|it| usize::from(it.number));
        numbers.sort_unstable();
        assert!(numbers.into_iter().eq(1..=STATUSES.len()));
    }
}
