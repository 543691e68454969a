
/* Solves for the forces of Coulomb friction in joints. */

/* Largest number of steps. */
#define FRICTION_STEPS$F 32U

/* Largest change in the last step of forces that have settled, relative to the largest force. */
static const $real FRICTION_SETTLED$f = 1e-10$f;

/* Largest change in the last step of settled forces, in roundings, if that is larger. */
static const $real FRICTION_SETTLED_ROUNDINGS$f = 32.0$f;

/* Change of forces after which no further step is taken, in roundings. */
static const $real FRICTION_ROUNDINGS$f = 4.0$f;

/* Factor by which a change must shrink for another step after the forces have settled. */
static const $real FRICTION_SHRINKS$f = 0.5$f;

/* Sign of a force on a slide. */
LINKWRIGHT_FUNCTION static $real sign_of_force$f($real force)
{
    return (force > 0.0$f) ? 1.0$f : ((force < 0.0$f) ? -1.0$f : 0.0$f);
}

/* Largest magnitude of n numbers. */
LINKWRIGHT_FUNCTION static $real largest_force$f(const $real values[], size_t n)
{
    $real largest = 0.0$f;
    for (size_t k = 0U; k < n; k += 1U) {
        largest = larger$f(largest, fabs$f(values[k]));
    }
    return largest;
}

/* Linearizes the force in one joint: the next force, and its row of the equations of the changes. */
LINKWRIGHT_FUNCTION static $real linearized_friction$f(const linkwright$f_friction_joints *joints, size_t joint,
    const $real forces[], $real matrix[])
{
    const size_t n = joints->count;
    const $real coefficient = joints->coefficients[joint];
    const $real *const units = &joints->units[2U * joint * n];
    $real first = joints->alone[2U * joint];
    $real second = joints->alone[(2U * joint) + 1U];
    $real magnitude;
    $real slopes[2] = {0.0$f, 0.0$f};
    for (size_t unit = 0U; unit < n; unit += 1U) {
        first += units[2U * unit] * forces[unit];
        second += units[(2U * unit) + 1U] * forces[unit];
    }
    if (joint < joints->pins) {
        magnitude = sqrt$f((first * first) + (second * second));
        if (magnitude > 0.0$f) {
            slopes[0] = first / magnitude;
            slopes[1] = second / magnitude;
        }
    } else {
        magnitude = fabs$f(first) + fabs$f(second);
        slopes[0] = sign_of_force$f(first);
        slopes[1] = sign_of_force$f(second);
    }
    for (size_t unit = 0U; unit < n; unit += 1U) {
        const $real slope =
            coefficient * ((slopes[0] * units[2U * unit]) + (slopes[1] * units[(2U * unit) + 1U]));
        /* The linear solve takes the transposed matrix. */
        matrix[(unit * n) + joint] = ((unit == joint) ? 1.0$f : 0.0$f) - slope;
    }
    return coefficient * magnitude;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_friction(const linkwright$f_friction_joints *joints, $real found[],
    $real reals[], uint16_t exchanges[], const linkwright$f_conditions *conditions, uint16_t block)
{
    const size_t n = joints->count;
    const $real settled = larger$f(FRICTION_SETTLED$f, FRICTION_SETTLED_ROUNDINGS$f * $FLT_EPSILON);
    $real *const matrix = reals;
    $real *const forces = &matrix[n * n];
    $real *const change = &forces[n];
    $real *const workspace = &change[n];
    $real last = $FLT_MAX;
    $real relative = last;
    for (size_t k = 0U; k < n; k += 1U) {
        forces[k] = 0.0$f;
    }
    for (size_t step = 0U; step < FRICTION_STEPS$F; step += 1U) {
        for (size_t joint = 0U; joint < n; joint += 1U) {
            found[joint] = linearized_friction$f(joints, joint, forces, matrix);
            change[joint] = found[joint] - forces[joint];
        }
        if (!(linkwright$f_all_finite(found, n) && linkwright$f_all_finite(change, n))) {
            return linkwright$f_not_finite(conditions, block);
        }
        const $real size = largest_force$f(found, n);
        const $real largest_change = largest_force$f(change, n);
        if (largest_change <= (FRICTION_ROUNDINGS$f * $FLT_EPSILON * size)) {
            return LINKWRIGHT_OK;
        }
        relative = largest_change / larger$f(size, $FLT_MIN);
        if ((relative <= settled) && (largest_change > (FRICTION_SHRINKS$f * last))) {
            return LINKWRIGHT_OK;
        }
        last = largest_change;
        const linkwright_status solved =
            linkwright$f_multipliers(joints->count, matrix, change, workspace, exchanges, conditions, block);
        for (size_t k = 0U; k < n; k += 1U) {
            forces[k] = (solved == LINKWRIGHT_OK) ? (forces[k] + change[k]) : found[k];
        }
    }
    if (relative <= settled) {
        return LINKWRIGHT_OK;
    }
    return noted$f(conditions->failure, LINKWRIGHT_FRICTION_UNSETTLED, relative, 0U, conditions->t, block);
}
