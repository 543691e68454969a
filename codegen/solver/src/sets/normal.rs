//! Evaluates quantiles of the normal distribution.
//!
//! M. J. Wichura, Algorithm AS 241: the percentage points of the normal distribution, Applied Statistics 37 (1988) 477-484. Its
//! function PPND16 has a relative error of 1e-16.

/// Distance from the median up to which the first ratio of polynomials holds.
const CENTRAL: f64 = 0.425;

/// Square of [`CENTRAL`] as the first ratio takes it.
const CENTRAL_SQUARE: f64 = 0.180_625;

/// Root of the negative logarithm from which on the last ratio holds.
const TAIL_START: f64 = 5.0;

/// Arguments of the second ratio are shifted by this number.
const SHIFT: f64 = 1.6;

const CENTER: [[f64; 8]; 2] = [
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
];

const TAIL: [[f64; 8]; 2] = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_6,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_9,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
];

const FAR_TAIL: [[f64; 8]; 2] = [
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        0.001_242_660_947_388_078_4,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
];

fn ratio([above, below]: &[[f64; 8]; 2], x: f64) -> f64 {
    let polynomial = |of: &[f64; 8]| of.iter().rev().fold(0.0, |sum, it| sum * x + it);
    polynomial(above) / polynomial(below)
}

/// Returns the number of standard deviations below which a share of a normal distribution lies; the share is between 0 and 1.
pub fn normal_quantile(share: f64) -> f64 {
    let from_median = share - 0.5;
    if from_median.abs() <= CENTRAL {
        return from_median * ratio(&CENTER, CENTRAL_SQUARE - from_median * from_median);
    }
    let outside = share.min(1.0 - share);
    let root = (-outside.ln()).sqrt();
    let distance = match root <= TAIL_START {
        true => ratio(&TAIL, root - SHIFT),
        false => ratio(&FAR_TAIL, root - TAIL_START),
    };
    distance.copysign(from_median)
}

#[cfg(test)]
mod tests {
    use super::normal_quantile;

    /// Values of Python's `statistics.NormalDist`, an independent implementation.
    #[test]
    fn quantiles_are_those_of_another_program() {
        for (share, expected) in [
            (0.5, 0.0),
            (0.25, -0.674_489_750_196_081_7),
            (0.9, 1.281_551_565_544_600_8),
            (0.001_35, -2.999_976_992_703_393),
            (0.998_65, 2.999_976_992_703_401),
            (1e-10, -6.361_340_902_404_056),
            (2.0_f64.powi(-33), -6.337_957_754_553_789),
        ] {
            let quantile = normal_quantile(share);
            let error = (quantile - expected).abs();
            assert!(error <= 4e-15 * expected.abs(), "{share}: {quantile}");
        }
    }
}
