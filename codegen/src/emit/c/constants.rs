//! Writes the public constants of a mechanism.
//!
//! A device does not see variables of the host. Device code therefore has a function for each constant, and a macro of the
//! constant's name that calls it.

use crate::emit::code::Code;

/// Public constant; a table if it has a count.
pub(super) struct Constant {
    pub type_name: String,
    pub name: String,
    pub count: Option<String>,
}

impl Constant {
    pub(super) fn new(type_name: String, name: String) -> Constant {
        Constant {
            type_name,
            name,
            count: None,
        }
    }

    /// Writes the declaration.
    pub(super) fn declare(&self, text: &mut Code) {
        let name = &self.name;
        text.line(format!(
            "LINKWRIGHT_CONSTANT{}({});",
            self.plural(),
            self.arguments()
        ));
        text.line("#ifdef LINKWRIGHT_DEVICE");
        text.line(match self.count {
            None => format!("#define {name} (*{name}_ADDRESS())"),
            Some(_) => format!("#define {name} {name}_ADDRESS()"),
        });
        text.line("#endif");
    }

    /// Writes the definition with the values of its fields, or with one element of a table in each line.
    pub(super) fn define(&self, values: &[String], text: &mut Code) {
        text.gap();
        text.line(format!(
            "LINKWRIGHT_CONSTANT{}_BEGIN({})",
            self.plural(),
            self.arguments()
        ));
        match self.count {
            None => text.line(format!("{{{}}}", values.join(", "))),
            Some(_) => {
                text.open("{");
                for value in values {
                    text.line(format!("{value},"));
                }
                text.close("}");
            }
        }
        text.line(format!("LINKWRIGHT_CONSTANT{}_END", self.plural()));
    }

    fn plural(&self) -> &'static str {
        match self.count {
            None => "",
            Some(_) => "S",
        }
    }

    fn arguments(&self) -> String {
        let Constant {
            type_name,
            name,
            count,
        } = self;
        let count = count.as_ref();
        let count = count.map_or(String::new(), |count| format!(", {count}"));
        format!("{type_name}, {name}{count}")
    }
}
