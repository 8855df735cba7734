#define _POSIX_C_SOURCE 200809L /* clock_gettime */
#include "measure.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double number_argument(const char *name, const char *text)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || !isfinite(value)) {
        fprintf(stderr, "%s: \"%s\" is not a finite number\n", name, text);
        exit(EXIT_FAILURE);
    }
    return value;
}

size_t count_argument(const char *name, const char *text, size_t least)
{
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (end == text || *end != '\0' || *text == '-' || errno != 0 || value < least || value > SIZE_MAX) {
        fprintf(stderr, "%s: \"%s\" is not a whole number of at least %zu\n", name, text, least);
        exit(EXIT_FAILURE);
    }
    return (size_t)value;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double measure(bool (*run)(void *context), void *context, size_t batches, size_t runs)
{
    double *seconds = malloc(batches * sizeof(double));
    if (seconds == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(EXIT_FAILURE);
    }
    for (size_t batch = 0; batch < batches; ++batch) {
        const double start = now();
        for (size_t i = 0; i < runs; ++i) {
            if (!run(context)) {
                fprintf(stderr, "a run failed\n");
                exit(EXIT_FAILURE);
            }
        }
        seconds[batch] = (now() - start) / (double)runs;
    }
    qsort(seconds, batches, sizeof(double), compare);
    const double median = 0.5 * (seconds[(batches - 1) / 2] + seconds[batches / 2]);
    free(seconds);
    return median;
}

void print_result(double seconds, const Sample *samples, size_t count, unsigned long evaluations)
{
    double largest = samples[0].theta;
    for (size_t i = 1; i < count; ++i)
        largest = fmax(largest, samples[i].theta);
    printf("{\"seconds\": %.9g, \"theta_final\": %.17g, \"theta_max\": %.17g, \"evaluations\": %lu}\n", seconds,
           samples[count - 1].theta, largest, evaluations);
}

void write_samples(const char *path, const Sample *samples, size_t count)
{
    FILE *file = fopen(path, "w");
    bool written = file != NULL;
    for (size_t i = 0; written && i < count; ++i)
        written = fprintf(file, "%.17g %.17g %.17g\n", samples[i].theta, samples[i].omega, samples[i].alpha) > 0;
    if (file != NULL)
        written = fclose(file) == 0 && written;
    if (!written) {
        fprintf(stderr, "cannot write %s: %s\n", path, strerror(errno));
        exit(EXIT_FAILURE);
    }
}
