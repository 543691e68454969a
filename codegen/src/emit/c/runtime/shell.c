
/* Assembly and motion of a mechanism. It keeps two frames, the last one and the one that the next solution is
   written to; only a successful solution replaces the last frame. */

LINKWRIGHT_FUNCTION static void *frame_of$f(const linkwright$f_mechanism *mechanism, bool is_last)
{
    return mechanism->frames[(mechanism->state->second_is_last == is_last) ? 1U : 0U];
}

LINKWRIGHT_FUNCTION const void *linkwright$f_last_frame(const linkwright$f_mechanism *mechanism)
{
    return frame_of$f(mechanism, true);
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_allow(const linkwright$f_mechanism *mechanism,
    const void *parameters, $real t)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    uint16_t place = 0U;
    $real value = 0.0$f;
    if ((blocks->parameters_are_finite != NULL) && !blocks->parameters_are_finite(parameters)) {
        return noted$f(mechanism->failure, LINKWRIGHT_NOT_FINITE, 0.0$f, 0U, t, 0U);
    }
    if ((blocks->not_positive != NULL) && blocks->not_positive(parameters, &place, &value)) {
        return noted$f(mechanism->failure, LINKWRIGHT_NOT_POSITIVE, value, 0U, t, place);
    }
    return LINKWRIGHT_OK;
}

/* Forgets the verified window, and looks so many steps ahead next. */
LINKWRIGHT_FUNCTION static void forget_path$f(linkwright$f_state *state, $real steps)
{
    state->has_window = false;
    state->steps = steps;
    state->steps_of_closed_forms = steps;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_assemble(const linkwright$f_mechanism *mechanism, $real t)
{
    linkwright$f_state *const state = mechanism->state;
    const linkwright$f_conditions conditions = {t, LINKWRIGHT_ESTIMATE, mechanism->parameters, mechanism->inputs,
        &state->settings, mechanism->failure};
    void *const at = mechanism->frames[0];
    void *const last = mechanism->frames[1];
    (void)memcpy(at, last, mechanism->blocks->frame_size);
    state->start = LINKWRIGHT_LAST_FRAME;
    state->second_is_last = false;
    forget_path$f(state, AHEAD$f);
    state->t = t;
    state->sum = t;
    state->rest = 0.0$f;
    (void)noted$f(mechanism->failure, LINKWRIGHT_OK, 0.0$f, 0U, t, 0U);
    const linkwright_status status = solve_all$f(mechanism, at, last, mechanism->branches, &conditions);
    mechanism->failure->status = status;
    state->is_assembled = status == LINKWRIGHT_OK;
    return status;
}

/* Keeps a solved frame. */
LINKWRIGHT_FUNCTION static void keep$f(const linkwright$f_mechanism *mechanism, const void *inputs)
{
    linkwright$f_state *const state = mechanism->state;
    if ((mechanism->blocks->signals > 0U) && (mechanism->inputs != inputs)) {
        (void)memcpy(mechanism->inputs, inputs, mechanism->blocks->inputs_size);
    }
    state->start = LINKWRIGHT_LAST_FRAME;
    state->second_is_last = !state->second_is_last;
    mechanism->failure->status = LINKWRIGHT_OK;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_advance(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs)
{
    const linkwright$f_state *const state = mechanism->state;
    void *const at = frame_of$f(mechanism, false);
    const void *const last = frame_of$f(mechanism, true);
    const linkwright$f_conditions conditions = {t, state->start, mechanism->parameters, inputs,
        &state->settings, mechanism->failure};
    const linkwright$f_pair pair = {at, last, mechanism->inputs, &conditions};
    linkwright_status status = solve_all$f(mechanism, at, last, mechanism->branches, &conditions);
    if (status == LINKWRIGHT_OK) {
        status = admitted$f(mechanism, &pair, false);
    }
    if (status == LINKWRIGHT_OK) {
        keep$f(mechanism, inputs);
    }
    return status;
}

/* Advances to the end of a path, through change points. */
LINKWRIGHT_FUNCTION static linkwright_status gone$f(Way$f *way)
{
    const linkwright$f_blocks *const blocks = way->mechanism->blocks;
    if (blocks->passage == NULL) {
        return steps_to$f(way, way->end);
    }
    (void)blocks->passage(way, LINKWRIGHT_PASSAGE_OF_ENDS);
    linkwright_status status = steps_to$f(way, way->end);
    for (uint16_t crossings = 0U; (status != LINKWRIGHT_OK) && (crossings < CROSSINGS$F); crossings++) {
        const linkwright$f_failure failure = way->failure;
        if (blocks->passage(way, LINKWRIGHT_PASSAGE_OF_BREAK)) {
            status = steps_to$f(way, way->end);
        } else {
            way->failure = failure;
            break;
        }
    }
    if ((status != LINKWRIGHT_OK) && blocks->passage(way, LINKWRIGHT_PASSAGE_IS_UNDECIDED)) {
        status = LINKWRIGHT_UNDECIDED;
        restate$f(&way->failure, status, 0.0$f, 0U);
    }
    return status;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_advance_in_steps(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs, const linkwright$f_workspace *workspace)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    linkwright$f_state *const state = mechanism->state;
    const void *const last = frame_of$f(mechanism, true);
    /* No path leads to inputs that are not allowed. */
    const bool is_driven_so = (blocks->signals > 0U) && (mechanism->failure->status == LINKWRIGHT_NOT_POSITIVE);
    if (is_of_input$f(mechanism->failure) || is_driven_so || (state->settings.substeps <= 1U)) {
        return mechanism->failure->status;
    }
    /* The steps depend on the last frame alone, not on the windows that have led there. */
    forget_path$f(state, 1.0$f);
    Way$f way;
    way.mechanism = mechanism;
    way.from = blocks->time(last);
    way.end = t;
    way.is_change = false;
    way.part = 0.0$f;
    way.first_inputs = mechanism->inputs;
    way.last_inputs = inputs;
    way.start = state->start;
    for (size_t k = 0U; k < 6U; k += 1U) {
        way.frames[k] = element$f(workspace->frames, blocks->frame_size, k);
    }
    way.reached = element$f(workspace->frames, blocks->frame_size, 6U);
    way.origin = element$f(workspace->frames, blocks->frame_size, 7U);
    way.next = element$f(workspace->frames, blocks->frame_size, 8U);
    way.branches = workspace->branches;
    way.others = element$f(workspace->branches, blocks->branches_size, 1U);
    way.kept_branches = element$f(workspace->branches, blocks->branches_size, 2U);
    way.solved_branches = element$f(workspace->branches, blocks->branches_size, 3U);
    way.found_branches = element$f(workspace->branches, blocks->branches_size, 4U);
    way.tried_branches = element$f(workspace->branches, blocks->branches_size, 5U);
    way.later_branches = element$f(workspace->branches, blocks->branches_size, 6U);
    way.may_be_weak = false;
    way.direction = 1.0$f;
    way.law = LAW_OF_WAY$F;
    way.inputs = workspace->inputs;
    way.before = workspace->inputs;
    if (blocks->signals > 0U) {
        way.before = element$f(workspace->inputs, blocks->inputs_size, 1U);
    }
    way.failure = *mechanism->failure;
    way.tried = *mechanism->failure;
    (void)memcpy(way.reached, last, blocks->frame_size);
    (void)memcpy(way.origin, last, blocks->frame_size);
    (void)memcpy(way.branches, mechanism->branches, blocks->branches_size);
    linkwright_status status;
    if (is_without_length$f(&way) && is_changed$f(&way)) {
        status = changed$f(&way);
    } else if ((way.from == t) && (way.start == LINKWRIGHT_ESTIMATE)) {
        /* The last frame belongs to its own parameters only. */
        status = way.failure.status;
    } else {
        status = gone$f(&way);
    }
    if (status == LINKWRIGHT_OK) {
        (void)memcpy(mechanism->branches, way.branches, blocks->branches_size);
        (void)memcpy(frame_of$f(mechanism, false), way.reached, blocks->frame_size);
        keep$f(mechanism, inputs);
    } else {
        *mechanism->failure = way.failure;
    }
    return status;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_frame_at(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs, void *frame, void *branches)
{
    const linkwright$f_blocks *const blocks = mechanism->blocks;
    const void *const last = frame_of$f(mechanism, true);
    const linkwright$f_conditions conditions = {t, LINKWRIGHT_ESTIMATE, mechanism->parameters, inputs,
        &mechanism->state->settings, mechanism->failure};
    (void)memcpy(frame, last, blocks->frame_size);
    (void)memcpy(branches, mechanism->branches, blocks->branches_size);
    return solve_all$f(mechanism, frame, last, branches, &conditions);
}

LINKWRIGHT_FUNCTION $real linkwright$f_time_after(const linkwright$f_mechanism *mechanism, $real duration, $real *rest)
{
    const linkwright$f_state *const state = mechanism->state;
    const $real t = mechanism->blocks->time(frame_of$f(mechanism, true));
    /* The remainder of a sum counts if t is its time. */
    const $real whole = duration + ((state->sum == t) ? state->rest : 0.0$f);
    const $real sum = t + whole;
    const $real added = sum - t;
    *rest = (t - (sum - added)) + (whole - added);
    return sum;
}

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_recover(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs, void *branches)
{
    linkwright$f_state *const state = mechanism->state;
    if (!state->is_assembled) {
        return noted$f(mechanism->failure, LINKWRIGHT_NOT_FINITE, 0.0$f, 0U, t, 0U);
    }
    const linkwright_status status = linkwright$f_frame_at(mechanism, t, inputs, frame_of$f(mechanism, false), branches);
    if (status == LINKWRIGHT_OK) {
        (void)memcpy(mechanism->branches, branches, mechanism->blocks->branches_size);
        state->has_window = false;
        keep$f(mechanism, inputs);
    }
    return status;
}

LINKWRIGHT_FUNCTION void linkwright$f_parameters_changed(const linkwright$f_mechanism *mechanism)
{
    mechanism->state->start = LINKWRIGHT_ESTIMATE;
    mechanism->state->has_window = false;
}
