/* fmi3.c - an FMU of FMI 3.0 Co-Simulation that gives back what it gets: numbers of every type, texts, arrays;
 * and an oscillator, x'' = -4 x - 0.5 x' + 3 force, with its directional and adjoint derivatives.
 *
 * The value references of the number k of the types are 10 k + 1 (parameter), + 2 (input), + 3 and + 4 (outputs,
 * the same numbers) and + 5 (an array of parameter, input, parameter). */
#define _POSIX_C_SOURCE 200809L
#include "fmi3Functions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { P = 1, U, P_AGAIN, U_AGAIN, BOTH };
enum { TEXT = 200, SAID, TEXTS, TEXT_INPUT, TEXT_AGAIN };
enum { FORCE = 300, X, DER_X, Y, X_AGAIN, FORCE_AGAIN, DELAY };

typedef struct {
    fmi3Float32 Float32[2];
    fmi3Float64 Float64[2];
    fmi3Int8 Int8[2];
    fmi3UInt8 UInt8[2];
    fmi3Int16 Int16[2];
    fmi3UInt16 UInt16[2];
    fmi3Int32 Int32[2];
    fmi3UInt32 UInt32[2];
    fmi3Int64 Int64[2];
    fmi3UInt64 UInt64[2];
    char text[64], input[64], said[4][64];
    double force, delay /* ms a step */, x[2];
    int steps;
} Echo;

/* Of der(x[0]), der(x[1]) and y by x[0], x[1] and the force. */
static const double slopes[3][3] = {{0.0, 1.0, 0.0}, {-4.0, -0.5, 3.0}, {0.0, 2.0, 1.0}};

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                         fmi3Boolean early_return, const fmi3ValueReference required[],
                                         size_t n_required, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)event_mode, (void)early_return;
    (void)required, (void)n_required, (void)environment, (void)log, (void)update;
    return calloc(1, sizeof(Echo));
}

void fmi3FreeInstance(fmi3Instance instance)
{
    free(instance);
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    memset(instance, 0, sizeof(Echo));
    return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    (void)instance, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    (void)instance;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    (void)instance;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 length, fmi3Boolean no_going_back,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached)
{
    const long nanoseconds = (long)(((Echo *)instance)->delay * 1e6);
    (void)no_going_back;
    nanosleep(&(struct timespec){nanoseconds / 1000000000L, nanoseconds % 1000000000L}, NULL);
    ((Echo *)instance)->steps += 1;
    *event = *terminate = *early = false;
    *reached = time + length;
    return fmi3OK;
}

#define TYPE(type, number)                                                                                      \
    fmi3Status fmi3Set##type(fmi3Instance instance, const fmi3ValueReference r[], size_t n,                     \
                             const fmi3##type value[], size_t size)                                             \
    {                                                                                                           \
        for (size_t i = 0; i < n; ++i) {                                                                        \
            if (r[i] / 10 != number || r[i] % 10 > U)                                                           \
                return fmi3Error;                                                                               \
            ((Echo *)instance)->type[r[i] % 10 - 1] = value[i];                                                 \
        }                                                                                                       \
        return n == size ? fmi3OK : fmi3Error;                                                                  \
    }                                                                                                           \
                                                                                                                \
    fmi3Status fmi3Get##type(fmi3Instance instance, const fmi3ValueReference r[], size_t n, fmi3##type value[], \
                             size_t size)                                                                       \
    {                                                                                                           \
        const fmi3##type *has = ((Echo *)instance)->type;                                                       \
        size_t place = 0;                                                                                       \
        for (size_t i = 0; i < n; ++i) {                                                                        \
            const size_t one = r[i] % 10, count = one == BOTH ? 3 : 1;                                          \
            if (r[i] / 10 != number || place + count > size)                                                    \
                return fmi3Error;                                                                               \
            for (size_t k = 0; k < count; ++k)                                                                  \
                value[place++] = has[one == BOTH ? k % 2 : (one - 1) % 2];                                      \
        }                                                                                                       \
        return place == size ? fmi3OK : fmi3Error;                                                              \
    }

TYPE(Float32, 1)
TYPE(Int8, 2)
TYPE(UInt8, 3)
TYPE(Int16, 4)
TYPE(UInt16, 5)
TYPE(Int32, 6)
TYPE(UInt32, 7)
TYPE(Int64, 8)
TYPE(UInt64, 9)

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference r[], size_t n,
                          const fmi3Float64 value[], size_t size)
{
    Echo *it = instance;
    for (size_t i = 0; i < n; ++i) {
        if (r[i] != FORCE && r[i] != DELAY)
            return fmi3Error;
        *(r[i] == FORCE ? &it->force : &it->delay) = value[i];
    }
    return n == size ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference r[], size_t n, fmi3Float64 value[],
                          size_t size)
{
    const Echo *it = instance;
    const double all[3] = {it->x[0], it->x[1], it->force};
    size_t place = 0;
    for (size_t i = 0; i < n; ++i) {
        double found[2] = {it->force, 0.0};
        const int is_array = r[i] == X || r[i] == DER_X || r[i] == X_AGAIN;
        const int first = r[i] == DER_X ? 0 : 2;
        for (int k = 0; k < 2 && (r[i] == DER_X || r[i] == Y); ++k) {
            found[k] = 0.0;
            for (int j = 0; j < 3 && first + k < 3; ++j)
                found[k] += slopes[first + k][j] * all[j];
        }
        if (r[i] == X || r[i] == X_AGAIN)
            memcpy(found, it->x, sizeof found);
        if (place + (is_array ? 2 : 1) > size)
            return fmi3Error;
        value[place++] = found[0];
        if (is_array)
            value[place++] = found[1];
    }
    return place == size ? fmi3OK : fmi3Error;
}

/* The row of `slopes` or the knowns of a value reference; -1 where there are none. */
static int row_of(fmi3ValueReference r)
{
    return r == DER_X ? 0 : r == Y ? 2 : -1;
}

static int column_of(fmi3ValueReference r)
{
    return r == X ? 0 : r == FORCE ? 2 : -1;
}

static size_t count_of(fmi3ValueReference r)
{
    return r == X || r == DER_X || r == X_AGAIN ? 2 : 1;
}

/* As those of many tools, it answers 0 for a state as an unknown. */
fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nu,
                                        const fmi3ValueReference knowns[], size_t nk, const fmi3Float64 seed[],
                                        size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    (void)instance;
    size_t place = 0;
    for (size_t i = 0; i < nu; ++i)
        for (size_t k = 0; k < count_of(unknowns[i]); ++k, ++place) {
            size_t at = 0;
            if (place >= n_sensitivity)
                return fmi3Error;
            sensitivity[place] = 0.0;
            for (size_t j = 0; j < nk; ++j)
                for (size_t m = 0; m < count_of(knowns[j]); ++m, ++at) {
                    if (at >= n_seed || column_of(knowns[j]) < 0)
                        return fmi3Error;
                    if (row_of(unknowns[i]) >= 0)
                        sensitivity[place] += slopes[row_of(unknowns[i]) + k][column_of(knowns[j]) + m] * seed[at];
                }
        }
    return place == n_sensitivity ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nu,
                                    const fmi3ValueReference knowns[], size_t nk, const fmi3Float64 seed[],
                                    size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    (void)instance;
    size_t at = 0;
    for (size_t j = 0; j < nk; ++j)
        for (size_t m = 0; m < count_of(knowns[j]); ++m, ++at) {
            size_t place = 0;
            if (at >= n_sensitivity || column_of(knowns[j]) < 0)
                return fmi3Error;
            sensitivity[at] = 0.0;
            for (size_t i = 0; i < nu; ++i)
                for (size_t k = 0; k < count_of(unknowns[i]); ++k, ++place) {
                    if (place >= n_seed)
                        return fmi3Error;
                    if (row_of(unknowns[i]) >= 0)
                        sensitivity[at] += slopes[row_of(unknowns[i]) + k][column_of(knowns[j]) + m] * seed[place];
                }
        }
    return at == n_sensitivity ? fmi3OK : fmi3Error;
}

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference r[], size_t n,
                         const fmi3String value[], size_t size)
{
    Echo *it = instance;
    for (size_t i = 0; i < n; ++i)
        snprintf(r[i] == TEXT ? it->text : it->input, sizeof it->text, "%s", value[i]);
    return n == size ? fmi3OK : fmi3Error;
}

/* The texts last until the next call, which writes over them. */
fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference r[], size_t n, fmi3String value[],
                         size_t size)
{
    Echo *it = instance;
    size_t place = 0;
    memset(it->said, '?', sizeof it->said - 1);
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < (r[i] == TEXTS ? 2 : 1); ++k, ++place) {
            if (place >= size || place >= 4)
                return fmi3Error;
            if (r[i] == TEXT_AGAIN)
                snprintf(it->said[place], sizeof it->said[place], "%s", it->input);
            else
                snprintf(it->said[place], sizeof it->said[place], "%.40s %d.%d", it->text, it->steps, k);
            value[place] = it->said[place];
        }
    return place == size ? fmi3OK : fmi3Error;
}
