//! A joint or driver → what its rows are named after in generated code.
//!
//! Afterwards every slug differs from every other slug, and neither it nor what is appended to it (`_x`, `_2`) can be the name of
//! something else in the generated functions. Deliberately unknown here: how many rows a joint has.

use std::collections::{HashMap, HashSet};

use super::Role;
use super::operands::WrittenJoint;
use super::resolve::Resolver;

/// The slugs of all joints so far; only looked up.
#[derive(Clone, Debug, Default)]
pub(super) struct Slugs {
    taken: HashSet<String>,
    /// Of a base the number up to which all are taken.
    numbers: HashMap<String, usize>,
}

impl Slugs {
    /// Takes the slug of a joint.
    pub(super) fn take(&mut self, slug: &str) {
        self.taken.insert(slug.to_string());
    }

    /// The base, or with the first number from 2 on that makes it free.
    pub(super) fn free(&mut self, base: String) -> String {
        if !self.taken.contains(&base) {
            return base;
        }
        let number = self.numbers.entry(base.clone()).or_insert(2);
        loop {
            let numbered = format!("{base}_{number}");
            if !self.taken.contains(&numbered) {
                return numbered;
            }
            *number += 1;
        }
    }
}

impl Resolver<'_> {
    /// A lower-case identifier for the rows of a joint.
    pub(super) fn unique_slug(&mut self, given: &WrittenJoint<'_>) -> String {
        let mut words: Vec<String> = Vec::new();
        match given.name {
            Some(name) => words.push(name.text.clone()),
            None => {
                if given.role == Role::Driver {
                    words.push("drive".to_string());
                }
                words.push(given.kind.keyword().to_string());
                for operand in given.operands {
                    words.extend(operand.body.iter().map(|body| body.text.clone()));
                    words.push(operand.name.text.clone());
                }
            }
        }
        self.linkage.unique_slug(&words.join("_"))
    }
}
