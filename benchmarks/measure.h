/* measure.h - shared by the programs of the benchmark: arguments, the clock and the output. */
#ifndef MEASURE_H
#define MEASURE_H

#include <stdbool.h>
#include <stddef.h>

/* The motion at one time: rad, rad/s, rad/s2. */
typedef struct {
    double theta, omega, alpha;
} Sample;

/* Returns a finite number from a command-line argument; ends the program with a message if it is none. */
double number_argument(const char *name, const char *text);
/* The same for an integer of at least `least`. */
size_t count_argument(const char *name, const char *text, size_t least);

/* Carries out `batches` times `runs` runs. Returns the seconds per run: the median over the batches. Ends the program
 * with a message if a run fails. */
double measure(bool (*run)(void *context), void *context, size_t batches, size_t runs);

/* Prints the results as one line of JSON to standard output, with the last and the largest theta as a checksum. */
void print_result(double seconds, const Sample *samples, size_t count, unsigned long evaluations);

/* Writes a line "theta omega alpha" per sample; ends the program with a message if that fails. */
void write_samples(const char *path, const Sample *samples, size_t count);

#endif
