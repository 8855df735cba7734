/* module_face.c - calls every function of the face of a WebAssembly module, for a sanitizer to watch: runs by each of its
 * ways, which must be the same bit for bit, and calls that it must refuse.
 *
 * Arguments: stop time, number of rows, then variables: a letter and a value reference, such as r3. Of the letters 'r', 'i'
 * and 'b' of explore_run they are recorded; of the letter 'u' they are Real inputs. */
#include "explore.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEMAND(HOLDS)                                                           \
    do {                                                                        \
        if (!(HOLDS)) {                                                         \
            fprintf(stderr, "violated: %s\n%s\n", #HOLDS, explore_message());   \
            exit(1);                                                            \
        }                                                                       \
    } while (0)

static int32_t rows, n, n_inputs;
static double stop, step;
static uint32_t *references, *inputs;
static char *kinds;
static double *values, *slopes, *times;

/* Blocks of just the size that is needed, so that a sanitizer sees each step over their end. */
static void *block(size_t size)
{
    void *memory = calloc(size > 0 ? size : 1, 1);
    DEMAND(memory != NULL);
    return memory;
}

static void refused(int32_t status)
{
    DEMAND(status != 0);
    DEMAND(explore_status() == status);
    DEMAND(explore_message()[0] != '\0');
}

static void refuse_without_begin(void)
{
    double row[1];
    refused(explore_set_real(1, references, row));
    refused(explore_set_integer(1, references, (int32_t[]){1}));
    refused(explore_set_boolean(1, references, (int32_t[]){1}));
    refused(explore_initialize());
    refused(explore_step(0.0, 0.1));
    DEMAND(explore_run(1, references, kinds, 1, 0.0, 0.1, row) == 0);
    DEMAND(explore_time() == 0.0);
}

static void begin(void)
{
    DEMAND(explore_begin(0.0, stop, 1e-8) == 0);
    DEMAND(explore_initialize() == 0);
    /* Half as many rows as the run has: the last one stays. */
    explore_inputs(n_inputs, inputs, rows / 2, values, slopes);
}

static double *table(void)
{
    return block(sizeof(double) * (size_t)(rows * n));
}

static void runs(void)
{
    double *first = table(), *second = table(), *third = table();
    begin();
    DEMAND(explore_run(n, references, kinds, rows, 0.0, step, first) == rows);
    begin();
    DEMAND(explore_run(n, references, kinds, rows, 0.0, step, second) == rows);
    begin();
    DEMAND(explore_record(n, references, kinds, rows, times, third) == rows);
    const size_t size = sizeof(double) * (size_t)(rows * n);
    DEMAND(memcmp(first, second, size) == 0);
    DEMAND(memcmp(first, third, size) == 0);
    for (int32_t i = 0; i < rows * n; ++i)
        DEMAND(isfinite(first[i]));
    DEMAND(fabs(explore_time() - times[rows - 1]) < 1e-12);
    free(first), free(second), free(third);
}

static void wrong_calls(void)
{
    double row[1];
    const uint32_t unknown = 4000000000u;
    begin();
    DEMAND(explore_step(0.0, step) == 0);
    refused(explore_step(0.0, -step));
    DEMAND(explore_begin(0.0, stop, 0.0) == 0);
    refused(explore_set_real(1, &unknown, row));
    refused(explore_begin(NAN, stop, 0.0));
    DEMAND(explore_begin(0.0, stop, 0.0) == 0);
    DEMAND(explore_initialize() == 0);
    DEMAND(explore_run(1, &unknown, "r", 1, 0.0, step, row) == 0);
    DEMAND(explore_message()[0] != '\0');
    DEMAND(explore_begin(0.0, stop, 0.0) == 0);
    DEMAND(explore_initialize() == 0);
    DEMAND(explore_run(1, references, "x", 1, 0.0, step, row) == 0);
    DEMAND(explore_message()[0] != '\0');
}

int main(int count, char **arguments)
{
    DEMAND(count > 3);
    stop = atof(arguments[1]);
    rows = atoi(arguments[2]);
    step = stop / (rows - 1);
    references = block(sizeof *references * (size_t)count);
    inputs = block(sizeof *inputs * (size_t)count);
    kinds = block((size_t)count);
    for (int i = 3; i < count; ++i) {
        const uint32_t reference = (uint32_t)strtoul(arguments[i] + 1, NULL, 10);
        if (arguments[i][0] == 'u') {
            inputs[n_inputs++] = reference;
        } else {
            kinds[n] = arguments[i][0];
            references[n++] = reference;
        }
    }
    times = block(sizeof(double) * (size_t)rows);
    const size_t size = sizeof(double) * (size_t)(rows / 2 * n_inputs);
    values = block(size), slopes = block(size);
    for (int32_t row = 0; row < rows; ++row) {
        times[row] = 0.0 + step * row;
        for (int32_t i = 0; i < n_inputs && row < rows / 2; ++i) {
            values[row * n_inputs + i] = sin(times[row] + i);
            slopes[row * n_inputs + i] = cos(times[row] + i);
        }
    }
    refuse_without_begin();
    runs();
    wrong_calls();
    free(references), free(inputs), free(kinds), free(times), free(values), free(slopes);
    return 0;
}
