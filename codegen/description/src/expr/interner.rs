//! Stores nodes without duplicates, and numbers them in order of insertion.
//!
//! Equal nodes have equal ids, and an id never changes its node. Nodes are compared as they are: canonical forms are made by the
//! [graph](super::Graph).

use std::hash::{Hash, Hasher};

use super::hashing::ExprHasher;
use super::node::{ExprId, Node};

const VACANT: u32 = u32::MAX;

/// Nodes with their ids.
#[derive(Clone, Debug)]
pub(super) struct Interner {
    nodes: Vec<Node>,
    hashes: Vec<u64>,
    /// Hash table with open addressing, at most half full; its length is a power of two.
    slots: Vec<u32>,
}

/// Slot of a node that is not stored yet; valid until the next insertion.
pub(super) struct Vacancy {
    hash: u64,
    slot: usize,
}

impl Interner {
    pub fn new() -> Interner {
        Interner {
            nodes: Vec::new(),
            hashes: Vec::new(),
            slots: vec![VACANT; 64],
        }
    }

    /// Returns a node.
    pub fn node(&self, id: ExprId) -> &Node {
        &self.nodes[id.index()]
    }

    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the id of a node.
    ///
    /// # Errors
    /// The node is not stored; the vacancy takes it.
    pub fn find(&self, node: &Node) -> Result<ExprId, Vacancy> {
        let hash = hash(node);
        let mask = self.slots.len() - 1;
        let mut slot = hash as usize & mask;
        loop {
            let id = self.slots[slot];
            if id == VACANT {
                return Err(Vacancy { hash, slot });
            }
            if self.hashes[id as usize] == hash && self.nodes[id as usize] == *node {
                return Ok(ExprId(id));
            }
            slot = (slot + 1) & mask;
        }
    }

    /// Stores a node in the vacancy that was found for it.
    pub fn insert(&mut self, node: Node, vacancy: Vacancy) -> ExprId {
        assert!(
            self.nodes.len() < VACANT as usize,
            "expressions are numbered with 32 bits"
        );
        let id = self.nodes.len() as u32;
        self.slots[vacancy.slot] = id;
        self.nodes.push(node);
        self.hashes.push(vacancy.hash);
        if self.nodes.len() * 2 > self.slots.len() {
            self.widen();
        }
        ExprId(id)
    }

    fn widen(&mut self) {
        let length = self.slots.len() * 2;
        self.slots.clear();
        self.slots.resize(length, VACANT);
        for (id, &hash) in self.hashes.iter().enumerate() {
            let mut slot = hash as usize & (length - 1);
            while self.slots[slot] != VACANT {
                slot = (slot + 1) & (length - 1);
            }
            self.slots[slot] = id as u32;
        }
    }
}

fn hash(node: &Node) -> u64 {
    let mut hasher = ExprHasher::default();
    node.hash(&mut hasher);
    hasher.finish()
}
