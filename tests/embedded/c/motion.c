/* A mechanism, moved as the Rust program moves it: prints the same lines.
 *
 * The compiler is told HEADER, the name of its header in quotes; MECHANISM and PREFIX, what its types and functions begin with; and REAL,
 * its scalar, with WORD, an integer of its size, and FAILURE, what a failure is called. */
#include HEADER
#include "machine.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define JOINED_(first, second) first##second
#define JOINED(first, second) JOINED_(first, second)
#define FUNCTION(name) JOINED(PREFIX, name)
#define FRAME JOINED(MECHANISM, Frame)

/* Frames in a second, in all, in one digest; how many long steps are taken, each of so many frames. */
enum { RATE = 1024, FRAMES = 5 * RATE, BUNDLE = RATE / 2, LONG_STEPS = 24, LONG = 200 };

static MECHANISM mechanism;
static uint32_t frame_number;
static uint64_t digest;

typedef struct work {
    uint32_t calls;
    uint64_t total;
    uint32_t worst;
} work;

static work loop_work, long_work;

/* What a loop calls, apart, so that its names are in the program. */
__attribute__((noinline)) static linkwright_status assemble(REAL t)
{
    return FUNCTION(_assemble)(&mechanism, t);
}

__attribute__((noinline)) static linkwright_status advance(REAL t)
{
    return FUNCTION(_advance)(&mechanism, t);
}

static void number(uint64_t value)
{
    char text[18];
    size_t place = sizeof(text) - 1;
    text[place] = '\0';
    do {
        text[--place] = "0123456789abcdef"[value & 15u];
        value >>= 4;
    } while (value != 0);
    text[--place] = ' ';
    machine_write(&text[place]);
}

static uint64_t bits(REAL value)
{
    WORD word;
    memcpy(&word, &value, sizeof(word));
    return word;
}

static void add(uint64_t word)
{
    const uint64_t mixed = (digest ^ word) * UINT64_C(0x100000001b3);
    digest = mixed ^ (mixed >> 32);
}

static void numbers(void (*each)(uint64_t))
{
    const FRAME *const frame = FUNCTION(_frame)(&mechanism);
    REAL values[sizeof(frame->q) / sizeof(REAL)];
    const void *const levels[3] = {&frame->q, &frame->qd, &frame->qdd};
    each(bits(frame->t));
    for (size_t level = 0; level < 3; level++) {
        memcpy(values, levels[level], sizeof(values));
        for (size_t k = 0; k < sizeof(values) / sizeof(REAL); k++) {
            each(bits(values[k]));
        }
    }
}

static void print_frame(void)
{
    machine_write("frame");
    numbers(number);
    machine_write("\n");
}

static void print_digest(void)
{
    machine_write("digest");
    number(digest);
    machine_write("\n");
}

static void print_failure(void)
{
    const FAILURE *const failure = &mechanism.failure;
    machine_write("failure");
    number((uint64_t)failure->status);
    number(isnan(failure->time) ? 0 : bits(failure->time));
    number(failure->block);
    number(failure->iterations);
    machine_write("\n");
}

static REAL time_of(uint32_t frame)
{
    return (REAL)frame / (REAL)RATE;
}

static void move(work *done, REAL t)
{
    const uint32_t start = machine_now();
    const linkwright_status status = advance(t);
    const uint32_t taken = machine_instructions(machine_now() - start);
    done->calls += 1;
    done->total += taken;
    if (taken > done->worst) {
        done->worst = taken;
    }
    if (status != LINKWRIGHT_OK) {
        print_failure();
    }
    numbers(add);
}

static void assemble_once(void)
{
    (void)assemble(time_of(0));
}

static void in_loop(void)
{
    digest = UINT64_C(0xcbf29ce484222325);
    for (frame_number = 1; frame_number <= FRAMES; frame_number++) {
        move(&loop_work, time_of(frame_number));
        if (frame_number % BUNDLE == 0) {
            print_digest();
            print_frame();
        }
    }
}

static void in_long_steps(void)
{
    digest = UINT64_C(0xcbf29ce484222325);
    frame_number = FRAMES;
    for (uint32_t step = 0; step < LONG_STEPS; step++) {
        frame_number = (step % 3 == 2) ? frame_number - LONG : frame_number + LONG;
        move(&long_work, (step % 8 == 7) ? (REAL)NAN : time_of(frame_number));
        print_digest();
    }
}

static void report(const char *what, const work *done, uint32_t stack)
{
    machine_write(what);
    number(done->calls);
    number(done->total);
    number(done->worst);
    number(stack);
    machine_write("\n");
}

int main(void)
{
    uint32_t stack = machine_stack(assemble_once);
    const uint32_t start = machine_now();
    const linkwright_status status = assemble(time_of(0));
    const uint32_t taken = machine_instructions(machine_now() - start);
    machine_write("measured state");
    number(sizeof(mechanism));
    machine_write("\nmeasured assemble");
    number(taken);
    number(stack);
    machine_write("\n");
    if (status != LINKWRIGHT_OK) {
        print_failure();
        return 0;
    }
    print_frame();
    stack = machine_stack(in_loop);
    report("measured advance", &loop_work, stack);
    stack = machine_stack(in_long_steps);
    report("measured long", &long_work, stack);
    return 0;
}
