 * The runtime of generated mechanisms: sines, cosines and angles, Newton-Raphson, linear solves, and the motion of a
 * mechanism from frame to frame on one smooth path.
 *
 * It is C99; this file is also C++. The runtime does not allocate, has no state of its own and is not recursive; the
 * work of every call is bounded. Names that begin with linkwright_ are for double, those with linkwrightf_ for float.
 * The runtime uses memcpy of the standard library, the exact functions of <math.h> (sqrt, floor, round, fabs, copysign,
 * ldexp), and log and pow for descriptions that have them.
 *
 * The same bits everywhere: every operation is one of IEEE 754, in the order in which it is written. The compiler must
 * neither contract a product and a sum into one operation nor reorder them. Clang reads the pragma in the .c files.
 * GCC does not: give it -std=c99 or -ffp-contract=off. GCC 12 contracts in spite of them if it vectorizes straight-line
 * code for a processor with fused operations (-mfma, -march=native); a pragma in the .c files prevents that, and so
 * does -fno-tree-slp-vectorize. In GNU mode (-std=gnu99 and later, as Arduino compiles) GCC contracts on a processor
 * with fused operations, such as a Cortex-M4F: all bounds, failures and guarantees hold there too, but the last bits
 * may differ from those of another build. -ffast-math is refused.
 *
 * This file is part of the output of the generator. Anyone who generates it may use, change and distribute it and
 * everything generated beside it for any purpose and under any licence, without a notice. Warranties are excluded. */
#ifndef LINKWRIGHT_H
#define LINKWRIGHT_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Version of the generator: generated files refuse that of another one. */
#define LINKWRIGHT_VERSION $version

#if defined(__FAST_MATH__)
#error "linkwright: -ffast-math reorders sums and ignores NaN; compile without it"
#endif

/* Qualifiers of every function that a frame needs: nothing, or __host__ __device__ for CUDA and HIP, in C++17. */
#ifdef LINKWRIGHT_FUNCTION
#define LINKWRIGHT_DEVICE
#ifndef __cplusplus
#error "linkwright: LINKWRIGHT_FUNCTION is for C++17"
#endif
#else
#define LINKWRIGHT_FUNCTION
#endif

/* Public constants. A device does not see variables of the host: for it, functions return their addresses, and macros
   of their names call these. */
#ifdef LINKWRIGHT_DEVICE
#define LINKWRIGHT_CONSTANT(type, name) LINKWRIGHT_FUNCTION const type *name##_ADDRESS()
#define LINKWRIGHT_CONSTANTS(type, name, count) LINKWRIGHT_FUNCTION const type *name##_ADDRESS()
#define LINKWRIGHT_CONSTANT_BEGIN(type, name) \
    LINKWRIGHT_FUNCTION const type *name##_ADDRESS() { static const type constant =
#define LINKWRIGHT_CONSTANT_END ; return &constant; }
#define LINKWRIGHT_CONSTANTS_BEGIN(type, name, count) \
    LINKWRIGHT_FUNCTION const type *name##_ADDRESS() { static const type constants[count] =
#define LINKWRIGHT_CONSTANTS_END ; return constants; }
#else
#define LINKWRIGHT_CONSTANT(type, name) extern const type name
#define LINKWRIGHT_CONSTANTS(type, name, count) extern const type name[count]
#define LINKWRIGHT_CONSTANT_BEGIN(type, name) const type name =
#define LINKWRIGHT_CONSTANTS_BEGIN(type, name, count) const type name[count] =
#define LINKWRIGHT_CONSTANT_END ;
#define LINKWRIGHT_CONSTANTS_END ;
#endif

/* Brackets of a header and of its source. A program for a device includes several sources: their names stay apart. */
#if defined(LINKWRIGHT_DEVICE)
#define LINKWRIGHT_HEADER_BEGIN(name) inline namespace linkwright_##name {
#define LINKWRIGHT_HEADER_END }
#define LINKWRIGHT_SOURCE_BEGIN(name) inline namespace linkwright_##name {
#define LINKWRIGHT_SOURCE_END }
#else
#if defined(__cplusplus)
#define LINKWRIGHT_HEADER_BEGIN(name) extern "C" {
#define LINKWRIGHT_HEADER_END }
#else
#define LINKWRIGHT_HEADER_BEGIN(name)
#define LINKWRIGHT_HEADER_END
#endif
#define LINKWRIGHT_SOURCE_BEGIN(name)
#define LINKWRIGHT_SOURCE_END
#endif

LINKWRIGHT_HEADER_BEGIN(runtime)

/* Status: LINKWRIGHT_OK, or the reason for a call without a frame. */
typedef enum linkwright_status {
    LINKWRIGHT_OK = 0,
$statuses} linkwright_status;

/* Words for a status, on the host. */
const char *linkwright_status_text(linkwright_status status);

/* Sign of a block's determinant. */
typedef enum linkwright_branch {
    LINKWRIGHT_NEGATIVE = -1,
    /* For blocks that need Newton-Raphson alone: the estimate decides. */
    LINKWRIGHT_NEAREST = 0,
    LINKWRIGHT_POSITIVE = 1
} linkwright_branch;

/* Kind of the frame from which a block is solved. */
typedef enum linkwright_start {
    /* Estimate of the pose, which may be poor. */
    LINKWRIGHT_ESTIMATE = 0,
    /* Last frame of a motion, which continues from there. */
    LINKWRIGHT_LAST_FRAME = 1
} linkwright_start;

/* Part of a passage through change points: at the ends of a path, at its break, or the decision about the break. */
typedef enum linkwright_passage {
    LINKWRIGHT_PASSAGE_OF_ENDS = 0,
    LINKWRIGHT_PASSAGE_OF_BREAK = 1,
    LINKWRIGHT_PASSAGE_IS_UNDECIDED = 2
} linkwright_passage;

/* Name of a block. */
typedef struct linkwright_block_name {
    const char *name;
    /* State of the block's members at a singular pose or at the end of reach; for a quantity that must be positive,
       its kind. */
    const char *singular;
} linkwright_block_name;

/* Number of reals that Newton-Raphson needs for so many unknowns, and that the verification of their path needs. */
#define LINKWRIGHT_NEWTON_REALS(order) ((3 * (order) * (order)) + (12 * (order)))
#define LINKWRIGHT_MOST_TEARS 2
#define LINKWRIGHT_ISOLATION_REALS(order) (((order) * (order)) + (3 * (order)))

/* Keeps functions that are called seldom and need much stack out of those that are called often. */
#if defined(__GNUC__)
#define LINKWRIGHT_APART __attribute__((noinline))
#else
#define LINKWRIGHT_APART
#endif

/* Number of frames, of assembly modes and of inputs that a motion in several steps needs. */
#define LINKWRIGHT_SUBSTEP_FRAMES 9
#define LINKWRIGHT_WAY_BRANCHES 7
#define LINKWRIGHT_WAY_INPUTS 2
