//! The motion of points, and pressure angles, as functions of a frame that holds all coordinates.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::literal::count;
use super::names::identifier;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Function, Output};
use crate::system::Pressure;

/// One function for each point and each contact.
pub(super) fn methods(module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let points = system
        .outputs
        .iter()
        .zip(&module.program.points)
        .enumerate();
    let points = points.map(|(index, (output, function))| {
        let name = identifier(&format!("point_{}", output.name.to_lowercase()));
        let text = docs(documentation::of_point(index, system));
        let (computed, results) = computed(module, function);
        let [x, y, vx, vy, ax, ay] = results.as_slice() else {
            unreachable!("a point has two components of position, velocity and acceleration each")
        };
        quote! {
            #text
            pub fn #name(&self) -> PointMotion {
                #computed
                PointMotion { position: [#x, #y], velocity: [#vx, #vy], acceleration: [#ax, #ay] }
            }
        }
    });
    let contacts = system.pressures.iter().zip(&module.program.pressures);
    let contacts = contacts.map(|(pressure, function)| pressure_angle(module, pressure, function));
    quote!(#(#points)* #(#contacts)*)
}

/// The points by name, for code that is written for any mechanism.
pub(super) fn table(module: &Module<'_>) -> TokenStream {
    let entry = |name: &str| {
        let function = identifier(&format!("point_{}", name.to_lowercase()));
        quote!((#name, Frame::#function))
    };
    let entries: Vec<TokenStream> = match &module.program.outputs {
        None => module
            .system
            .outputs
            .iter()
            .map(|it| entry(&it.name))
            .collect(),
        Some(outputs) => outputs
            .iter()
            .filter_map(|output| match output {
                Output::Point { name, fields } if fields.len() == 3 => Some(entry(name)),
                _ => None,
            })
            .collect(),
    };
    let number = count(entries.len());
    quote! {
        /// The points whose motion frames offer, by name.
        const POINTS: [NamedPoint<Frame>; #number] = [#(#entries),*];
    }
}

/// `fn pressure_angle_NAME`.
fn pressure_angle(module: &Module<'_>, pressure: &Pressure, function: &Function) -> TokenStream {
    let joint = &module.system.mechanism.joints[pressure.joint];
    let name = identifier(&format!("pressure_angle_{}", joint.slug));
    let mut lines = documentation::of_pressure(pressure, module.system);
    lines.push("contact; `None` while the follower rests.".to_string());
    let text = docs(lines);
    let (computed, results) = computed(module, function);
    quote! {
        #text
        pub fn #name(&self) -> Option<Scalar> {
            #computed
            pressure_angle(#(#results),*)
        }
    }
}

/// The statements of a method of the frame, and its results.
fn computed(module: &Module<'_>, function: &Function) -> (TokenStream, Vec<TokenStream>) {
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results, reads) = (scope.plain_statements(), scope.results(), scope.reads());
    let read = [
        (reads.position, quote!(q)),
        (reads.rate, quote!(qd)),
        (reads.acceleration, quote!(qdd)),
        (reads.parameters, quote!(parameters)),
    ];
    let read = read.into_iter().filter(|(is_read, _)| *is_read);
    let read: Vec<TokenStream> = read.map(|(_, name)| name).collect();
    let take = match read.is_empty() {
        true => TokenStream::new(),
        false => quote!(let Self { #(#read,)* .. } = self;),
    };
    (quote!(#take #(#statements)*), results)
}
