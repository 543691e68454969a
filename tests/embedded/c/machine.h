/* What a machine offers besides arithmetic. */
#ifndef MACHINE_H
#define MACHINE_H

#include <stdint.h>

/* Prints a text. */
void machine_write(const char *text);
/* The instructions since some start, as ticks of which the next function makes instructions. */
uint32_t machine_now(void);
uint32_t machine_instructions(uint32_t ticks);
/* Calls a function and gives the bytes of the stack that this took. */
uint32_t machine_stack(void (*call)(void));

#endif
