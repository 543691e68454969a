
/* Newton-Raphson: solves equations for the pose at a time from an estimate, or returns a failure. Residuals are
   measured in the scales of the rows, steps in those of the unknowns. */

/* Longest step, in scales, that still counts as progress. */
static const $real LONGEST_STEP$f = 1e6$f;

/* Largest growth of the scaled residual over the first one, or over 1 if that is larger. */
static const $real LARGEST_GROWTH$f = 1e4$f;

/* Number of consecutive steps with growing residual that count as divergence. */
#define GROWING_STEPS$F 5U

/* Part of the residual above which a polishing step ends a solve: the remaining residual is rounding. */
static const $real NOISE$f = 0.75$f;

/* Largest ratio of the lengths of two consecutive steps on a path that is being followed. */
static const $real LARGEST_CONTRACTION$f = 0.5$f;

/* Multiple of the residual below which the square of the pivot ratio makes a pose doubtful. */
static const $real DOUBT$f = 256.0$f;

/* Largest uncertainty of a coordinate, in its scale; a pose beyond it is refused. */
static const $real LARGEST_UNCERTAINTY$f = 1e-3$f;

/* Largest change of the Jacobian, relative to itself, at a regular pose. */
static const $real LARGEST_CHANGE$f = 0.125$f;

/* Scaled residual of a pose, and the equation with it. */
typedef struct Residual$f {
    $real magnitude;
    uint16_t row;
} Residual$f;

/* Conditions on the Jacobians and steps of a solve. */
typedef struct Watch$f {
    /* Required sign of the determinant; LINKWRIGHT_NEAREST without a requirement. */
    linkwright_branch branch;
    /* True if intermediate Jacobians must have it too, and steps must become shorter. */
    bool on_the_way;
    bool has_last;
    $real last;
    /* Measure of the Jacobian at the returned pose, or null. */
    linkwright$f_measure *measure;
} Watch$f;

/* Record of earlier steps. */
typedef struct Progress$f {
    /* Earlier pose that new ones are compared with (Brent, BIT 20 (1980), 176-184). */
    $real *checkpoint;
    uint32_t age;
    uint32_t lifetime;
    $real bound;
    $real last;
    uint16_t growing;
} Progress$f;

/* Progress of a solve. */
typedef struct Convergence$f {
    uint16_t iterations;
    Residual$f residual;
} Convergence$f;

LINKWRIGHT_FUNCTION static Residual$f residual_of$f(const linkwright$f_equations *equations, const $real phi[])
{
    Residual$f largest = {0.0$f, 0U};
    bool goes_on = true;
    for (uint16_t row = 0U; (row < equations->order) && goes_on; row++) {
        const $real magnitude = fabs$f(phi[row]) / equations->row_scales[row];
        goes_on = linkwright$f_is_finite(magnitude);
        if (!goes_on || (magnitude > largest.magnitude)) {
            largest.magnitude = magnitude;
            largest.row = row;
        }
    }
    return largest;
}

LINKWRIGHT_FUNCTION static bool scales_are_valid$f(const linkwright$f_equations *equations)
{
    bool are_valid = true;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        const $real row = equations->row_scales[k];
        const $real column = equations->column_scales[k];
        are_valid = are_valid && (row > 0.0$f) && linkwright$f_is_finite(row);
        are_valid = are_valid && (column > 0.0$f) && linkwright$f_is_finite(column);
    }
    return are_valid;
}

/* Length of a step in scales. */
LINKWRIGHT_FUNCTION static $real step_length$f(const linkwright$f_equations *equations, const $real update[])
{
    $real longest = 0.0$f;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        longest = larger$f(longest, fabs$f(update[k]) / equations->column_scales[k]);
    }
    return longest;
}

/* Distance of two vectors in scales. */
LINKWRIGHT_FUNCTION static $real distance$f(const linkwright$f_equations *equations, const $real a[], const $real b[])
{
    $real longest = 0.0$f;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        longest = larger$f(longest, fabs$f(a[k] - b[k]) / equations->column_scales[k]);
    }
    return longest;
}

/* True if no coordinate of two poses differs by more than a part of its scale. */
LINKWRIGHT_FUNCTION static bool are_close$f(const linkwright$f_equations *equations, const $real a[], const $real b[],
    $real part)
{
    bool are_close = true;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        are_close = are_close && (fabs$f(a[k] - b[k]) <= (part * equations->column_scales[k]));
    }
    return are_close;
}

/* True if no entry of a change exceeds a part of its coordinate or of its scale, whichever is larger. */
LINKWRIGHT_FUNCTION static bool is_negligible$f(const linkwright$f_equations *equations, const $real update[],
    const $real pose[], $real part)
{
    bool is_negligible = true;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        is_negligible = is_negligible && (fabs$f(update[k]) <= (part * larger$f(fabs$f(pose[k]),
            equations->column_scales[k])));
    }
    return is_negligible;
}

/* True if no coordinate of two poses differs by more than a part of its value or of its scale, whichever is larger. */
LINKWRIGHT_FUNCTION static bool coincide$f(const linkwright$f_equations *equations, const $real a[], const $real b[],
    $real part)
{
    bool coincide = true;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        coincide = coincide && (fabs$f(a[k] - b[k]) <= (part * larger$f(fabs$f(a[k]), equations->column_scales[k])));
    }
    return coincide;
}

LINKWRIGHT_FUNCTION static linkwright_status gave_up$f(const linkwright$f_equations *equations, Verdict$f verdict,
    Convergence$f convergence, const linkwright$f_conditions *conditions)
{
    linkwright$f_failure *const failure = conditions->failure;
    (void)noted$f(failure, verdict.status, verdict.value, verdict.column, conditions->t, equations->block);
    failure->iterations = convergence.iterations;
    failure->residual = convergence.residual.magnitude;
    failure->row = convergence.residual.row;
    return verdict.status;
}

/* Judges an intermediate Jacobian, or the last one. */
LINKWRIGHT_FUNCTION static linkwright_status judged_jacobian$f(const Watch$f *watch,
    const linkwright$f_factorization *factorization, bool has_arrived)
{
    const bool is_asked = (watch->branch != LINKWRIGHT_NEAREST) && (has_arrived || watch->on_the_way);
    return (is_asked && (branch_of$f(factorization) != watch->branch)) ? LINKWRIGHT_WRONG_BRANCH : LINKWRIGHT_OK;
}

/* Judges a step before it is taken. */
LINKWRIGHT_FUNCTION static linkwright_status judged_step$f(Watch$f *watch, const linkwright$f_equations *equations,
    const $real update[])
{
    linkwright_status status = LINKWRIGHT_OK;
    if (watch->on_the_way) {
        const $real length = step_length$f(equations, update);
        if (watch->has_last && (length > (LARGEST_CONTRACTION$f * watch->last))) {
            status = LINKWRIGHT_STEP_TOO_LARGE;
        }
        watch->last = length;
        watch->has_last = true;
    }
    return status;
}

/* Judges the step that led to a pose, while the residual is above the tolerance. */
LINKWRIGHT_FUNCTION static linkwright_status judged_progress$f(Progress$f *progress,
    const linkwright$f_equations *equations, const $real pose[], const $real update[], $real residual)
{
    const $real rounding = ROUNDING$f * $FLT_EPSILON;
    if (is_negligible$f(equations, update, pose, rounding)) {
        return LINKWRIGHT_STALLED;
    }
    progress->growing = (residual > progress->last) ? (uint16_t)(progress->growing + 1U) : 0U;
    progress->last = residual;
    if ((step_length$f(equations, update) > LONGEST_STEP$f) || (residual > progress->bound)
        || (progress->growing >= GROWING_STEPS$F)) {
        return LINKWRIGHT_DIVERGED;
    }
    if (coincide$f(equations, pose, progress->checkpoint, rounding)) {
        return LINKWRIGHT_CYCLING;
    }
    progress->age += 1U;
    if (progress->age >= progress->lifetime) {
        (void)memcpy(progress->checkpoint, pose, equations->order * sizeof($real));
        progress->age = 0U;
        progress->lifetime *= 2U;
    }
    return LINKWRIGHT_OK;
}

/* Residual, or rounding if the residual is lower. */
LINKWRIGHT_FUNCTION static $real level$f($real residual)
{
    return larger$f(residual, ROUNDING$f * $FLT_EPSILON);
}

/* Requires that a pose can be told from a singular one within the uncertainty of its residual (Deuflhard, Newton
   Methods for Nonlinear Problems, 2004, section 2.1). Workspace of n x n + 6 n numbers. */
LINKWRIGHT_FUNCTION static Verdict$f regular$f(const linkwright$f_equations *equations, const $real q[], $real t,
    $real residual, const $real jacobian[], const linkwright$f_factorization *factorization, $real reals[])
{
    const size_t n = equations->order;
    $real *const changed = reals;
    $real *const uncertain = &reals[n * n];
    $real *const moved = &uncertain[n];
    $real *const image = &moved[n];
    largest_image$f(factorization, uncertain, &image[n]);
    const Verdict$f singular = {LINKWRIGHT_SINGULAR, factorization->pivot_ratio, position_of_largest$f(uncertain, n)};
    /* The residual may have either sign, so two poses that both fit differ by twice the uncertainty. */
    const $real reach = level$f(residual) + level$f(residual);
    for (size_t k = 0U; k < n; k += 1U) {
        uncertain[k] *= reach * equations->column_scales[k];
        moved[k] = q[k] + uncertain[k];
        image[k] = 0.0$f;
    }
    const $real size = step_length$f(equations, uncertain);
    const $real by_rounding = size * (level$f(0.0$f) / level$f(residual));
    /* Written so that NaN is rejected too. */
    if (!(by_rounding <= LARGEST_UNCERTAINTY$f)) {
        return singular;
    }
    equations->jacobian(equations->context, moved, t, changed);
    for (size_t column = 0U; column < n; column += 1U) {
        for (size_t row = 0U; row < n; row += 1U) {
            const size_t k = (row * n) + column;
            image[row] += (changed[k] - jacobian[k]) * uncertain[column];
        }
    }
    linkwright$f_solve_factorized(factorization, image);
    const $real change = step_length$f(equations, image);
    return (change <= (LARGEST_CHANGE$f * size)) ? verdict_of$f(LINKWRIGHT_OK) : singular;
}

LINKWRIGHT_FUNCTION static bool is_worth_polishing$f(Residual$f residual, const linkwright$f_settings *settings)
{
    return settings->polish && (residual.magnitude > (ROUNDING$f * $FLT_EPSILON));
}

/* Right-hand side of a step. */
LINKWRIGHT_FUNCTION static void negated$f($real update[], const $real phi[], size_t n)
{
    for (size_t k = 0U; k < n; k += 1U) {
        update[k] = -phi[k];
    }
}

/* Moves an estimate to a pose at which the equations hold. One more step polishes the residual to rounding level; a
   pose that has not settled by then is not returned. */
LINKWRIGHT_FUNCTION static linkwright_status solved$f(const linkwright$f_equations *equations, $real pose[],
    Watch$f *watch, Convergence$f *convergence, const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    const $real t = conditions->t;
    const linkwright$f_settings *const settings = conditions->settings;
    $real *const jacobian = equations->reals;
    $real *const factors = &jacobian[n * n];
    $real *const phi = &factors[(n * n) + n];
    $real *const update = &phi[n];
    $real *const rest = &update[2U * n];
    Progress$f progress = {&update[n], 0U, 1U, 0.0$f, 0.0$f, 0U};
    linkwright$f_factorization factorization;
    bool is_unsettled = false;
    equations->residual(equations->context, pose, t, phi);
    convergence->iterations = 0U;
    convergence->residual = residual_of$f(equations, phi);
    const bool is_finite = linkwright$f_all_finite(pose, n)
        && linkwright$f_is_finite(convergence->residual.magnitude);
    if (!(linkwright$f_is_finite(t) && scales_are_valid$f(equations) && is_finite)) {
        return gave_up$f(equations, verdict_of$f(LINKWRIGHT_NOT_FINITE), *convergence, conditions);
    }
    (void)memcpy(progress.checkpoint, pose, n * sizeof($real));
    progress.bound = LARGEST_GROWTH$f * larger$f(convergence->residual.magnitude, 1.0$f);
    progress.last = convergence->residual.magnitude;
    for (;;) {
        const bool is_solved = convergence->residual.magnitude <= settings->tolerance;
        if (is_solved && !is_worth_polishing$f(convergence->residual, settings)) {
            return LINKWRIGHT_OK;
        }
        const bool is_limit = (!is_solved || is_unsettled) && (convergence->iterations >= settings->iterations);
        if (is_limit && !is_unsettled) {
            return gave_up$f(equations, verdict_of$f(LINKWRIGHT_ITERATION_LIMIT), *convergence, conditions);
        }
        equations->jacobian(equations->context, pose, t, jacobian);
        Verdict$f verdict = factorized$f(&factorization, jacobian, equations, equations->row_scales,
            equations->column_scales, settings->pivot_ratio, factors);
        if (is_limit) {
            /* A pose that meets the tolerance has not settled because it is singular, or because there were too few
               steps. */
            if (verdict.status == LINKWRIGHT_OK) {
                verdict = regular$f(equations, pose, t, convergence->residual.magnitude, jacobian, &factorization,
                    rest);
            }
            if (verdict.status == LINKWRIGHT_OK) {
                verdict = verdict_of$f(LINKWRIGHT_ITERATION_LIMIT);
            }
            return gave_up$f(equations, verdict, *convergence, conditions);
        }
        if (verdict.status != LINKWRIGHT_OK) {
            /* A pose that meets the tolerance is good already; a singular Jacobian only prevents polishing it. */
            return (is_solved && !is_unsettled) ? LINKWRIGHT_OK : gave_up$f(equations, verdict, *convergence,
                conditions);
        }
        if (!is_solved) {
            negated$f(update, phi, n);
            linkwright$f_solve_factorized(&factorization, update);
            linkwright_status status = judged_jacobian$f(watch, &factorization, false);
            if (status == LINKWRIGHT_OK) {
                status = judged_step$f(watch, equations, update);
            }
            if (status != LINKWRIGHT_OK) {
                return gave_up$f(equations, verdict_of$f(status), *convergence, conditions);
            }
            for (size_t k = 0U; k < n; k += 1U) {
                pose[k] += update[k];
            }
            equations->residual(equations->context, pose, t, phi);
            convergence->residual = residual_of$f(equations, phi);
            convergence->iterations++;
            if (!(linkwright$f_all_finite(pose, n) && linkwright$f_is_finite(convergence->residual.magnitude))) {
                return gave_up$f(equations, verdict_of$f(LINKWRIGHT_NOT_FINITE), *convergence, conditions);
            }
            if (convergence->residual.magnitude > settings->tolerance) {
                status = judged_progress$f(&progress, equations, pose, update, convergence->residual.magnitude);
                if (status != LINKWRIGHT_OK) {
                    return gave_up$f(equations, verdict_of$f(status), *convergence, conditions);
                }
                continue;
            }
            if (!is_worth_polishing$f(convergence->residual, settings)) {
                return LINKWRIGHT_OK;
            }
        }
        /* The pose is solved. One more step is taken unless it makes the residual larger. */
        negated$f(update, phi, n);
        linkwright$f_solve_factorized(&factorization, update);
        for (size_t k = 0U; k < n; k += 1U) {
            update[k] += pose[k];
        }
        equations->residual(equations->context, update, t, phi);
        const Residual$f after = residual_of$f(equations, phi);
        const bool is_better = (after.magnitude <= convergence->residual.magnitude) && linkwright$f_all_finite(update,
            n);
        const bool is_rounding = after.magnitude <= (ROUNDING$f * $FLT_EPSILON);
        /* Written so that a NaN residual is not an improvement. */
        const bool improves = after.magnitude < (NOISE$f * convergence->residual.magnitude);
        const $real settled = (0.5$f * settings->tolerance) * (convergence->residual.magnitude / after.magnitude);
        is_unsettled = is_better && !is_rounding && improves && !are_close$f(equations, pose, update, settled);
        /* Only the step of a Jacobian at this very pose shows that nothing but noise is left. */
        const bool again = !is_rounding && (improves || !is_solved)
            && (convergence->iterations < settings->iterations);
        if (is_better) {
            (void)memcpy(pose, update, n * sizeof($real));
            convergence->residual = after;
        }
        if (!(is_unsettled || again)) {
            return LINKWRIGHT_OK;
        }
        convergence->iterations++;
        if (!is_better) {
            equations->residual(equations->context, pose, t, phi);
        }
    }
}

/* Solves for the pose from the estimate in the frame, then for its rates and accelerations. */
LINKWRIGHT_FUNCTION static linkwright_status completed$f(const linkwright$f_equations *equations,
    linkwright$f_tears *found, Watch$f *watch, const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    const $real t = conditions->t;
    $real *const jacobian = equations->reals;
    $real *const factors = &jacobian[n * n];
    $real *const rest = &factors[(n * n) + n];
    linkwright$f_factorization factorization;
    Convergence$f convergence;
    const linkwright_status status = solved$f(equations, found->q, watch, &convergence, conditions);
    if (status != LINKWRIGHT_OK) {
        return status;
    }
    equations->jacobian(equations->context, found->q, t, jacobian);
    Verdict$f verdict = factorized$f(&factorization, jacobian, equations, equations->row_scales,
        equations->column_scales, conditions->settings->pivot_ratio, factors);
    if (verdict.status == LINKWRIGHT_OK) {
        verdict = verdict_of$f(judged_jacobian$f(watch, &factorization, true));
    }
    if ((verdict.status == LINKWRIGHT_OK) && (watch->measure != NULL)) {
        *watch->measure = measured$f(&factorization, jacobian, rest);
    }
    if (verdict.status == LINKWRIGHT_OK) {
        const $real ratio = factorization.pivot_ratio;
        const $real residual = convergence.residual.magnitude;
        if ((ratio * ratio) < (DOUBT$f * level$f(residual))) {
            verdict = regular$f(equations, found->q, t, residual, jacobian, &factorization, rest);
        }
    }
    if (verdict.status != LINKWRIGHT_OK) {
        return gave_up$f(equations, verdict, convergence, conditions);
    }
    found->t = t;
    equations->time_derivative(equations->context, found->q, t, found->qd);
    negated$f(found->qd, found->qd, n);
    linkwright$f_solve_factorized(&factorization, found->qd);
    equations->gamma(equations->context, found->q, found->qd, t, found->qdd);
    linkwright$f_solve_factorized(&factorization, found->qdd);
    if (!(linkwright$f_all_finite(found->qd, n) && linkwright$f_all_finite(found->qdd, n))) {
        return gave_up$f(equations, verdict_of$f(LINKWRIGHT_NOT_FINITE), convergence, conditions);
    }
    return LINKWRIGHT_OK;
}
