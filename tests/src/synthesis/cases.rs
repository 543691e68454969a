//! Lists the published cases, each with the best published design whose error can be computed.
//!
//! The points are those of Cabrera, Simon and Prado 2002 and of Acharyya and Mandal 2009, and the designs are as they are reprinted beside the
//! program of Nguyen-Van et al. 2022.

use super::{Case, Design, Published};

const LINE: [[f64; 2]; 6] = [
    [20.0, 20.0],
    [20.0, 25.0],
    [20.0, 30.0],
    [20.0, 35.0],
    [20.0, 40.0],
    [20.0, 45.0],
];

const FIVE: [[f64; 2]; 5] = [
    [3.0, 3.0],
    [2.759, 3.363],
    [2.372, 3.663],
    [1.890, 3.862],
    [1.355, 3.943],
];

const EIGHTEEN: [[f64; 2]; 18] = [
    [0.5, 1.1],
    [0.4, 1.1],
    [0.3, 1.1],
    [0.2, 1.0],
    [0.1, 0.9],
    [0.05, 0.75],
    [0.02, 0.6],
    [0.0, 0.5],
    [0.0, 0.4],
    [0.03, 0.3],
    [0.1, 0.25],
    [0.15, 0.2],
    [0.2, 0.3],
    [0.3, 0.4],
    [0.4, 0.5],
    [0.5, 0.7],
    [0.6, 0.9],
    [0.6, 1.0],
];

const ARC: [[f64; 2]; 6] = [
    [0.0, 0.0],
    [1.9098, 5.8779],
    [6.9098, 9.5106],
    [13.09, 9.5106],
    [18.09, 5.8779],
    [20.0, 0.0],
];

const OVAL: [[f64; 2]; 10] = [
    [20.0, 10.0],
    [17.66, 15.142],
    [11.736, 17.878],
    [5.0, 16.928],
    [0.603_07, 12.736],
    [0.603_07, 7.2638],
    [5.0, 3.0718],
    [11.736, 2.1215],
    [17.66, 4.8577],
    [20.0, 10.0],
];

/// Cases with up to eighteen points.
pub const CASES: [Case; 5] = [
    Case {
        name: "six points on a line, in their order",
        points: &LINE,
        timing: None,
        seeks_start: false,
        is_grounded: false,
        bounds: [[5.0, 60.0], [-60.0, 60.0]],
        is_exact: true,
        published: Published {
            source: "Cabrera, Ortiz, Nadal and Castillo 2011 (MUMSA)",
            design: Design {
                links: [31.788_26, 8.204_65, 24.932_13, 31.385_93],
                point: [34.193_72, 14.415_67],
                ground: [-6.366_52, 56.836_76, 4.015_96],
            },
            angles: &[1.366_55, 2.330_77, 2.871_04, 3.394_59, 3.970_96, 4.963_49],
        },
    },
    Case {
        name: "five timed points",
        points: &FIVE,
        timing: Some([30.0, 15.0]),
        seeks_start: false,
        is_grounded: true,
        bounds: [[0.0, 50.0], [-50.0, 50.0]],
        is_exact: false,
        published: Published {
            source: "Cabrera, Ortiz, Nadal and Castillo 2011 (MUMSA)",
            design: Design {
                links: [3.773_268_56, 2.000_004_03, 4.116_971_04, 2.746_156_71],
                point: [1.678_487_87, 1.670_980_07],
                ground: [0.0; 3],
            },
            angles: &[],
        },
    },
    Case {
        name: "eighteen timed points",
        points: &EIGHTEEN,
        timing: Some([0.0, 20.0]),
        seeks_start: true,
        is_grounded: false,
        bounds: [[0.0, 50.0], [-50.0, 50.0]],
        is_exact: false,
        published: Published {
            source: "Nguyen-Van, Lieu, Xuan-Mung and Nguyen 2022 (HCDJ)",
            design: Design {
                links: [49.800_886, 0.288_171_59, 48.476_138, 1.633_642],
                point: [-23.412_81, 7.664_488_6],
                ground: [-14.836_153, 20.140_223, 2.528_609_1],
            },
            angles: &[5.064_422_4],
        },
    },
    Case {
        name: "six timed points on an arc",
        points: &ARC,
        timing: Some([30.0, 30.0]),
        seeks_start: false,
        is_grounded: false,
        bounds: [[5.0, 50.0], [-50.0, 50.0]],
        is_exact: false,
        published: Published {
            source: "reprinted by Nguyen-Van et al. 2022 without its source",
            design: Design {
                links: [50.0, 5.0, 7.031_047, 48.134_183],
                point: [16.976_687, 12.952_139],
                ground: [12.197_494, -15.998_203, 0.042_824_7],
            },
            angles: &[],
        },
    },
    Case {
        name: "ten points of an oval, in their order",
        points: &OVAL,
        timing: None,
        seeks_start: false,
        is_grounded: false,
        bounds: [[5.0, 80.0], [-80.0, 80.0]],
        is_exact: false,
        published: Published {
            source: "Lin, reprinted by Nguyen-Van et al. 2022",
            design: Design {
                links: [80.0, 8.045_662, 50.819_02, 42.208_01],
                point: [-10.636_97, -2.291_09],
                ground: [8.494_813, -0.757_967_8, 3.889_21],
            },
            angles: &[
                2.449_437, 3.153_969, 3.837_114, 4.520_171, 5.204_799, 5.898_536, 0.316_204,
                1.023_555, 1.738_992, 2.449_437,
            ],
        },
    },
];
