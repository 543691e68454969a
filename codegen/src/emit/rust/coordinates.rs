//! The named coordinates and the frame.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::docs::docs;
use super::expression::{identifier, written};
use super::given::{kept_in_frame, only};
use super::lints;
use super::literal::{count, float};
use super::solved;
use crate::program::{LARGEST_TEXTBOOK, Program, Straight};
use crate::system::{Coordinate, Described, Pressure, System};

/// What a structure with a value per coordinate derives. Comparing and printing thousands of fields one by one is code that
/// no compiler digests; such structures are compared and printed as arrays.
pub(super) fn derives(coordinates: usize) -> TokenStream {
    if coordinates <= LARGEST_TEXTBOOK {
        quote!(#[derive(Clone, Copy, Debug, PartialEq)])
    } else {
        quote!(#[derive(Clone, Copy)])
    }
}

/// The fields' identifiers, in order.
fn fields(system: &System) -> Vec<Ident> {
    system
        .coordinates
        .iter()
        .map(|coordinate| identifier(&coordinate.name))
        .collect()
}

/// `struct Coordinates` with its names, the drawn pose, and its array form.
pub(super) fn coordinates(system: &System) -> TokenStream {
    let fields = fields(system);
    let number = count(fields.len());
    let field_docs = system
        .coordinates
        .iter()
        .map(|coordinate| docs(field_text(coordinate, system)));
    let names = system
        .coordinates
        .iter()
        .map(|coordinate| coordinate.name.as_str());
    let drawn = system.coordinates.iter().map(|coordinate| {
        // The estimates were found to be finite constants when they were read.
        float(
            system
                .mechanism
                .graph
                .constant_value(coordinate.estimate)
                .unwrap_or(0.0),
        )
    });
    let derives = derives(fields.len());
    let structure = quote! {
        #[repr(C)]
        #derives
        pub struct Coordinates {
            #(#field_docs pub #fields: f64,)*
        }
    };
    let implementation = quote! {
        impl Coordinates {
            /// How many coordinates there are.
            pub const COUNT: usize = #number;
            /// Their names, in order.
            pub const NAMES: [&'static str; #number] = [#(#names),*];
            /// The pose in the drawing, from which the mechanism is assembled.
            pub const DRAWN: Self = Self { #(#fields: #drawn),* };

            /// The coordinates in order.
            pub const fn to_array(self) -> [f64; #number] {
                [#(self.#fields),*]
            }

            /// The coordinates from their values in order.
            pub const fn from_array(values: [f64; #number]) -> Self {
                let [#(#fields),*] = values;
                Self { #(#fields),* }
            }
        }
    };
    let (capitals, allow) = (
        lints::capitals(&structure),
        lints::unused_item(&implementation),
    );
    quote! {
        /// The coordinates of all bodies: position of the origin in m, angle in rad. Also their rates (m/s, rad/s) and
        /// accelerations (m/s², rad/s²).
        #capitals
        #structure

        #allow
        #implementation
    }
}

/// What a coordinate is; the first of a body also carries what the description says of the body.
fn field_text(coordinate: &Coordinate, system: &System) -> Vec<String> {
    let (body, axis) = match coordinate.describes {
        Described::Pose { body, axis } => (&system.mechanism.bodies[body], axis),
        Described::Contact { joint } => {
            let label = &system.mechanism.joints[joint].label;
            return vec![format!("Where `{label}` touches its curve.")];
        }
    };
    let name = &body.name;
    match axis {
        0 if body.docs.is_empty() => vec![format!("x of body {name}.")],
        0 => [format!("x of body {name}."), String::new()]
            .into_iter()
            .chain(body.docs.iter().cloned())
            .collect(),
        1 => vec![format!("y of body {name}.")],
        _ => vec![format!("Angle of body {name}.")],
    }
}

/// `struct Frame` with a method for the motion of each point.
pub(super) fn frame(system: &System, program: &Program) -> TokenStream {
    if let Some(solved) = &program.solved
        && let Some(outputs) = &solved.outputs
    {
        return solved::output_frame(system, solved, outputs);
    }
    let methods = system.outputs.iter().zip(&program.points).enumerate().map(
        |(index, (output, straight))| {
            let name = identifier(&format!("point_{}", output.name.to_lowercase()));
            let point = &system.mechanism.points[index];
            let body = &system.mechanism.bodies[point.mark.frame.body.0].name;
            let carrier = if body == "ground" {
                "the ground".to_string()
            } else {
                format!("body {body}")
            };
            let mut lines = vec![format!(
                "Motion of the point {} of {carrier}, in m, m/s and m/s².",
                output.name
            )];
            if !point.docs.is_empty() {
                lines.push(String::new());
                lines.extend(point.docs.iter().cloned());
            }
            let text = docs(lines);
            let body = motion(system, program, straight);
            quote!(#text pub fn #name(&self) -> Motion { #body })
        },
    );
    let pressure_angles = system.pressures.iter().zip(&program.pressures);
    let pressure_angles = pressure_angles
        .map(|(pressure, straight)| pressure_angle(system, program, pressure, straight));
    let solved_view = program.solved.as_ref();
    let closeness = solved_view.map(|solved| solved::closeness(system, solved));
    let (shared, drawn, transmissions, sensitivities, structures, responded) = match &program.solved
    {
        Some(solved) => (
            solved::frame_fields(system, solved),
            solved::frame_values(system, solved),
            solved::transmissions(system, solved),
            solved::sensitivities(system, solved),
            solved::structures(solved),
            solved::responded(system, solved),
        ),
        None => Default::default(),
    };
    let also = if responded.is_empty() {
        TokenStream::new()
    } else {
        quote!(&& all_finite(&[#(#responded),*]))
    };
    let keeps_parameters = kept_in_frame(program);
    let parameters = only(
        keeps_parameters,
        quote! {
            /// What the points of this instant are found with.
            parameters: Parameters,
        },
    );
    let nominal = only(keeps_parameters, quote!(parameters: Parameters::NOMINAL,));
    let zeros = system.coordinates.iter().map(|_| quote!(0.0));
    let at_rest = quote!(Coordinates::from_array([#(#zeros),*]));
    let check = if system.coordinates.len() > LARGEST_TEXTBOOK {
        TokenStream::new()
    } else {
        quote! {
            /// Whether every coordinate, rate and acceleration is a number.
            fn is_finite(&self) -> bool {
                [self.q, self.qd, self.qdd].iter().all(|values| all_finite(&values.to_array())) #also
            }
        }
    };
    let private = match program.solved {
        Some(_) => quote! {
            /// The drawing at rest, which the solution starts from.
            const DRAWN: Self = Self { t: 0.0, q: Coordinates::DRAWN, qd: #at_rest, qdd: #at_rest, #nominal #drawn };

            #check
        },
        None => TokenStream::new(),
    };
    let implementation = quote! {
        impl Frame {
            #(#methods)*
            #transmissions
            #sensitivities
            #closeness
            #(#pressure_angles)*
            #private
        }
    };
    let allow = lints::unused_item(&implementation);
    let derives = derives(system.coordinates.len());
    quote! {
        /// One solved instant.
        #derives
        pub struct Frame {
            /// The time t, in s.
            pub t: f64,
            /// The pose.
            pub q: Coordinates,
            /// The rates of the coordinates.
            pub qd: Coordinates,
            /// The accelerations of the coordinates.
            pub qdd: Coordinates,
            #parameters
            #shared
        }

        #allow
        #implementation

        #structures
    }
}

/// `fn pressure_angle_NAME`.
fn pressure_angle(
    system: &System,
    program: &Program,
    pressure: &Pressure,
    straight: &Straight,
) -> TokenStream {
    let joint = &system.mechanism.joints[pressure.joint];
    let name = identifier(&format!("pressure_angle_{}", joint.slug));
    let text = docs([
        format!("The pressure angle of `{}`, in rad.", joint.label),
        String::new(),
        "It is the angle between the common normal and the velocity of the follower's point at the"
            .to_string(),
        "contact; `None` while the follower rests.".to_string(),
    ]);
    let (computed, results) = computed(system, program, straight);
    quote! {
        #text
        pub fn #name(&self) -> Option<f64> {
            #computed
            ::linkwright::contact::pressure_angle(#(#results),*)
        }
    }
}

fn motion(system: &System, program: &Program, straight: &Straight) -> TokenStream {
    let (computed, results) = computed(system, program, straight);
    let [x, y, vx, vy, ax, ay] = results.as_slice() else {
        unreachable!("a point has two components of position, velocity and acceleration each")
    };
    quote! {
        #computed
        Motion { position: [#x, #y], velocity: [#vx, #vy], acceleration: [#ax, #ay] }
    }
}

/// The statements of a method of the frame, and its results.
fn computed(
    system: &System,
    program: &Program,
    straight: &Straight,
) -> (TokenStream, Vec<TokenStream>) {
    let (statements, results) = written(system, program, straight);
    let inputs = straight.inputs;
    let read = [
        (inputs.position, quote!(q)),
        (inputs.rate, quote!(qd)),
        (inputs.acceleration, quote!(qdd)),
        (inputs.parameters, quote!(parameters)),
    ];
    let read: Vec<TokenStream> = read
        .into_iter()
        .filter(|(used, _)| *used)
        .map(|(_, name)| name)
        .collect();
    let take = if read.is_empty() {
        TokenStream::new()
    } else {
        quote!(let Self { #(#read,)* .. } = self;)
    };
    (quote!(#take #(#statements)*), results)
}
