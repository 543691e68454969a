//! Finds the calls between the functions of firmware from its instructions, and the functions that can call
//! themselves.
//!
//! A call through a pointer may lead to every function whose address the program holds: in its constants, beside its
//! code, or in a pair of instructions. So a function that is reported as recursive need not be, but one that is not
//! reported cannot be.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::Path;
use std::process::Command;

use super::tools::output;

/// A function.
#[derive(Clone, Debug, Default)]
struct Function {
    name: String,
    /// Addresses that it branches to.
    targets: BTreeSet<u32>,
    /// True if it calls through a pointer.
    is_indirect: bool,
    /// True if it calls itself; a branch to its own start is a loop.
    calls_itself: bool,
}

/// Functions of a program.
#[derive(Clone, Debug, Default)]
pub struct Calls {
    functions: BTreeMap<u32, Function>,
    /// Functions to which pointers may lead.
    held: BTreeSet<u32>,
}

impl Calls {
    /// Disassembles a program.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(elf: &Path) -> io::Result<Self> {
        let code = output(
            Command::new("arm-none-eabi-objdump")
                .args(["-d", "-z", "-C", "--no-show-raw-insn"])
                .arg(elf),
        )?;
        let constants = output(
            Command::new("arm-none-eabi-objdump")
                .args(["-s", "-j", ".rodata", "-j", ".data", "-j", ".text"])
                .arg(elf),
        )?;
        let mut calls = Self::of_code(&code);
        calls.hold(words(&constants));
        Ok(calls)
    }

    fn of_code(code: &str) -> Self {
        let mut calls = Self::default();
        let mut address = None;
        // Lower halves of addresses in registers.
        let mut halves: BTreeMap<String, u32> = BTreeMap::new();
        let mut pairs = Vec::new();
        for line in code.lines() {
            if let Some(heading) = line.strip_suffix(">:") {
                let Some((start, name)) = heading.split_once(" <") else {
                    continue;
                };
                address = u32::from_str_radix(start, 16).ok();
                halves.clear();
                if let Some(address) = address {
                    let name = name.to_string();
                    calls.functions.insert(
                        address,
                        Function {
                            name,
                            ..Function::default()
                        },
                    );
                }
                continue;
            }
            let Some(function) = address.and_then(|it| calls.functions.get_mut(&it)) else {
                continue;
            };
            let mut columns = line.split('\t').skip(1);
            let (Some(mnemonic), operands) = (columns.next(), columns.next().unwrap_or("")) else {
                continue;
            };
            let first = operands.split([',', ' ']).next().unwrap_or("");
            if mnemonic.starts_with("movw") || mnemonic == "mov.w" {
                halves.insert(first.to_string(), immediate(operands));
            } else if mnemonic.starts_with("movt") {
                let lower = halves.get(first).copied().unwrap_or(0);
                pairs.push(immediate(operands) << 16 | lower);
            } else if mnemonic.starts_with("blx") || mnemonic.starts_with("bx") {
                function.is_indirect |= first != "lr";
            } else if mnemonic.starts_with('b') || mnemonic.starts_with("cb") {
                // `bl 24c0 <solve>`, `cbz r0, 24c0 <solve+0x10>`
                let target = operands.split(" <").next().unwrap_or("");
                let target = target.rsplit([' ', ',']).next().unwrap_or("");
                if let (true, Ok(target)) =
                    (operands.contains(" <"), u32::from_str_radix(target, 16))
                {
                    function.targets.insert(target);
                    function.calls_itself |= mnemonic == "bl" && Some(target) == address;
                }
            } else if first == "pc" && ["ldr", "mov"].iter().any(|it| mnemonic.starts_with(it)) {
                function.is_indirect = true;
            }
        }
        calls.hold(pairs);
        calls
    }

    /// Records the words that are addresses of functions, which are odd.
    fn hold(&mut self, words: impl IntoIterator<Item = u32>) {
        let odd = words
            .into_iter()
            .filter(|word| word % 2 == 1)
            .map(|word| word - 1);
        self.held
            .extend(odd.filter(|it| self.functions.contains_key(it)));
    }

    /// Function that contains an address.
    fn place(&self, address: u32) -> Option<u32> {
        self.functions
            .range(..=address)
            .next_back()
            .map(|(start, _)| *start)
    }

    fn called(&self, start: u32) -> BTreeSet<u32> {
        let function = &self.functions[&start];
        let targets = function.targets.iter();
        let mut called: BTreeSet<u32> = targets.filter_map(|it| self.place(*it)).collect();
        called.retain(|it| *it != start || function.calls_itself);
        if function.is_indirect {
            called.extend(&self.held);
        }
        called
    }

    /// Functions that can be on the stack twice, among those that functions with these words in their names can
    /// reach. `through a pointer` marks those to which only a pointer leads back.
    pub fn recursive(&self, roots: &[&str]) -> Vec<String> {
        let is_root = |function: &Function| roots.iter().any(|it| function.name.contains(it));
        let from = self
            .functions
            .iter()
            .filter(|(_, it)| is_root(it))
            .map(|(start, _)| *start);
        let reached = self.reached(from.collect());
        let in_cycle = |start: &&u32| self.reached(self.called(**start)).contains(*start);
        let cycles = reached.iter().filter(in_cycle);
        cycles
            .map(|start| self.functions[start].name.clone())
            .collect()
    }

    /// Number of functions that these can reach, and of those among them that call through pointers.
    pub fn extent(&self, roots: &[&str]) -> [usize; 2] {
        let is_root = |function: &Function| roots.iter().any(|it| function.name.contains(it));
        let from = self
            .functions
            .iter()
            .filter(|(_, it)| is_root(it))
            .map(|(start, _)| *start);
        let reached = self.reached(from.collect());
        let indirect = reached
            .iter()
            .filter(|it| self.functions[it].is_indirect)
            .count();
        [reached.len(), indirect]
    }

    fn reached(&self, from: BTreeSet<u32>) -> BTreeSet<u32> {
        let mut open: Vec<u32> = from.iter().copied().collect();
        let mut reached = from;
        while let Some(start) = open.pop() {
            for next in self.called(start) {
                if reached.insert(next) {
                    open.push(next);
                }
            }
        }
        reached
    }
}

/// `#5`, in `movw r0, #5 @ 0x5`.
fn immediate(operands: &str) -> u32 {
    let number = operands.split('#').nth(1).unwrap_or("");
    let digits = number
        .split(|it: char| !it.is_ascii_digit())
        .next()
        .unwrap_or("");
    digits.parse().unwrap_or(0)
}

/// Words of a listing of memory: an address, four words of four bytes, and their characters.
fn words(listing: &str) -> Vec<u32> {
    let lines = listing
        .lines()
        .filter(|line| line.starts_with(' ') && line.len() > 41);
    let word = |text: &str| u32::from_str_radix(text, 16).ok().map(u32::swap_bytes);
    lines
        .flat_map(|line| {
            let columns = line.split_whitespace().skip(1).take(4);
            columns
                .filter(|it| it.len() == 8)
                .filter_map(word)
                .collect::<Vec<_>>()
        })
        .collect()
}
