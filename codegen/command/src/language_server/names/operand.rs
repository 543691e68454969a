//! Finds the names in joints and drivers, by the operands of their kinds.

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::joint::{CONSTRAINTS, DRIVERS, Kind, Line, Slot};
use linkwright_codegen::stages::syntax::{Direction, Drive, DrivenForm, Joint, Name, Reference};

use super::scope::{JointNames, Owner, Scopes, Space};
use super::{Sort, Symbol, SymbolId};

impl Scopes {
    /// Finds the names in a joint, with its own name and its line.
    pub(super) fn joint(&mut self, joint: &Joint) {
        let kind = named(CONSTRAINTS, &joint.kind.text);
        let slots = kind.map_or(&[][..], |kind| kind.operands.slots);
        let line = kind.map_or(Line::None, |kind| kind.operands.line);
        let mut owners = Vec::new();
        let mut pins = Vec::new();
        for (place, operand) in joint.operands.iter().enumerate() {
            let slot = slots.get(place).copied().unwrap_or(Slot::Point);
            let owner = self.operand(slot, operand, joint.name.as_ref());
            if let (Slot::Pin, Some(name), Some(owner), None) =
                (slot, &joint.name, owner, &operand.body)
            {
                pins.extend(self.point_of(owner, name));
            }
            owners.push(owner);
        }
        for pair in pins.windows(2) {
            self.unite(pair[0], pair[1]);
        }
        // A joint that is not named after a point of its bodies has a symbol of its own.
        let symbol = joint.name.as_ref().map(|name| match pins.first() {
            Some(&pin) => pin,
            None => self.own_name(joint, name),
        });
        let along = joint.along.as_ref().map(|along| {
            let ends = self.line(along, line, &owners);
            (along.clone(), ends)
        });
        self.joints.push(JointNames {
            motion: self.motion,
            name: joint.name.as_ref().map(|name| name.text.clone()),
            symbol,
            along,
        });
        for part in joint.value.iter().chain(&joint.pressure_angle) {
            self.formula(part, None);
        }
    }

    fn own_name(&mut self, joint: &Joint, name: &Name) -> SymbolId {
        self.declare(Symbol {
            sort: Sort::Joint,
            name: name.text.clone(),
            spelled: name.text.clone(),
            place: name.span,
            declared: name.span,
            written: joint.span,
            statement: joint.span,
            opening: "",
            docs: joint.docs.clone(),
            body: None,
            motion: self.motion,
        })
    }

    /// Finds the names in a driver, or in a free quantity.
    pub(super) fn driver(&mut self, drive: &Drive) {
        let kind = named(DRIVERS, &drive.quantity.text);
        let form = kind.map(|kind| kind.operands);
        match (form.map(|it| it.line), &drive.operands[..]) {
            (Some(Line::Existing), [from, to]) => self.existing_line(from, to),
            _ => {
                for (place, operand) in drive.operands.iter().enumerate() {
                    if drive.form == DrivenForm::Dotted && operand.body.is_none() {
                        self.point_or_body(&operand.name);
                        continue;
                    }
                    let slot = form.and_then(|it| it.slots.get(place)).copied();
                    self.operand(slot.unwrap_or(Slot::Point), operand, None);
                }
            }
        }
        self.formula(&drive.value, None);
    }

    /// Finds the names of an operand; returns its body, or the body of its point.
    fn operand(&mut self, slot: Slot, operand: &Reference, joint: Option<&Name>) -> Option<Owner> {
        if let Some(body) = &operand.body {
            let owner = self.body(body)?;
            self.point_of(owner, &operand.name);
            return Some(owner);
        }
        let name = &operand.name;
        match slot {
            Slot::Body | Slot::Turning | Slot::Counterpart | Slot::Carrier => self.body(name),
            Slot::Pin if joint.is_some() => self.body(name),
            Slot::Point | Slot::Pin => self.body_or_point(name),
            Slot::GroundPoint => {
                self.point_of(Owner::Ground, name);
                Some(Owner::Ground)
            }
            Slot::Curve => {
                if let Some(curve) = self.find(Space::Curves, &name.text) {
                    self.mention(name.span, curve);
                }
                None
            }
        }
    }

    /// Finds a body that stands for its origin, or a point that is named without a body.
    pub(super) fn body_or_point(&mut self, name: &Name) -> Option<Owner> {
        let owner = self.body(name);
        if owner.is_none()
            && let Some(point) = self.bare_point(&name.text)
        {
            self.mention(name.span, point);
        }
        owner
    }

    /// Finds the ends of a line on the bodies that the line belongs to.
    fn line(
        &mut self,
        along: &Direction,
        line: Line,
        owners: &[Option<Owner>],
    ) -> [Option<SymbolId>; 2] {
        let places = match line {
            Line::On(owner) => [owner; 2],
            Line::None | Line::Between | Line::Existing => [0, 1],
        };
        let ends = [(&along.from, places[0]), (&along.to, places[1])];
        ends.map(|(end, place)| self.end(end, owners.get(place).copied().flatten()))
    }

    fn end(&mut self, end: &Reference, owner: Option<Owner>) -> Option<SymbolId> {
        let owner = match &end.body {
            Some(body) => self.body(body),
            None => owner,
        };
        self.point_of(owner?, &end.name)
    }

    /// Finds the names in `(P, Q)`, which refers to the joint along P -> Q.
    fn existing_line(&mut self, from: &Reference, to: &Reference) {
        let motion = self.motion;
        let known = self.joints.iter().filter(|it| it.is_known_in(motion));
        let lines = known.filter_map(|joint| joint.along.as_ref());
        let mut lines = lines.filter(|(along, _)| same(from, &along.from) && same(to, &along.to));
        let ends = lines.next().map(|(_, ends)| *ends);
        for (place, end) in [from, to].into_iter().enumerate() {
            if let Some(body) = &end.body {
                self.body(body);
            }
            if let Some(point) = ends.and_then(|it| it[place]) {
                self.mention(end.name.span, point);
            }
        }
    }

    /// Records the joints of a name, which share one name in a request.
    pub(super) fn joints_named(&mut self, name: &Name) {
        let motion = self.motion;
        let known = self.joints.iter().filter(|it| it.is_known_in(motion));
        let named = known.filter(|it| it.name.as_ref() == Some(&name.text));
        let symbols: Vec<SymbolId> = named.filter_map(|it| it.symbol).collect();
        for &symbol in &symbols {
            self.mention(name.span, symbol);
            self.unite(symbols[0], symbol);
        }
    }
}

impl JointNames {
    /// True if statements of a motion may name the joint.
    fn is_known_in(&self, motion: Option<Span>) -> bool {
        self.motion.is_none() || self.motion == motion
    }
}

fn named(kinds: &[&'static Kind], keyword: &str) -> Option<&'static Kind> {
    kinds.iter().copied().find(|kind| kind.keyword == keyword)
}

/// True if `written` names the end of a line.
fn same(written: &Reference, end: &Reference) -> bool {
    let bodies = match (&written.body, &end.body) {
        (Some(one), Some(other)) => one.text == other.text,
        _ => true,
    };
    bodies && written.name.text == end.name.text
}
