
/* Bounds on signals and unknowns between two frames: whether the second one lies on the path of the first. */

/* Multiple of the rounding by which a value of Newton-Raphson may be off. */
static const $real TUBE_ROUNDING$f = 65536.0$f;

/* Multiple of the rounding by which a solved equation may be off zero. */
static const $real LEFT_BY_ROUNDING$f = 64.0$f;

/* Multiple of the rounding by which the difference of two values may be off, relative to their magnitude. */
static const $real OF_DIFFERENCES$f = 32.0$f;

/* Bound on the rounding of values in frames, and of their differences multiplied by steps. */
LINKWRIGHT_FUNCTION static $real window_rounding$f($real steps)
{
    return $FLT_EPSILON * (LEFT_BY_ROUNDING$f + (OF_DIFFERENCES$f * steps));
}

/* Bound on the deviation of a signal from the chord between two values that are h (s) apart. */
LINKWRIGHT_FUNCTION static $real remainder_of_signal$f($real h, const linkwright$f_signal *before,
    const linkwright$f_signal *now)
{
    const $real moved = now->value - before->value;
    const $real rate_before = fabs$f((before->rate * h) - moved);
    const $real rate_now = fabs$f((now->rate * h) - moved);
    const $real acceleration_before = fabs$f((before->acceleration * h) * h);
    const $real acceleration_now = fabs$f((now->acceleration * h) * h);
    return (0.2$f * (rate_before + rate_now)) + (0.018$f * (acceleration_before + acceleration_now));
}

/* Deviation from the chord that a signal with this change in one step may have beyond the frames. */
LINKWRIGHT_FUNCTION static $real allowance_of_signal$f(const linkwright$f_time_window *window, $real moved)
{
    return (0.25$f * window->steps) * moved;
}

LINKWRIGHT_FUNCTION void linkwright$f_window_signal(const linkwright$f_time_window *window,
    const linkwright$f_signal *before, const linkwright$f_signal *now, $real found[2])
{
    const $real moved = fabs$f(now->value - before->value);
    /* If no time passes, the signal follows the chord. */
    const $real remainder = (window->step == 0.0$f) ? 0.0$f : remainder_of_signal$f(window->step, before, now);
    const $real deviation = remainder + (window->beyond * allowance_of_signal$f(window, moved));
    found[0] = (window->steps * moved) + deviation;
    found[1] = deviation;
}

/* True if a signal that goes from last to next in the time h stays as near to the chord from before to now as is
   assumed; the chord ends so long (s) before next. */
LINKWRIGHT_FUNCTION static bool holds_signal$f(const linkwright$f_time_window *window,
    const linkwright$f_signal *before, const linkwright$f_signal *now, const linkwright$f_signal *last,
    const linkwright$f_signal *next, $real h, $real since)
{
    const $real moved = now->value - before->value;
    const $real line_last = now->value + (moved * ((since - h) / window->step));
    const $real line_next = now->value + (moved * (since / window->step));
    const $real allowance = 0.5$f * allowance_of_signal$f(window, fabs$f(moved));
    return (fabs$f(last->value - line_last) <= allowance) && (fabs$f(next->value - line_next) <= allowance)
        && (remainder_of_signal$f(h, last, next) <= allowance);
}

/* Signal at a part of the time h (s) from one value to another, by the polynomial of the fifth degree with value,
   rate and acceleration of both ends. */
LINKWRIGHT_FUNCTION static linkwright$f_signal signal_towards$f(const linkwright$f_signal *first,
    const linkwright$f_signal *last, $real h, $real part)
{
    const $real a = first->value;
    const $real b = first->rate * h;
    const $real c = ((0.5$f * first->acceleration) * h) * h;
    const $real value = ((last->value - a) - b) - c;
    const $real rate = (((last->rate * h) - b) - c) - c;
    const $real acceleration = (((last->acceleration * h) * h) - c) - c;
    const $real d = ((10.0$f * value) - (4.0$f * rate)) + (0.5$f * acceleration);
    const $real e = ((7.0$f * rate) - (15.0$f * value)) - acceleration;
    const $real f = ((6.0$f * value) - (3.0$f * rate)) + (0.5$f * acceleration);
    const $real s = part;
    const $real velocity = b + (s * ((2.0$f * c) + (s * ((3.0$f * d) + (s * ((4.0$f * e) + ((s * 5.0$f) * f)))))));
    const $real change = (2.0$f * c) + (s * ((6.0$f * d) + (s * ((12.0$f * e) + ((s * 20.0$f) * f)))));
    linkwright$f_signal found;
    found.value = a + (s * (b + (s * (c + (s * (d + (s * (e + (s * f)))))))));
    found.rate = velocity / h;
    found.acceleration = change / (h * h);
    return found;
}

LINKWRIGHT_FUNCTION linkwright$f_enclosure linkwright$f_enclosure_of($real now, $real before, $real deviation)
{
    const linkwright$f_enclosure enclosure = {now, now - before, deviation};
    return enclosure;
}

LINKWRIGHT_FUNCTION bool linkwright$f_enclosure_holds(const linkwright$f_enclosure *enclosure, $real value, $real steps)
{
    const $real rounding = (TUBE_ROUNDING$f * $FLT_EPSILON) * (1.0$f + fabs$f(value));
    return fabs$f((value - enclosure->value) - (enclosure->moved * steps)) <= (enclosure->deviation + rounding);
}
