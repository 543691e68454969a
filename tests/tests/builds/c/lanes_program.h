/* Moves a group and the same mechanisms one by one, for the mechanism that TYPE, PREFIX and the like name. */
#include "counted.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define JOINED_(a, b) a##b
#define JOINED(a, b) JOINED_(a, b)
#define OF(name) JOINED(TYPE, name)
#define CALL(name) JOINED(PREFIX, name)
#define LANES JOINED(CONSTANT, _LANES)

#if INPUTS > 0
#define WITH(inputs) , inputs
#else
#define WITH(inputs)
#endif

static TYPE alone[LANES];
static OF(Group) group;

#if INPUTS > 0
/* Signals that move in a way of their own in each lane; some jump far. */
static void set_signals(OF(Inputs) *inputs, size_t lane, int step, double t)
{
    REAL numbers[INPUTS][3];
    *inputs = JOINED(CONSTANT, _INITIAL);
    (void)memcpy(numbers, inputs, sizeof(numbers));
    for (int index = 0; index < INPUTS; index++) {
        const double phase = t + index + (0.3 * (double)lane);
        double jump = 0.0;
        if ((lane == 2U) && ((step % 37) == 36)) {
            jump = 5.0;
        }
        if ((lane == 4U) && ((step % 37) == 30)) {
            jump = NAN;
        }
        numbers[index][0] += (REAL)((0.03 * (sin(phase) - sin(phase - t))) + jump);
        numbers[index][1] = (REAL)(0.03 * cos(phase));
        numbers[index][2] = (REAL)(-0.03 * sin(phase));
    }
    (void)memcpy(inputs, numbers, sizeof(numbers));
}
#endif

/* Time of a lane: small steps, jumps forward and back, NaN and infinity. */
static double time_of(size_t lane, int step)
{
    double ahead = 0.0;
    if ((lane == 1U) && (step >= 30)) {
        ahead = 3.0;
    }
    if ((lane == 5U) && (step == 36)) {
        ahead = 40.0;
    }
    if (lane == 6U) {
        ahead = (step == 38) ? NAN : ((step == 39) ? INFINITY : 0.0);
    }
    if ((lane == 7U) && (step >= 26) && (step < 30)) {
        ahead = -1.0;
    }
    return (0.001 * (double)lane) + (((step > 50) ? 0.2 : 0.01) * step) + ahead;
}

/* Assembles a mechanism whose parameters differ from those of the description, if it has a pose. */
static bool is_assembled(size_t lane WITH(const OF(Inputs) *inputs))
{
    const REAL t = (REAL)time_of(lane, 0);
#if PARAMETERS > 0
    const double factors[2] = {1.0 + (0.004 * (double)lane), 1.0};
    for (int k = 0; k < 2; k++) {
        OF(Parameters) parameters = JOINED(CONSTANT, _NOMINAL);
        REAL numbers[PARAMETERS];
        (void)memcpy(numbers, &parameters, sizeof(numbers));
        for (int index = 0; index < PARAMETERS; index++) {
            numbers[index] *= (REAL)factors[k];
        }
        (void)memcpy(&parameters, numbers, sizeof(numbers));
        if (CALL(_assemble_for)(&alone[lane], &parameters, t WITH(inputs)) == LINKWRIGHT_OK) {
            return true;
        }
    }
    return false;
#else
    return CALL(_assemble)(&alone[lane], t WITH(inputs)) == LINKWRIGHT_OK;
#endif
}

/* True if the group has the frame of the mechanism alone, and its failure. */
static bool is_same(size_t lane, uint32_t failed, linkwright_status status)
{
    OF(Frame) frame;
    const bool is_read = CALL(_group_frame)(&group, lane, &frame);
    const bool is_marked = ((failed >> lane) & 1U) != 0U;
    bool same = is_read && (is_marked == (status != LINKWRIGHT_OK));
    same = same && (memcmp(&frame, CALL(_frame)(&alone[lane]), sizeof(frame)) == 0);
    if (is_marked) {
        const FAILURE *const one = CALL(_group_failure)(&group, lane);
        const FAILURE *const other = &alone[lane].failure;
        same = same && (one != NULL) && (one->status == other->status) && (one->block == other->block);
        same = same && (one->column == other->column);
        same = same && (memcmp(&one->time, &other->time, sizeof(one->time)) == 0);
        same = same && (memcmp(&one->value, &other->value, sizeof(one->value)) == 0);
    } else {
        same = same && (CALL(_group_failure)(&group, lane) == NULL);
    }
    return same;
}

/* Number of differences. */
int JOINED(compare_, PREFIX)(Counted *counted)
{
    REAL times[LANES];
    int differences = 0;
#if INPUTS > 0
    OF(Inputs) inputs[LANES];
#endif
    CALL(_group_clear)(&group);
    for (size_t lane = 0U; lane < LANES; lane++) {
#if INPUTS > 0
        set_signals(&inputs[lane], lane, 0, time_of(lane, 0));
#endif
        if (!is_assembled(lane WITH(&inputs[lane]))) {
            counted->unassembled++;
            return 0;
        }
        differences += CALL(_group_put)(&group, lane, &alone[lane]) ? 0 : 1;
    }
    differences += CALL(_group_put)(&group, LANES, &alone[0]) ? 1 : 0;
    for (int step = 1; step < 56; step++) {
        for (size_t lane = 0U; lane < LANES; lane++) {
            times[lane] = (REAL)time_of(lane, step);
#if INPUTS > 0
            set_signals(&inputs[lane], lane, step, (double)times[lane]);
#endif
        }
        if (step == 20) {
            TYPE taken;
            const bool is_taken = CALL(_group_take)(&group, 3U, &taken);
            const OF(Frame) *const expected = CALL(_frame)(&alone[3]);
            differences += is_taken && (memcmp(CALL(_frame)(&taken), expected, sizeof(*expected)) == 0) ? 0 : 1;
            differences += CALL(_group_take)(&group, 3U, &taken) ? 1 : 0;
        }
        if (step == 25) {
            differences += CALL(_group_put)(&group, 3U, &alone[3]) ? 0 : 1;
        }
        const uint32_t failed = CALL(_group_advance)(&group, times WITH(inputs));
        for (size_t lane = 0U; lane < LANES; lane++) {
            if ((lane == 3U) && (step >= 20) && (step < 25)) {
                differences += ((failed >> 3) & 1U) != 0U ? 1 : 0;
                continue;
            }
            const linkwright_status status = CALL(_advance)(&alone[lane], times[lane] WITH(&inputs[lane]));
            if (!is_same(lane, failed, status)) {
                printf("%s, lane %d, step %d: status %d\n", NAME, (int)lane, step, (int)status);
                differences++;
            }
            counted->by_status[status]++;
        }
    }
    return differences;
}
