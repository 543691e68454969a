#include "linkwright.h"

#include <math.h>
#include <string.h>

/* Products and sums stay two operations; for GCC see linkwright.h. */
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif
/* GCC 12 fuses them where it vectorizes straight lines of code, whatever its options are. */
#if defined(__GNUC__) && !defined(__clang__) && (defined(__FP_FAST_FMA) || defined(__FP_FAST_FMAF))
#pragma GCC optimize ("no-tree-slp-vectorize")
#endif
/* Comparisons for equality are intended, for example with zero, or with an earlier time. */
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wfloat-equal"
#endif

#if LINKWRIGHT_VERSION != $version
#error "linkwright.h and linkwright.c were written by different generators: generate both again"
#endif

const char *linkwright_status_text(linkwright_status status)
{
    const char *text = "unknown status";
    switch (status) {
    case LINKWRIGHT_OK:
        text = "solved";
        break;
    case LINKWRIGHT_SINGULAR:
        text = "singular Jacobian";
        break;
    case LINKWRIGHT_DIVERGED:
        text = "Newton-Raphson diverges";
        break;
    case LINKWRIGHT_CYCLING:
        text = "Newton-Raphson cycles";
        break;
    case LINKWRIGHT_STALLED:
        text = "Newton-Raphson stalls";
        break;
    case LINKWRIGHT_ITERATION_LIMIT:
        text = "Newton-Raphson does not converge";
        break;
    case LINKWRIGHT_OUT_OF_REACH:
        text = "out of reach";
        break;
    case LINKWRIGHT_WRONG_BRANCH:
        text = "only another assembly mode is found";
        break;
    case LINKWRIGHT_STEP_TOO_LARGE:
        text = "the step is too large for the motion to be followed";
        break;
    case LINKWRIGHT_UNDECIDED:
        text = "two assembly modes meet, and the motion does not tell them apart";
        break;
    case LINKWRIGHT_NOT_POSITIVE:
        text = "not positive";
        break;
    case LINKWRIGHT_NOT_FINITE:
        text = "a number is not finite";
        break;
    case LINKWRIGHT_LOAD_NOT_FINITE:
        text = "a load is not finite";
        break;
    default:
        break;
    }
    return text;
}
