/* A machine with an operating system: prints, and counts nothing. */
#include "machine.h"

#include <stdio.h>

void machine_write(const char *text)
{
    fputs(text, stdout);
}

uint32_t machine_now(void)
{
    return 0;
}

uint32_t machine_instructions(uint32_t ticks)
{
    return ticks;
}

uint32_t machine_stack(void (*call)(void))
{
    call();
    return 0;
}
