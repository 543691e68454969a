/* A solve that did not succeed: what happened, when and how far it had come. */
typedef struct linkwright$f_failure {
    linkwright_status status;
    /* The time at which the equations were to be solved, or where the path ends (s). */
    $real time;
    /* The block of equations that failed, in solve order. */
    uint16_t block;
    /* How many Newton-Raphson steps had been taken, the last scaled residual, and the equation with that residual. */
    uint16_t iterations;
    $real residual;
    uint16_t row;
    /* What the status says of a value and a column; 0 for others. The column of LINKWRIGHT_NOT_FINITE is the place of
       the input that is not finite, counted from 1, or 0 if no input is the cause. */
    $real value;
    uint16_t column;
} linkwright$f_failure;

/* The limits within which a solve must succeed. */
typedef struct linkwright$f_settings {
    /* The largest scaled residual that counts as solved. */
    $real tolerance;
    /* The largest number of Newton-Raphson steps of one call, the polishing step not counted. */
    uint16_t iterations;
    /* The smallest pivot ratio of a Jacobian that is not called singular. */
    $real pivot_ratio;
    /* Whether a pose that has met the tolerance is brought to rounding level. */
    bool polish;
    /* The largest number of attempts of one call to move on; the least is one. */
    uint16_t substeps;
} linkwright$f_settings;

/* The default settings. */
extern const linkwright$f_settings LINKWRIGHT$F_SETTINGS;

/* A quantity that is supplied at one time: its value with its first two time derivatives. */
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

/* How close a block is to a singular pose: both numbers are 0 there, and 1 in size where it is farthest from one. */
typedef struct linkwright$f_normalized_determinant {
    /* The block in solve order. */
    uint16_t block;
    /* Its determinant divided by the lengths of the columns of its Jacobian; the sign is that of the assembly mode.
       */
    $real determinant;
    /* The reciprocal condition of the Jacobian with columns of length 1. */
    $real reciprocal_condition;
} linkwright$f_normalized_determinant;

/* What follows is for generated code. */

/* Cubic pieces side by side, each valid from its start to the next. */
typedef struct linkwright$f_table {
    const $real *starts;
    /* The coefficients of the powers 0 to 3 of the distance from each start. */
    const $real (*pieces)[4];
    size_t count;
    /* The distance between starts that are equally spaced, or else 0. */
    $real spacing;
    /* After how much the table is repeated, or else 0. */
    $real period;
} linkwright$f_table;

/* What one instant is solved with. */
typedef struct linkwright$f_conditions {
    /* The time (s). */
    $real t;
    linkwright_start start;
    /* The mechanism's own parameters and inputs. */
    const void *parameters;
    const void *inputs;
    const linkwright$f_settings *settings;
    /* Where a failure is noted. */
    linkwright$f_failure *failure;
} linkwright$f_conditions;

/* A window of time about two frames. */
typedef struct linkwright$f_time_window {
    /* From the first frame to the second one, and how far the time goes from there (s). */
    $real step;
    $real time;
    /* The same in steps: 1 where the window ends with the frames. */
    $real steps;
    /* The remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1. */
    $real remainder;
    /* 1 where the window goes beyond the frames, and as far before them, or else 0. */
    $real beyond;
    /* How far rounding leaves what frames hold from what it stands for over the window, as a part of its size. */
    $real rounding;
} linkwright$f_time_window;

/* A straight line through the values of two frames, and how far a value may be from it. */
typedef struct linkwright$f_enclosure {
    $real value;
    $real moved;
    $real deviation;
} linkwright$f_enclosure;

/* Two frames and what they were solved with. */
typedef struct linkwright$f_pair {
    const void *at;
    const void *last;
    /* The inputs of the first frame. */
    const void *before;
    const linkwright$f_conditions *conditions;
} linkwright$f_pair;

/* What goes through poses at which modes meet. */
typedef struct linkwright$f_passage linkwright$f_passage;
extern const linkwright$f_passage LINKWRIGHT$F_PASSAGE;

/* The blocks of a mechanism, and what must be known to keep its frames. */
typedef struct linkwright$f_blocks {
    size_t frame_size;
    size_t branches_size;
    size_t inputs_size;
    uint16_t signals;
    /* Whether frames are shown to lie on the path of the last one. */
    bool is_guarded;
    linkwright_status (*solve)(void *at, const void *last, void *branches, const linkwright$f_conditions *conditions);
    /* Whether all inputs are finite, and all parameters; null where there are none. */
    bool (*inputs_are_finite)(const void *inputs);
    bool (*parameters_are_finite)(const void *parameters);
    /* The signals of the inputs in order; null where there are none. */
    linkwright$f_signal *(*signal)(void *inputs, uint16_t index);
    const linkwright$f_signal *(*read_signal)(const void *inputs, uint16_t index);
    /* The modes beyond a pose at which those of a block meet; false where they are not known. */
    bool (*exchanged)(const void *branches, uint16_t block, void *others);
    /* Null where no modes meet: a linker then leaves out what goes through such poses. */
    const linkwright$f_passage *passage;
    /* Whether a frame stays on the path of the last one, or else the block; null where nothing is guarded. */
    bool (*verify_path)(const linkwright$f_pair *pair, const linkwright$f_time_window *window, linkwright$f_enclosure *enclosures,
        uint16_t *block);
    /* Whether no block is singular anywhere in a window, or else the block; null where not all have a closed form. */
    bool (*verify_nonsingular)(const linkwright$f_pair *pair, const linkwright$f_time_window *window, uint16_t *block);
    bool (*is_within)(const void *at, const linkwright$f_enclosure *enclosures, $real steps);
    /* The time of a frame, and the number of coordinates or components of points by which poses are compared. Where
       frames hold coordinates, these are the first numbers after the time. */
    $real (*time)(const void *frame);
    uint16_t values;
    bool holds_coordinates;
    /* A component of a point; null where frames hold coordinates. */
    $real (*value)(const void *frame, uint16_t index);
    /* The least place of what parameters leave not positive, and its value; null where none can. */
    bool (*not_positive)(const void *parameters, uint16_t *place, $real *value);
} linkwright$f_blocks;

/* What a mechanism keeps from frame to frame beside what has a type of its own. */
typedef struct linkwright$f_state {
    linkwright$f_settings settings;
    linkwright_start start;
    /* Whether there is a last frame, which there is not after an assembly that failed. */
    bool is_assembled;
    bool second_is_last;
    /* Whether something is known of the path, and of which time (s). */
    bool has_window;
    linkwright$f_time_window window;
    $real t;
    /* How many steps are looked ahead next, and the same of closed forms by themselves. */
    $real steps;
    $real steps_of_closed_forms;
    /* The last sum of durations (s), and what it is beyond its rounding. */
    $real sum;
    $real rest;
} linkwright$f_state;

/* A mechanism as the runtime sees it: where everything is. */
typedef struct linkwright$f_mechanism {
    const linkwright$f_blocks *blocks;
    linkwright$f_state *state;
    linkwright$f_failure *failure;
    void *frames[2];
    void *branches;
    void *parameters;
    void *inputs;
    /* The inputs of both frames of the window, and its enclosures. */
    void *window_inputs[2];
    linkwright$f_enclosure *enclosures;
} linkwright$f_mechanism;

/* Room for what moving in several steps works with: arrays of the mechanism's own types, of as many elements as
   LINKWRIGHT_SUBSTEP_FRAMES and its like say. */
typedef struct linkwright$f_workspace {
    void *frames;
    void *branches;
    void *inputs;
} linkwright$f_workspace;

/* The equations of a block without a closed form, as functions of as many unknowns. Matrices are stored row by row.
   */
typedef struct linkwright$f_equations {
    uint16_t order;
    uint16_t block;
    const void *context;
    void (*residual)(const void *context, const $real q[], $real t, $real phi[]);
    void (*jacobian)(const void *context, const $real q[], $real t, $real phi_q[]);
    void (*time_derivative)(const void *context, const $real q[], $real t, $real phi_t[]);
    void (*gamma)(const void *context, const $real q[], const $real qd[], $real t, $real gamma[]);
    /* By what residuals and unknowns are scaled, and which unknowns are angles. */
    const $real *row_scales;
    const $real *column_scales;
    const bool *angles;
    /* Room for LINKWRIGHT_NEWTON_REALS(order) numbers and for order exchanges. */
    $real *reals;
    uint16_t *exchanges;
} linkwright$f_equations;

/* The unknowns of such a block at one time, with their rates and accelerations. */
typedef struct linkwright$f_tears {
    $real t;
    $real *q;
    $real *qd;
    $real *qdd;
} linkwright$f_tears;

/* The equations of a block of which all unknowns follow from a few, the tears. */
typedef struct linkwright$f_tearing {
    const linkwright$f_equations *equations;
    /* How many tears there are, and which of the unknowns they are. */
    uint16_t count;
    const uint16_t *tears;
    /* By what their residuals are scaled, and how large their terms are beside that. */
    const $real *scales;
    const $real *terms;
    /* Finds their residuals, the inverse of the Jacobian, its determinant, and what completion needs of the way there;
       false where a closed form is out of reach or nearly singular. */
    bool (*evaluate)(const void *context, const $real tears[], const $real signs[], $real t, $real evaluated[]);
    /* Finds of each unknown its cosine, or itself where it is a length; then their sines, rates and accelerations; then
       all residuals of the block; then how the unknowns respond to the tears, in scales. */
    void (*complete)(const void *context, const $real tears[], const $real signs[], const $real carried[], $real t,
        $real completed[]);
    uint16_t responses;
    /* The signs that the closed forms have at a pose. */
    void (*signs)(const void *context, const $real q[], $real t, $real signs[]);
    /* Room for what is found. */
    $real *evaluated;
    $real *completed;
} linkwright$f_tearing;

/* How far a block is from singular. */
typedef struct linkwright$f_measure {
    $real determinant;
    $real reciprocal_condition;
} linkwright$f_measure;

/* A matrix as P S = L U, with S the matrix in its scales. */
typedef struct linkwright$f_factorization {
    uint16_t order;
    $real *factors;
    uint16_t *exchanges;
    $real *row_factors;
    const $real *column_factors;
    $real pivot_ratio;
} linkwright$f_factorization;

/* Equations along a straight line through two frames. Matrices are stored row by row. */
typedef struct linkwright$f_chord {
    /* The remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1. */
    $real remainder;
    /* How far each equation may be from zero on the line, but for what follows. */
    const $real *bounds;
    /* What each equation's second derivative over the window is, where it is known with its sign, without the arms that
       turn. */
    const $real *curvatures;
    /* How far each unknown goes along the line, and how large it is, which rounding is a part of. */
    const $real *changes;
    $real *sizes;
    /* The Jacobian of the second frame. */
    const $real *jacobian;
    /* Whether a column turns with its angle, and the derivatives of those that do: zeros in the others. */
    const bool *turns;
    $real *turning;
} linkwright$f_chord;

/* What is shown of unknowns near a straight line. */
typedef struct linkwright$f_isolation {
    uint16_t order;
    const uint16_t *blocks;
    /* For which deviations the variation is wanted. */
    $real *deviations;
    /* What was shown: whether the unknowns stay on their path, or else the block that does not, and their deviations. */
    bool is_shown;
    uint16_t block;
    const $real *found;
    /* The size of the inverse, what is left of the line at least, and what is being worked with. */
    const linkwright$f_chord *chord;
    const $real *variation;
    $real *inverse;
    $real *least;
    $real *needed;
    $real *rest;
    uint16_t rounds;
    uint16_t farthest;
    /* By how much the farthest deviation is too small, and whether that has become less. */
    $real largest;
    bool is_nearing;
} linkwright$f_isolation;

/* The sine and the cosine of an angle (rad), each within 1 ulp; NaN for infinite angles. */
void linkwright$f_sin_cos($real angle, $real *sine, $real *cosine);
$real linkwright$f_sin($real angle);
$real linkwright$f_cos($real angle);
/* The angle in (-pi, pi] of the vector (x, y), within 2 ulp. */
$real linkwright$f_atan2($real y, $real x);
/* The exponential function, within 1 ulp. */
$real linkwright$f_exp($real x);
/* The angle with this sine and cosine, or a common positive multiple of them, that is nearest to another one (rad).
   */
$real linkwright$f_angle_near($real sine, $real cosine, $real near_angle);

/* Whether the square of a half chord is safely positive beside a scale. False for NaN. */
bool linkwright$f_exceeds_rounding($real excess, $real scale);
/* Notes why links do not span a distance (m). */
linkwright_status linkwright$f_fail_out_of_reach($real distance, $real longest, $real shortest,
    const linkwright$f_conditions *conditions, uint16_t block);
/* Notes that a divisor has vanished beside a scale. */
linkwright_status linkwright$f_singular_divisor($real value, $real scale, const linkwright$f_conditions *conditions,
    uint16_t block);
/* Notes that a driven length is not positive, by its place among what must be. */
linkwright_status linkwright$f_not_positive($real value, const linkwright$f_conditions *conditions, uint16_t place);
/* Notes that a number is not finite. */
linkwright_status linkwright$f_not_finite(const linkwright$f_conditions *conditions, uint16_t block);
/* Notes the first load that is not finite, if there is one and everything that loads follow from is finite. */
linkwright_status linkwright$f_load_not_finite(const $real read[], size_t read_count, const $real loads[],
    uint16_t load_count, const linkwright$f_conditions *conditions, uint16_t block);
/* Whether a number is finite, and whether all are. */
bool linkwright$f_is_finite($real value);
bool linkwright$f_all_finite(const $real values[], size_t count);
/* The pressure angle in [0, pi/2] rad; false while the follower rests. */
bool linkwright$f_pressure_angle($real along, $real across, $real sliding, $real *angle);
/* The largest magnitude of these lengths, or another one where that is zero or no number. */
$real linkwright$f_largest_length(const $real lengths[], size_t count, $real otherwise);
/* The least place of these values that is not positive. */
bool linkwright$f_first_not_positive(const $real values[], uint16_t count, uint16_t *place, $real *value);

/* The value of a table at a place and its first three derivatives, or one of them. */
void linkwright$f_table_at(const linkwright$f_table *table, $real x, $real found[4]);
$real linkwright$f_table_value(const linkwright$f_table *table, $real x, size_t order);

/* How far a signal goes from its second value, and from the straight line. */
void linkwright$f_window_signal(const linkwright$f_time_window *window, const linkwright$f_signal *before,
    const linkwright$f_signal *now, $real found[2]);
/* The enclosure about a value, and whether another value is in it so many steps after the second frame. */
linkwright$f_enclosure linkwright$f_enclosure_of($real now, $real before, $real deviation);
bool linkwright$f_enclosure_holds(const linkwright$f_enclosure *enclosure, $real value, $real steps);
/* Begins to show that unknowns keep to a straight line through both frames. The variation, zero at first, is how far
   the entries of the Jacobian may change, but for the columns that turn: as long as linkwright$f_isolation_needs_variation says
   so, it is wanted for the deviations of the isolation. The sizes and what turns are changed; reals is room for
   LINKWRIGHT_ISOLATION_REALS(order) numbers. */
void linkwright$f_isolate(linkwright$f_isolation *isolation, uint16_t order, const uint16_t blocks[],
    const linkwright$f_chord *chord, const $real variation[], $real reals[]);
bool linkwright$f_isolation_needs_variation(linkwright$f_isolation *isolation);
/* The same as a whole where all columns turn and every two equations but the last two link two unknowns to the next
   two: the work is in proportion to the cells of such a chain. The variation is zero. */
void linkwright$f_isolate_chain(linkwright$f_isolation *isolation, uint16_t order, const uint16_t blocks[],
    const linkwright$f_time_window *window, const linkwright$f_chord *chord, const $real variation[], $real reals[]);

/* Solves the equations of a block from the last frame, or near an estimate; notes a failure. */
linkwright_status linkwright$f_solve_block(const linkwright$f_equations *equations, const linkwright$f_tears *last,
    linkwright_branch *branch, linkwright$f_tears *found, linkwright$f_measure *measure,
    const linkwright$f_conditions *conditions);
/* The same by way of its tears where it can. The memory is what a frame keeps of the block: a number with the sign of
   the determinant in the tears, zero where that is not known, and the signs of the closed forms. */
linkwright_status linkwright$f_solve_torn(const linkwright$f_tearing *tearing, const linkwright$f_tears *last,
    $real memory[], linkwright_branch *branch, linkwright$f_tears *found, const linkwright$f_conditions *conditions);
/* Factorizes their Jacobian at a pose that is solved, and solves with it; notes a failure. */
linkwright_status linkwright$f_factorize(const linkwright$f_equations *equations, const $real q[],
    linkwright$f_factorization *factorization, const linkwright$f_conditions *conditions);
/* The multipliers of a transposed Jacobian, in the place of the forces, in room for n x n + 3 n numbers and n exchanges. */
linkwright_status linkwright$f_multipliers(uint16_t n, const $real jacobian[], $real forces[], $real reals[],
    uint16_t exchanges[], const linkwright$f_conditions *conditions, uint16_t block);
void linkwright$f_solve_factorized(const linkwright$f_factorization *factorization, $real right_hand_side[]);

/* How close blocks in closed form are to a singular pose, and the closest of all. */
linkwright$f_normalized_determinant linkwright$f_of_sine(uint16_t block, $real sine);
linkwright$f_normalized_determinant linkwright$f_of_slope(uint16_t block, $real slope);
linkwright$f_normalized_determinant linkwright$f_closest(const linkwright$f_normalized_determinant found[],
    size_t count);

/* Assembles a mechanism whose older frame is the estimate, with branches, parameters, inputs and settings in place.
   */
linkwright_status linkwright$f_assemble(const linkwright$f_mechanism *mechanism, $real t);
/* Moves a mechanism to a time, in one step. LINKWRIGHT_OK, or what linkwright$f_advance_in_steps goes on from. */
linkwright_status linkwright$f_advance(const linkwright$f_mechanism *mechanism, $real t, const void *inputs);
/* Goes on in several steps where that has failed. */
linkwright_status linkwright$f_advance_in_steps(const linkwright$f_mechanism *mechanism, $real t, const void *inputs,
    const linkwright$f_workspace *workspace);
/* Solves for a frame at a time in the modes of now, in room for a copy of them; the mechanism stays where it is. */
linkwright_status linkwright$f_frame_at(const linkwright$f_mechanism *mechanism, $real t, const void *inputs,
    void *frame, void *branches);
/* The time after a duration (s) from the last frame, as a compensated sum, and what it is beyond its rounding. */
$real linkwright$f_time_after(const linkwright$f_mechanism *mechanism, $real duration, $real *rest);
/* Goes on from the frame at a time in the modes of now, whether or not a path leads there, with room for a copy of the
   modes. Without a last frame it is LINKWRIGHT_NOT_FINITE. */
linkwright_status linkwright$f_recover(const linkwright$f_mechanism *mechanism, $real t, const void *inputs,
    void *branches);
/* The last frame. */
const void *linkwright$f_last_frame(const linkwright$f_mechanism *mechanism);
/* Whether parameters are allowed; notes a failure. */
linkwright_status linkwright$f_allow(const linkwright$f_mechanism *mechanism, const void *parameters, $real t);
/* Makes the next frame the first one of another path, because parameters have changed. */
void linkwright$f_parameters_changed(const linkwright$f_mechanism *mechanism);
