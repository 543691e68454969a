
/* Elementary functions of double. */

static const double PI = 3.141592653589793;
static const double HALF_PI = 1.5707963267948966;
static const double QUARTER_PI = 0.7853981633974483;
static const double TURN = 6.283185307179586;

LINKWRIGHT_FUNCTION static uint64_t bits_of(double value)
{
    uint64_t bits;
    (void)memcpy(&bits, &value, sizeof(bits));
    return bits;
}

LINKWRIGHT_FUNCTION static double of_bits(uint64_t bits)
{
    double value;
    (void)memcpy(&value, &bits, sizeof(value));
    return value;
}

/* Product of two words: its lower word, and through high its upper one. */
LINKWRIGHT_FUNCTION static uint64_t multiplied(uint64_t a, uint64_t b, uint64_t *high)
{
    const uint64_t a_low = a & 0xffffffffU;
    const uint64_t a_high = a >> 32;
    const uint64_t b_low = b & 0xffffffffU;
    const uint64_t b_high = b >> 32;
    const uint64_t low = a_low * b_low;
    const uint64_t first = (a_high * b_low) + (low >> 32);
    const uint64_t second = (a_low * b_high) + (first & 0xffffffffU);
    *high = (a_high * b_high) + (first >> 32) + (second >> 32);
    return (second << 32) | (low & 0xffffffffU);
}

/* First of two words, shifted to the left with the leading bits of the second. */
LINKWRIGHT_FUNCTION static uint64_t shifted(uint64_t high, uint64_t low, uint32_t shift)
{
    return (shift == 0U) ? high : ((high << shift) | (low >> (64U - shift)));
}

/* Quadrant of a positive angle that is large, or close to a multiple of pi/2. The difference of the angle from that
   multiple is an unevaluated sum (M. Payne and R. Hanek, 1983). */
LINKWRIGHT_FUNCTION static uint32_t far_angle(double x, double *rest, double *tail)
{
    /* Bits of 2/pi, after 64 zeros. */
    static const uint64_t two_over_pi[20] = {
        0x0000000000000000U, 0xa2f9836e4e441529U, 0xfc2757d1f534ddc0U, 0xdb6295993c439041U, 0xfe5163abdebbc561U,
        0xb7246e3a424dd2e0U, 0x06492eea09d1921cU, 0xfe1deb1cb129a73eU, 0xe88235f52ebb4484U, 0xe99c7026b45f7e41U,
        0x3991d639835339f4U, 0x9c845f8bbdf9283bU, 0x1ff897ffde05980fU, 0xef2f118b5a0a6d1fU, 0x6d367ecf27cb09b7U,
        0x4f463f669e5fea2dU, 0x7527bac7ebe5f17bU, 0x3d0739f78a5292eaU, 0x6bfb5fb11f8d5d08U, 0x56033046fc7b6babU,
    };
    const uint64_t fraction_bits = ((uint64_t)1U << 52) - 1U;
    const uint64_t bits = bits_of(x);
    const uint64_t exponent = bits >> 52;
    if ((exponent >= 2047U) || (exponent < 1013U)) {
        *rest = of_bits(0x7ff8000000000000U);
        *tail = *rest;
        return 0U;
    }
    const uint64_t m = (bits & fraction_bits) | (fraction_bits + 1U);
    /* Index of the first bits with a weight of 2 and less. */
    const uint32_t place = (uint32_t)(exponent - 1013U);
    const uint64_t *const words = &two_over_pi[place / 64U];
    const uint32_t shift = place % 64U;
    uint64_t high;
    uint64_t low = multiplied(m, shifted(words[1], words[2], shift), &high);
    uint64_t left_out;
    (void)multiplied(m, shifted(words[2], words[3], shift), &left_out);
    low += left_out;
    high += (m * shifted(words[0], words[1], shift)) + ((low < left_out) ? 1U : 0U);
    /* Two bits before the point; the fraction as one of -1/2 to 1/2. */
    uint64_t size_high = (high << 2) | (low >> 62);
    uint64_t size_low = low << 2;
    const bool is_negative = (size_high >> 63) != 0U;
    const uint32_t quadrant = (uint32_t)(high >> 62) + (is_negative ? 1U : 0U);
    if (is_negative) {
        size_low = ~size_low + 1U;
        size_high = ~size_high + ((size_low == 0U) ? 1U : 0U);
    }
    uint32_t leading = 0U;
    while ((leading < 127U) && ((size_high >> 63) == 0U)) {
        size_high = (size_high << 1) | (size_low >> 63);
        size_low <<= 1;
        leading += 1U;
    }
    uint64_t upper;
    const uint64_t lower = multiplied(size_high, 0xc90fdaa22168c235U, &upper);
    const uint64_t first = upper >> 11;
    const uint64_t second = ((upper << 42) | (lower >> 22)) & ((2U * fraction_bits) + 1U);
    const double sign = is_negative ? -1.0 : 1.0;
    *rest = (double)first * (sign * of_bits((uint64_t)(1024U - (leading + 53U)) << 52));
    *tail = (double)second * (sign * of_bits((uint64_t)(1024U - (leading + 106U)) << 52));
    return quadrant;
}

/* The angle is brought within pi/4 of a multiple of pi/2 by subtracting that multiple in parts (W. J. Cody and W.
   Waite, 1980); the remainder is the argument of two minimax polynomials. */
LINKWRIGHT_FUNCTION void linkwright_sin_cos(double angle, double *sine, double *cosine)
{
    /* Adding it to a number of moderate size leaves the nearest integer in the last bits. */
    const double rounder = 6755399441055744.0;
    const double size = fabs(angle);
    uint32_t quadrant = 0U;
    double y = size;
    double tail = 0.0;
    /* Positive numbers are ordered like their bits, which are compared faster if double is computed in software. */
    if (bits_of(size) > bits_of(QUARTER_PI)) {
        const double moved = (size * 0.6366197723675814) + rounder;
        const double quadrants = moved - rounder;
        /* Leading 36 bits of pi/2, and the rest of it. */
        const double above = size - (quadrants * 1.5707963267923333);
        const double below = quadrants * 2.563344151594519e-12;
        y = above - below;
        tail = (above - y) - below;
        quadrant = (uint32_t)(bits_of(moved) & 0xffffffffU);
        if ((bits_of(size) > bits_of(205000.0)) || (bits_of(fabs(y)) < bits_of(1.52587890625e-5))) {
            quadrant = far_angle(size, &y, &tail);
        }
    }
    const double z = y * y;
    /* In independent pairs. */
    const double fourth = z * z;
    const double eighth = fourth * fourth;
    const double cube = y * z;
    const double bend = (fourth * (-0.00019841269829358484 + (z * 2.7557313538483216e-6)))
        + (eighth * (-2.505073438205976e-8 + (z * 1.589543274989012e-10)));
    const double rise = ((0.041666666666666595 + (z * -0.0013888888888873307))
        + (fourth * (2.480158728896531e-5 + (z * -2.7557314203131543e-7))))
        + (eighth * (2.087570315049668e-9 + (z * -1.1358617758465667e-11)));
    const double half = 0.5 * z;
    const double parabola = 1.0 - half;
    const double s = y + (((cube * (-0.1666666666666663 + (z * 0.00833333333332184))) + (tail * parabola))
        + (cube * bend));
    const double c = parabola + (((1.0 - parabola) - half) + ((fourth * rise) - (y * tail)));
    const double first = ((quadrant & 1U) == 0U) ? s : c;
    const double second = ((quadrant & 1U) == 0U) ? c : s;
    const uint64_t sign = (uint64_t)1U << 63;
    *sine = of_bits(bits_of(first) ^ ((uint64_t)(quadrant & 2U) << 62) ^ (bits_of(angle) & sign));
    *cosine = of_bits(bits_of(second) ^ ((uint64_t)((quadrant + 1U) & 2U) << 62));
}

/* x - atan(x) for |x| up to 1/2. */
LINKWRIGHT_FUNCTION static double bend_of(double x)
{
    const double square = x * x;
    const double fourth = square * square;
    const double eighth = fourth * fourth;
    const double low = (0.3333333333333298 + (square * -0.1999999999990311))
        + (fourth * (0.14285714276385547 + (square * -0.11111110659606666)));
    const double middle = (0.0909089624363649 + (square * -0.0769207389053018))
        + (fourth * (0.06663810351291395 + (square * -0.05858296891311183)));
    const double high = (0.05121995960854574 + (square * -0.04186474804083825))
        + (fourth * (0.02743444999642423 + (square * -0.010116482732360559)));
    return x * (square * (low + (eighth * (middle + (eighth * high)))));
}

/* x - atan(x) for |x| up to 7/16, with fewer operations. */
LINKWRIGHT_FUNCTION static double slight_bend_of(double x)
{
    const double square = x * x;
    const double fourth = square * square;
    const double even = 0.3333333333333292 + (fourth * (0.14285714272267291 + (fourth * (0.09090886880563956
        + (fourth * (0.06661034789657813 + (fourth * (0.04975930205904045 + (fourth * 0.016265851216325327)))))))));
    const double odd = -0.19999999999873752 + (fourth * (-0.11111110395283973 + (fourth * (-0.0769187231230305
        + (fourth * (-0.058333280116692414 + (fourth * -0.036510629139443695)))))));
    return x * ((square * even) + (fourth * odd));
}

/* Difference of pi/4 from its rounded value. */
static const double QUARTER_REST = 3.061616997868383e-17;

/* Magnitudes of vectors whose components neither overflow nor become subnormal when they are doubled or halved. */
static const double SMALLEST_VECTOR = 1e-290;
static const double LARGEST_VECTOR = 1e307;

LINKWRIGHT_FUNCTION static uint32_t last_bits(double value)
{
    return (uint32_t)(bits_of(value) & 7U);
}

static const double ROUNDER = 6755399441055744.0;
static const double SCALE_OF_TINY = 1152921504606846976.0;

/* cos(k pi/4) for k = 0 ... 7; the sine of such an angle is two entries further back. */
LINKWRIGHT_FUNCTION static double eighth_cosine(uint32_t place)
{
    static const double cosines[8] = {
        1.0, 0.7071067811865476, 0.0, -0.7071067811865476, -1.0, -0.7071067811865476, 0.0, 0.7071067811865476,
    };
    return cosines[place];
}

/* Exponential function: x minus a multiple of ln 2, in two parts, is the argument of a rational function of a
   minimax polynomial, with the coefficients of FDLIBM (K. C. Ng, 1993), which are those of the Rust runtime. */
LINKWRIGHT_FUNCTION double linkwright_exp(double x)
{
    const uint64_t size = bits_of(fabs(x)) >> 32;
    const int sign = (signbit(x) != 0) ? -1 : 1;
    int power = 0;
    if (!(fabs(x) <= DBL_MAX)) {
        /* Infinite or NaN: below zero nothing is left. */
        return (sign < 0) && (isnan(x) == 0) ? 0.0 : x;
    }
    if (x > 709.782712893383973096) {
        return HUGE_VAL;
    }
    if (x < -745.13321910194110842) {
        return 0.0;
    }
    if (size > 0x3fd62e42U) {
        power = sign;
        if (size >= 0x3ff0a2b2U) {
            power = (int)((1.44269504088896338700e+00 * x) + ((sign < 0) ? -0.5 : 0.5));
        }
    } else if (size <= 0x3e300000U) {
        return 1.0 + x;
    } else {
        /* The remainder is within ln 2 / 2 of zero. */
    }
    const double high = x - ((double)power * 6.93147180369123816490e-01);
    const double low = (double)power * 1.90821492927058770002e-10;
    const double rest = high - low;
    const double square = rest * rest;
    const double c = rest - (square * (1.66666666666666019037e-01
        + (square * (-2.77777777770155933842e-03
        + (square * (6.61375632143793436117e-05
        + (square * (-1.65339022054652515390e-06 + (square * 4.13813679705723846039e-08)))))))));
    const double y = 1.0 + (((rest * c) / (2.0 - c) - low) + high);
    return (power == 0) ? y : ldexp(y, power);
}
