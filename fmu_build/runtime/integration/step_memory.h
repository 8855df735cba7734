/* step_memory.h - the step size that last suited each combination of relations.
 *
 * Behind an event the equations may be a hundred times stiffer or softer than before it. A mechanism that goes to
 * and fro meets the same few combinations again and again, and need not find out each time. */
#ifndef STEP_MEMORY_H
#define STEP_MEMORY_H

#include <stdint.h>

enum { STEP_MEMORY_SIZE = 32 };

/* Plain data; all zeros is empty. */
typedef struct {
    uint64_t present; /* key of the combination since the last event, 0 before the first */
    uint64_t key[STEP_MEMORY_SIZE];
    double step[STEP_MEMORY_SIZE];
} StepMemory;

/* After an event: keeps `step` for the combination that has ended, and returns what suited the one in p, or `step`
 * where that is not known. */
double step_memory_switch(StepMemory *memory, const double *p, double step);

#endif
