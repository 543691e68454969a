//! The statements of a document, in written order → a mechanism.

use std::collections::{HashMap, HashSet};

use super::bounds::beyond_bounds;
use super::carriers::Carriers;
use super::curve::{self, DrawnCurve};
use super::expression::{BUILT_IN, Value, listed};
use super::kinematic::KinematicTerms;
use super::lines::APART;
use super::namespace::Namespace;
use super::naming::Naming;
use super::parameters::Fields;
use super::request::Named;
use super::slug::Slugs;
use super::{Body, Dimension, Input, Joint, Mechanism, Motion, NamedMark, Parameter, Table};
use crate::diagnostic::{Attachment, Code, Diagnostic, Diagnostics, Span, Suggestions};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{BodyFrame, BodyId, Mark, Vector, subtract};
use crate::syntax::{self, WishKind};

/// A point of the drawing.
#[derive(Clone, Debug)]
pub(super) struct DrawnPoint {
    pub position: Vector,
    pub docs: Vec<String>,
}

/// What has been declared so far.
pub(super) struct Resolver<'a> {
    pub graph: Graph,
    pub time: SymbolId,
    /// Constants, parameters and inputs.
    pub constants: Namespace<Value>,
    pub parameters: Vec<Parameter>,
    pub inputs: Vec<Input>,
    /// The place of the input that a symbol is the value of; only looked up.
    pub input_places: HashMap<SymbolId, usize>,
    pub fields: Fields,
    /// The name that first became this constant of a table; only looked up.
    pub table_fields: HashMap<String, syntax::Name>,
    /// Every symbol that some expression mentions by the name of a constant, a parameter or an input; only looked up.
    pub mentioned: HashSet<SymbolId>,
    /// Where the points of the ground are that equations name.
    pub named_on_ground: Vec<Vector>,
    /// Tables: places in the list below; nothing where the statement has an error.
    pub table_names: Namespace<Option<usize>>,
    pub tables: Vec<Table>,
    pub drawn: Namespace<DrawnPoint>,
    /// Curves; nothing where the statement has an error.
    pub curves: Namespace<Option<DrawnCurve>>,
    /// The choices around the formula that is read: each condition, and whether the formula stands where it is negative.
    pub choices: Vec<(ExprId, bool)>,
    /// The parameter of the curve whose formula is read.
    pub parameter: Option<curve::Parameter>,
    /// The first body in the whole description that carries a point of each name, and where it lists it; only looked up.
    pub carried: HashMap<&'a str, (&'a str, Span)>,
    pub body_ids: Namespace<BodyId>,
    /// The names that drivers were given.
    pub drivers: Namespace<()>,
    /// The names that equations were given.
    pub equations: Namespace<()>,
    /// What the equation that is being read mentions; `None` elsewhere, where nothing moves but by t.
    pub kinematic: Option<KinematicTerms>,
    pub bodies: Vec<Body>,
    /// The body and the axis of each coordinate; only looked up.
    pub coordinate_places: HashMap<SymbolId, (BodyId, usize)>,
    /// The points that they carry.
    pub carriers: Carriers,
    /// Each with the direction it was written along, by which drivers find it.
    pub joints: Vec<(Joint, Option<syntax::Direction>)>,
    /// What their rows are named after.
    pub slugs: Slugs,
    pub naming: &'static Naming,
    /// How many equations the description has written out.
    pub equation_count: usize,
    /// The directions of joints that have an error.
    pub broken_lines: Vec<syntax::Direction>,
    /// The files that the description names.
    pub attachments: &'a [Attachment],
    pub suggestions: Suggestions,
    /// Whether a bound of the graph has been passed and reported.
    pub exceeded: bool,
    pub diagnostics: &'a mut Diagnostics,
}

/// Resolves the mechanism that these statements of a document make, all of them or those of one motion.
///
/// Names may only be used below their declaration. The coordinates are named `x1, y1, phi1` for the body `1` and
/// `x_c1, y_c1, phi_c1` for the body `c1`.
pub(super) fn resolve_statements<'a>(
    document: &'a syntax::Document,
    statements: &[&'a syntax::Statement],
    motion: Option<&syntax::Motion>,
    naming: &'static Naming,
    diagnostics: &mut Diagnostics,
) -> Mechanism {
    let mut graph = Graph::new();
    let item = &document.mechanism;
    // Coordinates are numbered before t, so that they come first wherever symbols are ordered.
    let written_bodies = statements.iter().filter_map(|statement| match statement {
        syntax::Statement::Body(body) => Some(body),
        _ => None,
    });
    let mut carried = HashMap::new();
    for body in written_bodies {
        for name in coordinate_names(&body.name.text) {
            graph.symbol(&name);
        }
        for member in &body.members {
            let (syntax::Member::Local { name, .. } | syntax::Member::Carried { name, .. }) =
                member;
            let first = (body.name.text.as_str(), name.span);
            carried.entry(name.text.as_str()).or_insert(first);
        }
    }
    let time = graph.symbol("t");
    let mut resolver = Resolver::new(graph, time, naming, diagnostics);
    resolver.attachments = &document.attachments;
    resolver.carried = carried;
    resolver.diagnostics.extend((naming.mechanism)(&item.name));
    for statement in statements {
        let before = resolver.diagnostics.mark();
        resolver.add(statement);
        resolver.note_excess(before, statement.span());
        if resolver.exceeded || resolver.diagnostics.is_full() {
            break;
        }
    }
    if resolver.bodies.len() == 1 && !resolver.diagnostics.has_errors() {
        resolver.diagnostics.push(
            Diagnostic::error(
                Code::NoBodies,
                item.name.span,
                format!("mechanism `{}` has no bodies", item.name.text),
            )
            .help("declare one: `body 1 at (0, 0) { P: (1, 0) }`"),
        );
    }
    let points = resolver.output_points();
    let outputs = statements.iter().filter_map(|statement| match statement {
        syntax::Statement::Output(output) => Some(output),
        _ => None,
    });
    let named = Named::new(&points);
    let requests = outputs
        .flat_map(|output| resolver.requests(output, &named))
        .collect();
    let transmissions = resolver.transmissions(statements, &named);
    let sensitivities = resolver.sensitivities(statements, &points);
    let monitor = resolver.wishes(WishKind::Monitor, statements);
    let is_unguarded = resolver.wishes(WishKind::Unguarded, statements);
    let end = resolver.diagnostics.mark();
    resolver.note_excess(end, item.name.span);
    resolver.note_used();
    let characteristic_length = resolver.characteristic_length();
    let docs = document.docs.iter().chain(&item.docs).cloned().collect();
    Mechanism {
        name: item.name.text.clone(),
        motion: motion.map(|motion| Motion {
            name: motion.name.text.clone(),
            docs: motion.docs.clone(),
            span: motion.name.span,
        }),
        docs,
        span: item.name.span,
        naming,
        graph: resolver.graph,
        time,
        parameters: resolver.parameters,
        inputs: resolver.inputs,
        tables: resolver.tables,
        bodies: resolver.bodies,
        joints: resolver
            .joints
            .into_iter()
            .map(|(joint, _)| joint)
            .collect(),
        points,
        requests,
        transmissions,
        sensitivities,
        monitor,
        is_unguarded,
        characteristic_length,
    }
}

/// `x1, y1, phi1` of body `1`; `x_c1, y_c1, phi_c1` of body `c1`.
fn coordinate_names(body: &str) -> [String; 3] {
    let separator = if body.starts_with(|first: char| first.is_ascii_digit()) {
        ""
    } else {
        "_"
    };
    ["x", "y", "phi"].map(|coordinate| format!("{coordinate}{separator}{body}"))
}

impl<'a> Resolver<'a> {
    /// Nothing has been declared but the ground.
    pub(super) fn new(
        graph: Graph,
        time: SymbolId,
        naming: &'static Naming,
        diagnostics: &'a mut Diagnostics,
    ) -> Resolver<'a> {
        let zero = graph.zero();
        let ground_frame = BodyFrame {
            body: BodyId::GROUND,
            origin: [zero, zero],
            angle: zero,
        };
        let mut resolver = Resolver {
            graph,
            time,
            constants: Namespace::new("constant"),
            parameters: Vec::new(),
            inputs: Vec::new(),
            input_places: HashMap::new(),
            fields: Fields::new(),
            table_fields: HashMap::new(),
            mentioned: HashSet::new(),
            named_on_ground: Vec::new(),
            table_names: Namespace::new("table"),
            tables: Vec::new(),
            drawn: Namespace::new("point"),
            curves: Namespace::new("curve"),
            choices: Vec::new(),
            parameter: None,
            carried: HashMap::new(),
            body_ids: Namespace::new("body"),
            drivers: Namespace::new("driver"),
            equations: Namespace::new("equation"),
            kinematic: None,
            bodies: vec![Body {
                name: "ground".to_string(),
                docs: Vec::new(),
                span: Span::default(),
                frame: ground_frame,
                coordinates: None,
                drawn: ground_frame,
                marks: Vec::new(),
            }],
            coordinate_places: HashMap::new(),
            carriers: Carriers::default(),
            joints: Vec::new(),
            slugs: Slugs::default(),
            naming,
            equation_count: 0,
            broken_lines: Vec::new(),
            attachments: &[],
            suggestions: Suggestions::default(),
            exceeded: false,
            diagnostics,
        };
        let ground = syntax::Name {
            text: "ground".to_string(),
            span: Span::default(),
        };
        // The first declaration of a fresh table cannot be a duplicate.
        let _ = resolver.body_ids.declare(&ground, BodyId::GROUND);
        resolver
    }
}

impl Resolver<'_> {
    /// Carries out one statement.
    fn add(&mut self, statement: &syntax::Statement) {
        match statement {
            syntax::Statement::Constant(constant) => self.add_constant(constant),
            syntax::Statement::Parameter(parameter) => self.add_parameter(parameter),
            syntax::Statement::Input(input) => self.add_input(input),
            syntax::Statement::Table(table) => self.add_table(table),
            syntax::Statement::Points(points) => self.add_points(points),
            syntax::Statement::Body(body) => self.add_body(body),
            syntax::Statement::Curve(curve) => self.add_curve(curve),
            syntax::Statement::Joint(joint) => self.add_joint(joint),
            syntax::Statement::Drive(drive) => self.add_driver(drive),
            syntax::Statement::Equation(equation) => self.add_equation(equation),
            // Points are known once all bodies are, and parameters may follow.
            syntax::Statement::Output(_)
            | syntax::Statement::Transmission(_)
            | syntax::Statement::Sensitivity(_)
            | syntax::Statement::Wish(_) => {}
            // Its statements come by themselves.
            syntax::Statement::Motion(_) => {}
        }
    }

    /// Where a bound of the graph has been passed, that is the one finding of the statement that did so.
    fn note_excess(&mut self, before: usize, span: Span) {
        if let (Some(excess), false) = (self.graph.excess(), self.exceeded) {
            self.exceeded = true;
            self.diagnostics.forget_after(before);
            self.diagnostics.push(beyond_bounds(excess, span));
        }
    }

    fn add_constant(&mut self, constant: &syntax::Constant) {
        let name = &constant.name;
        if !self.may_be_declared(name) {
            return;
        }
        let value = self.value(&constant.value);
        if let Some((value, _)) = value
            && let Some(cause) = self.moving(value)
        {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NotConstant,
                    constant.value.span,
                    format!("a constant cannot depend on {cause}"),
                )
                .label("changes with time")
                .help("write the expression where it is used, in a `drive` statement"),
            );
        }
        let value = value.unwrap_or((self.graph.one(), Dimension::Number));
        if let Some(duplicate) = self.constants.declare(name, value) {
            self.diagnostics.push(duplicate);
        }
    }

    /// The known name that was probably meant.
    pub(super) fn nearest_known<'n>(
        &self,
        word: &str,
        known: impl IntoIterator<Item = &'n str>,
    ) -> Option<&'n str> {
        self.suggestions.nearest(word, known)
    }

    /// Reports a name that has a fixed meaning.
    pub(super) fn may_be_declared(&mut self, name: &syntax::Name) -> bool {
        if !BUILT_IN.contains(&name.text.as_str()) {
            return true;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::NameNotAllowed,
                name.span,
                format!("`{}` has a fixed meaning", name.text),
            )
            .help(format!(
                "{} cannot be declared; choose another name",
                listed(BUILT_IN)
            )),
        );
        false
    }

    fn add_points(&mut self, points: &syntax::Points) {
        for point in &points.points {
            let position = self.pair(&point.position);
            self.declare_drawn(
                &point.name,
                DrawnPoint {
                    position,
                    docs: points.docs.clone(),
                },
            );
        }
    }

    /// A pair of lengths; an erroneous component counts as zero, so that the name it belongs to is still declared.
    fn pair(&mut self, pair: &syntax::Pair) -> Vector {
        let zero = self.graph.zero();
        let mut component = |written: &syntax::Expression| {
            let value = self.constant(written, Dimension::LENGTH);
            let value = value.filter(|&value| self.is_measurable(value, written.span));
            value.unwrap_or(zero)
        };
        [component(&pair.x), component(&pair.y)]
    }

    fn add_body(&mut self, body: &syntax::Body) {
        let name = &body.name;
        if name.text == "ground" {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    name.span,
                    "`ground` is the fixed frame and is always there",
                )
                .help("joints may name it: `revolute A(ground, 1);`"),
            );
            return;
        }
        let id = BodyId(self.bodies.len());
        if let Some(duplicate) = self.body_ids.declare(name, id) {
            self.diagnostics.push(duplicate);
            return;
        }
        let symbols = coordinate_names(&name.text).map(|name| self.graph.symbol(&name));
        let [x, y, phi] = symbols.map(|symbol| self.graph.variable(symbol));
        let drawn = self.drawn_pose(body, id);
        let frame = BodyFrame {
            body: id,
            origin: [x, y],
            angle: phi,
        };
        let mut marks: Vec<NamedMark> = Vec::new();
        let mut places: HashMap<&str, usize> = HashMap::new();
        for member in &body.members {
            let Some(mark) = self.member(member, frame, drawn) else {
                continue;
            };
            let (syntax::Member::Local { name: own, .. }
            | syntax::Member::Carried { name: own, .. }) = member;
            match places.get(own.text.as_str()).map(|&at| &marks[at]) {
                Some(earlier) => self.diagnostics.push(
                    Diagnostic::error(
                        Code::DuplicateName,
                        mark.span,
                        format!("body `{}` carries `{}` twice", name.text, mark.name),
                    )
                    .label("listed again here")
                    .also(earlier.span, "first listed here")
                    .help("remove one of them"),
                ),
                None => {
                    places.insert(&own.text, marks.len());
                    marks.push(mark);
                }
            }
        }
        let places = symbols.into_iter().enumerate();
        self.coordinate_places
            .extend(places.map(|(axis, symbol)| (symbol, (id, axis))));
        for (place, mark) in marks.iter().enumerate() {
            self.carriers.add((id, place), &mark.name, mark.mark.local);
        }
        self.bodies.push(Body {
            name: name.text.clone(),
            docs: body.docs.clone(),
            span: name.span,
            frame,
            coordinates: Some(symbols),
            drawn,
            marks,
        });
    }

    /// The pose in which a body is drawn.
    fn drawn_pose(&mut self, body: &syntax::Body, id: BodyId) -> BodyFrame {
        let zero = self.graph.zero();
        let origin = match &body.origin {
            syntax::Origin::Coordinates(pair) => self.pair(pair),
            syntax::Origin::Point(reference) => self.drawn_point(reference).unwrap_or([zero, zero]),
        };
        let angle = match &body.orientation {
            syntax::Orientation::Aligned => zero,
            syntax::Orientation::Angle(angle) => {
                self.constant(angle, Dimension::Angle).unwrap_or(zero)
            }
            syntax::Orientation::Facing(direction) => self.facing(direction).unwrap_or(zero),
        };
        BodyFrame {
            body: id,
            origin,
            angle,
        }
    }

    /// The angle of the direction from one drawn point to another.
    fn facing(&mut self, direction: &syntax::Direction) -> Option<ExprId> {
        let (from, to) = (
            self.drawn_point(&direction.from),
            self.drawn_point(&direction.to),
        );
        let (from, to) = (from?, to?);
        let mut along = self.unit_direction(from, to, direction.span, APART)?;
        if !along.iter().all(|&part| self.graph.is_constant(part)) {
            // Of parameters the gap itself is the shorter expression, and has the same angle.
            along = subtract(to, from, &mut self.graph);
        }
        Some(self.graph.atan2(along[1], along[0]))
    }

    fn member(
        &mut self,
        member: &syntax::Member,
        frame: BodyFrame,
        drawn: BodyFrame,
    ) -> Option<NamedMark> {
        match member {
            syntax::Member::Local {
                docs,
                name,
                position,
            } => {
                let local = self.pair(position);
                let in_drawing = Mark::new(drawn, local, &mut self.graph);
                Some(NamedMark {
                    name: name.text.clone(),
                    docs: docs.clone(),
                    mark: Mark::new(frame, local, &mut self.graph),
                    drawn: in_drawing.position(&mut self.graph),
                    span: name.span,
                })
            }
            syntax::Member::Carried { docs, name } => {
                let Some(DrawnPoint { position, .. }) = self.drawn.get(&name.text) else {
                    let unknown = self.drawn.unknown(&name.text, name.span);
                    self.diagnostics.push(unknown.help(format!(
                        "give it where it is drawn, `point {0} = (x, y);`, or in the body's frame, `{0}: (x, y)`",
                        name.text
                    )));
                    return None;
                };
                let position = *position;
                let gap = crate::joint::geometry::subtract(position, drawn.origin, &mut self.graph);
                let local = drawn.unrotate(gap, &mut self.graph);
                Some(NamedMark {
                    name: name.text.clone(),
                    docs: docs.clone(),
                    mark: Mark::new(frame, local, &mut self.graph),
                    drawn: position,
                    span: name.span,
                })
            }
        }
    }

    /// The largest coordinate of what joints hold and equations name, which lengths are measured against.
    fn characteristic_length(&self) -> f64 {
        let marks = self
            .joints
            .iter()
            .flat_map(|(joint, _)| &joint.operands.marks);
        let marks = marks.map(|mark| mark.local);
        let origins = self.bodies.iter().map(|body| body.drawn.origin);
        let named = self.named_on_ground.iter().copied();
        let components = marks.chain(origins).chain(named).flatten();
        let largest = components
            .filter_map(|component| self.graph.constant_value(component))
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if largest > 0.0 && largest.is_finite() {
            largest
        } else {
            1.0
        }
    }
}
