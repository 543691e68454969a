 * The runtime of generated mechanisms: sines, cosines and angles, Newton-Raphson, linear solves, and what moves a
 * mechanism from frame to frame on one smooth path.
 *
 * It is C99, and C++ as far as this file goes. It allocates nothing, holds no state of its own and calls itself nowhere;
 * the work of every call is bounded. Names that begin with linkwright_ are for double, those with linkwrightf_ for float.
 * Of the standard library it takes memcpy, and of <math.h> what is exact (sqrt, floor, round, fabs, copysign, ldexp) and,
 * where a description has them, log and pow.
 *
 * The same bits everywhere: every operation is one of IEEE 754, in the order in which it is written. The compiler must
 * neither contract a product and a sum into one operation nor reorder them. Clang reads the pragma in the .c files.
 * GCC does not: give it -std=c99 or -ffp-contract=off. GCC 12 contracts in spite of them where it vectorizes straight
 * lines of code for a processor with fused operations (-mfma, -march=native); a pragma in the .c files prevents that, and
 * so does -fno-tree-slp-vectorize. In GNU mode (-std=gnu99 and later, as Arduino compiles) it
 * contracts where the processor has fused operations, a Cortex-M4F for example: all bounds, failures and guarantees
 * hold there too, but the last bits may differ from those of another build. -ffast-math is refused.
 *
 * This file is part of what the generator writes. Whoever generates it may use, change and pass on it and everything
 * generated beside it for any purpose and under any licence, without a notice. It comes without any warranty.
 */
#ifndef LINKWRIGHT_H
#define LINKWRIGHT_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Which generator has written this: generated files refuse that of another one. */
#define LINKWRIGHT_VERSION $version

#if defined(__FAST_MATH__)
#error "linkwright: -ffast-math reorders sums and forgets about NaN; compile without it"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What came of a call: LINKWRIGHT_OK, or why there is no frame. */
typedef enum linkwright_status {
    LINKWRIGHT_OK = 0,
    /* The Jacobian is singular, or so close to it that no digit of a solution can be trusted. The failure's value is
       the pivot ratio that was found, its column the coordinate at which elimination stopped. */
    LINKWRIGHT_SINGULAR = 1,
    /* The iterates of Newton-Raphson run away. */
    LINKWRIGHT_DIVERGED = 2,
    /* They repeat themselves. */
    LINKWRIGHT_CYCLING = 3,
    /* A step was shorter than rounding, and the residual still exceeds the tolerance. */
    LINKWRIGHT_STALLED = 4,
    /* None of the others occurred within the steps that the settings allow. */
    LINKWRIGHT_ITERATION_LIMIT = 5,
    /* The links of a closed-form block do not span the distance between their far pins. The value is how much is
       missing, in m. */
    LINKWRIGHT_OUT_OF_REACH = 6,
    /* The pose that was found belongs to another assembly mode. */
    LINKWRIGHT_WRONG_BRANCH = 7,
    /* The motion could not be followed to the time asked for in as many steps as the settings allow. */
    LINKWRIGHT_STEP_TOO_LARGE = 8,
    /* Parameters, inputs or t make something not positive that must be. The value is what it would be, the block its
       place among what must be positive. */
    LINKWRIGHT_NOT_POSITIVE = 9,
    /* A number is infinite or NaN. Of an input, the failure's column is its place, counted from 1. */
    LINKWRIGHT_NOT_FINITE = 10,
    /* The motion comes to a pose at which two assembly modes meet, and nothing tells in which of them it goes on: it
       rests there, or it is as smooth in both. A shorter step does not help. */
    LINKWRIGHT_UNDECIDED = 11,
    /* A load, such as an applied force or a spring, is infinite or NaN; the pose that it follows from is finite. The
       failure's column is the place of the load in the table LOADS of the mechanism. */
    LINKWRIGHT_LOAD_NOT_FINITE = 12
} linkwright_status;

/* What happened, in a few words. */
const char *linkwright_status_text(linkwright_status status);

/* One of the two signs that the determinant of a block can have. */
typedef enum linkwright_branch {
    LINKWRIGHT_NEGATIVE = -1,
    /* Of blocks that need Newton-Raphson alone: the estimate decides. */
    LINKWRIGHT_NEAREST = 0,
    LINKWRIGHT_POSITIVE = 1
} linkwright_branch;

/* What the frame is from which a block is solved. */
typedef enum linkwright_start {
    /* An estimate of the pose, which may be poor. */
    LINKWRIGHT_ESTIMATE = 0,
    /* The last frame of a motion, which goes on from there. */
    LINKWRIGHT_LAST_FRAME = 1
} linkwright_start;

/* What a block is called. */
typedef struct linkwright_block_name {
    const char *name;
    /* What can be said of its parts where it is singular or at the end of its reach. Of what must be positive, what
       it is. */
    const char *singular;
} linkwright_block_name;

/* How many numbers Newton-Raphson works with for so many unknowns, and what shows that so many stay on their path. */
#define LINKWRIGHT_NEWTON_REALS(order) ((3 * (order) * (order)) + (12 * (order)))
#define LINKWRIGHT_MOST_TEARS 2
#define LINKWRIGHT_ISOLATION_REALS(order) (((order) * (order)) + (3 * (order)))

/* What is called seldom and needs much room does not become part of what is called often. */
#if defined(__GNUC__)
#define LINKWRIGHT_APART __attribute__((noinline))
#else
#define LINKWRIGHT_APART
#endif

/* How many frames and how many assembly modes moving in several steps works with. */
#define LINKWRIGHT_SUBSTEP_FRAMES 9
#define LINKWRIGHT_WAY_BRANCHES 7
#define LINKWRIGHT_WAY_INPUTS 2
