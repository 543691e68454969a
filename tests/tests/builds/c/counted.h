/* Numbers of what was compared. */
#ifndef COUNTED_H
#define COUNTED_H

typedef struct Counted {
    /* Mechanisms that cannot be assembled in every lane. */
    int unassembled;
    /* Motions by their status. */
    int by_status[32];
} Counted;

#endif
