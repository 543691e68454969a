
/* Assembly from a poor estimate. */

/* Largest number of times that one step is shortened, and smallest part of a step that is taken. */
#define SHORTENINGS$F 8U
static const $real SMALLEST_PART$f = 1e-4$f;

/* Ratio of two consecutive corrections at full length below which plain Newton-Raphson continues. The next
   correction must be shorter by at least the second part of the step's fraction. */
static const $real NEAR_RATIO$f = 0.25$f;
static const $real LEAST_GAIN$f = 0.25$f;

/* Largest number of least-squares steps, and scaled residual at which their estimate is good enough. */
#define STEPS$F 60U
static const $real GOOD$f = 1e-4$f;

/* First damping of the least squares, relative to the largest entry of the diagonal, and smallest factor of the
   damping after a step with the predicted gain. */
static const $real FIRST_DAMPING$f = 1e-2$f;
static const $real LARGEST_EASING$f = 1.0$f / 3.0$f;

/* Moves an estimate to a pose by damped steps while they are needed (Deuflhard, Newton Methods for Nonlinear
   Problems, 2004, section 3.3.3, algorithm NLEQ-ERR), then by Newton-Raphson. */
LINKWRIGHT_FUNCTION static linkwright_status solved_damped$f(const linkwright$f_equations *equations, $real pose[],
    const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    const $real t = conditions->t;
    const linkwright$f_settings *const settings = conditions->settings;
    $real *const jacobian = equations->reals;
    $real *const factors = &jacobian[n * n];
    $real *const phi = &factors[(n * n) + n];
    $real *const update = &phi[n];
    $real *const trial = &update[n];
    $real *const correction = &trial[n];
    $real *const expected = &correction[n];
    $real *const linear = &expected[n];
    linkwright$f_factorization factorization;
    Convergence$f convergence = {0U, {0.0$f, 0U}};
    Watch$f unwatched = {LINKWRIGHT_NEAREST, false, false, 0.0$f, NULL};
    /* Length of the step before, and its part. */
    bool is_expected = false;
    $real last_length = 0.0$f;
    $real last_part = 0.0$f;
    bool is_near = false;
    equations->residual(equations->context, pose, t, phi);
    convergence.residual = residual_of$f(equations, phi);
    const bool is_finite = linkwright$f_all_finite(pose, n) && linkwright$f_is_finite(convergence.residual.magnitude);
    if (!(linkwright$f_is_finite(t) && scales_are_valid$f(equations) && is_finite)) {
        return gave_up$f(equations, verdict_of$f(LINKWRIGHT_NOT_FINITE), convergence, conditions);
    }
    while ((convergence.residual.magnitude > settings->tolerance) && !is_near) {
        if (convergence.iterations >= settings->iterations) {
            return gave_up$f(equations, verdict_of$f(LINKWRIGHT_ITERATION_LIMIT), convergence, conditions);
        }
        equations->jacobian(equations->context, pose, t, jacobian);
        const Verdict$f verdict = factorized$f(&factorization, jacobian, equations, equations->row_scales,
            equations->column_scales, settings->pivot_ratio, factors);
        if (verdict.status != LINKWRIGHT_OK) {
            return gave_up$f(equations, verdict, convergence, conditions);
        }
        negated$f(update, phi, n);
        linkwright$f_solve_factorized(&factorization, update);
        const $real length = step_length$f(equations, update);
        $real part = 1.0$f;
        if (is_expected) {
            const $real bend = distance$f(equations, expected, update);
            const $real numerator = (last_length * step_length$f(equations, expected)) * last_part;
            part = smaller$f(numerator / (bend * length), 1.0$f);
        }
        part = larger$f(part, SMALLEST_PART$f);
        uint16_t shortenings = 0U;
        bool is_taken = false;
        $real ratio = 0.0$f;
        while (!is_taken) {
            for (size_t k = 0U; k < n; k += 1U) {
                trial[k] = pose[k] + (part * update[k]);
            }
            equations->residual(equations->context, trial, t, phi);
            const Residual$f after = residual_of$f(equations, phi);
            negated$f(correction, phi, n);
            linkwright$f_solve_factorized(&factorization, correction);
            ratio = step_length$f(equations, correction) / length;
            /* Written so that NaN is not accepted. */
            is_taken = (ratio <= (1.0$f - (LEAST_GAIN$f * part))) && linkwright$f_is_finite(after.magnitude);
            if (is_taken) {
                (void)memcpy(pose, trial, n * sizeof($real));
                convergence.residual = after;
            } else {
                /* Difference of the correction from that of a linear system. */
                for (size_t k = 0U; k < n; k += 1U) {
                    linear[k] = update[k] * (1.0$f - part);
                }
                const $real bend = distance$f(equations, correction, linear);
                const $real better = (((0.5$f * length) * part) * part) / bend;
                /* The smaller of the two, and the half if the other is NaN. */
                part = smaller$f(0.5$f * part, better);
                shortenings++;
                if ((part < SMALLEST_PART$f) || (shortenings > SHORTENINGS$F)) {
                    return gave_up$f(equations, verdict_of$f(LINKWRIGHT_STALLED), convergence, conditions);
                }
            }
        }
        convergence.iterations++;
        is_near = !(part < 1.0$f) && (ratio < NEAR_RATIO$f);
        (void)memcpy(expected, correction, n * sizeof($real));
        last_length = length;
        last_part = part;
        is_expected = true;
    }
    return solved$f(equations, pose, &unwatched, &convergence, conditions);
}

/* Scales residuals and returns the sum of their squares. */
LINKWRIGHT_FUNCTION static $real sum_of_squares$f(const linkwright$f_equations *equations, $real phi[])
{
    $real sum = 0.0$f;
    for (size_t k = 0U; k < equations->order; k += 1U) {
        phi[k] /= equations->row_scales[k];
        sum += phi[k] * phi[k];
    }
    return sum;
}

/* Scales a Jacobian J, and computes J^T J and J^T Phi. */
LINKWRIGHT_FUNCTION static void assemble_normal$f(const linkwright$f_equations *equations, $real jacobian[],
    const $real phi[], $real normal[], $real gradient[])
{
    const size_t n = equations->order;
    for (size_t row = 0U; row < n; row += 1U) {
        for (size_t column = 0U; column < n; column += 1U) {
            jacobian[(row * n) + column] *= equations->column_scales[column] / equations->row_scales[row];
        }
    }
    for (size_t column = 0U; column < n; column += 1U) {
        $real sum = 0.0$f;
        for (size_t row = 0U; row < n; row += 1U) {
            sum += jacobian[(row * n) + column] * phi[row];
        }
        gradient[column] = sum;
        for (size_t other = 0U; other < n; other += 1U) {
            $real product = 0.0$f;
            for (size_t row = 0U; row < n; row += 1U) {
                product += jacobian[(row * n) + column] * jacobian[(row * n) + other];
            }
            normal[(other * n) + column] = product;
        }
    }
}

/* Moves an estimate towards a minimum of the residuals by the method of Levenberg and Marquardt (Madsen, Nielsen and
   Tingleff, Methods for Non-Linear Least Squares Problems, 2004, section 3.2). */
LINKWRIGHT_FUNCTION static void approach$f(const linkwright$f_equations *equations, $real q[], $real t)
{
    const size_t n = equations->order;
    $real *const jacobian = equations->reals;
    $real *const normal = &jacobian[n * n];
    $real *const factors = &normal[n * n];
    $real *const phi = &factors[(n * n) + n];
    $real *const gradient = &phi[n];
    $real *const step = &gradient[n];
    $real *const trial = &step[n];
    $real *const after = &trial[n];
    $real *const unit = &after[n];
    $real *const diagonal = &unit[n];
    linkwright$f_factorization factorization;
    equations->residual(equations->context, q, t, phi);
    $real sum = sum_of_squares$f(equations, phi);
    equations->jacobian(equations->context, q, t, jacobian);
    assemble_normal$f(equations, jacobian, phi, normal, gradient);
    $real damping = 0.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        damping = larger$f(damping, normal[(k * n) + k]);
        unit[k] = 1.0$f;
    }
    damping = FIRST_DAMPING$f * damping;
    $real growth = 2.0$f;
    bool goes_on = true;
    for (uint16_t round = 0U; (round < STEPS$F) && goes_on; round++) {
        if (linkwright$f_is_finite(sum) && (sqrt$f(sum) <= GOOD$f)) {
            return;
        }
        for (size_t k = 0U; k < n; k += 1U) {
            diagonal[k] = normal[(k * n) + k];
            normal[(k * n) + k] += damping;
        }
        const Verdict$f verdict = factorized$f(&factorization, normal, equations, unit, unit, 0.0$f, factors);
        for (size_t k = 0U; k < n; k += 1U) {
            normal[(k * n) + k] = diagonal[k];
        }
        if (verdict.status != LINKWRIGHT_OK) {
            return;
        }
        negated$f(step, gradient, n);
        linkwright$f_solve_factorized(&factorization, step);
        /* Gain that the linear system predicts. */
        $real promised = 0.0$f;
        for (size_t k = 0U; k < n; k += 1U) {
            promised += step[k] * ((damping * step[k]) - gradient[k]);
            trial[k] = q[k] + (step[k] * equations->column_scales[k]);
        }
        equations->residual(equations->context, trial, t, after);
        const $real sum_after = sum_of_squares$f(equations, after);
        const $real gain = (sum - sum_after) / promised;
        if (gain > 0.0$f) {
            (void)memcpy(q, trial, n * sizeof($real));
            (void)memcpy(phi, after, n * sizeof($real));
            sum = sum_after;
            equations->jacobian(equations->context, q, t, jacobian);
            assemble_normal$f(equations, jacobian, phi, normal, gradient);
            const $real bend = (gain + gain) - 1.0$f;
            damping *= larger$f(1.0$f - ((bend * bend) * bend), LARGEST_EASING$f);
            growth = 2.0$f;
        } else {
            damping *= growth;
            growth += growth;
        }
        goes_on = linkwright$f_is_finite(damping);
    }
}

/* Solves for a frame from a start, with a required branch at its end if any. */
LINKWRIGHT_FUNCTION static linkwright_status finished$f(const linkwright$f_equations *equations, const $real start[],
    linkwright_branch branch, linkwright$f_tears *found, const linkwright$f_conditions *conditions)
{
    Watch$f watch = {branch, false, false, 0.0$f, NULL};
    (void)memcpy(found->q, start, equations->order * sizeof($real));
    return completed$f(equations, found, &watch, conditions);
}

/* Assembles from an estimate that may be poor: least squares first, then plain and damped Newton-Raphson from the
   given estimate. */
LINKWRIGHT_FUNCTION static linkwright_status assembled_from_afar$f(const linkwright$f_equations *equations,
    const $real estimate[], linkwright_branch branch, linkwright$f_tears *found,
    const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    linkwright$f_failure *const failure = conditions->failure;
    /* Nothing else uses the end of the workspace. */
    $real *const start = &equations->reals[(LINKWRIGHT_NEWTON_REALS(n)) - n];
    (void)memcpy(start, estimate, n * sizeof($real));
    approach$f(equations, start, conditions->t);
    linkwright_status status = finished$f(equations, start, branch, found, conditions);
    if (status == LINKWRIGHT_OK) {
        return status;
    }
    const linkwright$f_failure first = *failure;
    status = finished$f(equations, estimate, branch, found, conditions);
    if (status == LINKWRIGHT_OK) {
        return status;
    }
    const linkwright$f_failure second = *failure;
    (void)memcpy(start, estimate, n * sizeof($real));
    status = solved_damped$f(equations, start, conditions);
    if (status == LINKWRIGHT_OK) {
        status = finished$f(equations, start, branch, found, conditions);
    }
    if (status == LINKWRIGHT_OK) {
        return status;
    }
    /* A pose of the other branch says more than an iteration that found none. */
    if (first.status == LINKWRIGHT_WRONG_BRANCH) {
        *failure = first;
    } else if (second.status == LINKWRIGHT_WRONG_BRANCH) {
        *failure = second;
    } else if (status != LINKWRIGHT_WRONG_BRANCH) {
        *failure = first;
    } else {
        /* The failure is noted already. */
    }
    return failure->status;
}

/* True if the equations hold at a pose. */
LINKWRIGHT_FUNCTION static bool holds$f(const linkwright$f_equations *equations, const $real q[], $real phi[],
    const linkwright$f_conditions *conditions)
{
    equations->residual(equations->context, q, conditions->t, phi);
    return residual_of$f(equations, phi).magnitude <= conditions->settings->tolerance;
}

/* Removes whole turns from angles that a search from far away has wound up, if the equations hold without them: from
   all together, otherwise one by one. A rack counts the turns of its wheel. */
LINKWRIGHT_FUNCTION static void unwind$f(const linkwright$f_equations *equations, $real q[], const $real near[],
    const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    /* The workspace is free after the search. */
    $real *const unwound = equations->reals;
    $real *const phi = &equations->reals[n];
    bool is_wound = false;
    for (size_t k = 0U; k < n; k += 1U) {
        const $real turns = equations->angles[k] ? round$f((q[k] - near[k]) / TURN$f) : 0.0$f;
        unwound[k] = q[k] - (TURN$f * turns);
        is_wound = is_wound || (unwound[k] != q[k]);
    }
    if (!is_wound) {
        /* The angles stay as computed. */
    } else if (holds$f(equations, unwound, phi, conditions)) {
        (void)memcpy(q, unwound, n * sizeof($real));
    } else {
        for (size_t k = 0U; k < n; k += 1U) {
            const $real angle = q[k];
            q[k] = unwound[k];
            if ((angle != unwound[k]) && !holds$f(equations, q, phi, conditions)) {
                q[k] = angle;
            }
        }
    }
}

/* Assembles a block near an estimate, with angles near those of the estimate if the equations do not count their
   turns. */
LINKWRIGHT_FUNCTION static linkwright_status assembled_block$f(const linkwright$f_equations *equations,
    const linkwright$f_tears *estimate, linkwright_branch *branch, linkwright$f_tears *found,
    linkwright$f_measure *measure, const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    linkwright$f_factorization factorization;
    linkwright_status status = assembled_from_afar$f(equations, estimate->q, *branch, found, conditions);
    if (status != LINKWRIGHT_OK) {
        return status;
    }
    unwind$f(equations, found->q, estimate->q, conditions);
    if ((*branch == LINKWRIGHT_NEAREST) || (measure != NULL)) {
        status = linkwright$f_factorize(equations, found->q, &factorization, conditions);
    }
    if ((status == LINKWRIGHT_OK) && (*branch == LINKWRIGHT_NEAREST)) {
        *branch = branch_of$f(&factorization);
    }
    if ((status == LINKWRIGHT_OK) && (measure != NULL)) {
        *measure = measured$f(&factorization, equations->reals, &equations->reals[2U * ((n * n) + n)]);
    }
    return status;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_solve_block(const linkwright$f_equations *equations,
    const linkwright$f_tears *last, linkwright_branch *branch, linkwright$f_tears *found, linkwright$f_measure *measure,
    const linkwright$f_conditions *conditions)
{
    linkwright_status status;
    if ((conditions->start == LINKWRIGHT_LAST_FRAME) && (*branch != LINKWRIGHT_NEAREST)) {
        Watch$f watch = {*branch, true, false, 0.0$f, measure};
        const $real h = conditions->t - last->t;
        for (size_t k = 0U; k < equations->order; k += 1U) {
            found->q[k] = last->q[k] + (h * (last->qd[k] + ((0.5$f * h) * last->qdd[k])));
        }
        status = completed$f(equations, found, &watch, conditions);
    } else {
        status = assembled_block$f(equations, last, branch, found, measure, conditions);
    }
    return status;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_factorize(const linkwright$f_equations *equations, const $real q[],
    linkwright$f_factorization *factorization, const linkwright$f_conditions *conditions)
{
    const size_t n = equations->order;
    const Convergence$f convergence = {0U, {0.0$f, 0U}};
    equations->jacobian(equations->context, q, conditions->t, equations->reals);
    const Verdict$f verdict = factorized$f(factorization, equations->reals, equations, equations->row_scales,
        equations->column_scales, conditions->settings->pivot_ratio, &equations->reals[n * n]);
    return (verdict.status == LINKWRIGHT_OK) ? LINKWRIGHT_OK : gave_up$f(equations, verdict, convergence, conditions);
}
