
/* Factorizes a Jacobian in its scales, or decides that it is singular. Matrices are stored row by row. */

/* Status of a solve, with its value and column. */
typedef struct Verdict$f {
    linkwright_status status;
    $real value;
    uint16_t column;
} Verdict$f;

LINKWRIGHT_FUNCTION static Verdict$f verdict_of$f(linkwright_status status)
{
    const Verdict$f verdict = {status, 0.0$f, 0U};
    return verdict;
}

/* Row of the entry with the largest magnitude in a column, from a row on; the first of equal ones. */
LINKWRIGHT_FUNCTION static uint16_t pivot_row$f(const $real matrix[], size_t n, uint16_t column, $real *magnitude)
{
    $real largest = 0.0$f;
    uint16_t row = column;
    for (uint16_t k = column; k < n; k++) {
        const $real size = fabs$f(matrix[(k * n) + column]);
        if (size > largest) {
            largest = size;
            row = k;
        }
    }
    *magnitude = largest;
    return row;
}

/* Subtracts a multiple of column k below its diagonal from another one, or from a vector. */
LINKWRIGHT_FUNCTION static void subtract_multiple$f(const $real factors[], size_t n, size_t k, $real x[], size_t stride)
{
    const $real factor = x[k * stride];
    /* Jacobians of mechanisms are sparse: most factors are exactly zero, and the columns are finite. */
    if (factor != 0.0$f) {
        for (size_t row = k + 1U; row < n; row += 1U) {
            x[row * stride] -= factor * factors[(row * n) + k];
        }
    }
}

LINKWRIGHT_FUNCTION static void exchange$f($real x[], size_t stride, size_t first, size_t second)
{
    const $real kept = x[first * stride];
    x[first * stride] = x[second * stride];
    x[second * stride] = kept;
}

/* Factorizes a matrix (n x n) in a workspace of n x n + n numbers and n exchanges, judged in the scales. The
   elimination is Golub & Van Loan, Matrix Computations (4th ed.), algorithm 3.4.1, with partial pivoting. */
LINKWRIGHT_FUNCTION static Verdict$f factorized$f(linkwright$f_factorization *found, const $real matrix[],
    const linkwright$f_equations *equations, const $real row_scales[], const $real column_scales[],
    $real smallest_pivot_ratio, $real reals[])
{
    const size_t n = equations->order;
    $real *const factors = reals;
    $real *const row_factors = &reals[n * n];
    $real reference = 1.0$f;
    found->order = equations->order;
    found->factors = factors;
    found->exchanges = equations->exchanges;
    found->row_factors = row_factors;
    found->column_factors = column_scales;
    found->pivot_ratio = 1.0$f;
    for (size_t row = 0U; row < n; row += 1U) {
        row_factors[row] = 1.0$f / row_scales[row];
        for (size_t column = 0U; column < n; column += 1U) {
            const size_t k = (row * n) + column;
            factors[k] = matrix[k] * (row_factors[row] * column_scales[column]);
            reference = larger$f(reference, fabs$f(factors[k]));
        }
    }
    if (!linkwright$f_all_finite(factors, n * n)) {
        return verdict_of$f(LINKWRIGHT_NOT_FINITE);
    }
    for (uint16_t k = 0U; k < n; k++) {
        $real magnitude;
        const uint16_t pivot = pivot_row$f(factors, n, k, &magnitude);
        const $real ratio = magnitude / reference;
        /* Written so that NaN is rejected too. */
        if (!((ratio >= smallest_pivot_ratio) && (ratio > 0.0$f))) {
            const Verdict$f singular = {LINKWRIGHT_SINGULAR, ratio, k};
            return singular;
        }
        found->pivot_ratio = smaller$f(found->pivot_ratio, ratio);
        found->exchanges[k] = pivot;
        exchange$f(&factors[k], n, k, pivot);
        const $real reciprocal = 1.0$f / factors[(k * n) + k];
        for (size_t row = (size_t)k + 1U; row < n; row += 1U) {
            factors[(row * n) + k] *= reciprocal;
        }
        for (size_t column = (size_t)k + 1U; column < n; column += 1U) {
            exchange$f(&factors[column], n, k, pivot);
            subtract_multiple$f(factors, n, k, &factors[column], n);
        }
    }
    return verdict_of$f(linkwright$f_all_finite(factors, n * n) ? LINKWRIGHT_OK : LINKWRIGHT_NOT_FINITE);
}

/* Replaces the right-hand side of the scaled system with its solution. */
LINKWRIGHT_FUNCTION static void solve_scaled$f(const linkwright$f_factorization *factorization, $real x[])
{
    const size_t n = factorization->order;
    const $real *const factors = factorization->factors;
    /* Forward, the exchange of each column before its multipliers. */
    for (size_t k = 0U; k < n; k += 1U) {
        exchange$f(x, 1U, k, factorization->exchanges[k]);
        subtract_multiple$f(factors, n, k, x, 1U);
    }
    /* Backward, column by column. */
    for (size_t k = n; k > 0U; k -= 1U) {
        const size_t column = k - 1U;
        x[column] /= factors[(column * n) + column];
        const $real factor = x[column];
        if (factor != 0.0$f) {
            for (size_t row = 0U; row < column; row += 1U) {
                x[row] -= factor * factors[(row * n) + column];
            }
        }
    }
}

LINKWRIGHT_FUNCTION void linkwright$f_solve_factorized(const linkwright$f_factorization *factorization,
    $real right_hand_side[])
{
    const size_t n = factorization->order;
    for (size_t k = 0U; k < n; k += 1U) {
        right_hand_side[k] *= factorization->row_factors[k];
    }
    solve_scaled$f(factorization, right_hand_side);
    for (size_t k = 0U; k < n; k += 1U) {
        right_hand_side[k] *= factorization->column_factors[k];
    }
}

/* Replaces the right-hand side of the transposed scaled system with its solution. */
LINKWRIGHT_FUNCTION static void solve_scaled_transposed$f(const linkwright$f_factorization *factorization, $real x[])
{
    const size_t n = factorization->order;
    const $real *const factors = factorization->factors;
    for (size_t k = 0U; k < n; k += 1U) {
        $real sum = 0.0$f;
        for (size_t row = 0U; row < k; row += 1U) {
            sum += x[row] * factors[(row * n) + k];
        }
        x[k] = (x[k] - sum) / factors[(k * n) + k];
    }
    /* Multipliers of each column before its exchange, in the reverse order of the elimination. */
    for (size_t k = n; k > 0U; k -= 1U) {
        const size_t column = k - 1U;
        $real sum = 0.0$f;
        for (size_t row = k; row < n; row += 1U) {
            sum += x[row] * factors[(row * n) + column];
        }
        x[column] -= sum;
        exchange$f(x, 1U, column, factorization->exchanges[column]);
    }
}

/* Sign of the determinant. */
LINKWRIGHT_FUNCTION static linkwright_branch branch_of$f(const linkwright$f_factorization *factorization)
{
    const size_t n = factorization->order;
    bool is_negative = false;
    for (size_t k = 0U; k < n; k += 1U) {
        const bool is_below = factorization->factors[(k * n) + k] < 0.0$f;
        const bool is_exchanged = factorization->exchanges[k] != k;
        is_negative = is_negative != (is_below != is_exchanged);
    }
    return is_negative ? LINKWRIGHT_NEGATIVE : LINKWRIGHT_POSITIVE;
}

LINKWRIGHT_FUNCTION static $real sum_of_magnitudes$f(const $real x[], size_t n)
{
    $real sum = 0.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        sum += fabs$f(x[k]);
    }
    return sum;
}

/* Position of the first entry of largest magnitude; 0 if there is none. */
LINKWRIGHT_FUNCTION static uint16_t position_of_largest$f(const $real x[], size_t n)
{
    uint16_t place = 0U;
    $real largest = 0.0$f;
    for (uint16_t k = 0U; k < n; k++) {
        if (fabs$f(x[k]) > largest) {
            place = k;
            largest = fabs$f(x[k]);
        }
    }
    return place;
}

/* Largest number of unit vectors that are tried for the norm of an inverse. */
#define TRIALS$F 5U

/* Image of a vector with 1-norm 1 under the inverse of the scaled matrix; its norm estimates that of the inverse
   (Hager 1984; Higham, ACM Transactions on Mathematical Software 14 (1988), algorithm 4.1). Workspace of 3 n
   numbers. */
LINKWRIGHT_FUNCTION static void largest_image$f(const linkwright$f_factorization *factorization, $real image[],
    $real reals[])
{
    const size_t n = factorization->order;
    const $real count = ($real)n;
    $real *const gradient = reals;
    $real *const candidate = &reals[n];
    $real *const alternating = &reals[2U * n];
    for (size_t k = 0U; k < n; k += 1U) {
        image[k] = 1.0$f / count;
    }
    solve_scaled$f(factorization, image);
    $real norm = sum_of_magnitudes$f(image, n);
    bool has_unit = false;
    uint16_t unit = 0U;
    bool goes_on = true;
    for (uint16_t trial = 0U; (trial < TRIALS$F) && goes_on; trial++) {
        /* Gradient of the norm of the image. */
        for (size_t k = 0U; k < n; k += 1U) {
            gradient[k] = (image[k] < 0.0$f) ? -1.0$f : 1.0$f;
        }
        solve_scaled_transposed$f(factorization, gradient);
        const uint16_t steepest = position_of_largest$f(gradient, n);
        /* A unit vector that returns is a local maximum. */
        goes_on = !(has_unit && (unit == steepest));
        if (goes_on) {
            has_unit = true;
            unit = steepest;
            for (size_t k = 0U; k < n; k += 1U) {
                candidate[k] = (k == steepest) ? 1.0$f : 0.0$f;
            }
            solve_scaled$f(factorization, candidate);
            const $real more = sum_of_magnitudes$f(candidate, n);
            goes_on = !(more <= norm);
            if (goes_on) {
                norm = more;
                (void)memcpy(image, candidate, n * sizeof($real));
            }
        }
    }
    /* Vector of alternating signs, for the matrices on which the search above is misled. */
    $real total = 0.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        const $real magnitude = 1.0$f + (($real)k / count);
        total += magnitude;
        alternating[k] = ((k % 2U) == 0U) ? magnitude : -magnitude;
    }
    for (size_t k = 0U; k < n; k += 1U) {
        alternating[k] /= total;
    }
    solve_scaled$f(factorization, alternating);
    if (sum_of_magnitudes$f(alternating, n) > norm) {
        (void)memcpy(image, alternating, n * sizeof($real));
    }
}

/* Distance of a scaled matrix from singular; only the directions of its columns count. Workspace of 2 n numbers. */
LINKWRIGHT_FUNCTION static linkwright$f_measure measured$f(const linkwright$f_factorization *factorization,
    const $real matrix[], $real reals[])
{
    const size_t n = factorization->order;
    $real *const lengths = reals;
    $real *const column = &reals[n];
    linkwright$f_measure found;
    if (n == 1U) {
        const linkwright$f_normalized_determinant slope = linkwright$f_of_slope(0U, factorization->factors[0]);
        found.determinant = slope.determinant;
        found.reciprocal_condition = slope.reciprocal_condition;
        return found;
    }
    for (size_t k = 0U; k < n; k += 1U) {
        $real square = 0.0$f;
        for (size_t row = 0U; row < n; row += 1U) {
            const $real scaled
                = matrix[(row * n) + k] * (factorization->row_factors[row] * factorization->column_factors[k]);
            square += scaled * scaled;
        }
        lengths[k] = sqrt$f(square);
    }
    $real determinant = 1.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        const $real part = factorization->factors[(k * n) + k] / lengths[k];
        determinant *= (factorization->exchanges[k] == k) ? part : -part;
    }
    $real square = 0.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        for (size_t row = 0U; row < n; row += 1U) {
            column[row] = (row == k) ? 1.0$f : 0.0$f;
        }
        solve_scaled$f(factorization, column);
        for (size_t row = 0U; row < n; row += 1U) {
            square += (column[row] * lengths[row]) * (column[row] * lengths[row]);
        }
    }
    const $real ratio = sqrt$f(($real)n / square);
    /* Rounding may leave a little more than the limits. */
    found.determinant = smaller$f(larger$f(determinant, -1.0$f), 1.0$f);
    found.reciprocal_condition = linkwright$f_is_finite(ratio) ? smaller$f(ratio, 1.0$f) : 0.0$f;
    return found;
}
