//! Declares the type that a user holds, with the methods of the shell in the module's own terms.
//!
//! A module has no arguments for parameters and inputs that its description does not declare.

/// Mechanism's type, and the items of its module that the shell needs.
///
/// The module supplies `Frame`, `Coordinates`, `Branches`, `BLOCKS`, `POINTS`, and the function `solve`.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_mechanism {
    (
        $(#[$docs:meta])*
        $name:ident, $label:literal;
        parameters: $($parameters:ident)?;
        inputs: $($inputs:ident)?;
        path: $path:ident $(, enclosures: $enclosures:literal)?;
        $(drawn: $drawn:ident;)?
        $(requirements: $requirements:ident;)?
        $(driven: $driven:ident;)?
        $(assemblies: $assemblies:ident;)?
        $(loads: $loads:ident;)?
        $(parameter_ranges: $parameter_ranges:ident;)?
        $(input_ranges: $input_ranges:ident;)?
    ) => {
        /// Data with which one instant is solved.
        type Conditions<'a> = $crate::generated::Conditions<
            'a,
            Scalar,
            $crate::generated::or_unit!(@type $($parameters)?),
            $crate::generated::or_unit!(@type $($inputs)?),
        >;

        /// Path enclosures of the unknowns of Newton-Raphson.
        #[allow(dead_code)]
        type PathEnclosures = [PathEnclosure; 0 $(+ $enclosures)?];

        /// Frame with the one before it.
        #[allow(dead_code)]
        type Pair<'a> = $crate::generated::Pair<'a, Loops>;

        /// Equations of the mechanism, loop by loop.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct Loops;

        impl Blocks for Loops {
            type Scalar = Scalar;
            type Frame = Frame;
            type Coordinates = Coordinates;
            type Branches = Branches;
            type Parameters = $crate::generated::or_unit!(@type $($parameters)?);
            type Inputs = $crate::generated::or_unit!(@type $($inputs)?);
            type PathEnclosures = PathEnclosures;

            fn nominal_parameters(&self) -> Self::Parameters {
                Default::default()
            }

            fn initial_inputs(&self) -> Self::Inputs {
                Default::default()
            }

            fn drawn_branches(&self) -> Branches {
                Branches::DESIGN
            }

            fn exchanged(&self, branches: &Branches, block: u16) -> Option<Branches> {
                branches.exchanged(block)
            }

            #[inline]
            fn may_cross(&self) -> bool {
                Branches::MAY_CROSS
            }

            fn drawn_pose(&self, _parameters: &Self::Parameters) -> Coordinates {
                $crate::generated::or_drawn!(Coordinates, _parameters $(, $drawn)?)
            }

            fn estimate(&self, pose: &Coordinates, parameters: &Self::Parameters, t: Scalar) -> Frame {
                Frame::estimate(pose, parameters, t)
            }

            #[inline]
            fn time(frame: &Frame) -> Scalar {
                frame.t
            }

            fn set_time(frame: &mut Frame, t: Scalar) {
                frame.t = t;
            }

            #[inline]
            fn solve(
                &self,
                at: &mut Frame,
                last: &Frame,
                branches: &mut Branches,
                conditions: &Conditions<'_>,
            ) -> Result<(), Failure> {
                solve(at, last, branches, conditions)
            }

            #[inline]
            fn is_guarded(&self) -> bool {
                $crate::generated::path!(@is $path)
            }

            fn enclosures(&self) -> PathEnclosures {
                [PathEnclosure::ZERO; 0 $(+ $enclosures)?]
            }

            fn verify_path(&self, _pair: &Pair<'_>, _span: &TimeWindow, _enclosures: &mut PathEnclosures) -> Result<(), u16> {
                $crate::generated::path!(@keeps $path, _pair, _span, _enclosures)
            }

            #[inline]
            fn is_closed(&self) -> bool {
                $crate::generated::path!(@closed $path)
            }

            fn verify_nonsingular(&self, _pair: &Pair<'_>, _span: &TimeWindow) -> Result<(), u16> {
                $crate::generated::path!(@stays $path, _pair, _span)
            }

            #[inline]
            fn is_within(&self, _at: &Frame, _enclosures: &PathEnclosures, _steps: Scalar) -> bool {
                $crate::generated::path!(@within $path, _at, _enclosures, _steps $(, $enclosures)?)
            }

            fn name(&self) -> &str {
                $label
            }

            fn coordinate_name(&self, index: usize) -> Option<&str> {
                Coordinates::NAMES.get(index).copied()
            }

            fn parameter_name(&self, _index: usize) -> Option<&str> {
                $crate::generated::or_unit!(@name _index $(, $parameters)?)
            }

            fn input_name(&self, _index: usize) -> Option<&str> {
                $crate::generated::or_unit!(@name _index $(, $inputs)?)
            }

            fn coordinate(&self, frame: &Frame, index: usize) -> Option<[Scalar; 3]> {
                frame.coordinate(index)
            }

            fn holds_coordinates(&self) -> bool {
                Frame::HOLDS_COORDINATES
            }

            fn add(&self, sum: &mut Frame, multiple: Scalar, frame: &Frame, base: &Frame) {
                sum.add(multiple, frame, base);
            }

            fn point_name(&self, index: usize) -> Option<&str> {
                POINTS.get(index).map(|(name, _)| *name)
            }

            fn point(&self, frame: &Frame, index: usize) -> Option<PointMotion> {
                POINTS.get(index).map(|(_, motion)| motion(frame))
            }

            fn block_name(&self, index: usize) -> Option<BlockName<'_>> {
                BLOCKS.get(index).copied()
            }

            $(
                fn begin(&self, branches: &mut Branches, last: &mut Frame) {
                    $assemblies::begin(branches, last);
                }
            )?

            $(
                fn load_name(&self, index: usize) -> Option<&str> {
                    $loads.get(index).copied()
                }
            )?

            $(
                fn parameter_range(&self, index: usize) -> Option<ValueRange> {
                    $parameter_ranges.get(index).copied().flatten()
                }
            )?

            $(
                #[inline]
                fn input_range(&self, index: usize) -> Option<ValueRange> {
                    $input_ranges.get(index).copied().flatten()
                }
            )?

            $(
                fn not_positive(&self, parameters: &Self::Parameters) -> Option<(u16, Scalar)> {
                    $crate::generated::first_not_positive(&requirements(parameters))
                }

                fn requirement_name(&self, index: usize) -> Option<BlockName<'_>> {
                    $requirements.get(index).copied()
                }
            )?

            $(
                fn requirement_name(&self, index: usize) -> Option<BlockName<'_>> {
                    $driven.get(index).copied()
                }
            )?
        }

        $(#[$docs])*
        pub struct $name(Shell<Loops>);

        impl Mechanism for $name {
            type Blocks = Loops;

            fn from_shell(shell: Shell<Loops>) -> Self {
                Self(shell)
            }

            fn shell(&self) -> &Shell<Loops> {
                &self.0
            }

            fn shell_mut(&mut self) -> &mut Shell<Loops> {
                &mut self.0
            }
        }

        /// Describes a failure in the mechanism's own terms, as one sentence.
        #[allow(dead_code)]
        pub fn describe(failure: &Failure) -> FailureMessage {
            const { &Loops }.explained(failure)
        }

        #[allow(dead_code)]
        impl $name {
            /// Assembles the mechanism at time `t` (s) in its design configuration.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so.
            pub fn assemble(t: Scalar $(, inputs: &$inputs)?) -> Result<Self, Failure> {
                Self::assemble_on(Branches::DESIGN, t $(, inputs as &$inputs)?)
            }

            /// Assembles the mechanism at time `t` (s) in other modes than those of the design configuration.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so.
            pub fn assemble_on(branches: Branches, t: Scalar $(, inputs: &$inputs)?) -> Result<Self, Failure> {
                let parameters = Default::default();
                let (pose, settings) = (Loops.drawn_pose(&parameters), Settings::default());
                let inputs = $crate::generated::or_unit!(@value inputs $(, $inputs)?);
                Shell::assemble(Loops, &parameters, &pose, branches, t, inputs, settings).map(Self)
            }

            /// Assembles the mechanism at time `t` (s) in the modes of the design configuration, with angles near those
            /// of `estimate`: a measured pose, for example.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so.
            pub fn assemble_from(
                estimate: &Coordinates,
                t: Scalar,
                $(inputs: &$inputs,)?
                settings: Settings,
            ) -> Result<Self, Failure> {
                let inputs = $crate::generated::or_unit!(@value inputs $(, $inputs)?);
                Shell::assemble(Loops, &Default::default(), estimate, Branches::DESIGN, t, inputs, settings).map(Self)
            }

            /// Assembles the mechanism at time `t` (s) in these modes, with angles near those of `estimate`. A block of
            /// Newton-Raphson starts from the estimate, which may be poor.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so.
            pub fn assemble_with(
                $(parameters: &$parameters,)?
                estimate: &Coordinates,
                branches: Branches,
                t: Scalar,
                $(inputs: &$inputs,)?
                settings: Settings,
            ) -> Result<Self, Failure> {
                let parameters = $crate::generated::or_unit!(@value parameters $(, $parameters)?);
                let inputs = $crate::generated::or_unit!(@value inputs $(, $inputs)?);
                Shell::assemble(Loops, parameters, estimate, branches, t, inputs, settings).map(Self)
            }

            /// Moves the mechanism to time `t` (s), starting from the last frame; a failure leaves that frame
            /// unchanged. See `linkwright::Shell::advance`.
            ///
            /// # Errors
            /// Returns a [`Failure`] if the equations cannot be solved from there. Its time is the end of the motion,
            /// or the last time that could be followed.
            #[inline]
            pub fn advance(&mut self, t: Scalar $(, inputs: &$inputs)?) -> Result<&Frame, Failure> {
                self.0.advance(t, $crate::generated::or_unit!(@value inputs $(, $inputs)?))
            }

            /// Moves the mechanism by the time `duration` (s) from the last frame, as `advance` does. The times of
            /// successive calls are a compensated sum; a failure does not let time pass. See
            /// `linkwright::Shell::advance_by`.
            ///
            /// # Errors
            /// Returns those of `advance`.
            pub fn advance_by(&mut self, duration: Scalar $(, inputs: &$inputs)?) -> Result<&Frame, Failure> {
                self.0.advance_by(duration, $crate::generated::or_unit!(@value inputs $(, $inputs)?))
            }

            /// Assembles the mechanism at time `t` (s) near the last frame and in its modes, whether or not a path
            /// leads there: after a gap in the signals, for example. Returns the jump of each coordinate in its unit, m
            /// or rad; `None` if frames do not hold all coordinates.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so; the last frame is then unchanged.
            pub fn recover(&mut self, t: Scalar $(, inputs: &$inputs)?) -> Result<Option<Coordinates>, Failure> {
                self.0.recover(t, $crate::generated::or_unit!(@value inputs $(, $inputs)?))
            }

            /// Last solved instant.
            #[inline]
            pub fn frame(&self) -> &Frame {
                self.0.frame()
            }

            /// Frame at time `t` (s) in the current modes, whether or not a path leads there: an entry of a table, for
            /// example. The mechanism stays in its pose.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so at that time.
            pub fn frame_at(&self, t: Scalar $(, inputs: &$inputs)?) -> Result<Frame, Failure> {
                self.0.frame_at(t, $crate::generated::or_unit!(@value inputs $(, $inputs)?))
            }

            /// Assembly modes of the mechanism.
            pub fn branches(&self) -> Branches {
                *self.0.branches()
            }

            $(
                /// Parameters with which the next instant is solved.
                pub fn parameters(&self) -> &$parameters {
                    self.0.parameters()
                }

                /// Changes the parameters. The last frame stays as it was solved; the next one is solved with these
                /// parameters, in the same modes, with angles near those of the last frame.
                ///
                /// # Errors
                /// Returns a [`Failure`] for values that the description may not have, such as a negative length; the
                /// parameters are then unchanged.
                pub fn set_parameters(&mut self, parameters: &$parameters) -> Result<(), Failure> {
                    self.0.set_parameters(parameters)
                }
            )?
        }

        $($crate::generated::drawing!(Coordinates, $drawn);)?
        $crate::generated::parametric!($name, [$($inputs)?] $(, $parameters)?);
    };
}

/// Design configuration of given parameters.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_drawing {
    ($coordinates:ident, $drawn:ident) => {
        #[allow(dead_code)]
        impl $coordinates {
            /// Pose in the design configuration of these parameters, from which the mechanism is assembled.
            pub fn drawn(parameters: &Parameters) -> Self {
                // Displacements, which are not coordinates, come after them.
                match $drawn(parameters).first_chunk() {
                    Some(pose) => Self::from_array(*pose),
                    None => Self::DESIGN,
                }
            }
        }
    };
}

/// Method of mechanisms with parameters alone.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_parametric {
    ($name:ident, [$($inputs:ident)?]) => {};
    ($name:ident, [$($inputs:ident)?], $parameters:ident) => {
        #[allow(dead_code)]
        impl $name {
            /// Assembles the mechanism of these parameters at time `t` (s) in its design configuration.
            ///
            /// # Errors
            /// Returns a [`Failure`] if it cannot be assembled so.
            pub fn assemble_for(parameters: &$parameters, t: Scalar $(, inputs: &$inputs)?) -> Result<Self, Failure> {
                let (pose, settings) = (Loops.drawn_pose(parameters), Settings::default());
                let inputs = $crate::generated::or_unit!(@value inputs $(, $inputs)?);
                Shell::assemble(Loops, parameters, &pose, Branches::DESIGN, t, inputs, settings).map(Self)
            }
        }
    };
}

/// Pose of the design configuration, for fixed or for changeable parameters.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_or_drawn {
    ($coordinates:ident, $parameters:ident) => {
        $coordinates::DESIGN
    };
    ($coordinates:ident, $parameters:ident, $drawn:ident) => {
        $coordinates::drawn($parameters)
    };
}

/// Functions that verify paths.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_path {
    (@is unguarded) => {
        false
    };
    (@is $path:ident) => {
        true
    };
    (@closed closed) => {
        true
    };
    (@closed $path:ident) => {
        false
    };
    (@stays closed, $pair:ident, $window:ident) => {
        verify_nonsingular($pair, $window)
    };
    (@stays $path:ident, $pair:ident, $window:ident) => {
        Err(0)
    };
    (@stays_in_lanes closed, $at:ident, $last:ident, $window:ident, $parameters:ident) => {
        verify_nonsingular($at, $last, $window, $parameters)
    };
    (@stays_in_lanes $path:ident, $at:ident, $last:ident, $window:ident, $parameters:ident) => {
        Mask::NONE
    };
    (@keeps unguarded, $pair:ident, $window:ident, $enclosures:ident) => {
        Ok(())
    };
    (@keeps $path:ident, $pair:ident, $window:ident, $enclosures:ident) => {
        verify_path($pair, $window, $enclosures)
    };
    (@within guarded, $at:ident, $enclosures:ident, $steps:ident, $count:literal) => {
        is_within($at, $enclosures, $steps)
    };
    (@within $path:ident, $at:ident, $enclosures:ident, $steps:ident $(, $count:literal)?) => {
        true
    };
}

/// Value that belongs to a type.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_only {
    ($value:expr, $type:ident) => {
        $value
    };
}

/// Type, or else `()`; value if there is a type for it, or else `&()`; name among those of the type, if there is one.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_or_unit {
    (@type) => {
        ()
    };
    (@type $type:ident) => {
        $type
    };
    (@name $index:ident) => {
        None
    };
    (@name $index:ident, $type:ident) => {
        $type::NAMES.get($index).copied()
    };
    (@value $name:ident) => {
        &()
    };
    (@value $name:ident, $type:ident) => {
        $name
    };
}
