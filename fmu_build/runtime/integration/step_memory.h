/* step_memory.h - the last step size for each combination of relations.
 *
 * After an event, the equations may be a hundred times stiffer or softer than before. An oscillating mechanism passes
 * through the same few combinations again and again; the memory saves the search for a step size each time. */
#ifndef STEP_MEMORY_H
#define STEP_MEMORY_H

#include <stdint.h>

enum { STEP_MEMORY_SIZE = 32 };

/* Plain data; all zeros mean empty. */
typedef struct {
    uint64_t present; /* key of the combination since the last event, 0 before the first */
    uint64_t key[STEP_MEMORY_SIZE];
    double step[STEP_MEMORY_SIZE];
} StepMemory;

/* After an event: stores `step` for the previous combination; returns the step size stored for the one in p, or `step`
 * if there is none. */
double step_memory_switch(StepMemory *memory, const double *p, double step);

#endif
