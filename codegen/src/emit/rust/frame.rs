//! The frame: one solved instant, and what it offers.

use proc_macro2::TokenStream;
use quote::quote;

use super::closeness::closeness;
use super::docs::docs;
use super::given::is_given;
use super::lints;
use super::literal::count;
use super::module::{Module, derives, only};
use super::points;
use super::scope::identifier;
use super::sensitivity::{sensitivities, structures};
use super::transmission::transmissions;
use crate::expr::SymbolId;
use crate::program::Output;
use crate::system::SymbolRole;

/// `struct Frame`, with methods for everything that it offers.
pub(super) fn frame(module: &Module<'_>) -> TokenStream {
    let own = module.program.fields.iter();
    let names: Vec<_> = own
        .clone()
        .map(|&symbol| module.field_name(symbol))
        .collect();
    let drawn: Vec<_> = own
        .map(|&symbol| module.float(drawn(symbol, module)))
        .collect();
    let keeps_parameters = module.is_whole() && module.frame_keeps_parameters();
    let parameters = only(
        keeps_parameters,
        quote! {
            /// What the points of this instant are found with.
            parameters: Parameters,
        },
    );
    let nominal = only(keeps_parameters, quote!(parameters: Parameters::NOMINAL,));
    let size = count(module.system.coordinates.len());
    let (title, whole, at_rest) = match module.is_whole() {
        true => (
            "One solved instant.",
            quote! {
                /// The pose.
                pub q: Coordinates,
                /// The rates of the coordinates.
                pub qd: Coordinates,
                /// The accelerations of the coordinates.
                pub qdd: Coordinates,
            },
            quote! {
                q: Coordinates::DRAWN,
                qd: Coordinates::from_array([0.0; #size]),
                qdd: Coordinates::from_array([0.0; #size]),
            },
        ),
        false => (
            "One solved instant: what the description asks for.",
            TokenStream::new(),
            TokenStream::new(),
        ),
    };
    let methods = match &module.program.outputs {
        Some(outputs) => outputs
            .iter()
            .map(|output| method(output, module))
            .collect(),
        None => points::methods(module),
    };
    let offered = [
        methods,
        transmissions(module),
        sensitivities(module),
        closeness(module),
    ];
    let implementation = quote! {
        impl Frame {
            #(#offered)*
            /// The drawing at rest, which the solution starts from.
            const DRAWN: Self = Self { t: 0.0, #at_rest #nominal #(#names: #drawn,)* };
        }
    };
    let allow = lints::unused_item(&implementation);
    let numbers = if module.is_whole() {
        module.system.coordinates.len()
    } else {
        names.len()
    };
    let derives = derives(numbers);
    let structure = quote! {
        #derives
        pub struct Frame {
            /// The time t, in s.
            pub t: Scalar,
            #whole
            #parameters
            #(#names: Scalar,)*
        }
    };
    let capitals = lints::capitals(&structure);
    let text = docs([title]);
    let (structures, estimate, table) =
        (structures(module), estimate(module), points::table(module));
    quote! {
        #text
        #capitals
        #structure

        #allow
        #implementation

        #structures
        #table
        #estimate
    }
}

/// The value of a field in the drawing, where the solution starts from it.
fn drawn(symbol: SymbolId, module: &Module<'_>) -> f64 {
    match module.system.roles[symbol.index()] {
        SymbolRole::Position(unknown) => module.system.drawn_unknown(unknown),
        _ => 0.0,
    }
}

/// The frame before the first one, and one coordinate of a frame, as the shell asks for them.
fn estimate(module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let given = module.program.drawn.as_ref();
    let declared = module.declared();
    let mut reads_parameters = module.is_whole() && module.frame_keeps_parameters();
    let kept = only(reads_parameters, quote!(parameters: *parameters,));
    let mut fields = Vec::new();
    let mut reads_pose = module.is_whole();
    for &symbol in &module.program.fields {
        let SymbolRole::Position(unknown) = system.roles[symbol.index()] else {
            continue;
        };
        let name = module.field_name(symbol);
        if let Some(coordinate) = system.coordinates.get(unknown) {
            let own = identifier(&coordinate.name);
            fields.push(quote!(#name: pose.#own,));
            reads_pose = true;
        } else if given.is_some_and(|function| is_given(function, unknown, module)) {
            let place = count(unknown);
            fields.push(quote!(#name: drawn(parameters)[#place],));
            reads_parameters = true;
        }
    }
    let argument = |name: &str, is_read: bool| match is_read {
        true => identifier(name),
        false => identifier(&format!("_{name}")),
    };
    let (pose, parameters) = (
        argument("pose", reads_pose),
        argument("parameters", reads_parameters),
    );
    let parameters_type = match declared.parameters {
        true => quote!(Parameters),
        false => quote!(()),
    };
    let whole = only(module.is_whole(), quote!(q: *pose,));
    let offered = match module.is_whole() {
        true => quote! {
            /// A coordinate of a frame with its rate and its acceleration.
            fn coordinate(frame: &Frame, index: usize) -> Option<[Scalar; 3]> {
                let of = |values: &Coordinates| values.to_array().get(index).copied();
                Some([of(&frame.q)?, of(&frame.qd)?, of(&frame.qdd)?])
            }
        },
        false => quote! {
            /// Frames hold what is asked for alone.
            fn coordinate(_frame: &Frame, _index: usize) -> Option<[Scalar; 3]> {
                None
            }
        },
    };
    quote! {
        /// The frame before the first one: this pose at rest.
        fn estimate(#pose: &Coordinates, #parameters: &#parameters_type, t: Scalar) -> Frame {
            Frame { t, #whole #kept #(#fields)* ..Frame::DRAWN }
        }

        #offered
    }
}

/// The functions of one output.
fn method(output: &Output, module: &Module<'_>) -> TokenStream {
    let own = |symbol: SymbolId| {
        let name = module.field_name(symbol);
        quote!(self.#name)
    };
    let pair = |fields: &[SymbolId; 2]| {
        let [x, y] = fields.map(own);
        quote!([#x, #y])
    };
    match output {
        Output::Point { name, fields } => match fields.as_slice() {
            [position, velocity, acceleration] => {
                let function = identifier(&format!("point_{name}"));
                let text = docs([format!("Motion of the point {name}, in m, m/s and m/s².")]);
                let [position, velocity, acceleration] =
                    [position, velocity, acceleration].map(pair);
                quote! {
                    #text
                    pub fn #function(&self) -> Motion {
                        Motion { position: #position, velocity: #velocity, acceleration: #acceleration }
                    }
                }
            }
            fields => {
                let levels = [("position", "m"), ("velocity", "m/s")];
                let methods = fields.iter().zip(levels).map(|(field, (level, unit))| {
                    let function = identifier(&format!("point_{name}_{level}"));
                    let text = docs([format!("The {level} of the point {name}, in {unit}.")]);
                    let value = pair(field);
                    quote!(#text pub fn #function(&self) -> [Scalar; 2] { #value })
                });
                methods.collect()
            }
        },
        Output::Coordinate { name, fields } => {
            let levels = [
                ("", "coordinate"),
                ("_rate", "rate of the coordinate"),
                ("_acceleration", "acceleration of the coordinate"),
            ];
            let methods = fields.iter().zip(levels).map(|(&field, (suffix, what))| {
                let function = identifier(&format!("{name}{suffix}"));
                let text = docs([format!("The {what} {name}, in SI units.")]);
                let value = own(field);
                quote!(#text pub fn #function(&self) -> Scalar { #value })
            });
            methods.collect()
        }
    }
}
