/* A board of the family MPS2 as QEMU knows it: how it starts, prints through the debugger, and counts. */
#include "machine.h"

extern uint32_t data_source[], data_start[], data_end[], bss_start[], bss_end[];
/* No function, but as one it can stand among the vectors. */
void stack_top(void);
int main(void);
void reset(void);

/* The debugger's calls that are used here. */
enum { OPEN = 0x01, WRITE = 0x05, EXIT = 0x18, APPLICATION_EXIT = 0x20026 };

static uint32_t debugger(uint32_t operation, const void *argument)
{
    register uint32_t number __asm__("r0") = operation;
    register const void *place __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(number) : "r"(place) : "memory");
    return number;
}

/* The debugger's terminal, to be written to. */
static uint32_t terminal;

static void open_terminal(void)
{
    static const char name[] = ":tt";
    const uint32_t arguments[3] = {(uint32_t)name, 4, sizeof(name) - 1};
    terminal = debugger(OPEN, arguments);
}

void machine_write(const char *text)
{
    uint32_t length = 0;
    while (text[length] != '\0') {
        length++;
    }
    const uint32_t arguments[3] = {terminal, (uint32_t)text, length};
    (void)debugger(WRITE, arguments);
}

/* The timer 0 of the board counts down at 25 MHz. */
#define TIMER_CONTROL (*(volatile uint32_t *)0x40000000u)
#define TIMER_VALUE (*(volatile uint32_t *)0x40000004u)
#define TIMER_RELOAD (*(volatile uint32_t *)0x40000008u)

uint32_t machine_now(void)
{
    return ~TIMER_VALUE;
}

/* With -icount shift=8 an instruction takes 256 ns, and the timer ticks every 40 ns. */
uint32_t machine_instructions(uint32_t ticks)
{
    return (uint32_t)(((uint64_t)ticks * 40u + 128u) / 256u);
}

/* How far below a call the stack is looked at, in words, and what is written there before. */
#define DEPTH 32768u
#define PAINT 0xa5a55a5au

__attribute__((noinline)) uint32_t machine_stack(void (*call)(void))
{
    uint32_t *top;
    __asm__ volatile("mov %0, sp" : "=r"(top));
    volatile uint32_t *const lowest = top - DEPTH;
    volatile uint32_t *place = lowest;
    for (; place < top - 16; place++) {
        *place = PAINT;
    }
    call();
    for (place = lowest; (place < top) && (*place == PAINT); place++) {
    }
    return (uint32_t)((top - (uint32_t *)place) * sizeof(uint32_t));
}

static void hang(void)
{
    for (;;) {
    }
}

/* The stack, and the exceptions of the processor. */
__attribute__((section(".vectors"), used)) static void (*const vectors[16])(void) = {
    stack_top, reset, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang,
};

void reset(void)
{
    /* Lets the program use the floating-point unit. */
    *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb");
    const uint32_t *source = data_source;
    for (volatile uint32_t *target = data_start; target < data_end; target++) {
        *target = *source++;
    }
    for (volatile uint32_t *target = bss_start; target < bss_end; target++) {
        *target = 0;
    }
    TIMER_RELOAD = UINT32_MAX;
    TIMER_VALUE = UINT32_MAX;
    TIMER_CONTROL = 1;
    open_terminal();
    (void)main();
    (void)debugger(EXIT, (const void *)APPLICATION_EXIT);
    hang();
}
