
/* Blocks whose unknowns follow explicitly from a few tearing variables: Newton-Raphson on these alone. Tearing only
   saves work: unless it leads to a pose at which all equations hold to rounding, all are solved at once. */

/* Largest number of evaluations; from the last frame two or three suffice. */
#define EVALUATIONS$F 6U

/* Multiple of the rounding unit of its terms below which a tearing residual is rounding, once no step makes it
   smaller. Each unknown beyond that number adds a unit, because closed forms pass their rounding on along a chain. */
static const $real AMPLIFIED$f = 16.0$f;

/* Largest derivative of an unknown by a tearing variable, in their scales, with which rates are as accurate as those
   of all equations together. */
static const $real LARGEST_RESPONSE$f = 64.0$f;

/* Larger of a magnitude and that of a value, or one that is not finite. */
LINKWRIGHT_FUNCTION static $real largest_of$f($real largest, $real value)
{
    const $real magnitude = fabs$f(value);
    return ((largest < magnitude) || !linkwright$f_is_finite(magnitude)) ? magnitude : largest;
}

/* Rounding of one equation after many unknowns in sequence. */
LINKWRIGHT_FUNCTION static $real handed_on$f(const linkwright$f_equations *equations)
{
    const $real units = ($real)equations->order / AMPLIFIED$f;
    return $FLT_EPSILON * ((units > 1.0$f) ? units : 1.0$f);
}

/* Computes all unknowns and their rates at tearing variables with vanishing residuals; false if they are not as good
   as those of all equations together. */
LINKWRIGHT_FUNCTION static bool torn_completed$f(const linkwright$f_tearing *tearing, const $real tears[],
    const linkwright$f_tears *last, const $real memory[], linkwright$f_tears *found,
    const linkwright$f_conditions *conditions)
{
    const linkwright$f_equations *const equations = tearing->equations;
    const size_t n = equations->order;
    const $real *const carried = &tearing->evaluated[((tearing->count + 1U) * tearing->count) + 1U];
    $real *const cosines = tearing->completed;
    const $real *const sines = &cosines[n];
    const $real *const residual = &cosines[4U * n];
    const $real *const responses = &cosines[5U * n];
    $real left = conditions->settings->tolerance;
    $real response = 0.0$f;
    bool is_met = true;
    if (conditions->settings->polish) {
        $real largest = 0.0$f;
        for (size_t k = 0U; k < tearing->count; k += 1U) {
            largest = largest_of$f(largest, tearing->terms[k]);
        }
        left = (ROUNDING$f * handed_on$f(equations)) * largest;
    }
    tearing->complete(equations->context, tears, &memory[1], carried, conditions->t, tearing->completed);
    for (size_t k = 0U; k < n; k += 1U) {
        found->q[k] = equations->angles[k] ? linkwright$f_angle_near(sines[k], cosines[k], last->q[k]) : cosines[k];
        found->qd[k] = cosines[(2U * n) + k];
        found->qdd[k] = cosines[(3U * n) + k];
        /* All equations must hold as well as a solve of all together would leave them; this does not depend on the
           method. Written so that NaN is refused. */
        is_met = is_met && (fabs$f(residual[k]) <= (left * equations->row_scales[k]));
    }
    for (size_t k = 0U; k < tearing->count; k += 1U) {
        found->q[tearing->tears[k]] = tears[k];
    }
    for (size_t k = 0U; k < tearing->responses; k += 1U) {
        response = largest_of$f(response, responses[k]);
    }
    const bool are_finite = linkwright$f_all_finite(found->q, n) && linkwright$f_all_finite(found->qd, n)
        && linkwright$f_all_finite(found->qdd, n);
    found->t = conditions->t;
    return are_finite && is_met && (response <= LARGEST_RESPONSE$f);
}

/* Advances by the tearing variables if the frame is certain to be as good as by all equations. */
LINKWRIGHT_FUNCTION static bool torn_advanced$f(const linkwright$f_tearing *tearing, const linkwright$f_tears *last,
    const $real memory[], linkwright$f_tears *found, const linkwright$f_conditions *conditions)
{
    const linkwright$f_equations *const equations = tearing->equations;
    const size_t count = tearing->count;
    const $real h = conditions->t - last->t;
    const $real rounding = ROUNDING$f * $FLT_EPSILON;
    const $real enough = conditions->settings->polish ? rounding : conditions->settings->tolerance;
    const $real amplified = AMPLIFIED$f * handed_on$f(equations);
    $real tears[LINKWRIGHT_MOST_TEARS];
    $real before = 0.0$f;
    for (size_t k = 0U; k < count; k += 1U) {
        const size_t place = tearing->tears[k];
        const $real half = (0.5$f * h) * last->qdd[place];
        tears[k] = last->q[place] + (h * (last->qd[place] + half));
    }
    for (size_t evaluation = 0U; evaluation < EVALUATIONS$F; evaluation += 1U) {
        const $real *const residual = tearing->evaluated;
        const $real *const inverse = &residual[count];
        $real level = 0.0$f;
        $real noise = 0.0$f;
        $real length = 0.0$f;
        $real step[LINKWRIGHT_MOST_TEARS];
        const bool is_within_reach = tearing->evaluate(equations->context, tears, &memory[1], conditions->t,
            tearing->evaluated);
        /* Written so that NaN is refused. */
        if (!is_within_reach || !((inverse[count * count] * memory[0]) > 0.0$f)) {
            return false;
        }
        for (size_t row = 0U; row < count; row += 1U) {
            $real sum = 0.0$f;
            for (size_t column = 0U; column < count; column += 1U) {
                sum -= inverse[(row * count) + column] * residual[column];
            }
            step[row] = sum;
            const $real scaled = fabs$f(residual[row]) / tearing->scales[row];
            level = largest_of$f(level, scaled);
            noise = largest_of$f(noise, scaled / tearing->terms[row]);
            length = largest_of$f(length, fabs$f(sum) / equations->column_scales[tearing->tears[row]]);
        }
        const bool contracts = (evaluation == 0U) || (length <= (LARGEST_CONTRACTION$f * before));
        if ((level <= enough) || (!contracts && (noise <= amplified))) {
            return torn_completed$f(tearing, tears, last, memory, found, conditions);
        }
        if (!contracts) {
            return false;
        }
        before = length;
        for (size_t k = 0U; k < count; k += 1U) {
            tears[k] += step[k];
        }
    }
    return false;
}

/* Memory for the next frame, from a pose that all equations together have given. */
LINKWRIGHT_FUNCTION static void remembered$f(const linkwright$f_tearing *tearing, const $real q[], $real memory[],
    const linkwright$f_conditions *conditions)
{
    const linkwright$f_equations *const equations = tearing->equations;
    const size_t count = tearing->count;
    const $real *const residual = tearing->evaluated;
    $real tears[LINKWRIGHT_MOST_TEARS];
    for (size_t k = 0U; k < count; k += 1U) {
        tears[k] = q[tearing->tears[k]];
    }
    tearing->signs(equations->context, q, conditions->t, &memory[1]);
    bool leads_here = tearing->evaluate(equations->context, tears, &memory[1], conditions->t, tearing->evaluated);
    for (size_t k = 0U; (k < count) && leads_here; k += 1U) {
        /* The closed forms must lead to this pose. */
        leads_here = fabs$f(residual[k]) <= (conditions->settings->tolerance * tearing->scales[k]);
    }
    memory[0] = leads_here ? residual[(count + 1U) * count] : 0.0$f;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_solve_torn(const linkwright$f_tearing *tearing,
    const linkwright$f_tears *last, $real memory[], linkwright_branch *branch, linkwright$f_tears *found,
    const linkwright$f_conditions *conditions)
{
    const linkwright$f_equations *const equations = tearing->equations;
    const size_t n = equations->order;
    if ((conditions->start == LINKWRIGHT_LAST_FRAME) && (*branch != LINKWRIGHT_NEAREST)
        && torn_advanced$f(tearing, last, memory, found, conditions)) {
        return LINKWRIGHT_OK;
    }
    const linkwright_status status = linkwright$f_solve_block(equations, last, branch, found, NULL, conditions);
    if (status == LINKWRIGHT_OK) {
        for (size_t k = 0U; k < n; k += 1U) {
            tearing->completed[k] = found->q[k];
            tearing->completed[n + k] = 0.0$f;
            if (equations->angles[k]) {
                linkwright$f_sin_cos(found->q[k], &tearing->completed[n + k], &tearing->completed[k]);
            }
        }
        remembered$f(tearing, found->q, memory, conditions);
    }
    return status;
}
