//! Digests the bits of many results of the elementary functions of `linkwright_math`, as `elementary.c` does for
//! those of the C runtime.

use linkwright_math::{double, single};

/// Numbers of 64 bits that look random, and the digest of Fowler, Noll and Vo.
struct Digest {
    state: u64,
    digest: u64,
}

const BASIS: u64 = 0xcbf2_9ce4_8422_2325;

impl Digest {
    fn word(&mut self) -> u64 {
        let mut half = || {
            self.state = self.state.wrapping_mul(6_364_136_223_846_793_005);
            self.state = self.state.wrapping_add(1_442_695_040_888_963_407);
            self.state >> 32
        };
        half() << 32 | half()
    }

    fn add(&mut self, bits: u64) {
        self.digest = (self.digest ^ bits).wrapping_mul(0x0100_0000_01b3);
    }

    fn double(&mut self, value: f64) {
        self.add(value.to_bits());
    }

    fn single(&mut self, value: f32) {
        self.add(value.to_bits().into());
    }

    fn angles(&mut self, angle: f64) {
        let (sine, cosine) = double::sin_cos(angle);
        self.double(sine);
        self.double(cosine);
        let (sine, cosine) = single::sin_cos(angle as f32);
        if sine.is_finite() {
            self.single(sine);
            self.single(cosine);
        }
    }
}

/// A number of up to this size.
fn of_size(word: u64, size: u64) -> f64 {
    f64::from_bits((word & !(0x7ff << 52)) | (1023 - 32 + word % size) << 52)
}

/// Of random arguments, of the arguments in f32 at equal distances of their bits, and of vectors that are zero, tiny, huge or infinite.
pub fn digests() -> [u64; 3] {
    let mut random = Digest {
        state: 14,
        digest: BASIS,
    };
    for _ in 0..200_000 {
        let (a, b) = (random.word(), random.word());
        random.angles(of_size(a, 50));
        random.angles(f64::from_bits(a & !(1 << 62)));
        let (y, x, near) = (of_size(a, 40), of_size(b, 40), of_size(a ^ b, 40));
        random.double(double::atan2(y, x));
        random.double(double::angle_near(y, x, near));
        let (y, x, near) = (y as f32, x as f32, near as f32);
        random.single(single::atan2(y, x));
        random.single(single::angle_near(y, x, near));
    }
    let mut dense = Digest {
        state: 0,
        digest: BASIS,
    };
    for bits in (0..0x7f80_0000_u32).step_by(257) {
        let x = f32::from_bits(bits);
        let (sine, cosine) = single::sin_cos(x);
        dense.single(sine);
        dense.single(cosine);
        dense.single(single::atan2(x, 1.0));
        dense.single(single::atan2(-1.0, x));
        dense.single(single::exp(x));
        dense.single(single::exp(-x));
        dense.double(double::exp(f64::from(x) * 1.1));
        dense.double(double::exp(f64::from(x) * -1.1));
    }
    let mut odd = Digest {
        state: 0,
        digest: BASIS,
    };
    let all = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e-320,
        -1e-320,
        1e308,
        -1e308,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    for y in all {
        for x in all {
            odd.double(double::atan2(y, x));
            odd.single(single::atan2(y as f32, x as f32));
        }
    }
    [random.digest, dense.digest, odd.digest]
}
