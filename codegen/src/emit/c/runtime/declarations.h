/* Failure of a solve: its kind, its time and the progress of the solve. */
typedef struct linkwright$f_failure {
    linkwright_status status;
    /* Time for which the equations were to be solved, or end of the path (s). */
    $real time;
    /* Block of equations that failed, in solve order. */
    uint16_t block;
    /* Number of completed Newton-Raphson steps, last scaled residual, and equation with that residual. */
    uint16_t iterations;
    $real residual;
    uint16_t row;
    /* Value and column of the status; 0 if it has none. The column of LINKWRIGHT_NOT_FINITE, and of
       LINKWRIGHT_OUTSIDE_RANGE, is the index of the input that is refused, counted from 1, or 0 if no input is the
       cause. */
    $real value;
    uint16_t column;
} linkwright$f_failure;

/* Limits within which a solve must succeed. */
typedef struct linkwright$f_settings {
    /* Largest scaled residual that counts as solved. */
    $real tolerance;
    /* Largest number of Newton-Raphson steps of one call, without the polishing step. */
    uint16_t iterations;
    /* Smallest pivot ratio of a Jacobian that counts as regular. */
    $real pivot_ratio;
    /* True if a pose that has met the tolerance is polished to rounding level. */
    bool polish;
    /* Largest number of attempts of one call to advance; the least is one. */
    uint16_t substeps;
} linkwright$f_settings;

/* Default settings. */
LINKWRIGHT_CONSTANT(linkwright$f_settings, LINKWRIGHT$F_SETTINGS);
#ifdef LINKWRIGHT_DEVICE
#define LINKWRIGHT$F_SETTINGS (*LINKWRIGHT$F_SETTINGS_ADDRESS())
#endif

/* Quantity that is supplied at one time, with its first two time derivatives. */
typedef struct linkwright$f_signal {
    $real value;
    $real rate;
    $real acceleration;
} linkwright$f_signal;

/* Position (m), velocity (m/s) and acceleration (m/s^2) of one point: x and y. */
typedef struct linkwright$f_point_motion {
    $real position[2];
    $real velocity[2];
    $real acceleration[2];
} linkwright$f_point_motion;

/* Distance of a block from a singular pose: both numbers are 0 there, and at most 1 in magnitude. */
typedef struct linkwright$f_normalized_determinant {
    /* Block in solve order. */
    uint16_t block;
    /* Determinant of the block divided by the lengths of the columns of its Jacobian; the sign is that of the
       assembly mode. */
    $real determinant;
    /* Reciprocal condition of the Jacobian with columns of length 1. */
    $real reciprocal_condition;
} linkwright$f_normalized_determinant;

/* Name of a parameter or an input, its unit of SI (empty for a plain number), and both ends of its range, which belong
   to it. */
typedef struct linkwright$f_value_range {
    const char *name;
    const char *unit;
    /* True if there is a range; otherwise both ends are 0. */
    bool is_limited;
    $real ends[2];
} linkwright$f_value_range;

/* The rest of this file is for generated code. */

/* Joints with friction, pins before slides: coefficients with the sign of what resists sliding, and both components of
   each reaction without friction and to a unit of each force. */
typedef struct linkwright$f_friction_joints {
    uint16_t count;
    uint16_t pins;
    const $real *coefficients;
    const $real *alone;
    const $real *units;
} linkwright$f_friction_joints;

/* Cubic pieces side by side, each valid from its start to the next. */
typedef struct linkwright$f_table {
    const $real *starts;
    /* Coefficients of the powers 0 to 3 of the distance from each start. */
    const $real (*pieces)[4];
    size_t count;
    /* Distance between starts that are equally spaced, otherwise 0. */
    $real spacing;
    /* Period of the table, or 0 if it does not repeat. */
    $real period;
} linkwright$f_table;

/* Data with which one instant is solved. */
typedef struct linkwright$f_conditions {
    /* Time (s). */
    $real t;
    linkwright_start start;
    /* Parameters and inputs of the mechanism. */
    const void *parameters;
    const void *inputs;
    const linkwright$f_settings *settings;
    /* Storage of a failure. */
    linkwright$f_failure *failure;
} linkwright$f_conditions;

/* Window of time about two frames. */
typedef struct linkwright$f_time_window {
    /* Time from the first frame to the second one, and largest distance of a time in the window from the second one
       (s). */
    $real step;
    $real time;
    /* That distance in steps: 1 if the window ends with the frames. */
    $real steps;
    /* Remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1. */
    $real remainder;
    /* 1 if the window extends beyond the frames, and as far before them; otherwise 0. */
    $real beyond;
    /* Bound on the rounding of values in frames over the window, relative to their magnitude. */
    $real rounding;
} linkwright$f_time_window;

/* Chord through the values of two frames: value in the second one, change per step, and bound on the deviation from
   the chord. */
typedef struct linkwright$f_enclosure {
    $real value;
    $real moved;
    $real deviation;
} linkwright$f_enclosure;

/* Two frames with the conditions of their solution. */
typedef struct linkwright$f_pair {
    const void *at;
    const void *last;
    /* Inputs of the first frame. */
    const void *before;
    const linkwright$f_conditions *conditions;
} linkwright$f_pair;

/* Blocks of a mechanism, and the data that its frames need. */
typedef struct linkwright$f_blocks {
    size_t frame_size;
    size_t branches_size;
    size_t inputs_size;
    uint16_t signals;
    /* True if frames are verified to lie on the path of the last one. */
    bool is_guarded;
    linkwright_status (*solve)(void *at, const void *last, void *branches, const linkwright$f_conditions *conditions);
    /* True if all inputs are finite, and all parameters; null without any. */
    bool (*inputs_are_finite)(const void *inputs);
    bool (*parameters_are_finite)(const void *parameters);
    /* Signals of the inputs in order; null without any. */
    linkwright$f_signal *(*signal)(void *inputs, uint16_t index);
    const linkwright$f_signal *(*read_signal)(const void *inputs, uint16_t index);
    /* Modes beyond a change point of a block; false if they are unknown. */
    bool (*exchanged)(const void *branches, uint16_t block, void *others);
    /* Null if no modes meet: a linker then omits the functions that pass change points. */
    bool (*passage)(void *path, linkwright_passage part);
    /* True if a frame stays on the path of the last one, otherwise the block; null if nothing is guarded. */
    bool (*verify_path)(const linkwright$f_pair *pair, const linkwright$f_time_window *window,
        linkwright$f_enclosure *enclosures, uint16_t *block);
    /* True if no block is singular anywhere in a window, otherwise the block; null if not all have a closed form. */
    bool (*verify_nonsingular)(const linkwright$f_pair *pair, const linkwright$f_time_window *window, uint16_t *block);
    bool (*is_within)(const void *at, const linkwright$f_enclosure *enclosures, $real steps);
    /* Time of a frame, and number of coordinates or components of points by which poses are compared. If frames hold
       coordinates, these are the first numbers after the time. */
    $real (*time)(const void *frame);
    uint16_t values;
    bool holds_coordinates;
    /* Component of a point; null if frames hold coordinates. */
    $real (*value)(const void *frame, uint16_t index);
    /* Least index of a required positive quantity that parameters make zero or negative, and its value; null if none
       can be. */
    bool (*not_positive)(const void *parameters, uint16_t *place, $real *value);
} linkwright$f_blocks;

/* State of a mechanism between frames, besides data of its own types. */
typedef struct linkwright$f_state {
    linkwright$f_settings settings;
    linkwright_start start;
    /* True if there is a last frame; false after an assembly that failed. */
    bool is_assembled;
    bool second_is_last;
    /* True if a window of the path is verified; the window, and the time of its second frame (s). */
    bool has_window;
    linkwright$f_time_window window;
    $real t;
    /* Number of steps of the next look-ahead, and of that by closed forms alone. */
    $real steps;
    $real steps_of_closed_forms;
    /* Last sum of durations (s), and its remainder beyond rounding. */
    $real sum;
    $real rest;
} linkwright$f_state;

/* Mechanism of the runtime: pointers to its data. */
typedef struct linkwright$f_mechanism {
    const linkwright$f_blocks *blocks;
    linkwright$f_state *state;
    linkwright$f_failure *failure;
    void *frames[2];
    void *branches;
    void *parameters;
    void *inputs;
    /* Inputs of both frames of the window, and its enclosures. */
    void *window_inputs[2];
    linkwright$f_enclosure *enclosures;
} linkwright$f_mechanism;

/* Workspace of a motion in several steps: arrays of the mechanism's own types, of as many elements as
   LINKWRIGHT_SUBSTEP_FRAMES and the like require. */
typedef struct linkwright$f_workspace {
    void *frames;
    void *branches;
    void *inputs;
} linkwright$f_workspace;

/* Equations of a block without a closed form, in as many unknowns. Matrices are stored row by row. */
typedef struct linkwright$f_equations {
    uint16_t order;
    uint16_t block;
    const void *context;
    void (*residual)(const void *context, const $real q[], $real t, $real phi[]);
    void (*jacobian)(const void *context, const $real q[], $real t, $real phi_q[]);
    void (*time_derivative)(const void *context, const $real q[], $real t, $real phi_t[]);
    void (*gamma)(const void *context, const $real q[], const $real qd[], $real t, $real gamma[]);
    /* Scales of the residuals and of the unknowns, and true for unknowns that are angles. */
    const $real *row_scales;
    const $real *column_scales;
    const bool *angles;
    /* Workspace of LINKWRIGHT_NEWTON_REALS(order) numbers, and of order exchanges. */
    $real *reals;
    uint16_t *exchanges;
} linkwright$f_equations;

/* Unknowns of such a block at one time, with their rates and accelerations. */
typedef struct linkwright$f_tears {
    $real t;
    $real *q;
    $real *qd;
    $real *qdd;
} linkwright$f_tears;

/* Equations of a block whose unknowns all follow from a few tearing variables. */
typedef struct linkwright$f_tearing {
    const linkwright$f_equations *equations;
    /* Number of tearing variables, and their indices among the unknowns. */
    uint16_t count;
    const uint16_t *tears;
    /* Scales of the tearing residuals, and magnitudes of their terms relative to the scales. */
    const $real *scales;
    const $real *terms;
    /* Computes their residuals, the inverse of the Jacobian, its determinant, and the intermediate values for
       completion; false if a closed form is out of reach or nearly singular. */
    bool (*evaluate)(const void *context, const $real tears[], const $real signs[], $real t, $real evaluated[]);
    /* Computes for each unknown its cosine, or the length itself; then the sines, rates and accelerations; then all
       residuals of the block; then the responses of the unknowns to the tearing variables, in scales. */
    void (*complete)(const void *context, const $real tears[], const $real signs[], const $real carried[], $real t,
        $real completed[]);
    uint16_t responses;
    /* Signs of the closed forms at a pose. */
    void (*signs)(const void *context, const $real q[], $real t, $real signs[]);
    /* Workspace of the results. */
    $real *evaluated;
    $real *completed;
} linkwright$f_tearing;

/* Distance of a block from singular. */
typedef struct linkwright$f_measure {
    $real determinant;
    $real reciprocal_condition;
} linkwright$f_measure;

/* Matrix as P S = L U, with S the matrix in its scales. */
typedef struct linkwright$f_factorization {
    uint16_t order;
    $real *factors;
    uint16_t *exchanges;
    $real *row_factors;
    const $real *column_factors;
    $real pivot_ratio;
} linkwright$f_factorization;

/* Equations along the chord through two frames. Matrices are stored row by row. */
typedef struct linkwright$f_chord {
    /* Remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1. */
    $real remainder;
    /* Bound on each equation's residual on the chord, without the terms that follow. */
    const $real *bounds;
    /* Second derivative of each equation over the window if its sign is known, without the rotated arms. */
    const $real *curvatures;
    /* Change of each unknown along the chord, and its magnitude, to which rounding is relative. */
    const $real *changes;
    $real *sizes;
    /* Jacobian of the second frame. */
    const $real *jacobian;
    /* True for a column that rotates with its angle; derivatives of these columns, and zeros in the others. */
    const bool *turns;
    $real *turning;
} linkwright$f_chord;

/* Verification of unknowns near a chord. */
typedef struct linkwright$f_isolation {
    uint16_t order;
    const uint16_t *blocks;
    /* Deviations for which the variation is required. */
    $real *deviations;
    /* Result: true if the unknowns stay on their path, otherwise the block that does not; and their deviations. */
    bool is_shown;
    uint16_t block;
    const $real *found;
    /* Magnitudes of the inverse, least remainder on the chord, and intermediate values. */
    const linkwright$f_chord *chord;
    const $real *variation;
    $real *inverse;
    $real *least;
    $real *needed;
    $real *rest;
    uint16_t rounds;
    uint16_t farthest;
    /* Factor by which the farthest deviation is too small, and true if that has decreased. */
    $real largest;
    bool is_nearing;
} linkwright$f_isolation;

/* Sine and cosine of an angle (rad), each within 1 ulp; NaN for infinite angles. */
LINKWRIGHT_FUNCTION void linkwright$f_sin_cos($real angle, $real *sine, $real *cosine);
LINKWRIGHT_FUNCTION $real linkwright$f_sin($real angle);
LINKWRIGHT_FUNCTION $real linkwright$f_cos($real angle);
/* Angle in (-pi, pi] of the vector (x, y), within 2 ulp. */
LINKWRIGHT_FUNCTION $real linkwright$f_atan2($real y, $real x);
/* Exponential function, within 1 ulp. */
LINKWRIGHT_FUNCTION $real linkwright$f_exp($real x);
/* Angle with this sine and cosine, or a common positive multiple of them, that is nearest to another one (rad). */
LINKWRIGHT_FUNCTION $real linkwright$f_angle_near($real sine, $real cosine, $real near_angle);

/* True if the square of a half chord is safely positive relative to a scale. False for NaN. */
LINKWRIGHT_FUNCTION bool linkwright$f_exceeds_rounding($real excess, $real scale);
/* Notes that links do not span a distance (m). */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_fail_out_of_reach($real distance, $real longest, $real shortest,
    const linkwright$f_conditions *conditions, uint16_t block);
/* Notes that a divisor has vanished relative to a scale. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_singular_divisor($real value, $real scale,
    const linkwright$f_conditions *conditions, uint16_t block);
/* Notes that a driven length is not positive, by its index among the quantities that must be positive. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_not_positive($real value, const linkwright$f_conditions *conditions,
    uint16_t place);
/* Notes that a value is outside of its range: that of an input, whose index counted from 1 is the column, or that of
   the parameter at a place. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_outside_range(linkwright$f_failure *failure, $real value,
    uint16_t column, $real t, uint16_t place);
/* Notes that a number is not finite. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_not_finite(const linkwright$f_conditions *conditions,
    uint16_t block);
/* Notes the first load that is not finite, if there is one and all values that loads follow from are finite. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_load_not_finite(const $real read[], size_t read_count,
    const $real loads[], uint16_t load_count, const linkwright$f_conditions *conditions, uint16_t block);
/* True if a number is finite, and true if all are. */
LINKWRIGHT_FUNCTION bool linkwright$f_is_finite($real value);
LINKWRIGHT_FUNCTION bool linkwright$f_all_finite(const $real values[], size_t count);
/* Pressure angle in [0, pi/2] rad; false while the follower rests. */
LINKWRIGHT_FUNCTION bool linkwright$f_pressure_angle($real along, $real across, $real sliding, $real *angle);
/* Largest magnitude of these lengths, or otherwise if that is zero or NaN. */
LINKWRIGHT_FUNCTION $real linkwright$f_largest_length(const $real lengths[], size_t count, $real otherwise);
/* Least index of these values that is not positive; false if all are positive. */
LINKWRIGHT_FUNCTION bool linkwright$f_first_not_positive(const $real values[], uint16_t count, uint16_t *place,
    $real *value);

/* Value of a table at an argument and its first three derivatives, or one of them. */
LINKWRIGHT_FUNCTION void linkwright$f_table_at(const linkwright$f_table *table, $real x, $real found[4]);
LINKWRIGHT_FUNCTION $real linkwright$f_table_value(const linkwright$f_table *table, $real x, size_t order);

/* Bounds on a signal's change from its second value and on its deviation from the chord. */
LINKWRIGHT_FUNCTION void linkwright$f_window_signal(const linkwright$f_time_window *window,
    const linkwright$f_signal *before, const linkwright$f_signal *now, $real found[2]);
/* Enclosure about a value, and true if another value is in it so many steps after the second frame. */
LINKWRIGHT_FUNCTION linkwright$f_enclosure linkwright$f_enclosure_of($real now, $real before, $real deviation);
LINKWRIGHT_FUNCTION bool linkwright$f_enclosure_holds(const linkwright$f_enclosure *enclosure, $real value,
    $real steps);
/* Begins to verify that unknowns stay near the chord through both frames. The variation, zero at first, bounds the
   changes of the Jacobian's entries, without the columns that rotate. While linkwright$f_isolation_needs_variation
   returns true, it is required for the deviations of the isolation. The sizes and the rotating columns are changed;
   reals is a workspace of LINKWRIGHT_ISOLATION_REALS(order) numbers. */
LINKWRIGHT_FUNCTION void linkwright$f_isolate(linkwright$f_isolation *isolation, uint16_t order,
    const uint16_t blocks[], const linkwright$f_chord *chord, const $real variation[], $real reals[]);
LINKWRIGHT_FUNCTION bool linkwright$f_isolation_needs_variation(linkwright$f_isolation *isolation);
/* Completes the verification if all columns rotate and every two equations but the last two link two unknowns to the
   next two: the work is proportional to the cells of such a chain. The variation is zero. */
LINKWRIGHT_FUNCTION void linkwright$f_isolate_chain(linkwright$f_isolation *isolation, uint16_t order,
    const uint16_t blocks[], const linkwright$f_time_window *window, const linkwright$f_chord *chord,
    const $real variation[], $real reals[]);

/* Solves the equations of a block from the last frame, or near an estimate; notes a failure. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_solve_block(const linkwright$f_equations *equations,
    const linkwright$f_tears *last, linkwright_branch *branch, linkwright$f_tears *found, linkwright$f_measure *measure,
    const linkwright$f_conditions *conditions);
/* Solves a block by its tearing variables if possible. The memory is the frame's record of the block: a number with
   the sign of the determinant in the tearing variables, zero if the sign is unknown, and the signs of the closed
   forms. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_solve_torn(const linkwright$f_tearing *tearing,
    const linkwright$f_tears *last, $real memory[], linkwright_branch *branch, linkwright$f_tears *found,
    const linkwright$f_conditions *conditions);
/* Factorizes the Jacobian of a block at a solved pose, and solves with it; notes a failure. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_factorize(const linkwright$f_equations *equations, const $real q[],
    linkwright$f_factorization *factorization, const linkwright$f_conditions *conditions);
/* Multipliers of a transposed Jacobian, which replace the forces, in a workspace of n x n + 3 n numbers and n
   exchanges. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_multipliers(uint16_t n, const $real jacobian[], $real forces[],
    $real reals[], uint16_t exchanges[], const linkwright$f_conditions *conditions, uint16_t block);
/* Forces of friction in joints, in a workspace of 2 n x n + 5 n numbers and n exchanges. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_friction(const linkwright$f_friction_joints *joints, $real found[],
    $real reals[], uint16_t exchanges[], const linkwright$f_conditions *conditions, uint16_t block);
LINKWRIGHT_FUNCTION void linkwright$f_solve_factorized(const linkwright$f_factorization *factorization,
    $real right_hand_side[]);

/* Distances of blocks in closed form from a singular pose, and the closest of all. */
LINKWRIGHT_FUNCTION linkwright$f_normalized_determinant linkwright$f_of_sine(uint16_t block, $real sine);
LINKWRIGHT_FUNCTION linkwright$f_normalized_determinant linkwright$f_of_slope(uint16_t block, $real slope);
LINKWRIGHT_FUNCTION linkwright$f_normalized_determinant linkwright$f_closest(
    const linkwright$f_normalized_determinant found[], size_t count);

/* Assembles a mechanism whose older frame is the estimate, with branches, parameters, inputs and settings in place. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_assemble(const linkwright$f_mechanism *mechanism, $real t);
/* Moves a mechanism to a time, in one step. Returns LINKWRIGHT_OK, or the status from which
   linkwright$f_advance_in_steps continues. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_advance(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs);
/* Retries a failed step in substeps. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_advance_in_steps(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs, const linkwright$f_workspace *workspace);
/* Passes change points of a path that is followed in steps; true if it has, or if the answer is yes. */
LINKWRIGHT_FUNCTION bool linkwright$f_pass(void *path, linkwright_passage part);
/* Solves for a frame at a time in the current modes, with workspace for a copy of them; the mechanism stays in its
   pose. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_frame_at(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs, void *frame, void *branches);
/* Time after a duration (s) from the last frame, as a compensated sum, and its remainder beyond rounding. */
LINKWRIGHT_FUNCTION $real linkwright$f_time_after(const linkwright$f_mechanism *mechanism, $real duration, $real *rest);
/* Continues from the frame at a time in the current modes, whether or not a path leads there, with workspace for a
   copy of the modes. Without a last frame, returns LINKWRIGHT_NOT_FINITE. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_recover(const linkwright$f_mechanism *mechanism, $real t,
    const void *inputs, void *branches);
/* Last frame. */
LINKWRIGHT_FUNCTION const void *linkwright$f_last_frame(const linkwright$f_mechanism *mechanism);
/* Checks that parameters are allowed; notes a failure. */
LINKWRIGHT_FUNCTION linkwright_status linkwright$f_allow(const linkwright$f_mechanism *mechanism,
    const void *parameters, $real t);
/* Makes the next frame the first one of another path, after a change of parameters. */
LINKWRIGHT_FUNCTION void linkwright$f_parameters_changed(const linkwright$f_mechanism *mechanism);
