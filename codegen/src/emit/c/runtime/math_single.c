
/* Elementary functions of float, which use no double. */

static const float PIf = 3.1415927f;
static const float HALF_PIf = 1.5707964f;
static const float QUARTER_PIf = 0.7853982f;
static const float TURNf = 6.2831855f;

LINKWRIGHT_FUNCTION static uint32_t bits_off(float value)
{
    uint32_t bits;
    (void)memcpy(&bits, &value, sizeof(bits));
    return bits;
}

LINKWRIGHT_FUNCTION static float of_bitsf(uint32_t bits)
{
    float value;
    (void)memcpy(&value, &bits, sizeof(value));
    return value;
}

/* First of two words, shifted to the left with the leading bits of the second. */
LINKWRIGHT_FUNCTION static uint32_t shiftedf(uint32_t high, uint32_t low, uint32_t shift)
{
    return (shift == 0U) ? high : ((high << shift) | (low >> (32U - shift)));
}

/* Quadrant of a positive angle that is large, or close to a multiple of pi/2. The difference of the angle from that
   multiple is an unevaluated sum (M. Payne and R. Hanek, 1983). */
LINKWRIGHT_FUNCTION static uint32_t far_anglef(float x, float *rest, float *tail)
{
    /* Bits of 2/pi, after 32 zeros. */
    static const uint32_t two_over_pi[8] = {
        0x00000000U, 0xa2f9836eU, 0x4e441529U, 0xfc2757d1U, 0xf534ddc0U, 0xdb629599U, 0x3c439041U, 0xfe5163abU,
    };
    const uint32_t fraction_bits = ((uint32_t)1U << 23) - 1U;
    const uint32_t bits = bits_off(x);
    const uint32_t exponent = bits >> 23;
    if ((exponent >= 255U) || (exponent < 120U)) {
        *rest = of_bitsf(0x7fc00000U);
        *tail = *rest;
        return 0U;
    }
    const uint32_t m = (bits & fraction_bits) | (fraction_bits + 1U);
    /* Index of the first bits with a weight of 2 and less. */
    const uint32_t place = exponent - 120U;
    const uint32_t *const words = &two_over_pi[place / 32U];
    const uint32_t shift = place % 32U;
    const uint64_t product = ((uint64_t)(uint32_t)(m * shiftedf(words[0], words[1], shift)) << 32)
        + ((uint64_t)m * shiftedf(words[1], words[2], shift))
        + (((uint64_t)m * shiftedf(words[2], words[3], shift)) >> 32);
    /* Two bits before the point; the fraction as one of -1/2 to 1/2. */
    uint64_t size = product << 2;
    const bool is_negative = (size >> 63) != 0U;
    const uint32_t quadrant = (uint32_t)(product >> 62) + (is_negative ? 1U : 0U);
    if (is_negative) {
        size = ~size + 1U;
    }
    uint32_t leading = 0U;
    while ((leading < 63U) && ((size >> 63) == 0U)) {
        size <<= 1;
        leading += 1U;
    }
    const uint64_t whole = (size >> 32) * (uint64_t)0xc90fdaa2U;
    const uint32_t first = (uint32_t)(whole >> 40);
    const uint32_t second = (uint32_t)(whole >> 16) & ((2U * fraction_bits) + 1U);
    const float sign = is_negative ? -1.0f : 1.0f;
    *rest = (float)first * (sign * of_bitsf((128U - (leading + 24U)) << 23));
    *tail = (float)second * (sign * of_bitsf((128U - (leading + 48U)) << 23));
    return quadrant;
}

/* The angle is brought within pi/4 of a multiple of pi/2 by subtracting that multiple in parts (W. J. Cody and W.
   Waite, 1980); the remainder is the argument of two minimax polynomials. */
LINKWRIGHT_FUNCTION void linkwrightf_sin_cos(float angle, float *sine, float *cosine)
{
    /* Adding it to a number of moderate size leaves the nearest integer in the last bits. */
    const float rounder = 12582912.0f;
    const float size = fabsf(angle);
    uint32_t quadrant = 0U;
    float y = size;
    float tail = 0.0f;
    if (size > QUARTER_PIf) {
        const float moved = (size * 0.63661975f) + rounder;
        const float quadrants = moved - rounder;
        /* Leading 11 bits of pi/2, the next 11, and the rest of it. */
        const float above = (size - (quadrants * 1.5703125f)) - (quadrants * 0.0004837513f);
        const float below = quadrants * 7.54979e-8f;
        y = above - below;
        tail = (above - y) - below;
        quadrant = bits_off(moved);
        if ((size > 12800.0f) || (fabsf(y) < (quadrants * 3.8146973e-6f))) {
            quadrant = far_anglef(size, &y, &tail);
        }
    }
    const float z = y * y;
    const float bend = -0.16666655f + (z * (0.008332187f + (z * -0.00019517897f)));
    const float rise = 0.041666646f + (z * (-0.001388731f + (z * 2.4432327e-5f)));
    const float half = 0.5f * z;
    const float parabola = 1.0f - half;
    const float s = y + (((y * z) * bend) + (tail * parabola));
    const float c = parabola + (((1.0f - parabola) - half) + (((z * z) * rise) - (y * tail)));
    const float first = ((quadrant & 1U) == 0U) ? s : c;
    const float second = ((quadrant & 1U) == 0U) ? c : s;
    const uint32_t sign = (uint32_t)1U << 31;
    *sine = of_bitsf(bits_off(first) ^ ((quadrant & 2U) << 30) ^ (bits_off(angle) & sign));
    *cosine = of_bitsf(bits_off(second) ^ (((quadrant + 1U) & 2U) << 30));
}

/* x - atan(x) for |x| up to 1/2. */
LINKWRIGHT_FUNCTION static float bend_off(float x)
{
    const float square = x * x;
    const float fourth = square * square;
    return x * (square * ((0.33333233f + (square * -0.19994168f))
        + (fourth * ((0.14174205f + (square * -0.10155718f)) + (fourth * 0.05125411f)))));
}

/* x - atan(x) for |x| up to 7/16, with a smaller error. */
LINKWRIGHT_FUNCTION static float slight_bend_off(float x)
{
    const float square = x * x;
    const float fourth = square * square;
    return x * (square * ((0.33333305f + (square * -0.19997782f))
        + (fourth * ((0.14230172f + (square * -0.10494107f)) + (fourth * 0.05825629f)))));
}

/* Difference of pi/4 from its rounded value. */
static const float QUARTER_RESTf = -2.1855695e-8f;

/* Magnitudes of vectors whose components neither overflow nor become subnormal when they are doubled or halved. */
static const float SMALLEST_VECTORf = 1e-28f;
static const float LARGEST_VECTORf = 1e38f;

LINKWRIGHT_FUNCTION static uint32_t last_bitsf(float value)
{
    return bits_off(value) & 7U;
}

static const float ROUNDERf = 12582912.0f;
static const float SCALE_OF_TINYf = 1152921504606846976.0f;

/* cos(k pi/4) for k = 0 ... 7; the sine of such an angle is two entries further back. */
LINKWRIGHT_FUNCTION static float eighth_cosinef(uint32_t place)
{
    static const float cosines[8] = {
        1.0f, 0.70710677f, 0.0f, -0.70710677f, -1.0f, -0.70710677f, 0.0f, 0.70710677f,
    };
    return cosines[place];
}

/* Exponential function: x minus a multiple of ln 2, in two parts, is the argument of a rational function of a
   minimax polynomial, with the coefficients of FDLIBM (K. C. Ng, 1993), which are those of the Rust runtime. */
LINKWRIGHT_FUNCTION float linkwrightf_exp(float x)
{
    const uint32_t size = bits_off(fabsf(x));
    const int sign = (signbit(x) != 0) ? -1 : 1;
    int power = 0;
    if (!(fabsf(x) <= FLT_MAX)) {
        /* Infinite or NaN: below zero nothing is left. */
        return (sign < 0) && (isnan(x) == 0) ? 0.0f : x;
    }
    if (x >= 88.722839f) {
        return HUGE_VALF;
    }
    if (x <= -103.972084f) {
        return 0.0f;
    }
    if (size > 0x3eb17218U) {
        power = sign;
        if (size > 0x3f851592U) {
            power = (int)((1.4426950216e+00f * x) + ((sign < 0) ? -0.5f : 0.5f));
        }
    } else if (size <= 0x39000000U) {
        return 1.0f + x;
    } else {
        /* The remainder is within ln 2 / 2 of zero. */
    }
    const float high = x - ((float)power * 6.9314575195e-01f);
    const float low = (float)power * 1.4286067653e-06f;
    const float rest = high - low;
    const float square = rest * rest;
    const float c = rest - (square * (1.6666625440e-1f + (square * -2.7667332906e-3f)));
    const float y = 1.0f + (((rest * c) / (2.0f - c) - low) + high);
    return (power == 0) ? y : ldexpf(y, power);
}
