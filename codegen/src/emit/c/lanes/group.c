
/* Number of the frames of a group that are the last ones. */
static size_t $own_last_of(const $MechanismGroup *group)
{
    return group->second_is_last ? 1U : 0U;
}

/* Reads the last frame of a lane into its mechanism. */
static void $own_catch_up($MechanismGroup *group, size_t lane)
{
    $Mechanism *const mechanism = &group->mechanisms[lane];
    const uint32_t bit = (uint32_t)1U << lane;
    if ((group->behind & bit) != 0U) {
        $MechanismFrame *const frame = &mechanism->frames[mechanism->state.second_is_last ? 1 : 0];
        lane_read(&group->frames[$own_last_of(group)], $LANES, lane, frame, sizeof(*frame));
        mechanism->failure.status = LINKWRIGHT_OK;
        group->behind &= ~bit;
    }
}

/* Reads modes and the verified window of time from the mechanism of a lane. Nothing is in a window of negative length. */
static void $own_renew($MechanismGroup *group, size_t lane)
{
    const $Mechanism *const mechanism = &group->mechanisms[lane];
?signs $signs
?guarded     group->middles[lane] = mechanism->state.t;
?guarded     group->lengths[lane] = mechanism->state.has_window ? mechanism->state.window.time : -1.0$f;
?unguarded     (void)mechanism;
?unguarded     group->middles[lane] = 0.0$f;
?unguarded     group->lengths[lane] = $FLT_MAX;
}
?inputs 
?inputs /* True if the path of a lane to a time with these inputs stays in the verified window as far as inputs decide. */
?inputs static bool $own_inputs_continue(const $MechanismGroup *group, size_t lane, $real t, const $MechanismInputs *inputs)
?inputs {
?inputs     bool holds = $own_inputs_are_finite(inputs);
?guarded_inputs     const $Mechanism *const mechanism = &group->mechanisms[lane];
?guarded_inputs     const $real h = t - group->frames[$own_last_of(group)].t[lane];
?guarded_inputs     for (uint16_t k = 0U; (k < $signals) && holds; k++) {
?guarded_inputs         const linkwright$f_signal *const before = $own_read_signal(&mechanism->window_inputs[0], k);
?guarded_inputs         const linkwright$f_signal *const now = $own_read_signal(&mechanism->window_inputs[1], k);
?guarded_inputs         const linkwright$f_signal *const from = $own_read_signal(&mechanism->inputs, k);
?guarded_inputs         const linkwright$f_signal *const to = $own_read_signal(inputs, k);
?guarded_inputs         holds = lane_holds_signal$f(&mechanism->state.window, before, now, from, to, h, t - mechanism->state.t);
?guarded_inputs     }
?unguarded_inputs     (void)group;
?unguarded_inputs     (void)lane;
?unguarded_inputs     (void)t;
?inputs     return holds;
?inputs }

/* Solver of a frame that its lane has solved. */
static linkwright_status $own_solved(void *at, const void *last, void *branches, const linkwright$f_conditions *conditions)
{
    (void)at;
    (void)last;
    (void)branches;
    (void)conditions;
    return LINKWRIGHT_OK;
}

/* Moves the mechanism of a lane by itself, to the solved frame if its path leads there; true if that fails. */
static LINKWRIGHT_APART bool $own_advance_alone($MechanismGroup *group, size_t lane, bool is_solved, $real t$declared_input)
{
    $Mechanism *const mechanism = &group->mechanisms[lane];
    $MechanismLaneFrames *const at = &group->frames[1U - $own_last_of(group)];
    linkwright$f_mechanism parts = $own_parts_of(mechanism);
    const linkwright$f_blocks *const own = parts.blocks;
    linkwright$f_blocks blocks = *own;
    linkwright_status status;
    bool is_moved = false;
    $own_catch_up(group, lane);
    if (is_solved) {
        $MechanismFrame *const next = &mechanism->frames[mechanism->state.second_is_last ? 0 : 1];
        lane_read(at, $LANES, lane, next, sizeof(*next));
        blocks.solve = $own_solved;
        parts.blocks = &blocks;
        status = linkwright$f_advance(&parts, t, $any_input);
        parts.blocks = own;
        is_moved = (status == LINKWRIGHT_OK);
        if (!is_moved) {
            status = $own_advance_in_steps(&parts, t, $any_input);
        }
    } else {
        status = $mechanism_advance(mechanism, t$passed_input);
    }
    if (!is_moved) {
        const $MechanismFrame *const frame = $mechanism_frame(mechanism);
        lane_write(at, $LANES, lane, frame, sizeof(*frame));
    }
    $own_renew(group, lane);
    return status != LINKWRIGHT_OK;
}

void $mechanism_group_clear($MechanismGroup *group)
{
    (void)memset(group, 0, sizeof(*group));
}

bool $mechanism_group_put($MechanismGroup *group, size_t lane, const $Mechanism *mechanism)
{
    const $MechanismFrame *const frame = $mechanism_frame(mechanism);
    const bool is_put = (lane < $LANES) && (frame != NULL);
    if (is_put) {
        const uint32_t bit = (uint32_t)1U << lane;
        group->mechanisms[lane] = *mechanism;
        group->filled |= bit;
        group->behind &= ~bit;
        lane_write(&group->frames[0], $LANES, lane, frame, sizeof(*frame));
        lane_write(&group->frames[1], $LANES, lane, frame, sizeof(*frame));
?parameters         lane_write(&group->parameters, $LANES, lane, &mechanism->parameters, sizeof(mechanism->parameters));
        $own_renew(group, lane);
    }
    return is_put;
}

bool $mechanism_group_take($MechanismGroup *group, size_t lane, $Mechanism *mechanism)
{
    const uint32_t bit = (lane < $LANES) ? ((uint32_t)1U << lane) : 0U;
    const bool is_filled = (group->filled & bit) != 0U;
    if (is_filled) {
        $own_catch_up(group, lane);
        *mechanism = group->mechanisms[lane];
        group->filled &= ~bit;
    }
    return is_filled;
}

uint32_t $mechanism_group_advance($MechanismGroup *group, const $real times[$LANES]$declared_inputs)
{
    const size_t last = $own_last_of(group);
    $word unsolved[$LANES];
    uint32_t alone = 0U;
    uint32_t failed = 0U;
?inputs     for (size_t lane = 0U; lane < $LANES; lane++) {
?inputs         lane_write(&group->inputs, $LANES, lane, &given[lane], sizeof(given[lane]));
?inputs     }
    $own_solve_lanes($passed);
?ranges     for (size_t lane = 0U; lane < $LANES; lane++) {
?ranges         linkwright$f_failure failure;
?ranges         const linkwright_status of_input = $own_refuse_inputs(&given[lane], &failure, times[lane]);
?ranges         unsolved[lane] |= (of_input == LINKWRIGHT_OK) ? 0U : 1U;
?ranges     }
    for (size_t lane = 0U; lane < $LANES; lane++) {
        const bool is_inside = fabs$f(times[lane] - group->middles[lane]) <= group->lengths[lane];
        alone |= (is_inside && (unsolved[lane] == 0U)) ? 0U : ((uint32_t)1U << lane);
    }
?inputs     for (size_t lane = 0U; lane < $LANES; lane++) {
?inputs         const uint32_t bit = (uint32_t)1U << lane;
?inputs         if ((group->filled & ~alone & bit) != 0U) {
?inputs             if ($own_inputs_continue(group, lane, times[lane], &given[lane])) {
?inputs                 group->mechanisms[lane].inputs = given[lane];
?inputs             } else {
?inputs                 alone |= bit;
?inputs             }
?inputs         }
?inputs     }
    alone &= group->filled;
    if (alone != 0U) {
        for (size_t lane = 0U; lane < $LANES; lane++) {
            const uint32_t bit = (uint32_t)1U << lane;
            const bool is_solved = unsolved[lane] == 0U;
            if (((alone & bit) != 0U) && $own_advance_alone(group, lane, is_solved, times[lane]$given)) {
                failed |= bit;
            }
        }
    }
    group->behind |= group->filled & ~alone;
    group->second_is_last = !group->second_is_last;
    return failed;
}

const $MechanismLaneFrames *$mechanism_group_frames(const $MechanismGroup *group)
{
    return &group->frames[$own_last_of(group)];
}

bool $mechanism_group_frame(const $MechanismGroup *group, size_t lane, $MechanismFrame *frame)
{
    const uint32_t bit = (lane < $LANES) ? ((uint32_t)1U << lane) : 0U;
    const bool is_filled = (group->filled & bit) != 0U;
    if (is_filled) {
        lane_read(&group->frames[$own_last_of(group)], $LANES, lane, frame, sizeof(*frame));
    }
    return is_filled;
}

const linkwright$f_failure *$mechanism_group_failure(const $MechanismGroup *group, size_t lane)
{
    const uint32_t bit = (lane < $LANES) ? ((uint32_t)1U << lane) : 0U;
    const bool is_alone = (group->filled & ~group->behind & bit) != 0U;
    const bool has_failed = is_alone && (group->mechanisms[lane].failure.status != LINKWRIGHT_OK);
    return has_failed ? &group->mechanisms[lane].failure : NULL;
}
