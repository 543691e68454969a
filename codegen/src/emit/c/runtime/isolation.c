/* Verifies that equations have one solution near the chord through two frames, at every time of a window. */

/* Multiple of the least deviations that is tried first. */
static const $real FIRST$f = 2.0$f;

/* Factor of deviations that the operator does not map into themselves, and number of such inflations. */
static const $real INFLATION$f = 1.25$f;
#define WIDENED$F 8U

/* Round from which on deviations must approach being mapped into themselves. */
#define SETTLED$F 2U

/* Number of times that the variation is required before deviations are spread. */
#define FIRST_ROUND$F 2U

/* Makes a row that of the identity, by its column, and stores the row of the inverse in its place. Workspace of n
   numbers. */
LINKWRIGHT_FUNCTION static void eliminate$f($real matrix[], size_t n, size_t row, $real own[])
{
    const $real reciprocal = 1.0$f / matrix[(row * n) + row];
    matrix[(row * n) + row] = 1.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        matrix[(k * n) + row] *= reciprocal;
        own[k] = matrix[(k * n) + row];
    }
    for (size_t column = 0U; column < n; column += 1U) {
        const $real factor = matrix[(row * n) + column];
        /* A block does not depend on the blocks after it. */
        if ((column != row) && (factor != 0.0$f)) {
            matrix[(row * n) + column] = 0.0$f;
            for (size_t k = 0U; k < n; k += 1U) {
                matrix[(k * n) + column] -= factor * own[k];
            }
        }
    }
}

/* Inverse of a matrix (n x n), by elimination in place with the largest pivot of each row. Workspace of 2 n numbers.
   False, and the row, if every pivot vanishes. */
LINKWRIGHT_FUNCTION static bool invert$f(const $real matrix[], size_t n, $real inverse[], uint16_t *failed,
    $real reals[])
{
    $real *const own = reals;
    /* Exchanged columns, as exact numbers. */
    $real *const exchanged = &reals[n];
    (void)memcpy(inverse, matrix, (n * n) * sizeof($real));
    for (uint16_t row = 0U; row < n; row++) {
        size_t pivot = row;
        $real largest = fabs$f(inverse[(row * n) + row]);
        for (size_t column = (size_t)row + 1U; column < n; column += 1U) {
            const $real other = fabs$f(inverse[(row * n) + column]);
            if (other > largest) {
                pivot = column;
                largest = other;
            }
        }
        /* Written so that NaN is refused. */
        if (!(largest > 0.0$f)) {
            *failed = row;
            return false;
        }
        exchanged[row] = ($real)pivot;
        for (size_t k = 0U; k < n; k += 1U) {
            exchange$f(&inverse[k * n], 1U, row, pivot);
        }
        eliminate$f(inverse, n, row, own);
    }
    /* Columns that were exchanged are rows of the inverse. */
    for (size_t k = n; k > 0U; k -= 1U) {
        const size_t row = k - 1U;
        const size_t pivot = (size_t)exchanged[row];
        for (size_t column = 0U; column < n; column += 1U) {
            exchange$f(&inverse[column], n, row, pivot);
        }
    }
    return true;
}

/* Product of a matrix (n x n) and a vector. */
LINKWRIGHT_FUNCTION static void times$f(const $real matrix[], const $real vector[], size_t n, $real product[])
{
    for (size_t row = 0U; row < n; row += 1U) {
        $real sum = 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            sum += matrix[(row * n) + column] * vector[column];
        }
        product[row] = sum;
    }
}

/* Replaces every number by its magnitude. */
LINKWRIGHT_FUNCTION static void magnitudes$f($real values[], size_t count)
{
    for (size_t k = 0U; k < count; k += 1U) {
        values[k] = fabs$f(values[k]);
    }
}

/* Let C be the inverse of the Jacobian. The Newton operator with C maps the deviations R into themselves if its
   remainder on the chord plus |I - C J| R is at most R. The equations then have one solution near the chord
   (Krawczyk). Arms rotate with their angle, so that a column J of the Jacobian becomes J cos d + J' sin d, with C J
   known. Effects of one angle through many equations are added with their signs. */
LINKWRIGHT_FUNCTION void linkwright$f_isolate(linkwright$f_isolation *isolation, uint16_t order,
    const uint16_t blocks[], const linkwright$f_chord *chord, const $real variation[], $real reals[])
{
    const size_t n = order;
    uint16_t failed = 0U;
    isolation->order = order;
    isolation->blocks = blocks;
    isolation->chord = chord;
    isolation->variation = variation;
    isolation->inverse = reals;
    isolation->least = &reals[n * n];
    isolation->needed = &isolation->least[n];
    isolation->rest = &isolation->needed[n];
    isolation->deviations = chord->sizes;
    isolation->found = isolation->needed;
    isolation->rounds = 0U;
    isolation->largest = 0.0$f;
    isolation->is_nearing = false;
    isolation->farthest = 0U;
    isolation->is_shown = invert$f(chord->jacobian, n, isolation->inverse, &failed, isolation->least);
    isolation->block = blocks[failed];
    magnitudes$f(isolation->deviations, n);
}

/* Bound on each equation's residual on the chord: that of the chord, and that of rounding. */
LINKWRIGHT_FUNCTION static void off_line$f(const linkwright$f_isolation *isolation, $real off[])
{
    const linkwright$f_chord *const chord = isolation->chord;
    const size_t n = isolation->order;
    for (size_t row = 0U; row < n; row += 1U) {
        off[row] = 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            const size_t k = (row * n) + column;
            const $real rounding = (LEFT_BY_ROUNDING$f * $FLT_EPSILON) * isolation->deviations[column];
            const $real size = fabs$f(chord->jacobian[k]) + fabs$f(chord->turning[k]);
            off[row] = larger$f(rounding * (size + fabs$f(isolation->variation[k])), off[row]);
        }
        off[row] += chord->bounds[row];
    }
}

/* Replaces the rotating columns by their products with the inverse, column by column. */
LINKWRIGHT_FUNCTION static void turn_inverse$f(const linkwright$f_isolation *isolation, $real product[])
{
    const linkwright$f_chord *const chord = isolation->chord;
    const size_t n = isolation->order;
    for (size_t column = 0U; column < n; column += 1U) {
        for (size_t k = 0U; k < n; k += 1U) {
            product[k] = 0.0$f;
        }
        for (size_t row = 0U; row < n; row += 1U) {
            const $real factor = chord->turning[(row * n) + column];
            /* An equation has few unknowns. */
            if (factor != 0.0$f) {
                for (size_t k = 0U; k < n; k += 1U) {
                    product[k] += isolation->inverse[(k * n) + row] * factor;
                }
            }
        }
        if (chord->turns[column]) {
            for (size_t k = 0U; k < n; k += 1U) {
                chord->turning[(k * n) + column] = product[k];
            }
        }
    }
}

/* Least remainder on the chord: arms on it are A cos d + J sin d, and the second derivative of A is J'. Both frames
   satisfy their equations up to rounding. */
LINKWRIGHT_FUNCTION static void begin_isolation$f(linkwright$f_isolation *isolation)
{
    const linkwright$f_chord *const chord = isolation->chord;
    const size_t n = isolation->order;
    $real *const least = isolation->least;
    $real *const needed = isolation->needed;
    $real *const off = isolation->rest;
    off_line$f(isolation, off);
    turn_inverse$f(isolation, least);
    times$f(isolation->inverse, chord->curvatures, n, least);
    magnitudes$f(isolation->inverse, n * n);
    times$f(isolation->inverse, off, n, needed);
    for (size_t row = 0U; row < n; row += 1U) {
        const $real change = chord->changes[row];
        $real second = 0.0$f;
        /* Remainder beside second derivatives: half of d to the fourth for the cosine, and the cube of d for the
           sine. */
        $real fourth = 0.0$f;
        const $real third = chord->turns[row] ? (change * (change * change)) : 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            if (chord->turns[column]) {
                $real *const turned = &chord->turning[(row * n) + column];
                const $real square = chord->changes[column] * chord->changes[column];
                second += *turned * square;
                *turned = fabs$f(*turned);
                fourth += *turned * ((0.5$f * square) * square);
            }
        }
        least[row] = (chord->remainder * ((fabs$f(second + least[row]) + fourth) + third)) + needed[row];
        /* If a map least + k R + a R^2 of one deviation takes any R into itself, the largest such R is 2 least or
           more. */
        isolation->deviations[row] = least[row] * FIRST$f;
    }
}

/* Image of the deviations under the operator: |sin d| is at most d, and 1 - cos d at most d^2 / 2. */
LINKWRIGHT_FUNCTION static void spread$f(const linkwright$f_isolation *isolation)
{
    const linkwright$f_chord *const chord = isolation->chord;
    const size_t n = isolation->order;
    $real *const spread = isolation->rest;
    bool varies = false;
    /* Every column either rotates or varies. */
    for (size_t column = 0U; column < n; column += 1U) {
        varies = varies || !chord->turns[column];
        isolation->needed[column] = 0.0$f;
    }
    if (varies) {
        times$f(isolation->variation, isolation->deviations, n, spread);
        times$f(isolation->inverse, spread, n, isolation->needed);
    }
    for (size_t row = 0U; row < n; row += 1U) {
        $real turned = 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            if (chord->turns[column]) {
                const $real delta = chord->changes[column] + isolation->deviations[column];
                turned += chord->turning[(row * n) + column] * (delta * isolation->deviations[column]);
            }
        }
        const $real own = chord->changes[row] + isolation->deviations[row];
        const $real beside = chord->turns[row] ? (((0.5$f * own) * own) * isolation->deviations[row]) : 0.0$f;
        isolation->needed[row] = ((isolation->needed[row] + beside) + turned) + isolation->least[row];
    }
}

/* True if the operator, which has spread the deviations, maps them into themselves. */
LINKWRIGHT_FUNCTION static bool is_mapped_inside$f(linkwright$f_isolation *isolation)
{
    const size_t n = isolation->order;
    $real largest = 1.0$f;
    bool is_inside = true;
    for (uint16_t row = 0U; row < n; row++) {
        const $real needed = isolation->needed[row];
        const $real deviation = isolation->deviations[row];
        /* Written so that NaN and infinite bounds are refused. */
        is_inside = is_inside && (needed <= deviation) && linkwright$f_is_finite(deviation);
        if (!(needed <= (largest * deviation))) {
            isolation->farthest = row;
            largest = needed / deviation;
        }
    }
    isolation->is_nearing = largest < isolation->largest;
    isolation->largest = largest;
    return is_inside;
}

/* Widens deviations that this round does not map into themselves if they approach it; true if another round follows. */
LINKWRIGHT_FUNCTION static bool widens$f(linkwright$f_isolation *isolation, uint16_t round)
{
    bool is_wider = false;
    if (is_mapped_inside$f(isolation)) {
        /* The image of the deviations contains the solution as well. */
    } else if (((round + 1U) < WIDENED$F) && ((round < SETTLED$F) || isolation->is_nearing)) {
        for (size_t k = 0U; k < isolation->order; k += 1U) {
            isolation->deviations[k] = isolation->needed[k] * INFLATION$f;
        }
        is_wider = true;
    } else {
        isolation->is_shown = false;
        isolation->block = isolation->blocks[isolation->farthest];
    }
    return is_wider;
}

LINKWRIGHT_FUNCTION bool linkwright$f_isolation_needs_variation(linkwright$f_isolation *isolation)
{
    bool asks = false;
    const uint16_t round = isolation->rounds;
    isolation->rounds++;
    if (!isolation->is_shown) {
        /* The inverse does not exist. */
    } else if (round == 0U) {
        asks = true;
    } else if (round == 1U) {
        begin_isolation$f(isolation);
        asks = true;
    } else {
        spread$f(isolation);
        asks = widens$f(isolation, (uint16_t)(round - FIRST_ROUND$F));
    }
    return asks;
}
