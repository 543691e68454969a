
/* Functions of closed-form blocks besides arithmetic. */

LINKWRIGHT_CONSTANT_BEGIN(linkwright$f_settings, LINKWRIGHT$F_SETTINGS)
{$tolerance, 25U, 64.0$f * $FLT_EPSILON, true, 256U}
LINKWRIGHT_CONSTANT_END

/* Multiple of the rounding below which the square of a sine is rounding: links that enclose so small an angle are
   collinear. */
static const $real FOLD$f = 16.0$f;

/* Multiple of the smallest normal number below which the square of a half chord is no longer rounded in proportion. */
static const $real UNDERFLOW$f = 8.0$f;

/* Multiple of the rounding below which a change of a coordinate, or a residual, is rounding. */
static const $real ROUNDING$f = 4.0$f;

/* Larger of two numbers; the other one if one is NaN. */
LINKWRIGHT_FUNCTION static $real larger$f($real a, $real b)
{
    return ((a > b) || (isnan(b) != 0)) ? a : b;
}

/* Smaller of two numbers; the other one if one is NaN. */
LINKWRIGHT_FUNCTION static $real smaller$f($real a, $real b)
{
    return ((a < b) || (isnan(b) != 0)) ? a : b;
}

LINKWRIGHT_FUNCTION static linkwright_status noted$f(linkwright$f_failure *failure, linkwright_status status,
    $real value, uint16_t column, $real time, uint16_t block)
{
    failure->status = status;
    failure->time = time;
    failure->block = block;
    failure->iterations = 0U;
    failure->residual = 0.0$f;
    failure->row = 0U;
    failure->value = value;
    failure->column = column;
    return status;
}

LINKWRIGHT_FUNCTION bool linkwright$f_exceeds_rounding($real excess, $real scale)
{
    return excess > (((FOLD$f * $FLT_EPSILON) * scale) + (UNDERFLOW$f * $FLT_MIN));
}

LINKWRIGHT_FUNCTION bool linkwright$f_is_finite($real value)
{
    return fabs$f(value) <= $FLT_MAX;
}

LINKWRIGHT_FUNCTION bool linkwright$f_all_finite(const $real values[], size_t count)
{
    bool are_finite = true;
    for (size_t k = 0U; k < count; k += 1U) {
        are_finite = are_finite && linkwright$f_is_finite(values[k]);
    }
    return are_finite;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_fail_out_of_reach($real distance, $real longest, $real shortest,
    const linkwright$f_conditions *conditions, uint16_t block)
{
    const $real least = fabs$f(shortest);
    linkwright_status status = LINKWRIGHT_SINGULAR;
    $real value = 0.0$f;
    if (!linkwright$f_is_finite(distance) || !linkwright$f_is_finite(longest) || !linkwright$f_is_finite(least)) {
        status = LINKWRIGHT_NOT_FINITE;
    } else if (distance > longest) {
        status = LINKWRIGHT_OUT_OF_REACH;
        value = distance - longest;
    } else if (distance < least) {
        status = LINKWRIGHT_OUT_OF_REACH;
        value = least - distance;
    } else {
        /* The links reach, and are collinear. */
    }
    return noted$f(conditions->failure, status, value, 0U, conditions->t, block);
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_singular_divisor($real value, $real scale,
    const linkwright$f_conditions *conditions, uint16_t block)
{
    return noted$f(conditions->failure, LINKWRIGHT_SINGULAR, value / scale, 0U, conditions->t, block);
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_not_positive($real value, const linkwright$f_conditions *conditions,
    uint16_t place)
{
    return noted$f(conditions->failure, LINKWRIGHT_NOT_POSITIVE, value, 0U, conditions->t, place);
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_outside_range(linkwright$f_failure *failure, $real value,
    uint16_t column, $real t, uint16_t place)
{
    return noted$f(failure, LINKWRIGHT_OUTSIDE_RANGE, value, column, t, place);
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_not_finite(const linkwright$f_conditions *conditions, uint16_t block)
{
    return noted$f(conditions->failure, LINKWRIGHT_NOT_FINITE, 0.0$f, 0U, conditions->t, block);
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_load_not_finite(const $real read[], size_t read_count,
    const $real loads[], uint16_t load_count, const linkwright$f_conditions *conditions, uint16_t block)
{
    uint16_t load = 0U;
    while ((load < load_count) && linkwright$f_is_finite(loads[load])) {
        load++;
    }
    if ((load == load_count) || !linkwright$f_all_finite(read, read_count)) {
        return LINKWRIGHT_NOT_FINITE;
    }
    return noted$f(conditions->failure, LINKWRIGHT_LOAD_NOT_FINITE, 0.0$f, load, conditions->t, block);
}

LINKWRIGHT_FUNCTION bool linkwright$f_pressure_angle($real along, $real across, $real sliding, $real *angle)
{
    const $real speed = (along * along) + (across * across);
    const bool moves = linkwright$f_is_finite(speed) && (speed > ($FLT_EPSILON * sliding)) && (speed > 0.0$f);
    *angle = moves ? linkwright$f_atan2(fabs$f(across), fabs$f(along)) : 0.0$f;
    return moves;
}

LINKWRIGHT_FUNCTION $real linkwright$f_largest_length(const $real lengths[], size_t count, $real otherwise)
{
    $real largest = 0.0$f;
    for (size_t k = 0U; k < count; k += 1U) {
        largest = larger$f(largest, fabs$f(lengths[k]));
    }
    return ((largest > 0.0$f) && linkwright$f_is_finite(largest)) ? largest : otherwise;
}

LINKWRIGHT_FUNCTION bool linkwright$f_first_not_positive(const $real values[], uint16_t count, uint16_t *place,
    $real *value)
{
    bool is_found = false;
    for (uint16_t k = 0U; (k < count) && !is_found; k++) {
        /* Written so that NaN is not positive. */
        is_found = !(values[k] > 0.0$f);
        *place = k;
        *value = values[k];
    }
    return is_found;
}

/* Tables. */

LINKWRIGHT_FUNCTION static size_t pieces_begun$f(const linkwright$f_table *table, $real x)
{
    const size_t count = table->count;
    size_t begun = 0U;
    if (table->spacing > 0.0$f) {
        const $real place = (x - table->starts[0]) / table->spacing;
        size_t guess = 0U;
        /* Negative quotients and NaN become the first index, and large ones the last. */
        if (place >= ($real)(count - 1U)) {
            guess = count - 1U;
        } else if (place > 0.0$f) {
            guess = (size_t)place;
        } else {
            /* The first. */
        }
        /* Rounding may move an argument beside a start into the neighbouring piece. */
        if (!(table->starts[guess] <= x)) {
            begun = guess;
        } else if (((guess + 1U) < count) && (table->starts[guess + 1U] <= x)) {
            begun = guess + 2U;
        } else {
            begun = guess + 1U;
        }
    } else {
        size_t end = count;
        while (begun < end) {
            const size_t middle = begun + ((end - begun) / 2U);
            if (table->starts[middle] <= x) {
                begun = middle + 1U;
            } else {
                end = middle;
            }
        }
    }
    return begun;
}

LINKWRIGHT_FUNCTION void linkwright$f_table_at(const linkwright$f_table *table, $real x, $real found[4])
{
    const $real first = table->starts[0];
    $real inside = x;
    if (table->period > 0.0$f) {
        inside = x - (table->period * floor$f((x - first) / table->period));
    }
    size_t begun = pieces_begun$f(table, inside);
    if ((begun == 0U) && (table->period > 0.0$f)) {
        /* Rounding may move an argument into the period just before its start, where the first piece continues. */
        begun = 1U;
    }
    if (begun == 0U) {
        const $real slope = table->pieces[0][1];
        found[0] = table->pieces[0][0] + (slope * (inside - first));
        found[1] = slope;
        found[2] = 0.0$f;
        found[3] = 0.0$f;
    } else {
        const $real *const c = table->pieces[begun - 1U];
        const $real along = inside - table->starts[begun - 1U];
        found[0] = c[0] + (along * (c[1] + (along * (c[2] + (along * c[3])))));
        found[1] = c[1] + (along * ((2.0$f * c[2]) + (along * (3.0$f * c[3]))));
        found[2] = (2.0$f * c[2]) + (along * (6.0$f * c[3]));
        found[3] = 6.0$f * c[3];
    }
}

LINKWRIGHT_FUNCTION $real linkwright$f_table_value(const linkwright$f_table *table, $real x, size_t order)
{
    $real found[4];
    linkwright$f_table_at(table, x, found);
    return found[order];
}

/* Blocks that are close to singular. */

LINKWRIGHT_FUNCTION linkwright$f_normalized_determinant linkwright$f_of_sine(uint16_t block, $real sine)
{
    const linkwright$f_normalized_determinant found = {block, sine, fabs$f(sine)};
    return found;
}

LINKWRIGHT_FUNCTION linkwright$f_normalized_determinant linkwright$f_of_slope(uint16_t block, $real slope)
{
    return linkwright$f_of_sine(block, slope / larger$f(fabs$f(slope), 1.0$f));
}

LINKWRIGHT_FUNCTION linkwright$f_normalized_determinant linkwright$f_closest(
    const linkwright$f_normalized_determinant found[], size_t count)
{
    linkwright$f_normalized_determinant closest = linkwright$f_of_sine(0U, 1.0$f);
    for (size_t k = 0U; k < count; k += 1U) {
        if ((k == 0U) || (found[k].reciprocal_condition < closest.reciprocal_condition)) {
            closest = found[k];
        }
    }
    return closest;
}
