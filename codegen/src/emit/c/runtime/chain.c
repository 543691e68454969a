
/* Chains of cells: two unknowns each, two equations that link a cell to the next one, and two more that may read
   every cell. If one equation is off, every cell before its link follows from the first cell as in an exact chain.
   Every cell behind the link follows from the last cell. The inverse C of the Jacobian therefore has rank two on
   either side of the links, and is never written out. */

/* Largest derivative of an unknown by those of the first or the last cell. Beyond this bound, rounding grows along
 * the chain. */
static const $real LARGEST_TRANSFER$f = 64.0$f;

/* Each array holds two numbers for each of n unknowns or equations. */
typedef struct linked$f {
    const linkwright$f_chord *chord;
    size_t order;
    /* Derivatives of each unknown by those of the first and of the last cell if all links hold. */
    $real *from_first;
    $real *from_last;
    /* Changes of the first and of the last cell's unknowns for an equation that is off by 1. */
    $real *first;
    $real *last;
    /* Effects of the columns of the product of C and the rotating columns on the first cell, on the last one, and on
       their own. */
    $real *turned_first;
    $real *turned_last;
    $real *turned_own;
    $real *vector;
} linked$f;

/* Derivatives of the equations of a link by the unknowns of a cell, row by row. */
LINKWRIGHT_FUNCTION static void square$f(const linked$f *chain, size_t link, size_t cell, $real found[4])
{
    for (size_t row = 0U; row < 2U; row += 1U) {
        const size_t k = (((2U * link) + row) * chain->order) + (2U * cell);
        found[2U * row] = chain->chord->jacobian[k];
        found[(2U * row) + 1U] = chain->chord->jacobian[k + 1U];
    }
}

LINKWRIGHT_FUNCTION static $real dot$f(const $real left[2], const $real right[2])
{
    return (left[0] * right[0]) + (left[1] * right[1]);
}

LINKWRIGHT_FUNCTION static $real magnitude_dot$f(const $real left[2], const $real right[2])
{
    return (fabs$f(left[0]) * right[0]) + (fabs$f(left[1]) * right[1]);
}

LINKWRIGHT_FUNCTION static bool inverted$f(const $real matrix[4], $real found[4])
{
    const $real determinant = (matrix[0] * matrix[3]) - (matrix[1] * matrix[2]);
    const bool is_regular = (fabs$f(determinant) > 0.0$f) && linkwright$f_is_finite(determinant);
    if (is_regular) {
        found[0] = matrix[3] / determinant;
        found[1] = -matrix[1] / determinant;
        found[2] = -matrix[2] / determinant;
        found[3] = matrix[0] / determinant;
    }
    return is_regular;
}

LINKWRIGHT_FUNCTION static void product$f(const $real left[4], const $real right[4], $real found[4])
{
    for (size_t column = 0U; column < 2U; column += 1U) {
        const $real other[2] = {right[column], right[column + 2U]};
        found[column] = dot$f(left, other);
        found[column + 2U] = dot$f(&left[2], other);
    }
}

/* Derivatives of all unknowns by those of the first cell, or in reverse of the last one. False if a link does not
   determine one of its cells from the other, or is nearly singular. */
LINKWRIGHT_FUNCTION static bool transfers$f(const linked$f *chain, bool is_reversed, $real found[])
{
    const size_t cells = chain->order / 2U;
    $real transfer[4] = {1.0$f, 0.0$f, 0.0$f, 1.0$f};
    bool is_small = true;
    for (size_t place = 0U; (place < cells) && is_small; place += 1U) {
        const size_t cell = is_reversed ? ((cells - 1U) - place) : place;
        if (place > 0U) {
            const size_t link = is_reversed ? cell : (cell - 1U);
            $real near[4];
            $real far[4];
            $real inverse[4];
            $real moved[4];
            square$f(chain, link, is_reversed ? (cell + 1U) : (cell - 1U), near);
            square$f(chain, link, cell, far);
            is_small = inverted$f(far, inverse);
            if (is_small) {
                product$f(near, transfer, moved);
                product$f(inverse, moved, transfer);
            }
        }
        for (size_t k = 0U; k < 4U; k += 1U) {
            if (place > 0U) {
                transfer[k] = -transfer[k];
            }
            /* Written so that NaN is refused. */
            is_small = is_small && (fabs$f(transfer[k]) <= LARGEST_TRANSFER$f);
            found[(4U * cell) + k] = transfer[k];
        }
    }
    return is_small;
}

/* Changes of the first cell's unknowns for an equation that is off by 1, or in reverse those of the last cell. */
LINKWRIGHT_FUNCTION static bool responses$f(const linked$f *chain, bool is_reversed, $real found[])
{
    const size_t cells = chain->order / 2U;
    $real seen[4];
    $real answer[4];
    bool is_regular = true;
    /* Change of the last equations for a moved cell if all cells behind it follow. */
    square$f(chain, cells - 1U, is_reversed ? 0U : (cells - 1U), seen);
    for (size_t place = cells - 1U; (place > 0U) && is_regular; place -= 1U) {
        const size_t far_cell = is_reversed ? ((cells - 1U) - place) : place;
        const size_t near_cell = is_reversed ? (far_cell + 1U) : (far_cell - 1U);
        const size_t link = is_reversed ? far_cell : near_cell;
        $real far[4];
        $real inverse[4];
        $real near[4];
        $real off[4];
        $real followed[4];
        square$f(chain, link, far_cell, far);
        is_regular = inverted$f(far, inverse);
        if (is_regular) {
            product$f(seen, inverse, off);
            square$f(chain, link, near_cell, near);
            product$f(off, near, followed);
            square$f(chain, cells - 1U, near_cell, seen);
            /* Column by column. */
            found[4U * link] = off[0];
            found[(4U * link) + 1U] = off[2];
            found[(4U * link) + 2U] = off[1];
            found[(4U * link) + 3U] = off[3];
            for (size_t k = 0U; k < 4U; k += 1U) {
                seen[k] -= followed[k];
            }
        }
    }
    is_regular = is_regular && inverted$f(seen, answer);
    if (is_regular) {
        for (size_t row = 0U; row < (2U * (cells - 1U)); row += 1U) {
            const $real off[2] = {found[2U * row], found[(2U * row) + 1U]};
            found[2U * row] = -dot$f(answer, off);
            found[(2U * row) + 1U] = -dot$f(&answer[2], off);
        }
        for (size_t side = 0U; side < 2U; side += 1U) {
            const size_t k = 2U * ((2U * (cells - 1U)) + side);
            found[k] = answer[side];
            found[k + 1U] = answer[side + 2U];
        }
    }
    return is_regular;
}

/* Adds the effect of some equations of a rotating column on the first or the last cell. */
LINKWRIGHT_FUNCTION static void respond$f(const linked$f *chain, const $real responses[], size_t link, size_t column,
    $real sum[2])
{
    for (size_t row = 2U * link; row < ((2U * link) + 2U); row += 1U) {
        const $real entry = chain->chord->turning[(row * chain->order) + column];
        sum[0] += entry * responses[2U * row];
        sum[1] += entry * responses[(2U * row) + 1U];
    }
}

/* Product of C and the rotating columns. */
LINKWRIGHT_FUNCTION static void turn_chain$f(const linked$f *chain)
{
    const size_t cells = chain->order / 2U;
    for (size_t column = 0U; column < chain->order; column += 1U) {
        const size_t cell = column / 2U;
        const $real *const responses[2] = {chain->first, chain->last};
        $real *const found[2] = {chain->turned_first, chain->turned_last};
        $real ahead[2][2] = {{0.0$f, 0.0$f}, {0.0$f, 0.0$f}};
        $real before[2][2] = {{0.0$f, 0.0$f}, {0.0$f, 0.0$f}};
        for (size_t end = 0U; end < 2U; end += 1U) {
            $real closing[2] = {0.0$f, 0.0$f};
            if ((cell + 1U) < cells) {
                respond$f(chain, responses[end], cell, column, ahead[end]);
            }
            respond$f(chain, responses[end], cells - 1U, column, closing);
            if (cell > 0U) {
                respond$f(chain, responses[end], cell - 1U, column, before[end]);
            }
            for (size_t side = 0U; side < 2U; side += 1U) {
                ahead[end][side] += closing[side];
                found[end][(2U * column) + side] = ahead[end][side] + before[end][side];
            }
        }
        for (size_t side = 0U; side < 2U; side += 1U) {
            const size_t unknown = 2U * ((2U * cell) + side);
            chain->turned_own[(2U * column) + side] =
                dot$f(&chain->from_first[unknown], ahead[0]) + dot$f(&chain->from_last[unknown], before[1]);
        }
    }
}

/* Adds the effects of both entries of a cell or a link, or their magnitudes. */
LINKWRIGHT_FUNCTION static void gather$f(const $real responses[], size_t cell, bool is_size, const $real vector[],
    $real sum[2])
{
    for (size_t place = 2U * cell; place < ((2U * cell) + 2U); place += 1U) {
        for (size_t side = 0U; side < 2U; side += 1U) {
            const $real response = responses[(2U * place) + side];
            sum[side] += (is_size ? fabs$f(response) : response) * vector[place];
        }
    }
}

/* Effects of a vector's entries on all cells, from their effects on the first and the last cell: entries behind a
   cell act on the cells before them, and the others the other way round. Entries of a link are behind its cell; those
   of a cell act on neither side. */
LINKWRIGHT_FUNCTION static void sides$f(const linked$f *chain, const $real *const ends[2], bool are_links, bool is_size,
    const $real vector[], $real found[])
{
    const size_t cells = chain->order / 2U;
    $real behind[2] = {0.0$f, 0.0$f};
    $real before[2] = {0.0$f, 0.0$f};
    for (size_t cell = cells; cell > 0U; cell -= 1U) {
        if (are_links) {
            gather$f(ends[0], cell - 1U, is_size, vector, behind);
        }
        for (size_t unknown = 2U * (cell - 1U); unknown < (2U * cell); unknown += 1U) {
            const $real *const from = &chain->from_first[2U * unknown];
            found[unknown] = is_size ? magnitude_dot$f(from, behind) : dot$f(from, behind);
        }
        if (!are_links) {
            gather$f(ends[0], cell - 1U, is_size, vector, behind);
        }
    }
    for (size_t cell = 0U; cell < cells; cell += 1U) {
        for (size_t unknown = 2U * cell; unknown < ((2U * cell) + 2U); unknown += 1U) {
            const $real *const from = &chain->from_last[2U * unknown];
            found[unknown] += is_size ? magnitude_dot$f(from, before) : dot$f(from, before);
        }
        gather$f(ends[1], cell, is_size, vector, before);
    }
}

/* Product of C, or of its magnitudes, with a vector. */
LINKWRIGHT_FUNCTION static void times_chain$f(const linked$f *chain, const $real vector[], bool is_size, $real found[])
{
    const $real *const ends[2] = {chain->first, chain->last};
    sides$f(chain, ends, true, is_size, vector, found);
}

/* Product of the magnitudes of C and the rotating columns with a vector. */
LINKWRIGHT_FUNCTION static void spread_chain$f(const linked$f *chain, const $real vector[], $real found[])
{
    const $real *const ends[2] = {chain->turned_first, chain->turned_last};
    sides$f(chain, ends, false, true, vector, found);
    for (size_t cell = 0U; cell < (chain->order / 2U); cell += 1U) {
        $real own[2] = {0.0$f, 0.0$f};
        gather$f(chain->turned_own, cell, true, vector, own);
        found[2U * cell] += own[0];
        found[(2U * cell) + 1U] += own[1];
    }
}

/* Least remainder of the Newton operator on the chord. */
LINKWRIGHT_FUNCTION static void begin_chain$f(const linked$f *chain, const linkwright$f_isolation *isolation)
{
    const linkwright$f_chord *const chord = chain->chord;
    const size_t n = chain->order;
    $real *const least = isolation->least;
    $real *const off = isolation->rest;
    $real *const second = chain->vector;
    for (size_t row = 0U; row < n; row += 1U) {
        const bool is_link = row < (n - 2U);
        const size_t begin = is_link ? ((row / 2U) * 2U) : 0U;
        const size_t end = is_link ? (begin + 4U) : n;
        second[row] = chord->curvatures[row];
        off[row] = 0.0$f;
        for (size_t column = begin; column < end; column += 1U) {
            const size_t k = (row * n) + column;
            const $real rounding = (LEFT_BY_ROUNDING$f * $FLT_EPSILON) * fabs$f(chord->sizes[column]);
            const $real size = fabs$f(chord->jacobian[k]) + fabs$f(chord->turning[k]);
            off[row] = larger$f(rounding * size, off[row]);
            second[row] += chord->turning[k] * (chord->changes[column] * chord->changes[column]);
        }
        off[row] += chord->bounds[row];
    }
    times_chain$f(chain, second, false, least);
    /* Remainder beside second derivatives: half of d to the fourth for the cosine, and the cube of d for the sine. */
    for (size_t k = 0U; k < n; k += 1U) {
        const $real square = chord->changes[k] * chord->changes[k];
        chain->vector[k] = (0.5$f * square) * square;
    }
    spread_chain$f(chain, chain->vector, isolation->needed);
    for (size_t k = 0U; k < n; k += 1U) {
        const $real third = chord->changes[k] * (chord->changes[k] * chord->changes[k]);
        least[k] = chord->remainder * ((fabs$f(least[k]) + isolation->needed[k]) + third);
    }
    times_chain$f(chain, off, true, isolation->needed);
    for (size_t k = 0U; k < n; k += 1U) {
        least[k] += isolation->needed[k];
        isolation->deviations[k] = least[k] * FIRST$f;
    }
}

/* Image of the deviations under the operator: |sin d| is at most d, and 1 - cos d at most d^2 / 2. */
LINKWRIGHT_FUNCTION static void spread_deviations$f(const linked$f *chain, const linkwright$f_isolation *isolation)
{
    const $real *const changes = chain->chord->changes;
    for (size_t k = 0U; k < chain->order; k += 1U) {
        chain->vector[k] = (changes[k] + isolation->deviations[k]) * isolation->deviations[k];
    }
    spread_chain$f(chain, chain->vector, isolation->needed);
    for (size_t k = 0U; k < chain->order; k += 1U) {
        const $real delta = changes[k] + isolation->deviations[k];
        const $real beside = ((0.5$f * delta) * delta) * isolation->deviations[k];
        isolation->needed[k] = (isolation->needed[k] + beside) + isolation->least[k];
    }
}

LINKWRIGHT_FUNCTION void linkwright$f_isolate_chain(linkwright$f_isolation *isolation, uint16_t order,
    const uint16_t blocks[], const linkwright$f_time_window *window, const linkwright$f_chord *chord,
    const $real variation[], $real reals[])
{
    const size_t n = order;
    $real *const pairs = &reals[5U * n];
    linked$f chain = {chord, n, pairs, &pairs[2U * n], &pairs[4U * n], &pairs[6U * n], &pairs[8U * n], &pairs[10U * n],
        &pairs[12U * n], &reals[4U * n]};
    isolation->order = order;
    isolation->blocks = blocks;
    isolation->chord = chord;
    isolation->least = reals;
    isolation->needed = &reals[n];
    isolation->rest = &reals[2U * n];
    isolation->deviations = &reals[3U * n];
    isolation->found = isolation->needed;
    isolation->largest = 0.0$f;
    isolation->is_nearing = false;
    isolation->farthest = 0U;
    isolation->block = blocks[0];
    isolation->is_shown = transfers$f(&chain, false, chain.from_first) && responses$f(&chain, false, chain.first)
        && transfers$f(&chain, true, chain.from_last) && responses$f(&chain, true, chain.last);
    if (isolation->is_shown) {
        uint16_t round = 0U;
        bool is_wider = true;
        turn_chain$f(&chain);
        begin_chain$f(&chain, isolation);
        while (is_wider) {
            spread_deviations$f(&chain, isolation);
            is_wider = widens$f(isolation, round);
            round++;
        }
    }
    /* Beyond the frames there are nearer windows to try; between them the whole inverse decides. */
    if (!isolation->is_shown && (window->steps <= 1.0$f)) {
        linkwright$f_isolate(isolation, order, blocks, chord, variation, reals);
        while (linkwright$f_isolation_needs_variation(isolation)) {
            /* The rotating columns do not vary otherwise. */
        }
    }
}
