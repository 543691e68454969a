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

LINKWRIGHT_SOURCE_BEGIN(runtime)

const char *linkwright_status_text(linkwright_status status)
{
    const char *text = "unknown status";
    switch (status) {
    case LINKWRIGHT_OK:
        text = "solved";
        break;
$status_texts    default:
        break;
    }
    return text;
}
