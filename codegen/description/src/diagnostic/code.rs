//! Defines the classes of findings with stable numbers and titles. A number is never reused for another class.

use std::fmt;

macro_rules! codes {
    ($($(#[doc = $title:literal])+ $variant:ident = $name:literal;)+) => {
        /// Class of a finding. The first digit is the group: 0 syntax, 1 names, 2 values and units, 3 structure, 9 Linkwright
        /// itself.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $($(#[doc = $title])+ $variant,)+
        }

        impl Code {
            /// All codes, in order of their numbers.
            pub const ALL: &'static [Code] = &[$(Code::$variant),+];

            /// Returns the stable number, as in `error[K07]`.
            pub fn name(self) -> &'static str {
                match self {
                    $(Code::$variant => $name,)+
                }
            }

            /// Returns the title of the class, one line.
            pub fn title(self) -> &'static str {
                match self {
                    $(Code::$variant => concat!($($title),+).trim_ascii(),)+
                }
            }
        }
    };
}

codes! {
    /// The file is not UTF-8 text, or too large to be a description.
    UnreadableFile = "K00";
    /// A character that no token of the language starts with.
    UnreadableCharacter = "K01";
    /// A token that cannot stand here.
    UnexpectedToken = "K02";
    /// A statement without its closing `;`.
    MissingSemicolon = "K03";
    /// A bracket that is never closed, or that closes nothing.
    UnbalancedBracket = "K04";
    /// The file ends inside a statement.
    UnexpectedEnd = "K05";
    /// The file describes no mechanism.
    EmptyFile = "K06";
    /// A word at the beginning of a statement that does not name one.
    UnknownStatement = "K07";
    /// Something that Rust may write as an expression, but this language does not.
    OutsideGrammar = "K08";
    /// Brackets, signs or powers nested deeper than anyone reads.
    NestedTooDeeply = "K09";
    /// A name that is reserved, not ASCII, or collides in the generated code.
    NameNotAllowed = "K10";
    /// A name that nothing declares.
    UnknownName = "K11";
    /// A name declared twice.
    DuplicateName = "K12";
    /// A call of a function the language does not have.
    UnknownFunction = "K13";
    /// A point used on a body that does not carry it, or without its body.
    PointNotOnBody = "K14";
    /// A call with too few or too many arguments.
    WrongArgumentCount = "K15";
    /// A joint between a body and itself, or on the ground alone.
    JointOnOneBody = "K16";
    /// A name that is declared and never used.
    UnusedName = "K17";
    /// A unit suffix that is unknown.
    UnknownUnit = "K20";
    /// A length where an angle is wanted, and the like.
    WrongDimension = "K21";
    /// A value that is infinite or not a number.
    NotFinite = "K22";
    /// A value that depends on `t` or an input where a constant is wanted.
    NotConstant = "K23";
    /// A direction of zero length, or other geometry that determines nothing.
    DegenerateGeometry = "K24";
    /// A value that a joint of this kind cannot have, or beyond its range.
    ValueNotAllowed = "K25";
    /// A law of motion or a table whose places do not increase.
    NotIncreasing = "K27";
    /// Pieces of a motion that do not join.
    PiecesApart = "K28";
    /// A table whose file cannot be read, or lies in another folder.
    UnreadableTable = "K29";
    /// A statement with the wrong operands, a missing or a superfluous `along`, or a missing or superfluous value.
    WrongForm = "K30";
    /// A mechanism without bodies.
    NoBodies = "K31";
    /// Fewer equations than coordinates: some bodies can still move freely.
    TooFewEquations = "K32";
    /// More equations than coordinates: some bodies are constrained twice.
    TooManyEquations = "K33";
    /// Equations that say the same in every pose, so that they determine less than their number.
    DependentEquations = "K34";
    /// A joint marked `redundant` that repeats nothing.
    NotRedundant = "K35";
    /// Repeated equations that contradict one another, so that no pose exists.
    ContradictingEquations = "K36";
    /// Formulas or equations that take more work than one description may cause.
    TooMuchWork = "K37";
    /// An assembly mode that the drawing decides by little.
    UndecidedMode = "K38";
    /// Links of constant lengths that do not reach their ends, so that no pose exists.
    OutOfReach = "K39";
    /// Lanes of a mechanism that cannot be solved in lanes.
    NoLanes = "K40";
    /// An error of Linkwright itself.
    InternalError = "K90";
}

impl fmt::Display for Code {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::Code;

    #[test]
    fn numbers_ascend_and_titles_are_one_line() {
        for pair in Code::ALL.windows(2) {
            assert!(
                pair[0].name() < pair[1].name(),
                "{} is listed after {}",
                pair[0],
                pair[1]
            );
            assert!(pair[0] < pair[1]);
        }
        for code in Code::ALL {
            assert!(
                !code.title().is_empty() && !code.title().contains('\n'),
                "{code}"
            );
        }
        assert_eq!(Code::UnknownFunction.to_string(), "K13");
        assert_eq!(Code::EmptyFile.title(), "The file describes no mechanism.");
    }
}
