/* measure.h - what the programs of the benchmark share: arguments, the clock and the output. */
#ifndef MEASURE_H
#define MEASURE_H

#include <stdbool.h>
#include <stddef.h>

/* The motion at one time: rad, rad/s, rad/s2. */
typedef struct {
    double theta, omega, alpha;
} Sample;

/* A finite number in a command line; the program ends with a message where it is none. */
double number_argument(const char *name, const char *text);
/* Likewise a whole number of at least `least`. */
size_t count_argument(const char *name, const char *text, size_t least);

/* Carries out `batches` times `runs` runs. Returns the seconds a run took: the median over the batches. The program
 * ends with a message where a run fails. */
double measure(bool (*run)(void *context), void *context, size_t batches, size_t runs);

/* The results as one line of JSON on standard output, with the last and the largest theta as a checksum. */
void print_result(double seconds, const Sample *samples, size_t count, unsigned long evaluations);

/* Writes a line "theta omega alpha" a sample; the program ends with a message where that fails. */
void write_samples(const char *path, const Sample *samples, size_t count);

#endif
