
/* Frames on both sides of a change point, and the smooth path through it. Four frames on each side determine it.
   Their even and odd differences of the highest order vanish for a smooth motion; a kink shows in them. Near the
   change point, where equations are nearly singular, frames are interpolated between these eight. */

/* Number of frames on each side. */
#define NODES$F 4U

/* Differences of the highest order of frames at the distances 1, 2, 3 and 4 on both sides: of their sums, and of their
   differences. */
LINKWRIGHT_FUNCTION static $real even$f(size_t index)
{
    static const $real parts[NODES$F] = {-7.0$f, 14.0$f, -9.0$f, 2.0$f};
    return parts[index];
}

LINKWRIGHT_FUNCTION static $real odd$f(size_t index)
{
    static const $real parts[NODES$F] = {-14.0$f, 14.0$f, -6.0$f, 1.0$f};
    return parts[index];
}

/* Largest difference of the smooth path, relative to the distance of the modes, for passing a change point, and for
   interpolation. */
static const $real SMOOTH$f = 1.0$f / 64.0$f;
static const $real EXACT$f = 1.0$f / 16384.0$f;

/* Multiple of the squared distance of the modes up to which modes of other blocks meet at the same instant. */
static const $real ALIKE$f = 64.0$f;

/* Number of times at which modes of another block are compared, each closer to a change point than the one before.
   The square of their distance falls by the factor there if they meet. */
#define NEARER$F 3U
static const $real FALLEN$f = 0.25$f;

/* Number of the first blocks whose modes may be exchanged. */
#define MEETING_BLOCKS$F 64U

/* Modes before a change point and beyond it. */
typedef struct Sides$f {
    const void *before;
    const void *beyond;
} Sides$f;

/* Weights of a frame: from its side, its distance from the change point and the index of that. */
typedef void Weights$f($real place, $real side, $real distance, size_t index, $real weights[2]);

/* Weights of the highest differences. */
LINKWRIGHT_FUNCTION static void differences$f($real place, $real side, $real distance, size_t index, $real weights[2])
{
    (void)place;
    (void)distance;
    weights[0] = even$f(index);
    weights[1] = side * odd$f(index);
}

/* Weights of interpolation at a time, without the factor of their sum. */
LINKWRIGHT_FUNCTION static void parts$f($real place, $real side, $real distance, size_t index, $real weights[2])
{
    weights[0] = (side * odd$f(index)) / (place - (side * distance));
    weights[1] = 0.0$f;
}

/* Changes the number k of a frame. */
LINKWRIGHT_FUNCTION static void set_number$f(void *frame, size_t k, $real number)
{
    (void)memcpy(&((unsigned char *)frame)[k * sizeof number], &number, sizeof number);
}

/* Adds a multiple of the difference of two frames to a third one, in all numbers except for the time. */
LINKWRIGHT_FUNCTION static void add_difference$f(size_t frame_size, void *sum, $real multiple, const void *frame,
    const void *base)
{
    const size_t count = frame_size / sizeof($real);
    for (size_t k = 1U; k < count; k += 1U) {
        const $real change = multiple * (number_of$f(frame, k) - number_of$f(base, k));
        set_number$f(sum, k, number_of$f(sum, k) + change);
    }
}

/* Computes the nearest frame before a change point, in frames[0], plus two weighted sums of the differences of all
   eight from it, in frames[1] and frames[2]. */
LINKWRIGHT_FUNCTION static bool are_sums$f(Way$f *way, const void *near_frame, const Meeting$f *meeting, Sides$f sides,
    $real place, $real divisor, Weights$f *weigh)
{
    const size_t size = way->mechanism->blocks->frame_size;
    const $real length = way->direction * meeting->width;
    void *const base = way->frames[0];
    void *const last = way->frames[3];
    void *const node = way->frames[4];
    bool are_found = is_frame_at$f(way, meeting->time - length, near_frame, sides.before, base);
    (void)memcpy(way->frames[1], base, size);
    (void)memcpy(way->frames[2], base, size);
    for (size_t k = 0U; (k < 2U) && are_found; k += 1U) {
        const $real side = (k == 0U) ? -1.0$f : 1.0$f;
        $real distance = 0.0$f;
        (void)memcpy(last, base, size);
        for (size_t index = 0U; (index < NODES$F) && are_found; index += 1U) {
            distance += 1.0$f;
            are_found = is_frame_at$f(way, meeting->time + ((side * distance) * length), last,
                (k == 0U) ? sides.before : sides.beyond, node);
            if (are_found) {
                $real weights[2];
                weigh(place, side, distance, index, weights);
                add_difference$f(size, way->frames[1], weights[0] / divisor, node, base);
                add_difference$f(size, way->frames[2], weights[1], node, base);
                (void)memcpy(last, node, size);
            }
        }
    }
    return are_found;
}

/* Highest differences of the path with these modes, in the values that the others do not change. They are relative
   to the distance of the current modes from changed ones, and along it. False if they exceed a limit. */
LINKWRIGHT_FUNCTION static bool is_smooth$f(Way$f *way, const void *near_frame, const Meeting$f *meeting, Sides$f sides,
    const void *own, const void *changed, const void *others, $real limit)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    void *const base = way->frames[0];
    void *const found_own = way->frames[3];
    void *const found_changed = way->frames[4];
    void *const found_others = way->frames[5];
    bool is_found = are_sums$f(way, near_frame, meeting, sides, 0.0$f, 1.0$f, differences$f);
    if (is_found) {
        const $real t = blocks->time(base);
        is_found = is_frame_at$f(way, t, base, own, found_own) && is_frame_at$f(way, t, base, changed, found_changed)
            && is_frame_at$f(way, t, base, others, found_others);
    }
    if (!is_found) {
        return false;
    }
    const void *const even[3][2] = {{way->frames[1], base}, {found_changed, found_own}, {found_others, found_own}};
    const void *const odd[3][2] = {{way->frames[2], base}, {found_changed, found_own}, {found_others, found_own}};
    const void *const apart[3][2] = {{found_changed, found_own}, {found_changed, found_own},
        {found_others, found_own}};
    const $real roughness = larger$f(sum_of_products$f(blocks, even), sum_of_products$f(blocks, odd));
    return (roughness / sum_of_products$f(blocks, apart)) <= limit;
}

/* True if the highest differences of the path with these modes are at most a part of its change before the change
   point, in all coordinates together. */
LINKWRIGHT_FUNCTION static bool is_whole_smooth$f(Way$f *way, const void *near_frame, const Meeting$f *meeting,
    Sides$f sides, $real part)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const $real length = way->direction * meeting->width;
    void *const base = way->frames[0];
    void *const first = way->frames[3];
    const bool is_found = are_sums$f(way, near_frame, meeting, sides, 0.0$f, 1.0$f, differences$f)
        && is_frame_at$f(way, meeting->time - (($real)NODES$F * length), base, sides.before, first);
    if (!is_found) {
        return false;
    }
    const $real even = square_of_distance$f(blocks, way->frames[1], base);
    const $real odd = square_of_distance$f(blocks, way->frames[2], base);
    return larger$f(even, odd) <= ((part * part) * square_of_distance$f(blocks, first, base));
}

/* Computes the width of a change point by the modes of a block; false if they do not meet there. */
LINKWRIGHT_FUNCTION static bool is_width$f(Way$f *way, uint16_t block, const void *near_frame, const Meeting$f *meeting,
    $real *width)
{
    $real last = 0.0$f;
    *width = meeting->width;
    for (uint16_t k = 0U; k <= NEARER$F; k++) {
        const $real t = meeting->time - (way->direction * *width);
        $real square;
        if (!distance_of_modes$f(way, block, t, near_frame, &square)) {
            return false;
        }
        if ((k > 0U) && (square <= (FALLEN$f * last))) {
            $real whole = 0.0$f;
            const bool is_found = largest_distance$f(way, block, near_frame, meeting->time, &whole);
            *width *= sqrt$f(edge_of$f(whole) / square);
            return is_found;
        }
        last = square;
        *width /= CLOSER$f;
    }
    return false;
}

/* Sets the width of a change point to the least of all blocks whose modes meet there: some modes separate faster
   than others. */
LINKWRIGHT_FUNCTION static void narrow$f(Way$f *way, const void *near_frame, Meeting$f *meeting)
{
    $real narrowed = meeting->width;
    for (uint16_t block = 0U; block < MEETING_BLOCKS$F; block++) {
        $real width;
        if (is_width$f(way, block, near_frame, meeting, &width)) {
            narrowed = smaller$f(narrowed, width);
        }
    }
    meeting->width = narrowed;
}

/* Blocks with two modes as near to each other as those of the change point. */
LINKWRIGHT_FUNCTION static void blocks_that_meet$f(Way$f *way, uint16_t own, const void *near_frame,
    const Meeting$f *meeting, bool meets[MEETING_BLOCKS$F])
{
    const $real t = meeting->time - (way->direction * meeting->width);
    for (uint16_t block = 0U; block < MEETING_BLOCKS$F; block++) {
        $real square;
        const bool is_near = distance_of_modes$f(way, block, t, near_frame, &square)
            && (square <= (ALIKE$f * meeting->edge));
        meets[block] = is_near || (block == own);
    }
}

/* Sides with the current modes before the change point, or beyond it. */
LINKWRIGHT_FUNCTION static Sides$f sides_of$f(const void *own, const void *other, bool is_before)
{
    Sides$f sides;
    sides.before = is_before ? own : other;
    sides.beyond = is_before ? other : own;
    return sides;
}

/* Selects the modes on the other side of a change point on the smooth path, which has the current ones before it, or
   beyond it; false if no path is smooth. */
LINKWRIGHT_FUNCTION static bool are_sides$f(Way$f *way, uint16_t own_block, const void *near_frame,
    const Meeting$f *meeting, bool is_before, void *found)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const size_t size = blocks->branches_size;
    const void *const own = way->branches;
    void *const tried = way->tried_branches;
    void *const later = way->later_branches;
    void *const changed = way->others;
    bool meets[MEETING_BLOCKS$F];
    bool is_exchanged = false;
    blocks_that_meet$f(way, own_block, near_frame, meeting, meets);
    (void)memcpy(found, own, size);
    /* Each block is judged by values that no later block changes, because later blocks are not decided yet. */
    for (uint16_t block = 0U; block < MEETING_BLOCKS$F; block++) {
        if (!meets[block]) {
            continue;
        }
        (void)memcpy(later, own, size);
        for (uint16_t other = (uint16_t)(block + 1U); other < MEETING_BLOCKS$F; other++) {
            if (meets[other]) {
                if (!blocks->exchanged(later, other, changed)) {
                    return false;
                }
                (void)memcpy(later, changed, size);
            }
        }
        if (!blocks->exchanged(own, block, changed) || !blocks->exchanged(found, block, tried)) {
            return false;
        }
        if (is_smooth$f(way, near_frame, meeting, sides_of$f(own, tried, is_before), own, changed, later, SMOOTH$f)) {
            (void)memcpy(found, tried, size);
            is_exchanged = true;
        } else if (!is_smooth$f(way, near_frame, meeting, sides_of$f(own, found, is_before), own, changed, later,
            SMOOTH$f)) {
            return false;
        } else {
            /* The block stays in its mode. */
        }
    }
    /* A block that is wrongly left in its mode makes a kink elsewhere. */
    return is_exchanged
        && is_whole_smooth$f(way, near_frame, meeting, sides_of$f(own, found, is_before), SMOOTH$f);
}

/* Interpolates the frame at a time near a change point, in frames[1]; false if the path is too rough for that. */
LINKWRIGHT_FUNCTION static bool is_interpolated$f(Way$f *way, const void *near_frame, const Meeting$f *meeting,
    Sides$f sides, $real t)
{
    if (!is_smooth$f(way, near_frame, meeting, sides, sides.before, sides.beyond, sides.before, EXACT$f)
        || !is_whole_smooth$f(way, near_frame, meeting, sides, EXACT$f)) {
        return false;
    }
    const $real place = (way->direction * (t - meeting->time)) / meeting->width;
    $real whole = 0.0$f;
    for (size_t k = 0U; k < 2U; k += 1U) {
        $real distance = 0.0$f;
        for (size_t index = 0U; index < NODES$F; index += 1U) {
            $real weights[2];
            distance += 1.0$f;
            parts$f(place, (k == 0U) ? -1.0$f : 1.0$f, distance, index, weights);
            whole += weights[0];
        }
    }
    const bool is_found = are_sums$f(way, near_frame, meeting, sides, place, whole, parts$f);
    if (is_found) {
        set_number$f(way->frames[1], 0U, t);
    }
    return is_found;
}

/* Square of the distance of two frames in the rates of coordinates, which follow the coordinates, and these the
   time. */
LINKWRIGHT_FUNCTION static $real distance_of_rates$f(const linkwright$f_blocks *blocks, const void *first,
    const void *second)
{
    $real square = 0.0$f;
    for (size_t k = 0U; k < blocks->values; k += 1U) {
        const size_t place = (1U + (size_t)blocks->values) + k;
        const $real part = number_of$f(first, place) - number_of$f(second, place);
        square += fabs$f(part * part);
    }
    return square;
}

/* Computes the difference in rates between the path with the current modes before a change point, or beyond it, and
   a frame near it. */
LINKWRIGHT_FUNCTION static bool misses$f(Way$f *way, uint16_t block, const void *frame, const Meeting$f *meeting,
    bool is_before, void *found, $real *missed)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const bool is_found = are_sides$f(way, block, frame, meeting, is_before, found)
        && is_interpolated$f(way, frame, meeting, sides_of$f(way->branches, found, is_before), blocks->time(frame));
    *missed = is_found ? distance_of_rates$f(blocks, way->frames[1], frame) : 0.0$f;
    return is_found;
}

/* Square of the distance of the rates of both modes at the nearest time before a change point, or -1. */
LINKWRIGHT_FUNCTION static $real rates_apart$f(Way$f *way, uint16_t block, const void *near_frame,
    const Meeting$f *meeting)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const $real t = meeting->time - (way->direction * meeting->width);
    const bool are_found = blocks->exchanged(way->branches, block, way->others)
        && is_frame_at$f(way, t, near_frame, way->branches, way->frames[0])
        && is_frame_at$f(way, t, near_frame, way->others, way->frames[1]);
    return are_found ? distance_of_rates$f(blocks, way->frames[0], way->frames[1]) : -1.0$f;
}

/* Selects the modes on the other side of a change point on the smooth path through a frame near it; false if the
   path is undecided. */
LINKWRIGHT_FUNCTION static bool are_sides_through$f(Way$f *way, uint16_t block, const void *frame,
    const Meeting$f *meeting, bool *is_before, void *found)
{
    const $real part = SMOOTH$f * SMOOTH$f;
    $real first;
    $real second;
    const bool is_first = misses$f(way, block, frame, meeting, true, found, &first);
    const bool is_second = misses$f(way, block, frame, meeting, false, way->kept_branches, &second);
    /* If one of the two paths is too rough to be interpolated. */
    const $real apart = (is_first != is_second) ? rates_apart$f(way, block, frame, meeting) : 0.0$f;
    const bool is_own = is_first && (first <= (part * (is_second ? second : apart)));
    const bool is_other = is_second && (second <= (part * (is_first ? first : apart)));
    *is_before = is_own;
    if (!is_own) {
        (void)memcpy(found, way->kept_branches, way->mechanism->blocks->branches_size);
    }
    return is_own || is_other;
}
