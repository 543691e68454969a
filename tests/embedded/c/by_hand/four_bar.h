/* A frame of the four-bar linkage as one writes it who needs it once: with the C library's functions, without a check.
 *
 * The names are those of the generated header, so that the same program moves it. */
#ifndef FOUR_BAR_H
#define FOUR_BAR_H

#include <stdint.h>

#ifndef REAL
#define REAL float
#endif

typedef enum linkwright_status { LINKWRIGHT_OK = 0 } linkwright_status;

typedef struct FourBarCoordinates {
    REAL x_crank, y_crank, phi_crank, x_coupler, y_coupler, phi_coupler, x_rocker, y_rocker, phi_rocker;
} FourBarCoordinates;

typedef struct FourBarFrame {
    REAL t;
    FourBarCoordinates q, qd, qdd;
} FourBarFrame;

typedef struct FourBarFailure {
    linkwright_status status;
    REAL time;
    uint16_t block;
    uint16_t iterations;
} FourBarFailure;

typedef struct FourBar {
    FourBarFrame frame;
    FourBarFailure failure;
} FourBar;

linkwright_status four_bar_assemble(FourBar *mechanism, REAL t);
linkwright_status four_bar_advance(FourBar *mechanism, REAL t);
const FourBarFrame *four_bar_frame(const FourBar *mechanism);

#endif
