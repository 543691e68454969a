/* What all the bits of many results of the runtime's elementary functions come down to: see elementary.rs. */
#include "linkwright.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static uint64_t state = 14U;
static uint64_t digest;

static uint64_t half_word(void)
{
    state = (state * 6364136223846793005U) + 1442695040888963407U;
    return state >> 32;
}

static uint64_t word(void)
{
    const uint64_t upper = half_word();
    return (upper << 32) | half_word();
}

static void add(uint64_t bits)
{
    digest = (digest ^ bits) * 0x00000100000001b3U;
}

static void add_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    add(bits);
}

static void add_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof(bits));
    add(bits);
}

static double of_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

static float of_short_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

static double of_size(uint64_t bits, uint64_t size)
{
    return of_bits((bits & ~((uint64_t)0x7ffU << 52)) | ((1023U - 32U + (bits % size)) << 52));
}

static void angles(double angle)
{
    double sine;
    double cosine;
    float short_sine;
    float short_cosine;
    linkwright_sin_cos(angle, &sine, &cosine);
    add_double(sine);
    add_double(cosine);
    linkwrightf_sin_cos((float)angle, &short_sine, &short_cosine);
    if (isfinite(short_sine)) {
        add_float(short_sine);
        add_float(short_cosine);
    }
}

int main(void)
{
    digest = 0xcbf29ce484222325U;
    for (int round = 0; round < 200000; round += 1) {
        const uint64_t a = word();
        const uint64_t b = word();
        angles(of_size(a, 50U));
        angles(of_bits(a & ~((uint64_t)1U << 62)));
        const double y = of_size(a, 40U);
        const double x = of_size(b, 40U);
        const double near_angle = of_size(a ^ b, 40U);
        add_double(linkwright_atan2(y, x));
        add_double(linkwright_angle_near(y, x, near_angle));
        add_float(linkwrightf_atan2((float)y, (float)x));
        add_float(linkwrightf_angle_near((float)y, (float)x, (float)near_angle));
    }
    printf("%016" PRIx64 "\n", digest);
    digest = 0xcbf29ce484222325U;
    for (uint32_t bits = 0U; bits < 0x7f800000U; bits += 257U) {
        float sine;
        float cosine;
        linkwrightf_sin_cos(of_short_bits(bits), &sine, &cosine);
        add_float(sine);
        add_float(cosine);
        add_float(linkwrightf_atan2(of_short_bits(bits), 1.0f));
        add_float(linkwrightf_atan2(-1.0f, of_short_bits(bits)));
        add_float(linkwrightf_exp(of_short_bits(bits)));
        add_float(linkwrightf_exp(-of_short_bits(bits)));
        add_double(linkwright_exp((double)of_short_bits(bits) * 1.1));
        add_double(linkwright_exp((double)of_short_bits(bits) * -1.1));
    }
    printf("%016" PRIx64 "\n", digest);
    digest = 0xcbf29ce484222325U;
    const double odd[10] = {0.0, -0.0, 1.0, -1.0, 1e-320, -1e-320, 1e308, -1e308, HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 10; i += 1) {
        for (int j = 0; j < 10; j += 1) {
            add_double(linkwright_atan2(odd[i], odd[j]));
            add_float(linkwrightf_atan2((float)odd[i], (float)odd[j]));
        }
    }
    printf("%016" PRIx64 "\n", digest);
    return 0;
}
