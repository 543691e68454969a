
/* $LANES mechanisms that move in step. The caller owns the structure, and $mechanism_group_clear empties it. Its fields belong to the functions of the group. */
typedef struct $MechanismGroup {
    /* Mechanisms of the lanes; bits of those that are there, and of those whose last frames are in the arrays alone. */
    $Mechanism mechanisms[$LANES];
    uint32_t filled;
    uint32_t behind;
    bool second_is_last;
    $MechanismLaneFrames frames[2];
?signs     $MechanismLaneBranches branches;
?parameters     $MechanismLaneParameters parameters;
?inputs     $MechanismLaneInputs inputs;
    /* Middles and half lengths of the windows of time in which the paths are verified (s). */
    $real middles[$LANES];
    $real lengths[$LANES];
} $MechanismGroup;

/* Empties all lanes. */
void $mechanism_group_clear($MechanismGroup *group);

/* Puts a copy of a mechanism into a lane, where it continues from its last frame. False if it has none, or there is not such a lane. */
bool $mechanism_group_put($MechanismGroup *group, size_t lane, const $Mechanism *mechanism);

/* Takes the mechanism with its last frame out of a lane. False for an empty lane. */
bool $mechanism_group_take($MechanismGroup *group, size_t lane, $Mechanism *mechanism);

/* Moves all mechanisms, each to its own time (s)$with_inputs. Returns a bit for each lane that fails, the lowest for lane 0; their last frames stay as they are. Values of empty lanes are read, and their frames become arbitrary. */
uint32_t $mechanism_group_advance($MechanismGroup *group, const $real times[$LANES]$declared_inputs);

/* Last frames of all lanes. */
const $MechanismLaneFrames *$mechanism_group_frames(const $MechanismGroup *group);

/* Reads the last frame of a lane. False for an empty lane. */
bool $mechanism_group_frame(const $MechanismGroup *group, size_t lane, $MechanismFrame *frame);

/* Failure of the last motion of a lane; NULL if it did not fail. */
const linkwright$f_failure *$mechanism_group_failure(const $MechanismGroup *group, size_t lane);
