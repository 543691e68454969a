
/* Continues a path through change points near its ends, or where it has broken. Only nearly singular frames are
   interpolated instead of solved. */

/* Least distance of the first times about a change point, relative to the path so far. */
static const $real FIRST_STEP$f = 1.0$f / 16.0$f;

/* Square of the distance of modes, relative to that elsewhere, below which the mode of the motion is undecided. */
static const $real UNDECIDED$f = 1.0$f / 1048576.0$f;

/* Result at a change point: it is passed, there is none, or no path through it can be verified. */
typedef enum Passage$f {
    PASSED$F = 0,
    NO_MEETING$F = 1,
    NO_PATH$F = 2
} Passage$f;

/* Solves the frame at the end of the path or beyond a change point, in frames[1]. */
LINKWRIGHT_FUNCTION static bool is_passed$f(Way$f *way, const Meeting$f *meeting, Sides$f sides, $real beyond,
    bool lands, const void *modes)
{
    if (lands && way->mechanism->blocks->holds_coordinates) {
        way->law = LAST_LAW$F;
        return is_interpolated$f(way, way->reached, meeting, sides, way->end);
    }
    way->law = LAW_OF_WAY$F;
    return is_frame_at$f(way, lands ? way->end : beyond, way->reached, modes, way->frames[1]);
}

/* Passes a change point near a time, or advances to the end if that is near it. The search begins at times of the
   distance step (s) before it; a change point at an end may lie on both sides of it. Signals then continue from
   there. */
LINKWRIGHT_FUNCTION static Passage$f pass$f(Way$f *way, $real place, uint16_t block, $real step, Law$f law)
{
    const linkwright$f_mechanism *const mechanism = way->mechanism;
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const bool is_end = law != LAW_OF_WAY$F;
    const void *const near_frame = is_end ? way->origin : way->reached;
    const $real origin = blocks->time(way->origin);
    Meeting$f meeting;
    $real whole = 0.0$f;
    way->direction = (way->end < way->from) ? -1.0$f : 1.0$f;
    way->law = law;
    if (!largest_distance$f(way, block, near_frame, place, &whole) || !meet$f(way, block, near_frame, place,
        fabs$f(step), whole, &meeting)) {
        return NO_MEETING$F;
    }
    narrow$f(way, near_frame, &meeting);
    const $real from_place = way->direction * (meeting.time - place);
    const $real until_end = is_end ? from_place : (way->direction * (meeting.time - way->end));
    const $real before = meeting.time - (way->direction * meeting.width);
    const $real beyond = meeting.time + (way->direction * meeting.width);
    const bool is_here = (-from_place <= meeting.width) && (until_end <= meeting.width);
    if (!is_here || ((way->direction * (beyond - origin)) < 0.0$f)) {
        return NO_MEETING$F;
    }
    const bool is_outside = (way->direction * (before - origin)) > 0.0$f;
    bool is_before = true;
    void *const found = way->found_branches;
    /* A frame beside the change point may lie before it or beyond it, as its rates tell. */
    const bool are_found = is_outside ? are_sides$f(way, block, near_frame, &meeting, true, found)
                                      : are_sides_through$f(way, block, way->origin, &meeting, &is_before, found);
    if (!are_found) {
        return NO_PATH$F;
    }
    /* The path may have come nearer than the modes can be told apart: the last frame before the change point must
       lie on it. */
    (void)memcpy(way->reached, way->origin, blocks->frame_size);
    mechanism->state->has_window = false;
    if (is_outside && (steps_to$f(way, before) != LINKWRIGHT_OK)) {
        return NO_PATH$F;
    }
    /* Angles continue without a jump from the last frame; a solution from farther away may be off by whole turns. */
    const Sides$f sides = sides_of$f(way->branches, found, is_before);
    const bool lands = (way->direction * (way->end - beyond)) < 0.0$f;
    const bool stays_before = lands && ((way->direction * (way->end - meeting.time)) < 0.0$f);
    const void *const modes = stays_before ? sides.before : sides.beyond;
    if (!is_passed$f(way, &meeting, sides, beyond, lands, modes)) {
        return NO_PATH$F;
    }
    if (modes != way->branches) {
        (void)memcpy(way->branches, modes, blocks->branches_size);
    }
    (void)memcpy(way->reached, way->frames[1], blocks->frame_size);
    (void)memcpy(way->origin, way->frames[1], blocks->frame_size);
    mechanism->state->has_window = false;
    return PASSED$F;
}

/* Finds the first block that closed forms show to be nearly singular in a frame. */
LINKWRIGHT_FUNCTION static bool is_weak_frame$f(Way$f *way, const void *frame, $real t, uint16_t *block)
{
    const linkwright$f_mechanism *const mechanism = way->mechanism;
    const linkwright$f_conditions conditions = {t, LINKWRIGHT_LAST_FRAME, mechanism->parameters, way->inputs,
        &mechanism->state->settings, &way->tried};
    const linkwright$f_pair pair = {frame, frame, way->inputs, &conditions};
    inputs_at$f(way, t, LAW_OF_WAY$F, way->inputs);
    return is_weak$f(mechanism, &pair, WEAK$f, block);
}

/* Finds the block with the nearest modes at the time t (s), and the square of their distance. */
LINKWRIGHT_FUNCTION static bool nearest_modes$f(Way$f *way, $real t, uint16_t *nearest, $real *least)
{
    bool is_found = false;
    for (uint16_t block = 0U; block < MEETING_BLOCKS$F; block++) {
        $real square;
        if (distance_of_modes$f(way, block, t, way->reached, &square) && (!is_found || (square < *least))) {
            *nearest = block;
            *least = square;
            is_found = true;
        }
    }
    return is_found;
}

/* Finds a block that cannot be solved at the time t (s), or whose modes are far nearer to each other than elsewhere
   on the path. */
LINKWRIGHT_FUNCTION static bool has_near_modes$f(Way$f *way, $real t, uint16_t *block)
{
    const $real elsewhere = way->from + (SHORTER$f * (way->end - way->from));
    $real square = 0.0$f;
    $real whole = 0.0$f;
    way->law = LAW_OF_WAY$F;
    if (!is_frame_at$f(way, t, way->reached, way->branches, way->frames[0])) {
        *block = way->tried.block;
        return true;
    }
    return nearest_modes$f(way, t, block, &square)
        && distance_of_modes$f(way, *block, elsewhere, way->reached, &whole)
        && (square <= (sqrt$f(sqrt$f($FLT_EPSILON)) * whole));
}

/* Passes change points so near to the start or the end of the path that equations are nearly singular there. */
LINKWRIGHT_FUNCTION static void pass_ends$f(Way$f *way)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const $real step = SHORTER$f * (way->end - way->from);
    uint16_t block = 0U;
    Passage$f passage = PASSED$F;
    const bool is_closed = blocks->verify_nonsingular != NULL;
    /* The other mode of Newton-Raphson takes too long to be sought in each step that is divided. */
    if ((blocks->is_within != NULL) || !blocks->holds_coordinates || (way->start == LINKWRIGHT_ESTIMATE)
        || (way->from == way->end)) {
        return;
    }
    if (is_closed ? is_weak_frame$f(way, way->reached, way->from, &block) : has_near_modes$f(way, way->from, &block)) {
        passage = pass$f(way, way->from, block, step, FIRST_LAW$F);
    }
    if (blocks->time(way->reached) == way->end) {
        return;
    }
    way->law = LAW_OF_WAY$F;
    bool is_near = true;
    if (is_frame_at$f(way, way->end, way->reached, way->branches, way->frames[0])) {
        is_near = is_closed ? is_weak_frame$f(way, way->frames[0], way->end, &block)
                            : has_near_modes$f(way, way->end, &block);
    } else {
        block = way->tried.block;
    }
    if (is_near) {
        passage = pass$f(way, way->end, block, step, LAST_LAW$F);
    }
    way->may_be_weak = passage == NO_MEETING$F;
}

/* Passes the change point of a block at which the path has broken, if there is one. */
LINKWRIGHT_FUNCTION static LINKWRIGHT_APART bool is_crossed$f(Way$f *way)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const linkwright_status status = way->failure.status;
    /* At a change point, links may be apart by rounding. */
    const bool may_meet = (status == LINKWRIGHT_STEP_TOO_LARGE) || (status == LINKWRIGHT_SINGULAR)
        || (status == LINKWRIGHT_WRONG_BRANCH) || (status == LINKWRIGHT_OUT_OF_REACH);
    if (!may_meet || (way->start == LINKWRIGHT_ESTIMATE)) {
        return false;
    }
    const $real near_time = blocks->time(way->reached);
    const $real first = FIRST_STEP$f * fabs$f(near_time - blocks->time(way->origin));
    const $real step = larger$f(fabs$f(way->failure.time - near_time), first);
    uint16_t block = way->failure.block;
    $real square = 0.0$f;
    /* A later block may refuse the step that an earlier one, whose modes meet, leads astray. */
    if (blocks->is_within == NULL) {
        way->law = LAW_OF_WAY$F;
        (void)nearest_modes$f(way, near_time, &block, &square);
    }
    return pass$f(way, near_time, block, step, LAW_OF_WAY$F) == PASSED$F;
}

/* True if modes of a block are far nearer to each other at the break than elsewhere, though the motion continues. */
LINKWRIGHT_FUNCTION static bool is_undecided$f(Way$f *way)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const linkwright_status status = way->failure.status;
    const bool is_doubtful = (status == LINKWRIGHT_STEP_TOO_LARGE) || (status == LINKWRIGHT_SINGULAR)
        || (status == LINKWRIGHT_WRONG_BRANCH);
    const $real near_time = blocks->time(way->reached);
    const $real length = near_time - blocks->time(way->origin);
    /* A motion that turns back at a dead point has been followed to it, as far as rounding permits. */
    const $real beyond = way->failure.time + (sqrt$f(sqrt$f($FLT_EPSILON)) * length);
    uint16_t block = 0U;
    $real square = 0.0$f;
    $real whole = 0.0$f;
    way->law = LAW_OF_WAY$F;
    return is_doubtful && (blocks->is_within == NULL) && (way->start != LINKWRIGHT_ESTIMATE)
        && is_frame_at$f(way, beyond, way->reached, way->branches, way->frames[0])
        && nearest_modes$f(way, near_time, &block, &square)
        && largest_distance$f(way, block, way->reached, near_time, &whole) && (square <= (UNDECIDED$f * whole));
}

LINKWRIGHT_FUNCTION bool linkwright$f_pass(void *path, linkwright_passage part)
{
    Way$f *const way = (Way$f *)path;
    bool is_so = true;
    if (part == LINKWRIGHT_PASSAGE_OF_ENDS) {
        pass_ends$f(way);
    } else if (part == LINKWRIGHT_PASSAGE_OF_BREAK) {
        is_so = is_crossed$f(way);
    } else {
        is_so = is_undecided$f(way);
    }
    return is_so;
}
