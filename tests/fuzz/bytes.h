/* bytes.h - a fuzzer's bytes as the arguments of FMI calls. When the bytes run out, everything is zero. */
#ifndef BYTES_H
#define BYTES_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CALLS = 60, MAX_REFERENCES = 4, MAX_NUMBERS = 32, MAX_STATES = 4, STATE_HEADER = 96, STATE_CHECKSUM = 24 };

/* Most references are below this. A generated model is compiled with the number of its variables. */
#ifndef MAX_REFERENCE
#define MAX_REFERENCE 20
#endif

/* Of tests/fmu_build/runtime/allocations.c. */
long test_live(void);
void test_fail_after(long number);

typedef struct {
    const uint8_t *at, *end;
} Bytes;

static inline unsigned take(Bytes *bytes)
{
    return bytes->at == bytes->end ? 0 : *bytes->at++;
}

static inline unsigned below(Bytes *bytes, unsigned limit)
{
    return take(bytes) % limit;
}

static inline void take_raw(Bytes *bytes, void *to, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        ((uint8_t *)to)[i] = (uint8_t)take(bytes);
}

/* An extreme value, any bits, or a number of ordinary size. */
static inline double take_number(Bytes *bytes)
{
    static const double extremes[] = {0.0,     -0.0,    NAN,    INFINITY, -INFINITY, DBL_MAX, -DBL_MAX,
                                      DBL_MIN, 5e-324,  1e298,  -1e298,   1e-12,     1.0,     -1.0,
                                      1e8,     DBL_EPSILON, 0.5, 1e16};
    double any;
    switch (below(bytes, 4)) {
    case 0:
        return extremes[below(bytes, sizeof extremes / sizeof *extremes)];
    case 1:
        take_raw(bytes, &any, sizeof any);
        return any;
    default:
        return ((int)take(bytes) - 128) * pow(10.0, (int)below(bytes, 5) - 3);
    }
}

static inline void take_numbers(Bytes *bytes, double *numbers, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        numbers[i] = take_number(bytes);
}

/* Mostly of variables that exist. */
static inline size_t take_references(Bytes *bytes, unsigned references[MAX_REFERENCES])
{
    const size_t n = below(bytes, MAX_REFERENCES + 1);
    for (size_t i = 0; i < n; ++i)
        if ((references[i] = take(bytes)) < 250)
            references[i] %= MAX_REFERENCE;
        else
            take_raw(bytes, &references[i], sizeof *references);
    return n;
}

/* Changes some bytes of a serialized state and gives it the checksum (FNV-1a) that belongs to them. */
static inline void damage(Bytes *bytes, uint8_t *state, size_t size)
{
    for (unsigned i = below(bytes, 4); i > 0; --i) {
        const unsigned where = take(bytes);
        size_t place = STATE_HEADER + where; /* mostly what is no number: phases, truth values, counts */
        if (where >= 192)
            place = (size_t)(where | take(bytes) << 8);
        place %= size;
        if (take(bytes) % 2)
            state[place] = (uint8_t)take(bytes);
        else if (place + sizeof(double) <= size)
            memcpy(state + place, &(double){take_number(bytes)}, sizeof(double));
    }
    uint64_t hash = 14695981039346656037u;
    for (size_t i = STATE_HEADER; i < size; ++i)
        hash = (hash ^ state[i]) * 1099511628211u;
    memcpy(state + STATE_CHECKSUM, &hash, sizeof hash);
}

/* What must hold whatever the importer does. */
static inline void demand(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "violated: %s\n", what);
        abort();
    }
}

#endif
