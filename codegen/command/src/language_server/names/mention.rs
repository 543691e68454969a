//! Walks over a document for mentions of declared names.

use linkwright_codegen::stages::syntax::{
    Body, Center, Curve, Direction, Document, Element, Ends, Force, Mass, Member, Name, Operands,
    Orientation, Origin, OutputItem, Reference, Shape, Statement, Table, TablePoints,
};

use super::scope::{Owner, Scopes, Space};

impl Scopes {
    /// Records every mention. Requests of points and joints come last, since they may precede the declarations.
    pub(super) fn mention_all(&mut self, document: &Document) {
        let statements = &document.mechanism.statements;
        self.mention_in(statements, Scopes::mention_statement);
        self.mention_in(statements, Scopes::mention_requests);
    }

    fn mention_in(&mut self, statements: &[Statement], each: fn(&mut Scopes, &Statement)) {
        for statement in statements {
            match statement {
                Statement::Motion(motion) => {
                    self.motion = Some(motion.span);
                    self.mention_in(&motion.statements, each);
                    self.motion = None;
                }
                other => each(self, other),
            }
        }
    }

    fn mention_statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Constant(own)
            | Statement::Parameter(own)
            | Statement::Input(own)
            | Statement::Angle(own) => {
                self.formula(&own.value, None);
            }
            Statement::Table(own) => self.table(own),
            Statement::Points(own) => {
                for point in &own.points {
                    self.pair(&point.position, None);
                }
            }
            Statement::Body(own) => self.body_statement(own),
            Statement::Joint(own) => self.joint(own),
            Statement::Drive(own) => self.driver(own),
            Statement::Free(own) => {
                self.driver(&own.drive);
                if let Some(rate) = &own.rate {
                    self.formula(rate, None);
                }
            }
            Statement::Equation(own) => {
                self.formula(&own.left, None);
                self.formula(&own.right, None);
            }
            Statement::Curve(own) => self.curve(own),
            Statement::Mass(own) => self.mass(own),
            Statement::Gravity(own) => self.pair(&own.acceleration, None),
            Statement::Element(own) => self.element(own),
            Statement::Force(own) => self.force(own),
            Statement::Torque(own) => {
                self.body(&own.body);
                self.formula(&own.value, None);
            }
            Statement::Request(_) | Statement::Units(_) | Statement::Motion(_) => {}
        }
    }

    fn mention_requests(&mut self, statement: &Statement) {
        let Statement::Request(own) = statement else {
            return;
        };
        self.wanted(&own.items);
        if own.operands == Operands::Joints {
            own.names.iter().for_each(|it| self.joints_named(it));
            return;
        }
        for name in &own.names {
            if let Some(parameter) = self.find(Space::Values, &name.text) {
                self.mention(name.span, parameter);
            }
        }
    }

    fn table(&mut self, own: &Table) {
        if let TablePoints::Listed(pairs) = &own.points {
            pairs.iter().for_each(|it| self.pair(it, None));
        }
        if let Some(Ends { slopes, .. }) = &own.ends {
            slopes.iter().for_each(|it| self.formula(it, None));
        }
    }

    fn body_statement(&mut self, own: &Body) {
        match &own.origin {
            Origin::Coordinates(pair) => self.pair(pair, None),
            Origin::Point(reference) => self.drawn(reference),
        }
        match &own.orientation {
            Orientation::Aligned => {}
            Orientation::Angle(angle) => self.formula(angle, None),
            Orientation::Facing(Direction { from, to, .. }) => {
                self.drawn(from);
                self.drawn(to);
            }
        }
        for member in &own.members {
            if let Member::Local { position, .. } = member {
                self.pair(position, None);
            }
        }
    }

    /// Records a point at its place in the drawing.
    fn drawn(&mut self, reference: &Reference) {
        match &reference.body {
            Some(_) => self.point_of_body(reference),
            None => {
                self.point_of(Owner::Ground, &reference.name);
            }
        }
    }

    fn curve(&mut self, own: &Curve) {
        self.body(&own.body);
        for end in own.range.iter().flatten() {
            self.formula(end, None);
        }
        let parameter = self.declared_at(own.parameter.span);
        let running = parameter.map(|it| (own.parameter.text.as_str(), it));
        match &own.shape {
            Shape::Parametric(pair) => self.pair(pair, running),
            Shape::Polar(radius) => self.formula(radius, running),
        }
    }

    fn mass(&mut self, own: &Mass) {
        let owner = self.body(&own.body);
        self.formula(&own.mass, None);
        match (&own.center, owner) {
            (Some(Center::Point(name)), Some(owner)) => {
                self.point_of(owner, name);
            }
            (Some(Center::Local(pair)), _) => self.pair(pair, None),
            _ => {}
        }
        if let Some(inertia) = &own.inertia {
            self.formula(inertia, None);
        }
    }

    fn element(&mut self, own: &Element) {
        for operand in &own.operands {
            self.body_or_point_of(operand);
        }
        self.formula(&own.value, None);
        for part in own.free.iter().chain(&own.preload) {
            self.formula(part, None);
        }
    }

    fn force(&mut self, own: &Force) {
        match &own.point.body {
            Some(_) => self.point_of_body(&own.point),
            None => self.point_or_body(&own.point.name),
        }
        self.pair(&own.components, None);
        if let Some(frame) = &own.frame {
            self.body(frame);
        }
    }

    fn body_or_point_of(&mut self, operand: &Reference) {
        match &operand.body {
            Some(_) => self.point_of_body(operand),
            None => {
                self.body_or_point(&operand.name);
            }
        }
    }

    /// Records a point of the first body that carries it, or a body.
    pub(super) fn point_or_body(&mut self, name: &Name) {
        let body = self.find(Space::Bodies, &name.text);
        if let Some(found) = self.bare_point(&name.text).or(body) {
            self.mention(name.span, found);
        }
    }

    /// Records requested points and coordinates.
    fn wanted(&mut self, items: &[OutputItem]) {
        for item in items {
            match item {
                OutputItem::Point(Reference {
                    body: None, name, ..
                }) => {
                    let angle = self.angle(&name.text);
                    if let Some(named) = angle.or_else(|| self.bare_point(&name.text)) {
                        self.mention(name.span, named);
                    }
                }
                OutputItem::Point(reference) => self.point_of_body(reference),
                OutputItem::Coordinate { bodies, .. } => {
                    for body in bodies {
                        self.body(&body.name);
                    }
                }
            }
        }
    }
}
