/* Closed forms of three mechanisms, written by hand for speed alone: eight instants side by side, which compilers vectorize.
 *
 * Poses, rates and accelerations of all coordinates. No branch, no check and no path; angles lie between -pi and pi. Products and sums may be
 * fused. Prints `time NAME NS`, the time of a pose, and frames of some instants: `frame NAME INSTANT NUMBERS`. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define LANES 8
#define INLINE static inline __attribute__((always_inline))

/* Largest number of coordinates. */
#define MOST 30

/* Instants of a sweep, which goes forth and back, and sweeps, of which the fastest counts. */
#define INSTANTS 500
#define SWEEPS 60

/* ------------------------------------------------------------------------------------------------------------ functions */

INLINE uint64_t bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

INLINE double number(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

typedef struct { double x, y; } vector;

/* Unit vector with this angle, of a few turns: the rest from the nearest quarter turn, by polynomials. */
INLINE vector direction(double angle)
{
    /* Adding it leaves the nearest integer in the last bits. */
    const double rounder = 6755399441055744.0;
    const double shifted = angle * 0.63661977236758134308 + rounder;
    const double quarters = shifted - rounder;
    const double y = (angle - quarters * 1.5707963267923333) - quarters * 2.563344151594519e-12;
    const double z = y * y, fourth = z * z, eighth = fourth * fourth;
    const double bend = (-0.1666666666666663 + z * 0.00833333333332184) +
                        fourth * (-0.00019841269829358484 + z * 2.7557313538483216e-6) +
                        eighth * (-2.505073438205976e-8 + z * 1.589543274989012e-10);
    const double rise = (0.041666666666666595 + z * -0.0013888888888873307) +
                        fourth * (2.480158728896531e-5 + z * -2.7557314203131543e-7) +
                        eighth * (2.087570315049668e-9 + z * -1.1358617758465667e-11);
    const uint64_t sine = bits(y + y * z * bend), cosine = bits((1.0 - 0.5 * z) + fourth * rise);
    const uint64_t quadrant = bits(shifted);
    const uint64_t different = (sine ^ cosine) & (0 - (quadrant & 1));
    return (vector){number(cosine ^ different ^ (((quadrant + 1) & 2) << 62)),
                    number(sine ^ different ^ ((quadrant & 2) << 62))};
}

/* Angle of a vector: one quotient of magnitude 1/2 at most, and a polynomial. */
INLINE double angle_of(vector v)
{
    const double quarter = 0.78539816339744830962, half = 1.57079632679489661923;
    const double across = fabs(v.y), along = fabs(v.x);
    const double low = across > along ? along : across, high = across > along ? across : along;
    const double numerator = low > 0.5 * high ? low - high : low;
    const double denominator = low > 0.5 * high ? low + high : high;
    const double x = numerator / denominator;
    const double z = x * x, fourth = z * z, eighth = fourth * fourth;
    const double bend = ((0.3333333333333298 + z * -0.1999999999990311) +
                         fourth * (0.14285714276385547 + z * -0.11111110659606666)) +
                        eighth * (((0.0909089624363649 + z * -0.0769207389053018) +
                                   fourth * (0.06663810351291395 + z * -0.05858296891311183)) +
                                  eighth * ((0.05121995960854574 + z * -0.04186474804083825) +
                                            fourth * (0.02743444999642423 + z * -0.010116482732360559)));
    double angle = (low > 0.5 * high ? quarter : 0.0) + (x - x * z * bend);
    angle = across > along ? half - angle : angle;
    angle = v.x < 0.0 ? 2.0 * half - angle : angle;
    return copysign(angle, v.y);
}

/* -------------------------------------------------------------------------------------------------------------- geometry */

INLINE vector plus(vector a, vector b) { return (vector){a.x + b.x, a.y + b.y}; }
INLINE vector minus(vector a, vector b) { return (vector){a.x - b.x, a.y - b.y}; }
INLINE vector times(double f, vector a) { return (vector){f * a.x, f * a.y}; }
INLINE vector left_of(vector a) { return (vector){-a.y, a.x}; }
INLINE double dot(vector a, vector b) { return a.x * b.x + a.y * b.y; }
INLINE double cross(vector a, vector b) { return a.x * b.y - a.y * b.x; }

/* A point, its velocity and its acceleration. */
typedef struct { vector at, rate, acceleration; } motion;

/* Direction of a body, with its angular velocity and acceleration. */
typedef struct { vector unit; double rate, acceleration; } rotation;

INLINE motion fixed(double x, double y) { return (motion){{x, y}, {0.0, 0.0}, {0.0, 0.0}}; }

INLINE motion difference(motion a, motion b)
{
    return (motion){minus(a.at, b.at), minus(a.rate, b.rate), minus(a.acceleration, b.acceleration)};
}

/* Point of a body, by its place in the body's frame, whose origin is `pivot`. */
INLINE motion carried(motion pivot, rotation r, vector place)
{
    const vector arm = {r.unit.x * place.x - r.unit.y * place.y, r.unit.y * place.x + r.unit.x * place.y};
    const vector normal = left_of(arm);
    const double centripetal = r.rate * r.rate;
    return (motion){
        plus(pivot.at, arm),
        plus(pivot.rate, times(r.rate, normal)),
        plus(pivot.acceleration, minus(times(r.acceleration, normal), times(centripetal, arm))),
    };
}

/* Unit vector of the rotation from one vector to another of the same length. */
INLINE vector turned(vector from, vector to)
{
    const double inverse = 1.0 / dot(from, from);
    return (vector){dot(from, to) * inverse, cross(from, to) * inverse};
}

/* First side of a triangle from its base and both squared sides; the side is to the left (1) or to the right (-1). */
INLINE vector first_side(vector base, double first, double second, double side)
{
    const double square = dot(base, base);
    const double along = 0.5 * (square + first - second);
    const double across = side * sqrt(first * square - along * along);
    const double inverse = 1.0 / square;
    return plus(times(along * inverse, base), times(across * inverse, left_of(base)));
}

/* Two links from pin to pin: their vectors, and their rotations without direction. */
typedef struct { vector first, second; rotation of_first, of_second; } dyad;

INLINE dyad two_links(motion base, double first, double second, double side)
{
    dyad d;
    d.first = first_side(base.at, first, second, side);
    d.second = minus(base.at, d.first);
    const double inverse = 1.0 / cross(d.first, d.second);
    d.of_first.rate = dot(base.rate, d.second) * inverse;
    d.of_second.rate = -dot(base.rate, d.first) * inverse;
    const vector load = plus(base.acceleration, plus(times(d.of_first.rate * d.of_first.rate, d.first),
                                                     times(d.of_second.rate * d.of_second.rate, d.second)));
    d.of_first.acceleration = dot(load, d.second) * inverse;
    d.of_second.acceleration = -dot(load, d.first) * inverse;
    return d;
}

/* ------------------------------------------------------------------------------------------------------------ mechanisms */

/* Frames of eight instants: coordinate by coordinate, then rates, then accelerations. `out` is that of one lane. */
INLINE void put(double *restrict out, int count, int body, motion origin, double angle, rotation r)
{
    double *restrict q = out + 3 * body * LANES;
    double *restrict qd = q + count * LANES;
    double *restrict qdd = qd + count * LANES;
    q[0] = origin.at.x, q[LANES] = origin.at.y, q[2 * LANES] = angle;
    qd[0] = origin.rate.x, qd[LANES] = origin.rate.y, qd[2 * LANES] = r.rate;
    qdd[0] = origin.acceleration.x, qdd[LANES] = origin.acceleration.y, qdd[2 * LANES] = r.acceleration;
}

INLINE void two_body(double t, double *restrict out)
{
    const double length = 1.73205080756887729353;
    const vector phase = direction(2.0 * t);
    const double angle = 0.52359877559829887308 + phase.y;
    const rotation crank = {direction(angle), 2.0 * phase.x, -4.0 * phase.y};
    const motion origin = fixed(0.0, 0.0);
    const motion pin = carried(origin, crank, (vector){1.0, 0.0});
    rotation rod;
    rod.unit.x = 1.0 - pin.at.x * (1.0 / length);
    rod.unit.y = sqrt(1.0 - rod.unit.x * rod.unit.x);
    const double inverse = 1.0 / (length * rod.unit.y);
    rod.rate = pin.rate.x * inverse;
    rod.acceleration = (pin.acceleration.x - length * rod.unit.x * rod.rate * rod.rate) * inverse;
    motion end = carried(pin, rod, (vector){length, 0.0});
    end.at.x = length, end.rate.x = 0.0, end.acceleration.x = 0.0;
    put(out, 6, 0, origin, angle, crank);
    put(out, 6, 1, end, angle_of(rod.unit), rod);
}

INLINE void four_bar(double t, double *restrict out)
{
    const double angle = 0.69813170079773183 + 3.0 * t;
    const rotation crank = {direction(angle), 3.0, 0.0};
    const motion origin = fixed(0.0, 0.0), support = fixed(0.1, 0.0);
    const motion pin = carried(origin, crank, (vector){0.04, 0.0});
    const dyad d = two_links(difference(support, pin), 0.12 * 0.12, 0.08 * 0.08, 1.0);
    put(out, 9, 0, origin, angle, crank);
    put(out, 9, 1, pin, angle_of(d.first), d.of_first);
    put(out, 9, 2, support, angle_of(times(-1.0, d.second)), d.of_second);
}

/* A body on a pivot, its pin that a cylinder moves, and the rotation of the cylinder. */
typedef struct { rotation body; motion pin; rotation cylinder; } lifted;

/* `arm` is from the pivot to the pin in the design; the cylinder has a length with its rate and acceleration. */
INLINE lifted lift(motion pivot, vector arm, vector foot, double length, double rate, double acceleration)
{
    lifted l;
    const vector base = minus(foot, pivot.at);
    const vector to_pin = first_side(base, dot(arm, arm), length * length, -1.0);
    const vector rod = minus(to_pin, base);
    const double lever = 1.0 / cross(to_pin, rod);
    l.body.unit = turned(arm, to_pin);
    l.body.rate = (length * rate - dot(rod, pivot.rate)) * lever;
    const vector velocity = plus(pivot.rate, times(l.body.rate, left_of(to_pin)));
    const vector centripetal = minus(pivot.acceleration, times(l.body.rate * l.body.rate, to_pin));
    l.body.acceleration =
        (rate * rate + length * acceleration - dot(velocity, velocity) - dot(rod, centripetal)) * lever;
    l.pin.at = plus(pivot.at, to_pin);
    l.pin.rate = velocity;
    l.pin.acceleration = plus(centripetal, times(l.body.acceleration, left_of(to_pin)));
    const double inverse = 1.0 / length;
    l.cylinder.unit = times(inverse, rod);
    l.cylinder.rate = cross(l.cylinder.unit, l.pin.rate) * inverse;
    l.cylinder.acceleration =
        (cross(l.cylinder.unit, l.pin.acceleration) - 2.0 * rate * l.cylinder.rate) * inverse;
    return l;
}

INLINE void excavator(double t, double *restrict out)
{
    const vector A = {-1.0, 0.2}, B = {-0.7, 0.8}, D = {-0.2, 0.5}, E = {0.1, 0.8}, F = {0.9, 0.7}, G = {0.3, 0.6};
    const vector I = {0.7, 0.3}, J = {0.0, 0.9}, M = {0.2, 0.6};
    const motion H = fixed(0.7, -0.4), L = fixed(0.6, 0.3), N = fixed(0.4, -0.2);
    const double hg = 1.07703296142690080625, nm = 0.82462112512353210996;
    const vector phase = direction(1.5 * t);
    const double stroke = 0.05 * phase.y, rate = 0.075 * phase.x, acceleration = -0.1125 * phase.y;

    const lifted boom = lift(L, minus(G, L.at), H.at, hg + stroke, rate, acceleration);
    const motion f = carried(L, boom.body, minus(F, L.at));
    const motion i = carried(L, boom.body, minus(I, L.at));
    const lifted upper = lift(f, minus(M, F), N.at, nm + stroke, rate, acceleration);
    const motion e = carried(f, upper.body, minus(E, F));
    const motion j = carried(f, upper.body, minus(J, F));

    const vector id = minus(D, I), de = minus(E, D), ab = minus(B, A), bj = minus(J, B);
    dyad inner = two_links(difference(e, i), dot(id, id), dot(de, de), 1.0);
    inner.of_first.unit = turned(id, inner.first), inner.of_second.unit = turned(de, inner.second);
    const motion a = carried(i, inner.of_first, minus(A, I));
    dyad outer = two_links(difference(j, a), dot(ab, ab), dot(bj, bj), 1.0);
    outer.of_first.unit = turned(ab, outer.first), outer.of_second.unit = turned(bj, outer.second);

    /* Centers of mass. */
    const vector c1 = {-0.95, 0.55}, c2 = {0.4, 0.75}, c3 = {0.6, 0.5}, c4 = {-0.10, 0.35}, c5 = {-0.35, 0.85}, c6 = {-0.05, 0.65};
    put(out, 30, 0, carried(a, outer.of_first, minus(c1, A)), angle_of(outer.of_first.unit), outer.of_first);
    put(out, 30, 1, carried(f, upper.body, minus(c2, F)), angle_of(upper.body.unit), upper.body);
    put(out, 30, 2, carried(L, boom.body, minus(c3, L.at)), angle_of(boom.body.unit), boom.body);
    put(out, 30, 3, carried(i, inner.of_first, minus(c4, I)), angle_of(inner.of_first.unit), inner.of_first);
    put(out, 30, 4, carried(j, outer.of_second, minus(c5, J)), angle_of(outer.of_second.unit), outer.of_second);
    put(out, 30, 5, carried(e, inner.of_second, minus(c6, E)), angle_of(inner.of_second.unit), inner.of_second);
    const double of_upper = angle_of(upper.cylinder.unit), of_boom = angle_of(boom.cylinder.unit);
    put(out, 30, 6, carried(upper.pin, upper.cylinder, (vector){-0.25 * nm, 0.0}), of_upper, upper.cylinder);
    put(out, 30, 7, carried(N, upper.cylinder, (vector){0.25 * nm, 0.0}), of_upper, upper.cylinder);
    put(out, 30, 8, carried(boom.pin, boom.cylinder, (vector){-0.25 * hg, 0.0}), of_boom, boom.cylinder);
    put(out, 30, 9, carried(H, boom.cylinder, (vector){0.25 * hg, 0.0}), of_boom, boom.cylinder);
}

/* ----------------------------------------------------------------------------------------------------------- measurement */

#define EIGHT(name)                                                                                                  \
    __attribute__((noinline)) static void name##_lanes(const double *restrict t, double *restrict out)              \
    {                                                                                                                \
        _Pragma("GCC ivdep") for (int lane = 0; lane < LANES; lane++) name(t[lane], out + lane);                     \
    }

EIGHT(two_body)
EIGHT(four_bar)
EIGHT(excavator)

typedef void solve(const double *restrict t, double *restrict out);

static double out[3 * MOST * LANES] __attribute__((aligned(64)));

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void at(solve *mechanism, double step, int instant)
{
    double t[LANES] __attribute__((aligned(64)));
    for (int lane = 0; lane < LANES; lane++) t[lane] = step * (instant + lane / (double)LANES);
    mechanism(t, out);
}

static void measure(const char *name, solve *mechanism, int count, double step)
{
    double fastest = INFINITY;
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        const double begun = seconds();
        for (int instant = 0; instant < INSTANTS; instant++) at(mechanism, step, instant);
        for (int instant = INSTANTS - 1; instant >= 0; instant--) at(mechanism, step, instant);
        const double elapsed = seconds() - begun;
        fastest = elapsed < fastest ? elapsed : fastest;
    }
    printf("time %s %.4f\n", name, 1e9 * fastest / (2 * INSTANTS * LANES));
    for (int instant = 0; instant < INSTANTS; instant += 100) {
        at(mechanism, step, instant);
        printf("frame %s %d", name, instant);
        for (int place = 0; place < 3 * count; place++) printf(" %.17g", out[place * LANES]);
        printf("\n");
    }
}

int main(void)
{
    measure("two_body", two_body_lanes, 6, 0.001);
    measure("four_bar", four_bar_lanes, 9, 0.01);
    measure("excavator", excavator_lanes, 30, 0.01);
    return 0;
}
