/* Elementary functions of one lane. Compilers vectorize loops in which they are inlined. Their bits are those of the
   runtime's functions, except for rare arguments, for which they return 1: the runtime computes those once more. */
#if defined(__GNUC__)
#define LINKWRIGHT_LANE static inline __attribute__((always_inline, unused))
#else
#define LINKWRIGHT_LANE static inline
#endif

/* Arrays of a group lie apart. */
#if defined(__GNUC__) || defined(_MSC_VER)
#define LINKWRIGHT_RESTRICT __restrict
#elif defined(__cplusplus)
#define LINKWRIGHT_RESTRICT
#else
#define LINKWRIGHT_RESTRICT restrict
#endif

/* Excerpts of the runtime. */
$excerpts

/* Sine and cosine of an angle (rad). */
LINKWRIGHT_LANE $word lane_sin_cos($real angle, $real *sine, $real *cosine)
{
    const $real rounder = ROUNDER$f;
    const $real size = fabs$f(angle);
    $real y;
    $real tail;
    /* Angles below pi/4 have quadrant 0 and are their own remainder. */
$reduction
    const $word quadrant = bits_of$f(moved);
$rare
$polynomials
    return rare;
}

/* cos(k pi/4) for the last three bits of k, without reading memory. */
LINKWRIGHT_LANE $real lane_eighth_cosine($word place)
{
    const $word sign = ($word)1U << $top;
    const $word is_odd = ($word)0U - (place & 1U);
    /* Neither pi/2 nor 3 pi/2. */
    const $word is_not_zero = is_odd | (((place >> 1) & 1U) - 1U);
    const $word one = bits_of$f(1.0$f);
    const $word size = one ^ (is_odd & (one ^ bits_of$f($half_root)));
    return of_bits$f((size | (((place + 1U) << $eighth) & sign)) & is_not_zero);
}

/* Angle with this sine and cosine, or a common positive multiple of them, that is nearest to another one (rad). */
LINKWRIGHT_LANE $word lane_angle_near($real sine, $real cosine, $real near_angle, $real *angle)
{
    const $real moved = (near_angle * (4.0$f / PI$f)) + ROUNDER$f;
    const $real octants = moved - ROUNDER$f;
    const $word place = bits_of$f(moved);
    const $real along = lane_eighth_cosine(place);
    const $real across = lane_eighth_cosine(place + 6U);
    const $real high = (cosine * along) + (sine * across);
    const $real low = (sine * along) - (cosine * across);
    const $real x = low / high;
    *angle = (octants * QUARTER_PI$f) + ((octants * QUARTER_REST$f) + (x - slight_bend_of$f(x)));
    return ((high > 0.0$f) ? 0U : 1U) | ((fabs$f(x) <= 0.4375$f) ? 0U : 1U);
}

/* 1 if the square of a half chord is not safely positive relative to a scale. */
LINKWRIGHT_LANE $word lane_is_rounding($real excess, $real scale)
{
    return (excess > (((FOLD$f * $FLT_EPSILON) * scale) + (UNDERFLOW$f * $FLT_MIN))) ? 0U : 1U;
}

/* Writes the numbers of a structure into one lane of arrays, and reads them. */
static void lane_write(void *arrays, size_t lanes, size_t lane, const void *numbers, size_t size)
{
    unsigned char *const to = (unsigned char *)arrays;
    const unsigned char *const from = (const unsigned char *)numbers;
    for (size_t k = 0U; k < (size / sizeof($real)); k += 1U) {
        (void)memcpy(&to[((k * lanes) + lane) * sizeof($real)], &from[k * sizeof($real)], sizeof($real));
    }
}

static void lane_read(const void *arrays, size_t lanes, size_t lane, void *numbers, size_t size)
{
    unsigned char *const to = (unsigned char *)numbers;
    const unsigned char *const from = (const unsigned char *)arrays;
    for (size_t k = 0U; k < (size / sizeof($real)); k += 1U) {
        (void)memcpy(&to[k * sizeof($real)], &from[((k * lanes) + lane) * sizeof($real)], sizeof($real));
    }
}
