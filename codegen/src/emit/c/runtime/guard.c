
/* The frames of a mechanism, one after another: whether each lies on the smooth path of the last one. */

/* How many steps are looked ahead at first, at least and at most. */
static const $real AHEAD$f = 16.0$f;
static const $real LEAST_AHEAD$f = 2.0$f;
static const $real MOST_AHEAD$f = 1024.0$f;

/* By how much farther after a success, and less far after a failure. */
static const $real AHEAD_GROWTH$f = 1.125$f;
static const $real AHEAD_SHRINKING$f = 0.625$f;

/* The signals of both frames and of the way between them stay where the window supposes them. */
static bool holds_signals$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair, $real since)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    bool holds = true;
    if (blocks->signals > 0U) {
        const $real h = pair->conditions->t - blocks->time(pair->last);
        for (uint16_t k = 0U; (k < blocks->signals) && holds; k++) {
            holds = holds_signal$f(&mechanism->state->span, blocks->read_signal(mechanism->window_inputs[0], k),
                blocks->read_signal(mechanism->window_inputs[1], k), blocks->read_signal(pair->before, k),
                blocks->read_signal(pair->conditions->inputs, k), h, since);
        }
    }
    return holds;
}

/* Looks at the path between two frames, and beyond. */
static linkwright_status look$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    linkwright$f_state *const state = mechanism->state;
    const $real t = pair->conditions->t;
    const $real step = t - blocks->time(pair->last);
    $real stretch = state->stretch;
    linkwright$f_span span;
    uint16_t block = 0U;
    state->has_window = false;
    span.step = step;
    while ((stretch >= LEAST_AHEAD$f) && (fabs$f(step) > 0.0$f)) {
        span.time = fabs$f(step) * stretch;
        span.stretch = stretch;
        span.bend = 0.5$f + (0.5$f / stretch);
        span.beyond = 1.0$f;
        if (blocks->keeps_to_path(pair, &span, mechanism->tubes, &block)) {
            const $real further = stretch * AHEAD_GROWTH$f;
            state->has_window = true;
            state->span = span;
            state->t = t;
            state->stretch = (further < MOST_AHEAD$f) ? further : MOST_AHEAD$f;
            if (blocks->signals > 0U) {
                (void)memcpy(mechanism->window_inputs[0], pair->before, blocks->inputs_size);
                (void)memcpy(mechanism->window_inputs[1], pair->conditions->inputs, blocks->inputs_size);
            }
            return LINKWRIGHT_OK;
        }
        stretch *= AHEAD_SHRINKING$f;
    }
    /* Where it could not look beyond the frames at all, some frames go by before it tries again. */
    state->stretch = (state->stretch < LEAST_AHEAD$f) ? (stretch * AHEAD_GROWTH$f) : stretch;
    span.time = fabs$f(step);
    span.stretch = 1.0$f;
    span.bend = 0.125$f;
    span.beyond = 0.0$f;
    if (blocks->keeps_to_path(pair, &span, mechanism->tubes, &block)) {
        return LINKWRIGHT_OK;
    }
    return noted$f(pair->conditions->failure, LINKWRIGHT_STEP_TOO_LARGE, 0.0$f, 0U, t, block);
}

/* Asks that a frame lies on the path of the last one. The first frame of a path lies on it. */
static linkwright_status admitted$f(const linkwright$f_mechanism *mechanism, const linkwright$f_pair *pair)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const linkwright$f_state *const state = mechanism->state;
    linkwright_status status = LINKWRIGHT_OK;
    if (blocks->is_guarded && (pair->conditions->start != LINKWRIGHT_ESTIMATE)) {
        const $real since = pair->conditions->t - state->t;
        const bool holds = state->has_window && (fabs$f(since) <= state->span.time) && holds_signals$f(mechanism,
            pair, since)
            && ((blocks->is_within == NULL) || blocks->is_within(pair->at, mechanism->tubes,
                since / state->span.step));
        if (!holds) {
            status = look$f(mechanism, pair);
        }
    }
    return status;
}
