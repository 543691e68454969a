
/* Two frames and the bounds of what moves between them: whether the second one lies on the path of the first. */

/* The multiple of the rounding by which a value that Newton-Raphson finds may be off. */
static const $real TUBE_ROUNDING$f = 65536.0$f;

/* The multiple of the rounding by which a solved equation may be off zero. */
static const $real LEFT_BY_ROUNDING$f = 64.0$f;

/* The multiple of the rounding by which the difference of two values may be off, as a part of their size. */
static const $real OF_DIFFERENCES$f = 32.0$f;

/* The multiple of the least sags that is tried first. */
static const $real FIRST$f = 2.0$f;

/* By how much sags are widened that the operator does not map into themselves, and how often. */
static const $real INFLATION$f = 1.25$f;
#define WIDENED$F 8U

/* The round from which on sags must come nearer to being mapped into themselves. */
#define SETTLED$F 2U

/* How far rounding leaves what frames hold, and what differences of two of them lead to that are multiplied by
   stretch. */
static $real span_rounding$f($real stretch)
{
    return $FLT_EPSILON * (LEFT_BY_ROUNDING$f + (OF_DIFFERENCES$f * stretch));
}

/* How far a signal is from a straight line between two values that are h (s) apart. */
static $real bend_of_signal$f($real h, const linkwright$f_signal *before, const linkwright$f_signal *now)
{
    const $real moved = now->value - before->value;
    const $real rate_before = fabs$f((before->rate * h) - moved);
    const $real rate_now = fabs$f((now->rate * h) - moved);
    const $real acceleration_before = fabs$f((before->acceleration * h) * h);
    const $real acceleration_now = fabs$f((now->acceleration * h) * h);
    return (0.2$f * (rate_before + rate_now)) + (0.018$f * (acceleration_before + acceleration_now));
}

/* How far a signal that moves so far in one step may be from the straight line beyond the frames. */
static $real tube_of_signal$f(const linkwright$f_span *span, $real moved)
{
    return (0.25$f * span->stretch) * moved;
}

void linkwright$f_span_signal(const linkwright$f_span *span, const linkwright$f_signal *before,
    const linkwright$f_signal *now, $real found[2])
{
    const $real moved = fabs$f(now->value - before->value);
    const $real sag = bend_of_signal$f(span->step, before, now) + (span->beyond * tube_of_signal$f(span, moved));
    found[0] = (span->stretch * moved) + sag;
    found[1] = sag;
}

/* Whether a signal that goes from last to next in the time h stays as near to the straight line from before to now
   as is supposed; the line ends so long (s) before next. */
static bool holds_signal$f(const linkwright$f_span *span, const linkwright$f_signal *before,
    const linkwright$f_signal *now, const linkwright$f_signal *last, const linkwright$f_signal *next, $real h,
    $real since)
{
    const $real moved = now->value - before->value;
    const $real line_last = now->value + (moved * ((since - h) / span->step));
    const $real line_next = now->value + (moved * (since / span->step));
    const $real tube = 0.5$f * tube_of_signal$f(span, fabs$f(moved));
    return (fabs$f(last->value - line_last) <= tube) && (fabs$f(next->value - line_next) <= tube)
        && (bend_of_signal$f(h, last, next) <= tube);
}

/* What a signal is at a part of the time h (s) that it takes from one value to another, by the polynomial of the
   fifth degree that has value, rate and acceleration of both ends. */
static linkwright$f_signal signal_towards$f(const linkwright$f_signal *first, const linkwright$f_signal *last,
    $real h, $real part)
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

linkwright$f_tube linkwright$f_tube_of($real now, $real before, $real sag)
{
    const linkwright$f_tube tube = {now, now - before, sag};
    return tube;
}

bool linkwright$f_tube_holds(const linkwright$f_tube *tube, $real value, $real steps)
{
    const $real rounding = (TUBE_ROUNDING$f * $FLT_EPSILON) * (1.0$f + fabs$f(value));
    return fabs$f((value - tube->value) - (tube->moved * steps)) <= (tube->sag + rounding);
}

/* Makes a row that of the identity, by its column, and puts the row of the inverse in its place. Room for n numbers.
   */
static void eliminate$f($real matrix[], size_t n, size_t row, $real own[])
{
    const $real reciprocal = 1.0$f / matrix[(row * n) + row];
    matrix[(row * n) + row] = 1.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        matrix[(k * n) + row] *= reciprocal;
        own[k] = matrix[(k * n) + row];
    }
    for (size_t column = 0U; column < n; column += 1U) {
        const $real factor = matrix[(row * n) + column];
        /* A block reads nothing of those after it. */
        if ((column != row) && (factor != 0.0$f)) {
            matrix[(row * n) + column] = 0.0$f;
            for (size_t k = 0U; k < n; k += 1U) {
                matrix[(k * n) + column] -= factor * own[k];
            }
        }
    }
}

/* The magnitudes of the entries of the inverse of a matrix (n × n), by elimination in place with the largest pivot
   of each row. Room for 2 n numbers. False, and the row, where every pivot vanishes. */
static bool inverse_sizes$f(const $real matrix[], size_t n, $real sizes[], uint16_t *failed, $real reals[])
{
    $real *const own = reals;
    /* Which columns were exchanged, as numbers that are exact. */
    $real *const exchanged = &reals[n];
    (void)memcpy(sizes, matrix, (n * n) * sizeof($real));
    for (uint16_t row = 0U; row < n; row++) {
        size_t pivot = row;
        $real largest = fabs$f(sizes[(row * n) + row]);
        for (size_t column = (size_t)row + 1U; column < n; column += 1U) {
            const $real other = fabs$f(sizes[(row * n) + column]);
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
            exchange$f(&sizes[k * n], 1U, row, pivot);
        }
        eliminate$f(sizes, n, row, own);
    }
    /* Columns that were exchanged are rows of the inverse. */
    for (size_t k = n; k > 0U; k -= 1U) {
        const size_t row = k - 1U;
        const size_t pivot = (size_t)exchanged[row];
        for (size_t column = 0U; column < n; column += 1U) {
            exchange$f(&sizes[column], n, row, pivot);
        }
    }
    for (size_t k = 0U; k < (n * n); k += 1U) {
        sizes[k] = fabs$f(sizes[k]);
    }
    return true;
}

/* A matrix (n × n) times a vector. */
static void times$f(const $real matrix[], const $real vector[], size_t n, $real product[])
{
    for (size_t row = 0U; row < n; row += 1U) {
        $real sum = 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            sum += matrix[(row * n) + column] * vector[column];
        }
        product[row] = sum;
    }
}

/* With C the inverse of the Jacobian, the operator of Newton with C maps the sags R into themselves where
   |C| bounds + |C| variation(R) R is at most R; then the equations have one solution near the line (Krawczyk). */
void linkwright$f_isolate(linkwright$f_isolation *isolation, uint16_t order, const uint16_t blocks[],
    const $real bounds[], $real sizes[], const $real jacobian[], $real variation[], $real reals[])
{
    const size_t n = order;
    uint16_t failed = 0U;
    isolation->order = order;
    isolation->blocks = blocks;
    isolation->jacobian = jacobian;
    isolation->bounds = bounds;
    isolation->variation = variation;
    isolation->inverse = reals;
    isolation->least = &reals[n * n];
    isolation->needed = &isolation->least[n];
    isolation->rest = &isolation->needed[n];
    isolation->sags = sizes;
    isolation->found = isolation->needed;
    isolation->rounds = 0U;
    isolation->largest = 0.0$f;
    isolation->is_nearing = false;
    isolation->farthest = 0U;
    isolation->is_shown = inverse_sizes$f(jacobian, n, isolation->inverse, &failed, isolation->least);
    isolation->block = blocks[failed];
    for (size_t k = 0U; k < n; k += 1U) {
        sizes[k] = fabs$f(sizes[k]);
    }
}

/* What is left of the line at least: what the bounds say, and how far rounding may leave each equation from zero. */
static void begin_isolation$f(linkwright$f_isolation *isolation)
{
    const size_t n = isolation->order;
    $real *const off = isolation->rest;
    for (size_t row = 0U; row < n; row += 1U) {
        off[row] = 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            const size_t k = (row * n) + column;
            const $real rounding = (LEFT_BY_ROUNDING$f * $FLT_EPSILON) * isolation->sags[column];
            off[row] = larger$f(rounding * (fabs$f(isolation->jacobian[k]) + fabs$f(isolation->variation[k])),
                off[row]);
        }
        off[row] += isolation->bounds[row];
    }
    times$f(isolation->inverse, off, n, isolation->least);
    /* Where a map least + k R + a R² of one sag takes any R into itself, the largest that it does so with is 2 least
       or more. */
    for (size_t k = 0U; k < n; k += 1U) {
        isolation->sags[k] = isolation->least[k] * FIRST$f;
    }
}

/* Whether the operator maps the sags into themselves. */
static bool is_mapped_inside$f(linkwright$f_isolation *isolation)
{
    const size_t n = isolation->order;
    $real *const spread = isolation->rest;
    $real largest = 1.0$f;
    bool is_inside = true;
    times$f(isolation->variation, isolation->sags, n, spread);
    times$f(isolation->inverse, spread, n, isolation->needed);
    for (uint16_t row = 0U; row < n; row++) {
        isolation->needed[row] += isolation->least[row];
        const $real needed = isolation->needed[row];
        const $real sag = isolation->sags[row];
        /* Written so that NaN is refused, and bounds that have become infinite. */
        is_inside = is_inside && (needed <= sag) && linkwright$f_is_finite(sag);
        if (!(needed <= (largest * sag))) {
            isolation->farthest = row;
            largest = needed / sag;
        }
    }
    isolation->is_nearing = largest < isolation->largest;
    isolation->largest = largest;
    return is_inside;
}

bool linkwright$f_isolation_asks(linkwright$f_isolation *isolation)
{
    bool asks = false;
    const uint16_t round = isolation->rounds;
    isolation->rounds++;
    if (!isolation->is_shown) {
        /* There is no inverse. */
    } else if (round == 0U) {
        asks = true;
    } else if (round == 1U) {
        begin_isolation$f(isolation);
        asks = true;
    } else if (is_mapped_inside$f(isolation)) {
        /* What the operator maps them to holds the solution as well. */
    } else if ((round <= WIDENED$F) && ((round < (SETTLED$F + 2U)) || isolation->is_nearing)) {
        for (size_t k = 0U; k < isolation->order; k += 1U) {
            isolation->sags[k] = isolation->needed[k] * INFLATION$f;
        }
        asks = true;
    } else {
        isolation->is_shown = false;
        isolation->block = isolation->blocks[isolation->farthest];
    }
    return asks;
}
