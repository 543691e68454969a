//! Chooses stems for the row names of joints and drivers in generated code.
//!
//! Every slug is unique. Neither a slug nor a slug with a suffix (`_x`, `_2`) is the name of anything else in the generated
//! functions.

use std::collections::{HashMap, HashSet};

use super::Role;
use super::operands::WrittenJoint;
use super::resolve::Resolver;

/// Slugs of all joints so far; never iterated.
#[derive(Clone, Debug, Default)]
pub(super) struct Slugs {
    taken: HashSet<String>,
    /// For each base, the number up to which all slugs are taken.
    numbers: HashMap<String, usize>,
}

impl Slugs {
    /// Reserves the slug of a joint.
    pub(super) fn take(&mut self, slug: &str) {
        self.taken.insert(slug.to_string());
    }

    /// Returns the base, or the base with the least number from 2 that is free.
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
    /// Returns a lower-case identifier for the rows of a joint.
    pub(super) fn unique_slug(&mut self, given: &WrittenJoint<'_>) -> String {
        let mut words: Vec<String> = Vec::new();
        match given.name {
            Some(name) => words.push(name.text.clone()),
            None => {
                if given.role == Role::Driver {
                    words.push("drive".to_string());
                }
                words.push(given.kind.keyword.to_string());
                for operand in given.operands {
                    words.extend(operand.body.iter().map(|body| body.text.clone()));
                    words.push(operand.name.text.clone());
                }
            }
        }
        self.linkage.unique_slug(&words.join("_"))
    }
}
