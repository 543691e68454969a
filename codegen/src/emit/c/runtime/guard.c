
/* Path guard: verifies that frames continue one smooth path. */

/* Number of steps of the look-ahead: at first, at least and at most. */
static const $real AHEAD$f = 16.0$f;
static const $real LEAST_AHEAD$f = 2.0$f;
static const $real MOST_AHEAD$f = 1024.0$f;

/* Factor of the look-ahead after a success; its inverse after a failure. */
static const $real AHEAD_GROWTH$f = 1.125$f;
static const $real AHEAD_SHRINKING$f = 0.625$f;

/* Rounding that must not make a frame singular: links that enclose less than some 6e-4 rad leave accelerations few
   digits; and multiple of it for frames beyond. */
static const $real WEAK$f = 1.0$f / 67108864.0$f;
static const $real FAR_FROM_WEAK$f = 64.0$f;

/* True if the signals of both frames and between them stay within the bounds of the window. */
LINKWRIGHT_FUNCTION static bool holds_signals$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair,
    $real since)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    bool holds = true;
    if (blocks->signals > 0U) {
        const $real h = pair->conditions->t - blocks->time(pair->last);
        for (uint16_t k = 0U; (k < blocks->signals) && holds; k++) {
            holds = holds_signal$f(&mechanism->state->window, blocks->read_signal(mechanism->window_inputs[0], k),
                blocks->read_signal(mechanism->window_inputs[1], k), blocks->read_signal(pair->before, k),
                blocks->read_signal(pair->conditions->inputs, k), h, since);
        }
    }
    return holds;
}

/* Window from one frame to the next one, which is the time step (s) away. */
LINKWRIGHT_FUNCTION static linkwright$f_time_window window_between$f($real step)
{
    const linkwright$f_time_window window = {step, fabs$f(step), 1.0$f, 0.125$f, 0.0$f, window_rounding$f(1.0$f)};
    return window;
}

/* Window of so many steps on both sides of the second frame. */
LINKWRIGHT_FUNCTION static linkwright$f_time_window window_around$f($real step, $real steps)
{
    const linkwright$f_time_window window = {step, fabs$f(step) * steps, steps, 0.5$f + (0.5$f / steps), 1.0$f,
        window_rounding$f(steps)};
    return window;
}

/* Window with at least this rounding. */
LINKWRIGHT_FUNCTION static linkwright$f_time_window at_least$f(linkwright$f_time_window window, $real rounding)
{
    window.rounding = larger$f(window.rounding, rounding);
    return window;
}

/* Finds the first block that such a rounding might make singular in the second of two frames. */
LINKWRIGHT_FUNCTION static bool is_weak$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair,
    $real rounding, uint16_t *block)
{
    const linkwright$f_pair same = {pair->at, pair->at, pair->conditions->inputs, pair->conditions};
    const linkwright$f_time_window window = at_least$f(window_between$f(0.0$f), rounding);
    return !mechanism->blocks->verify_nonsingular(&same, &window, block);
}

/* True if a window can be verified: by closed forms in sequence, or by all equations together, which fills the
   enclosures. */
LINKWRIGHT_FUNCTION static bool shown$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair,
    const linkwright$f_time_window *window, bool is_closed, uint16_t *block)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const linkwright$f_time_window wide = at_least$f(*window, WEAK$f);
    return is_closed ? blocks->verify_nonsingular(pair, &wide, block)
                     : blocks->verify_path(pair, window, mechanism->enclosures, block);
}

/* Keeps the widest verified window about two frames, of at most so many steps; false if no window beyond the frames
   can be verified. Afterwards steps is the number to begin with next. */
LINKWRIGHT_FUNCTION static bool finds_window$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair,
    $real step, bool is_closed, $real *steps)
{
    linkwright$f_state *const state = mechanism->state;
    $real tried = *steps;
    uint16_t block = 0U;
    while ((tried >= LEAST_AHEAD$f) && (fabs$f(step) > 0.0$f)) {
        const linkwright$f_time_window window = window_around$f(step, tried);
        if (shown$f(mechanism, pair, &window, is_closed, &block)) {
            const $real further = tried * AHEAD_GROWTH$f;
            *steps = (further < MOST_AHEAD$f) ? further : MOST_AHEAD$f;
            state->has_window = true;
            state->window = window;
            state->t = pair->conditions->t;
            if (mechanism->blocks->signals > 0U) {
                (void)memcpy(mechanism->window_inputs[0], pair->before, mechanism->blocks->inputs_size);
                (void)memcpy(mechanism->window_inputs[1], pair->conditions->inputs, mechanism->blocks->inputs_size);
            }
            return true;
        }
        tried *= AHEAD_SHRINKING$f;
    }
    /* After a look-ahead that failed altogether, some frames pass before the next attempt. */
    *steps = (*steps < LEAST_AHEAD$f) ? (tried * AHEAD_GROWTH$f) : tried;
    return false;
}

/* Verifies the path between two frames, and beyond: first by closed forms in sequence, which costs little, then by
   all equations together. */
LINKWRIGHT_FUNCTION static linkwright_status look$f(const linkwright$f_mechanism *mechanism,
    const linkwright$f_pair *pair, bool may_be_weak)
{
    linkwright$f_state *const state = mechanism->state;
    const $real t = pair->conditions->t;
    const $real step = t - mechanism->blocks->time(pair->last);
    const linkwright$f_time_window between = window_between$f(step);
    uint16_t block = 0U;
    bool is_far = true;
    state->has_window = false;
    if (mechanism->blocks->verify_nonsingular != NULL) {
        if (finds_window$f(mechanism, pair, step, true, &state->steps_of_closed_forms)
            || shown$f(mechanism, pair, &between, true, &block)) {
            return LINKWRIGHT_OK;
        }
        /* Near a singular pose, frames beyond may be nearer to it. */
        is_far = !is_weak$f(mechanism, pair, WEAK$f * FAR_FROM_WEAK$f, &block);
        if (!is_far && !may_be_weak && is_weak$f(mechanism, pair, WEAK$f, &block)) {
            return noted$f(pair->conditions->failure, LINKWRIGHT_STEP_TOO_LARGE, 0.0$f, 0U, t, block);
        }
    }
    if ((is_far && finds_window$f(mechanism, pair, step, false, &state->steps))
        || shown$f(mechanism, pair, &between, false, &block)) {
        return LINKWRIGHT_OK;
    }
    return noted$f(pair->conditions->failure, LINKWRIGHT_STEP_TOO_LARGE, 0.0$f, 0U, t, block);
}

/* Requires that a frame lies on the path of the last one; the first frame of a path does. A nearly singular frame is
   refused unless it may be weak. */
LINKWRIGHT_FUNCTION static linkwright_status admitted$f(const linkwright$f_mechanism *mechanism,
    const linkwright$f_pair *pair, bool may_be_weak)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const linkwright$f_state *const state = mechanism->state;
    linkwright_status status = LINKWRIGHT_OK;
    if (blocks->is_guarded && (pair->conditions->start != LINKWRIGHT_ESTIMATE)) {
        const $real since = pair->conditions->t - state->t;
        const bool holds = state->has_window && (fabs$f(since) <= state->window.time) && holds_signals$f(mechanism,
            pair, since)
            && ((blocks->is_within == NULL) || blocks->is_within(pair->at, mechanism->enclosures,
                since / state->window.step));
        if (!holds) {
            status = look$f(mechanism, pair, may_be_weak);
        }
    }
    return status;
}
