
/* Advances a mechanism along its path from one frame to another time, in as many steps as needed. If one fails, half
   the distance is tried; at a change point of a block, the path continues straight in the other mode. */

/* Part of the whole distance below which a step is so short that a failure of its attempt lies on the path. */
static const $real REFINED$f = 1.0$f / 256.0$f;

/* Part of the distance to the predicted end of reach that the next attempt leaves, so that it usually lies on the
   same side. */
static const $real LEFT$f = 1.0$f / 16.0$f;

/* Maximum number of change points per path. */
#define CROSSINGS$F 8U

/* Signals on a path: its own, or those that continue from its first or last ones. */
typedef enum Law$f {
    LAW_OF_WAY$F = 0,
    FIRST_LAW$F = 1,
    LAST_LAW$F = 2
} Law$f;

/* Path to a time, with the progress on it. */
typedef struct Way$f {
    const linkwright$f_mechanism *mechanism;
    /* Start and end (s), and the signals at both ends. */
    $real from;
    $real end;
    const void *first_inputs;
    const void *last_inputs;
    /* True if it has no duration, so that the inputs alone change, and the completed part of their change. */
    bool is_change;
    $real part;
    linkwright_start start;
    /* Last frame on the path, frame of the last exchange of modes or else its first frame, and storage of the next
       frame. */
    void *reached;
    void *origin;
    void *next;
    void *branches;
    /* True if the frame at the end may be nearly singular, because no modes meet there. */
    bool may_be_weak;
    /* 1 if time grows on the path, otherwise -1, and the signals at a change point. */
    $real direction;
    Law$f law;
    /* Workspace for frames at change points, for other modes, and for the inputs of two times. */
    void *frames[6];
    void *others;
    void *kept_branches;
    void *solved_branches;
    void *found_branches;
    void *tried_branches;
    void *later_branches;
    void *inputs;
    void *before;
    linkwright$f_failure failure;
    /* Failure of a frame that is only tried. */
    linkwright$f_failure tried;
} Way$f;

/* Element of an array of elements of any size. */
LINKWRIGHT_FUNCTION static void *element$f(void *array, size_t size, size_t index)
{
    return &((unsigned char *)array)[index * size];
}

/* Signal after a time (s) with constant acceleration. */
LINKWRIGHT_FUNCTION static void go_on$f(linkwright$f_signal *signal, $real time)
{
    if (time != 0.0$f) {
        const $real change = signal->acceleration * time;
        signal->value += (signal->rate + (0.5$f * change)) * time;
        signal->rate += change;
    }
}

/* Signals at a time on the path; beyond it, and by the law of one of its ends, they continue from there. */
LINKWRIGHT_FUNCTION static void inputs_at$f(const Way$f *way, $real t, Law$f law, void *inputs)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    const $real part = (t - way->from) / (way->end - way->from);
    for (uint16_t k = 0U; k < blocks->signals; k++) {
        const linkwright$f_signal *const first = blocks->read_signal(way->first_inputs, k);
        const linkwright$f_signal *const last = blocks->read_signal(way->last_inputs, k);
        linkwright$f_signal *const found = blocks->signal(inputs, k);
        if ((law == FIRST_LAW$F) || ((law == LAW_OF_WAY$F) && (part <= 0.0$f))) {
            *found = *first;
            go_on$f(found, t - way->from);
        } else if ((law == LAST_LAW$F) || (part >= 1.0$f)) {
            *found = *last;
            go_on$f(found, t - way->end);
        } else {
            *found = signal_towards$f(first, last, way->end - way->from, part);
        }
    }
}

/* True if a signal's value, rate and acceleration are finite. */
LINKWRIGHT_FUNCTION static bool is_finite_signal$f(const linkwright$f_signal *signal)
{
    return linkwright$f_is_finite(signal->value) && linkwright$f_is_finite(signal->rate)
        && linkwright$f_is_finite(signal->acceleration);
}

/* Failure of an instant whose parameters or inputs are not finite: it names the first such input. */
LINKWRIGHT_FUNCTION static LINKWRIGHT_APART linkwright_status names_input$f(const linkwright$f_blocks *blocks,
    const linkwright$f_conditions *conditions)
{
    uint16_t place = 0U;
    while ((place < blocks->signals) && is_finite_signal$f(blocks->read_signal(conditions->inputs, place))) {
        place++;
    }
    const uint16_t column = (place < blocks->signals) ? (uint16_t)(place + 1U) : (uint16_t)0U;
    return noted$f(conditions->failure, LINKWRIGHT_NOT_FINITE, 0.0$f, column, conditions->t, 0U);
}

/* True if a failure is that of an input that is not finite. */
LINKWRIGHT_FUNCTION static bool is_of_input$f(const linkwright$f_failure *failure)
{
    return (failure->status == LINKWRIGHT_NOT_FINITE) && (failure->column > 0U);
}

/* Solves all blocks if all numbers are finite. */
LINKWRIGHT_FUNCTION static linkwright_status solve_all$f(const linkwright$f_mechanism *mechanism, void *at,
    const void *last, void *branches, const linkwright$f_conditions *conditions)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    bool are_finite = true;
    if (blocks->parameters_are_finite != NULL) {
        are_finite = blocks->parameters_are_finite(conditions->parameters);
    }
    if (blocks->inputs_are_finite != NULL) {
        are_finite = are_finite && blocks->inputs_are_finite(conditions->inputs);
    }
    return are_finite ? blocks->solve(at, last, branches, conditions) : names_input$f(blocks, conditions);
}

/* Number at a part of the straight path from one to another. */
LINKWRIGHT_FUNCTION static $real between$f($real first, $real last, $real part)
{
    return first + (part * (last - first));
}

/* Signals at a part of their change. */
LINKWRIGHT_FUNCTION static void changed_inputs$f(const Way$f *way, $real part, void *inputs)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    for (uint16_t k = 0U; k < blocks->signals; k++) {
        const linkwright$f_signal *const first = blocks->read_signal(way->first_inputs, k);
        const linkwright$f_signal *const last = blocks->read_signal(way->last_inputs, k);
        linkwright$f_signal *const found = blocks->signal(inputs, k);
        *found = *last;
        if (part < 1.0$f) {
            found->value = between$f(first->value, last->value, part);
            found->rate = between$f(first->rate, last->rate, part);
            found->acceleration = between$f(first->acceleration, last->acceleration, part);
        }
    }
}

/* Advances to a time, or to a part of the change of the inputs, which is then the time of a failure. */
LINKWRIGHT_FUNCTION static linkwright_status stepped$f(Way$f *way, $real place)
{
    const linkwright$f_mechanism *const mechanism = way->mechanism;
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const $real end_of_change = (place < 1.0$f) ? way->from : way->end;
    const $real t = way->is_change ? end_of_change : place;
    const linkwright$f_conditions conditions = {t, way->start, mechanism->parameters, way->inputs,
        &mechanism->state->settings, &way->failure};
    const linkwright$f_pair pair = {way->next, way->reached, way->before, &conditions};
    if (way->is_change) {
        changed_inputs$f(way, place, way->inputs);
        changed_inputs$f(way, way->part, way->before);
    } else {
        inputs_at$f(way, t, LAW_OF_WAY$F, way->inputs);
        inputs_at$f(way, blocks->time(way->reached), LAW_OF_WAY$F, way->before);
    }
    linkwright_status status = solve_all$f(mechanism, way->next, way->reached, way->branches, &conditions);
    if (status == LINKWRIGHT_OK) {
        /* Frames between the ends are not returned to the caller. */
        status = admitted$f(mechanism, &pair, way->may_be_weak || (t != way->end) || way->is_change);
    }
    if (status == LINKWRIGHT_OK) {
        void *const reached = way->next;
        way->next = way->reached;
        way->reached = reached;
        way->start = LINKWRIGHT_LAST_FRAME;
        way->part = place;
    } else if (way->is_change) {
        way->failure.time = place;
    } else {
        /* The failure has the time of the step. */
    }
    return status;
}

/* Time shortly beyond the end of reach, from two times beyond it, by the secant rule. False if the missing distance
   does not fall towards the reached time. */
LINKWRIGHT_FUNCTION static bool end_of_reach$f($real reached, const linkwright$f_failure *nearer,
    const linkwright$f_failure *farther, $real *aim)
{
    bool is_found = false;
    if ((nearer->status == LINKWRIGHT_OUT_OF_REACH) && (farther->status == LINKWRIGHT_OUT_OF_REACH)) {
        const $real way = (nearer->value * (farther->time - nearer->time)) / (farther->value - nearer->value);
        const $real time = nearer->time - (way * (1.0$f - LEFT$f));
        const bool is_between = ((time - reached) * (nearer->time - time)) >= 0.0$f;
        is_found = (nearer->value < farther->value) && is_between && (time != reached);
        *aim = time;
    }
    return is_found;
}

/* True for numbers that are refused: they do not tell which block has no pose. */
LINKWRIGHT_FUNCTION static bool refuses_number$f(linkwright_status status)
{
    return (status == LINKWRIGHT_NOT_POSITIVE) || (status == LINKWRIGHT_NOT_FINITE)
        || (status == LINKWRIGHT_LOAD_NOT_FINITE) || (status == LINKWRIGHT_FRICTION_UNSETTLED);
}

/* Status of a failure that no shorter step would have avoided. */
LINKWRIGHT_FUNCTION static linkwright_status lasting$f(linkwright_status status, bool is_coarse)
{
    const bool may_last = (status == LINKWRIGHT_SINGULAR) || (status == LINKWRIGHT_WRONG_BRANCH)
        || refuses_number$f(status);
    const bool lasts = (status == LINKWRIGHT_OUT_OF_REACH) || (may_last && !is_coarse);
    return lasts ? status : LINKWRIGHT_STEP_TOO_LARGE;
}

LINKWRIGHT_FUNCTION static bool is_end$f(const linkwright$f_failure *failure)
{
    return (failure->status == LINKWRIGHT_OUT_OF_REACH) || (failure->status == LINKWRIGHT_SINGULAR);
}

/* Changes the status of a failure, with its value and column. */
LINKWRIGHT_FUNCTION static void restate$f(linkwright$f_failure *failure, linkwright_status status, $real value,
    uint16_t column)
{
    failure->status = status;
    failure->value = value;
    failure->column = column;
}

/* Advances to a time in as many steps as needed, within the budget of the settings; the failure of the path gives
   the reason for its end. */
LINKWRIGHT_FUNCTION static linkwright_status in_steps$f(Way$f *way, $real from, $real to)
{
    const uint16_t budget = way->mechanism->state->settings.substeps;
    const $real refined = fabs$f(to - from) * REFINED$f;
    $real reached = from;
    $real step = to - from;
    bool has_succeeded = false;
    /* True if the last attempt was aimed at a time that two others have predicted. */
    bool is_aimed = false;
    bool is_refused = false;
    linkwright$f_failure refused = way->failure;
    linkwright$f_failure whole = way->failure;
    bool has_whole = false;
    /* Nearest time without a pose. */
    linkwright$f_failure beyond = way->failure;
    bool has_beyond = false;
    bool has_latest = false;
    uint16_t latest = 0U;
    uint16_t attempts = 0U;
    bool goes_on = true;
    while (goes_on) {
        const $real rest = to - reached;
        /* Written so that a NaN time is tried, and refused by the attempt. */
        const bool is_shorter = fabs$f(step) < fabs$f(rest);
        const $real target = is_shorter ? (reached + step) : to;
        bool is_in_line = false;
        attempts++;
        if (stepped$f(way, target) == LINKWRIGHT_OK) {
            if (!is_shorter) {
                return LINKWRIGHT_OK;
            }
            reached = target;
            /* A failure from farther away may have been passed. */
            is_refused = is_refused && ((from < to) ? (target < refused.time) : (refused.time < target));
            if (is_refused && (refused.status == LINKWRIGHT_OUT_OF_REACH)) {
                /* From nearer, the links reach no farther. */
                step = 0.5$f * (refused.time - reached);
            } else if (has_succeeded) {
                step += step;
            } else {
                /* The next step is as long. */
            }
            has_succeeded = true;
            is_aimed = false;
        } else {
            const linkwright$f_failure failure = way->failure;
            /* From farther away, the missing distance may belong to another gap than the next one. */
            const bool is_near = fabs$f(target - reached) <= refined;
            $real aim = 0.0$f;
            const bool has_aim = is_refused && is_near && end_of_reach$f(reached, &failure, &refused, &aim);
            /* Links that reach by less than rounding are collinear. */
            is_in_line = is_aimed && (failure.status == LINKWRIGHT_SINGULAR);
            is_aimed = has_aim || is_in_line;
            if (attempts == 1U) {
                whole = failure;
                has_whole = true;
            }
            refused = failure;
            is_refused = true;
            latest = failure.block;
            has_latest = true;
            if (is_end$f(&failure) || refuses_number$f(failure.status)) {
                beyond = failure;
                has_beyond = true;
            }
            step = has_aim ? (aim - reached) : (0.5$f * (target - reached));
            has_succeeded = false;
        }
        const $real next = reached + step;
        const bool is_repeated = is_refused && (refused.time == next) && is_aimed;
        const bool is_distinct = (next != reached) && linkwright$f_is_finite(next) && !is_repeated;
        goes_on = !is_in_line && (attempts < budget) && is_distinct;
    }
    if (!is_refused) {
        /* The only obstacle is the budget, which some block has used up. */
        return noted$f(&way->failure, LINKWRIGHT_STEP_TOO_LARGE, 0.0$f, 0U, reached, has_latest ? latest : 0U);
    }
    /* If the steps of a block have become as short, and it has no pose farther on, or none shortly beyond, that is
       the reason. */
    const bool has_end = has_beyond
        && (refuses_number$f(beyond.status) ? (fabs$f(beyond.time - reached) <= refined)
                                        : (beyond.block == refused.block));
    if (has_end && (refused.status == LINKWRIGHT_STEP_TOO_LARGE) && (fabs$f(step) <= refined)) {
        const $real time = refused.time;
        refused = beyond;
        refused.time = time;
    }
    /* Written so that a motion of zero or NaN duration counts as refined. */
    const bool is_coarse = (fabs$f(step) > refined) && !is_aimed;
    way->failure = refused;
    if (is_end$f(&refused) && has_whole && (whole.status == LINKWRIGHT_OUT_OF_REACH)
        && (whole.block == refused.block)) {
        /* The distance missing at the end says more than the zero at the end of reach. */
        restate$f(&way->failure, whole.status, whole.value, whole.column);
    } else {
        const linkwright_status status = lasting$f(refused.status, is_coarse);
        if (status != refused.status) {
            restate$f(&way->failure, status, 0.0$f, 0U);
        }
    }
    return way->failure.status;
}

/* Advances to a time. */
LINKWRIGHT_FUNCTION static linkwright_status steps_to$f(Way$f *way, $real end)
{
    const $real from = way->mechanism->blocks->time(way->reached);
    return (from == end) ? LINKWRIGHT_OK : in_steps$f(way, from, end);
}

/* True if time is too coarse to be divided between the ends. */
LINKWRIGHT_FUNCTION static bool is_without_length$f(const Way$f *way)
{
    const $real middle = way->from + (0.5$f * (way->end - way->from));
    return (middle == way->from) || (middle == way->end);
}

/* True if an input differs between the ends. */
LINKWRIGHT_FUNCTION static bool is_changed$f(const Way$f *way)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    bool is_found = false;
    for (uint16_t k = 0U; (k < blocks->signals) && !is_found; k++) {
        const linkwright$f_signal *const first = blocks->read_signal(way->first_inputs, k);
        const linkwright$f_signal *const last = blocks->read_signal(way->last_inputs, k);
        is_found = (first->value != last->value) || (first->rate != last->rate)
            || (first->acceleration != last->acceleration);
    }
    return is_found;
}

/* Advances to the end of a path without duration, in steps of the inputs. */
LINKWRIGHT_FUNCTION static linkwright_status changed$f(Way$f *way)
{
    way->is_change = true;
    const linkwright_status status = in_steps$f(way, 0.0$f, 1.0$f);
    if (status != LINKWRIGHT_OK) {
        way->failure.time = way->end;
    }
    return status;
}
