
/* Change points of a block, with the modes on both sides on the smooth path. Before the change point the square of
   the distance between the modes is a smooth function of time; if it vanishes to rounding, the modes meet. */

/* Factor of the squared distance at which a change point is located, and multiple of the rounding above which it is
   known there. */
static const $real NEAR_MEETING$f = 1.0$f / 4294967296.0$f;
static const $real KNOWN_DISTANCE$f = 16384.0$f;

/* Part of that below which only rounding is left. */
static const $real TOO_NEAR_MEETING$f = 1.0$f / 64.0$f;

/* Multiple of the rounding to which the square of the distance must fall at the change point. */
static const $real MEETING_ROUNDING$f = 1024.0$f;

/* Part of the largest square above which it is not a parabola, and its vertex is not used. */
static const $real BENT_DISTANCE$f = 1.0$f / 256.0$f;

/* Factor by which the times before the change point move closer to it or farther away. */
static const $real CLOSER$f = 4.0$f;

/* Distance of the vertex from the middle, in distances of the times: up to the first, these may come closer; up to
   the second, the vertex is examined; up to the third, the search moves to it at once. */
static const $real REACHED_VERTEX$f = 1.5$f;
static const $real AT_VERTEX$f = 1.0$f / 16.0$f;
static const $real LARGEST_SHIFT$f = 4.0$f;

/* Number of attempts to locate the change point, and of distances at which the modes are compared far from it. */
#define REFINEMENTS$F 32U
#define WAYS$F 12U

/* First of these distances relative to the path, which is not a rational part of a turn. */
static const $real SHORTER$f = 0.3819660112501051$f;

/* Change point: its time, the time from it to the nearest frames that determine the path (s), and the square of the
   distance of the modes there. */
typedef struct Meeting$f {
    $real time;
    $real width;
    $real edge;
} Meeting$f;

/* Solves the frame at a time in these modes, from one nearby; no path leads there. */
LINKWRIGHT_FUNCTION static bool is_frame_at$f(Way$f *way, $real t, const void *near_frame, const void *branches,
    void *found)
{
    const linkwright$f_mechanism *const mechanism = way->mechanism;
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const linkwright$f_conditions conditions = {t, LINKWRIGHT_ESTIMATE, mechanism->parameters, way->inputs,
        &mechanism->state->settings, &way->tried};
    inputs_at$f(way, t, way->law, way->inputs);
    if (found != near_frame) {
        (void)memcpy(found, near_frame, blocks->frame_size);
    }
    (void)memcpy(way->solved_branches, branches, blocks->branches_size);
    return solve_all$f(mechanism, found, near_frame, way->solved_branches, &conditions) == LINKWRIGHT_OK;
}

/* Number k of a frame, which consists of numbers only: the time, coordinates, their rates and accelerations, others. */
LINKWRIGHT_FUNCTION static $real number_of$f(const void *frame, size_t k)
{
    $real number;
    (void)memcpy(&number, &((const unsigned char *)frame)[k * sizeof number], sizeof number);
    return number;
}

/* Difference of two frames in the coordinate k, or if they hold none, in the component k of their points. */
LINKWRIGHT_FUNCTION static $real difference$f(const linkwright$f_blocks *blocks, const void *first, const void *second,
    uint16_t k)
{
    return blocks->holds_coordinates ? (number_of$f(first, 1U + (size_t)k) - number_of$f(second, 1U + (size_t)k))
                                     : (blocks->value(first, k) - blocks->value(second, k));
}

/* Sum of the magnitudes of the products of the differences of two pairs of frames, over the values that are equal in
   a third pair. */
LINKWRIGHT_FUNCTION static $real sum_of_products$f(const linkwright$f_blocks *blocks, const void *const pairs[3][2])
{
    $real sum = 0.0$f;
    for (uint16_t k = 0U; k < blocks->values; k++) {
        if (difference$f(blocks, pairs[2][0], pairs[2][1], k) == 0.0$f) {
            sum += fabs$f(difference$f(blocks, pairs[0][0], pairs[0][1], k)
                * difference$f(blocks, pairs[1][0], pairs[1][1], k));
        }
    }
    return sum;
}

/* Square of the distance of two frames. */
LINKWRIGHT_FUNCTION static $real square_of_distance$f(const linkwright$f_blocks *blocks, const void *first,
    const void *second)
{
    const void *const pairs[3][2] = {{first, second}, {first, second}, {first, first}};
    return sum_of_products$f(blocks, pairs);
}

/* Square of the distance between the poses in both modes of a block. */
LINKWRIGHT_FUNCTION static bool distance_of_modes$f(Way$f *way, uint16_t block, $real t, const void *near_frame,
    $real *square)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    void *const first = way->frames[0];
    void *const second = way->frames[1];
    const bool is_found = blocks->exchanged(way->branches, block, way->others)
        && is_frame_at$f(way, t, near_frame, way->branches, first)
        && is_frame_at$f(way, t, near_frame, way->others, second);
    *square = is_found ? square_of_distance$f(blocks, first, second) : 0.0$f;
    return is_found;
}

/* Square of the distance of the modes far from the change point. */
LINKWRIGHT_FUNCTION static bool largest_distance$f(Way$f *way, uint16_t block, const void *near_frame, $real place,
    $real *largest)
{
    bool is_found = false;
    $real length = SHORTER$f * (way->end - way->from);
    for (uint16_t k = 0U; k < WAYS$F; k++) {
        for (uint16_t side = 0U; side < 2U; side++) {
            const $real t = (side == 0U) ? (place - length) : (place + length);
            $real square;
            if (distance_of_modes$f(way, block, t, near_frame, &square)) {
                *largest = is_found ? larger$f(*largest, square) : square;
                is_found = true;
            }
        }
        length *= CLOSER$f;
    }
    return is_found;
}

/* Squared distance of modes at the width of a change point, from that elsewhere: the errors of rounding in frames
   there, and of interpolation between them, are similar. */
LINKWRIGHT_FUNCTION static $real edge_of$f($real whole)
{
    return sqrt$f(sqrt$f($FLT_EPSILON)) * whole;
}

/* Squares of the distances at four times before another one. */
LINKWRIGHT_FUNCTION static bool are_distances$f(Way$f *way, uint16_t block, const void *near_frame, $real middle,
    $real step, $real squares[4])
{
    bool are_found = true;
    $real part = 0.0$f;
    for (size_t k = 0U; k < 4U; k += 1U) {
        part += 1.0$f;
        $real square;
        if (distance_of_modes$f(way, block, middle - ((way->direction * part) * step), near_frame, &square)) {
            squares[k] = square;
        } else {
            are_found = false;
        }
    }
    return are_found;
}

/* Locates the change point of a block near a time, if there is one; the search begins at times of the distance step
   (s) before it. */
LINKWRIGHT_FUNCTION static bool meet$f(Way$f *way, uint16_t block, const void *near_frame, $real place,
    $real first_step, $real whole, Meeting$f *meeting)
{
    const $real known = larger$f(NEAR_MEETING$f, KNOWN_DISTANCE$f * $FLT_EPSILON);
    $real middle = place;
    $real nearest_step = first_step;
    $real step = first_step;
    for (uint16_t round = 0U; (round < REFINEMENTS$F) && (step > 0.0$f) && (whole > 0.0$f); round++) {
        $real squares[4];
        /* Beyond the change point, other blocks may have left the smooth path, so that the distance has a kink
           there. */
        if (!are_distances$f(way, block, near_frame, middle, step, squares)) {
            nearest_step *= SHORTER$f;
            middle = place;
            step = nearest_step;
            continue;
        }
        const $real curvature = ((squares[0] - squares[1]) - squares[1]) + squares[2];
        const $real slope = (squares[0] - squares[2]) * 0.5$f;
        const $real vertex = -2.0$f - (slope / curvature);
        const bool is_lowest = (curvature > 0.0$f) && linkwright$f_is_finite(vertex);
        const bool is_bent = larger$f(curvature, squares[0]) > (BENT_DISTANCE$f * whole);
        const bool is_near = curvature <= (known * whole);
        if (!is_lowest || is_bent) {
            /* A prediction from too far away may have led elsewhere. */
            nearest_step *= SHORTER$f;
            middle = place;
            step = nearest_step;
        } else if (is_near && (curvature < ((TOO_NEAR_MEETING$f * known) * whole))) {
            step *= CLOSER$f;
        } else if (is_near && (fabs$f(vertex) <= AT_VERTEX$f)) {
            /* Polynomial of the third degree, at the middle; below zero there is a gap between two dead points. */
            const $real at_middle = ((4.0$f * (squares[0] + squares[2])) - (6.0$f * squares[1])) - squares[3];
            const $real lowest = at_middle - (((0.5$f * curvature) * vertex) * vertex);
            const $real edge = edge_of$f(whole);
            meeting->time = middle + ((way->direction * vertex) * step);
            meeting->width = step * sqrt$f((2.0$f * edge) / curvature);
            meeting->edge = edge;
            return fabs$f(lowest) <= ((MEETING_ROUNDING$f * $FLT_EPSILON) * whole);
        } else if (fabs$f(vertex) > LARGEST_SHIFT$f) {
            /* From so far away, a larger step determines the middle better. */
            step *= CLOSER$f;
        } else {
            middle += (way->direction * vertex) * step;
            if (!is_near && (fabs$f(vertex) <= REACHED_VERTEX$f)) {
                step /= CLOSER$f;
            }
        }
    }
    return false;
}
