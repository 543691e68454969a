/* Freudenstein's way: the diagonal from the crank's pin to the rocker's, the law of cosines at both of its ends, then two linear
 * equations for the rates and two for the accelerations. */
#include "four_bar.h"

#include <math.h>

#define CRANK ((REAL)0.04)
#define COUPLER ((REAL)0.12)
#define ROCKER ((REAL)0.08)
#define GROUND ((REAL)0.1)
#define SPEED ((REAL)3.0)
#define START ((REAL)0.6981317007977318)

/* sinf for float, sin for double. */
#define SIN(x) ((sizeof(REAL) == sizeof(float)) ? (REAL)sinf((float)(x)) : (REAL)sin((double)(x)))
#define COS(x) ((sizeof(REAL) == sizeof(float)) ? (REAL)cosf((float)(x)) : (REAL)cos((double)(x)))
#define ACOS(x) ((sizeof(REAL) == sizeof(float)) ? (REAL)acosf((float)(x)) : (REAL)acos((double)(x)))
#define ATAN2(y, x) \
    ((sizeof(REAL) == sizeof(float)) ? (REAL)atan2f((float)(y), (float)(x)) : (REAL)atan2((double)(y), (double)(x)))
#define SQRT(x) ((sizeof(REAL) == sizeof(float)) ? (REAL)sqrtf((float)(x)) : (REAL)sqrt((double)(x)))

linkwright_status four_bar_advance(FourBar *mechanism, REAL t)
{
    FourBarFrame *const frame = &mechanism->frame;
    FourBarCoordinates *const q = &frame->q;
    FourBarCoordinates *const qd = &frame->qd;
    FourBarCoordinates *const qdd = &frame->qdd;
    frame->t = t;
    q->phi_crank = START + SPEED * t;
    q->x_coupler = CRANK * COS(q->phi_crank);
    q->y_coupler = CRANK * SIN(q->phi_crank);
    const REAL dx = GROUND - q->x_coupler;
    const REAL dy = -q->y_coupler;
    const REAL diagonal = SQRT(dx * dx + dy * dy);
    const REAL direction = ATAN2(dy, dx);
    const REAL at_crank =
        ACOS((diagonal * diagonal + COUPLER * COUPLER - ROCKER * ROCKER) / (2 * diagonal * COUPLER));
    q->phi_coupler = direction + at_crank;
    const REAL sin_coupler = SIN(q->phi_coupler);
    const REAL cos_coupler = COS(q->phi_coupler);
    q->phi_rocker = ATAN2(COUPLER * sin_coupler - dy, COUPLER * cos_coupler - dx);
    const REAL sin_rocker = SIN(q->phi_rocker);
    const REAL cos_rocker = COS(q->phi_rocker);
    q->x_rocker = GROUND;
    const REAL determinant = sin_rocker * cos_coupler - cos_rocker * sin_coupler;
    qd->phi_crank = SPEED;
    qd->x_coupler = -q->y_coupler * SPEED;
    qd->y_coupler = q->x_coupler * SPEED;
    qd->phi_coupler = -(qd->x_coupler * cos_rocker + qd->y_coupler * sin_rocker) / (COUPLER * determinant);
    qd->phi_rocker = -(qd->x_coupler * cos_coupler + qd->y_coupler * sin_coupler) / (ROCKER * determinant);
    qdd->x_coupler = -q->x_coupler * SPEED * SPEED;
    qdd->y_coupler = -q->y_coupler * SPEED * SPEED;
    const REAL coupler = COUPLER * qd->phi_coupler * qd->phi_coupler;
    const REAL rocker = ROCKER * qd->phi_rocker * qd->phi_rocker;
    const REAL ax = qdd->x_coupler - coupler * cos_coupler + rocker * cos_rocker;
    const REAL ay = qdd->y_coupler - coupler * sin_coupler + rocker * sin_rocker;
    qdd->phi_coupler = -(ax * cos_rocker + ay * sin_rocker) / (COUPLER * determinant);
    qdd->phi_rocker = -(ax * cos_coupler + ay * sin_coupler) / (ROCKER * determinant);
    return LINKWRIGHT_OK;
}

linkwright_status four_bar_assemble(FourBar *mechanism, REAL t)
{
    return four_bar_advance(mechanism, t);
}

const FourBarFrame *four_bar_frame(const FourBar *mechanism)
{
    return &mechanism->frame;
}
