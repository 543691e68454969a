
LINKWRIGHT_FUNCTION $real linkwright$f_sin($real angle)
{
    $real sine;
    $real cosine;
    linkwright$f_sin_cos(angle, &sine, &cosine);
    return sine;
}

LINKWRIGHT_FUNCTION $real linkwright$f_cos($real angle)
{
    $real sine;
    $real cosine;
    linkwright$f_sin_cos(angle, &sine, &cosine);
    return cosine;
}

/* Angle of a vector whose larger component is of ordinary magnitude. */
LINKWRIGHT_FUNCTION static $real ordinary_angle$f($real y, $real x)
{
    const $real across = fabs$f(y);
    const $real along = fabs$f(x);
    const bool is_steep = across > along;
    const $real low = is_steep ? along : across;
    const $real high = is_steep ? across : along;
    const bool is_turned = low > (0.5$f * high);
    const $real quotient = is_turned ? ((low - high) / (low + high)) : (low / high);
    const $real bend = bend_of$f(quotient);
    const $real base = is_turned ? QUARTER_PI$f : 0.0$f;
    const $real rest = is_turned ? QUARTER_REST$f : 0.0$f;
    const $real octant = base + (quotient - (bend - rest));
    const bool is_behind = signbit(x) != 0;
    $real start = 0.0$f;
    $real lacking = 0.0$f;
    if (is_steep) {
        start = HALF_PI$f;
        lacking = 2.0$f * QUARTER_REST$f;
    } else if (is_behind) {
        start = PI$f;
        lacking = 4.0$f * QUARTER_REST$f;
    } else {
        /* The vector is within pi/4 of the x axis. */
    }
    return copysign$f(start + (((is_steep == is_behind) ? octant : -octant) + lacking), y);
}

/* Component of another vector, scaled to ordinary magnitude. */
LINKWRIGHT_FUNCTION static $real scaled_component$f($real component, $real scale, bool is_infinite, bool is_zero,
    $real otherwise)
{
    $real size = scale * fabs$f(component);
    if (isinf(component) != 0) {
        /* A vector that is infinite in both directions is taken to be between them. */
        size = 1.0$f;
    } else if (is_infinite) {
        size = 0.0$f;
    } else if (is_zero) {
        size = otherwise;
    } else {
        /* Powers of two are exact. */
    }
    return copysign$f(size, component);
}

LINKWRIGHT_FUNCTION $real linkwright$f_atan2($real y, $real x)
{
    const $real across = fabs$f(y);
    const $real along = fabs$f(x);
    const $real high = (across > along) ? across : along;
    if ((high >= SMALLEST_VECTOR$f) && (high <= LARGEST_VECTOR$f)) {
        return ordinary_angle$f(y, x);
    }
    if ((isnan(x) != 0) || (isnan(y) != 0)) {
        return ($real)NAN;
    }
    const bool is_infinite = (isinf(x) != 0) || (isinf(y) != 0);
    const bool is_zero = !(across > 0.0$f) && !(along > 0.0$f);
    const bool is_tiny = (across < 1.0$f) && (along < 1.0$f);
    const $real scale = is_tiny ? SCALE_OF_TINY$f : 0.25$f;
    const $real scaled_y = scaled_component$f(y, scale, is_infinite, is_zero, 0.0$f);
    const $real scaled_x = scaled_component$f(x, scale, is_infinite, is_zero, 1.0$f);
    return ordinary_angle$f(scaled_y, scaled_x);
}

/* Angle that differs from another one by whole turns and is nearest to a third (rad). */
LINKWRIGHT_FUNCTION static $real nearest_turn$f($real angle, $real near_angle)
{
    const $real gap = near_angle - angle;
    $real turned = angle;
    if (!(fabs$f(gap) <= PI$f)) {
        turned = angle + (round$f(gap * (1.0$f / TURN$f)) * TURN$f);
    }
    return turned;
}

/* From one frame to the next an angle moves little: it is measured from the multiple of pi/4 next to the last angle. */
LINKWRIGHT_FUNCTION $real linkwright$f_angle_near($real sine, $real cosine, $real near_angle)
{
    const $real moved = (near_angle * (4.0$f / PI$f)) + ROUNDER$f;
    const $real octants = moved - ROUNDER$f;
    const uint32_t place = last_bits$f(moved);
    const $real along = eighth_cosine$f(place);
    const $real across = eighth_cosine$f((place + 6U) & 7U);
    const $real high = (cosine * along) + (sine * across);
    const $real low = (sine * along) - (cosine * across);
    const $real x = low / high;
    $real angle;
    if ((high > 0.0$f) && (fabs$f(x) <= 0.4375$f)) {
        angle = (octants * QUARTER_PI$f) + ((octants * QUARTER_REST$f) + (x - slight_bend_of$f(x)));
    } else if (!(sine < 0.0$f) && !(sine > 0.0$f) && !(cosine < 0.0$f) && !(cosine > 0.0$f)) {
        angle = ($real)NAN;
    } else {
        angle = nearest_turn$f(ordinary_angle$f(sine, cosine), near_angle);
    }
    return angle;
}
