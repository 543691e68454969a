
/* A pose near which two assembly modes of a block meet: the frame beyond it on the smooth path, in the other mode.
   Nearby the square of the distance between the modes is a smooth function of time; where it vanishes to rounding
   they meet. */

/* How far the square of the distance is fallen where the meeting is looked at. */
static const $real NEAR_MEETING$f = 1.0$f / 1073741824.0$f;

/* The multiple of the rounding to which it must fall there. */
static const $real MEETING_ROUNDING$f = 1024.0$f;

/* Largest miss of what lies opposite by the pose beyond: towards the other mode, as a part of the distance of the modes,
   and in any direction, as a part of the square of all that moves. */
static const $real MISS_TOWARDS$f = 1.0$f / 8.0$f;
static const $real MISS_IN_ALL$f = 1.0$f / 64.0$f;

/* How many steps before and beyond the meeting the poses are compared, and at least. */
static const $real COMPARED$f = 256.0$f;
static const $real LEAST_COMPARED$f = 8.0$f;

/* The least distance of the first times about the meeting, as a part of the way so far. */
static const $real FIRST_STEP$f = 1.0$f / 16.0$f;

/* By how much the times are brought closer together at once, and how many times their distance the middle may move.
   */
static const $real CLOSER$f = 4.0$f;
static const $real LARGEST_SHIFT$f = 4.0$f;

/* How often the times about the meeting are brought closer together, and how often a way is doubled to see the modes
   well apart. */
#define REFINEMENTS$F 32U
#define DOUBLINGS$F 8U

/* When the modes meet, and how long before and after it they can be told apart (s), signed as time goes. */
typedef struct Meeting$f {
    $real time;
    $real apart;
} Meeting$f;

/* The frame at a time in these modes, from one nearby; no path leads there. */
static bool is_frame_at$f(Way$f *way, $real t, const void *near_frame, const void *branches, void *found)
{
    const linkwright$f_mechanism *const mechanism = way->mechanism;
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    linkwright$f_failure failure = way->failure;
    const linkwright$f_conditions conditions = {t, LINKWRIGHT_ESTIMATE, mechanism->parameters, way->inputs,
        &mechanism->state->settings, &failure};
    inputs_at$f(way, t, way->inputs);
    (void)memcpy(found, near_frame, blocks->frame_size);
    (void)memcpy(way->solved_branches, branches, blocks->branches_size);
    return solve_all$f(mechanism, found, near_frame, way->solved_branches, &conditions) == LINKWRIGHT_OK;
}

/* The square of the distance between the poses in both modes. */
static bool distance_of_modes$f(Way$f *way, $real t, const void *near_frame, $real *square)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    void *const first = way->frames[0];
    void *const second = way->frames[1];
    const bool is_found = is_frame_at$f(way, t, near_frame, way->branches, first) && is_frame_at$f(way, t, near_frame,
        way->others, second);
    *square = 0.0$f;
    for (uint16_t k = 0U; is_found && (k < blocks->values); k++) {
        const $real part = blocks->value(first, k) - blocks->value(second, k);
        *square += part * part;
    }
    return is_found;
}

/* The square of how far the modes are apart where they are well apart. */
static bool largest_distance$f(Way$f *way, $real *largest)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    bool is_found = distance_of_modes$f(way, blocks->time(way->origin), way->origin, largest);
    $real length = way->end - way->from;
    for (uint16_t k = 0U; k < DOUBLINGS$F; k++) {
        for (uint16_t side = 0U; side < 2U; side++) {
            const $real t = (side == 0U) ? (way->from - length) : (way->end + length);
            $real square;
            if (distance_of_modes$f(way, t, way->reached, &square)) {
                *largest = is_found ? larger$f(*largest, square) : square;
                is_found = true;
            }
        }
        length += length;
    }
    return is_found;
}

/* Where the modes meet, between what was reached and the end of the way, if they do. */
static bool meet$f(Way$f *way, $real whole, $real refused, Meeting$f *meeting)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const $real from = blocks->time(way->origin);
    const $real near_time = blocks->time(way->reached);
    const $real to = way->end;
    $real middle = near_time;
    $real step = larger$f(fabs$f(refused - near_time), FIRST_STEP$f * fabs$f(near_time - from));
    if (!(step > 0.0$f)) {
        return false;
    }
    for (uint16_t round = 0U; round < REFINEMENTS$F; round++) {
        $real before;
        $real at;
        $real after;
        const bool has_before = distance_of_modes$f(way, middle - step, way->reached, &before);
        bool has_at = distance_of_modes$f(way, middle, way->reached, &at);
        const bool has_after = distance_of_modes$f(way, middle + step, way->reached, &after);
        if (!has_before || !has_after) {
            step /= CLOSER$f;
            continue;
        }
        if (!has_at) {
            /* Where the modes meet, rounding may leave links apart, and where there is a gap, they are: the parabola
               through four other times says which. */
            $real before_that;
            $real after_that;
            const bool has_before_that = distance_of_modes$f(way, (middle - step) - step, way->reached, &before_that);
            const bool has_after_that = distance_of_modes$f(way, (middle + step) + step, way->reached, &after_that);
            if (!has_before_that || !has_after_that) {
                step /= CLOSER$f;
                continue;
            }
            at = ((4.0$f * (before + after)) - (before_that + after_that)) / 6.0$f;
            has_at = true;
        }
        const $real curvature = ((before - at) - at) + after;
        if (!(curvature > 0.0$f)) {
            return false;
        }
        const $real slope = (after - before) * 0.5$f;
        $real shift = slope / curvature;
        const $real lowest = at - ((slope * shift) * 0.5$f);
        if ((curvature <= (NEAR_MEETING$f * whole)) && (fabs$f(shift) <= 1.0$f)) {
            meeting->time = middle - (shift * step);
            meeting->apart = (to < near_time) ? -step : step;
            const bool is_between = ((meeting->time - near_time) * (to - meeting->time)) >= 0.0$f;
            /* Below zero there is a gap between two dead points. */
            const bool meets = fabs$f(lowest) <= ((MEETING_ROUNDING$f * $FLT_EPSILON) * whole);
            return is_between && meets;
        }
        /* The parabola is followed as far as it can be trusted. */
        if (!(fabs$f(shift) <= LARGEST_SHIFT$f)) {
            shift = (LARGEST_SHIFT$f * shift) / fabs$f(shift);
        }
        middle -= shift * step;
        if (fabs$f(shift) <= 1.0$f) {
            step /= CLOSER$f;
        }
    }
    return false;
}

/* Finds the frame beyond a meeting that lies opposite to the one as long before it, but not later than the end of
   the way, in frames[1], and the one before in frames[0]. */
static bool opposite$f(Way$f *way, const Meeting$f *meeting)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const $real time = meeting->time;
    const $real apart = meeting->apart;
    const $real limits[2] = {fabs$f(way->end - time), fabs$f(time - blocks->time(way->origin))};
    $real length = COMPARED$f * apart;
    for (size_t k = 0U; k < 2U; k += 1U) {
        if (limits[k] < fabs$f(length)) {
            length = length * (limits[k] / fabs$f(length));
        }
    }
    if (!(fabs$f(length) >= (LEAST_COMPARED$f * fabs$f(apart)))) {
        return false;
    }
    void *const before = way->frames[0];
    void *const beyond = way->frames[1];
    void *const unchanged = way->frames[2];
    void *const *const center = &way->frames[3];
    const bool are_found = is_frame_at$f(way, time - length, way->origin, way->branches, before)
        && is_frame_at$f(way, time + length, before, way->others, beyond)
        && is_frame_at$f(way, time + length, before, way->branches, unchanged)
        && is_frame_at$f(way, time - apart, before, way->branches, center[0])
        && is_frame_at$f(way, time - apart, before, way->others, center[1])
        && is_frame_at$f(way, time + apart, before, way->branches, center[2])
        && is_frame_at$f(way, time + apart, before, way->others, center[3]);
    if (!are_found) {
        return false;
    }
    $real crossed = 0.0$f;
    $real stayed = 0.0$f;
    $real between = 0.0$f;
    $real moved = 0.0$f;
    for (uint16_t k = 0U; k < blocks->values; k++) {
        $real middle = 0.0$f;
        for (size_t place = 0U; place < 4U; place += 1U) {
            middle += 0.5$f * blocks->value(center[place], k);
        }
        const $real start = blocks->value(before, k);
        const $real missed = (blocks->value(beyond, k) + start) - middle;
        const $real missed_else = (blocks->value(unchanged, k) + start) - middle;
        const $real difference = blocks->value(unchanged, k) - blocks->value(beyond, k);
        const $real way_beyond = blocks->value(beyond, k) - start;
        crossed += missed * missed;
        stayed += missed_else * missed_else;
        between += difference * difference;
        moved += way_beyond * way_beyond;
    }
    /* What the path bends by in other units must not hide in which mode it goes on: twice the product of the miss and the
       way between the modes is what these squares differ by. */
    const $real product = ((stayed - crossed) - between) * 0.5$f;
    return (fabs$f(product) <= (MISS_TOWARDS$f * between)) && (crossed <= (MISS_IN_ALL$f * (stayed + moved)));
}

/* Goes through the pose at which the modes of a block meet, if it is where the way has broken. */
static bool is_crossed$f(Way$f *way)
{
    const linkwright$f_mechanism *const mechanism = way->mechanism;
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const linkwright_status status = way->failure.status;
    /* Where modes meet, links may be apart by rounding. */
    const bool may_meet = (status == LINKWRIGHT_STEP_TOO_LARGE) || (status == LINKWRIGHT_SINGULAR)
        || (status == LINKWRIGHT_WRONG_BRANCH)
        || (status == LINKWRIGHT_OUT_OF_REACH);
    $real whole;
    Meeting$f meeting;
    if (!may_meet || !blocks->is_guarded || (way->start == LINKWRIGHT_ESTIMATE)
        || !blocks->exchanged(way->branches, way->failure.block, way->others)) {
        return false;
    }
    if (!largest_distance$f(way, &whole) || !meet$f(way, whole, way->failure.time, &meeting) || !opposite$f(way,
        &meeting)) {
        return false;
    }
    const $real before = blocks->time(way->frames[0]);
    const $real beyond = blocks->time(way->frames[1]);
    /* The way has come nearer than the modes can be told apart: the frame before the meeting must lie on the path. */
    (void)memcpy(way->reached, way->origin, blocks->frame_size);
    mechanism->state->has_window = false;
    (void)memcpy(way->kept_branches, way->others, blocks->branches_size);
    if (steps_to$f(way, before) != LINKWRIGHT_OK) {
        return false;
    }
    /* From where the way has led, angles go on without a jump; what was found from farther away may be off by whole
       turns. */
    if (!is_frame_at$f(way, beyond, way->reached, way->kept_branches, way->frames[0])) {
        return false;
    }
    (void)memcpy(way->reached, way->frames[0], blocks->frame_size);
    (void)memcpy(way->origin, way->frames[0], blocks->frame_size);
    (void)memcpy(way->branches, way->kept_branches, blocks->branches_size);
    mechanism->state->has_window = false;
    return true;
}
