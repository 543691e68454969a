//! Lists the coefficients of the Radau IIA method with five stages, of order 9 (Hairer and Wanner 1999, Stiff differential equations
//! solved by Radau methods, Journal of Computational and Applied Mathematics 111:93–111).

/// Number of stages.
pub const STAGES: usize = 5;

/// Nodes cᵢ; the last one is the end of the step.
pub const NODES: [f64; STAGES] = [
    0.05710419611451768,
    0.2768430136381238,
    0.5835904323689168,
    0.8602401356562195,
    1.0,
];

/// A⁻¹: maps distances of the stages from the start to rates at the stages.
pub const INVERSE: [[f64; STAGES]; STAGES] = [
    [
        8.755923977938362,
        2.8919426153801173,
        -0.8751863962002651,
        0.3997052079399655,
        -0.13370616384921583,
    ],
    [
        -7.161380720145387,
        1.8060777240836443,
        2.3637971760686085,
        -0.8659007802831346,
        0.2743380777751942,
    ],
    [
        4.122165246243374,
        -4.4960171258133945,
        0.8567652453971776,
        2.5183209492110645,
        -0.6570627571343601,
    ],
    [
        -3.8786632197240105,
        3.3931519180649543,
        -5.188340906407187,
        0.5812330525808164,
        2.809983655279712,
    ],
    [
        8.41242422359429,
        -6.970256116656661,
        8.777114204150473,
        -18.2192823110881,
        13.0,
    ],
];

/// γ₀, the real eigenvalue of A.
pub const GAMMA: f64 = 0.15906584442746913;

/// Weights of the stages in the error estimate: with γ₀ times the rates at the start they are a formula of order 5.
pub const ESTIMATE: [f64; STAGES] = [
    -27.78093394406464,
    3.641478498049213,
    -1.2525477211691187,
    0.5920031671845428,
    -0.2,
];
