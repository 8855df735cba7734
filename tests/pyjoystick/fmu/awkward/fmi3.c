/* fmi3.c - the awkward model through FMI 3.0 Co-Simulation. */
#define _POSIX_C_SOURCE 200809L
#include "model.h"

#include "fmi3Functions.h"

typedef struct {
    Model model;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    bool is_initializing;
} Instance;

static fmi3Status tell(const Instance *it, int status, const char *what, double time)
{
    char text[100];
    snprintf(text, sizeof text, "%s at %g", what, time);
    if (status != fmi3OK)
        it->log(it->environment, (fmi3Status)status, "log", text);
    return (fmi3Status)status;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                         fmi3Boolean early_return, const fmi3ValueReference required[],
                                         size_t n_required, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)required, (void)n_required;
    (void)update;
    Instance *it = calloc(1, sizeof *it);
    if (it == NULL || event_mode || early_return) {
        free(it);
        return NULL;
    }
    model_start(&it->model);
    it->environment = environment;
    it->log = log;
    return it;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    model_end(&((Instance *)instance)->model);
    free(instance);
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    return tell(instance, model_reset(&((Instance *)instance)->model), "reset", 0.0);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    if (!has_tolerance || tolerance != 1e-8 || !has_stop || stop <= start)
        return tell(instance, fmi3Error, "not these settings", start);
    ((Instance *)instance)->is_initializing = true;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    Instance *it = instance;
    it->is_initializing = false;
    return tell(it, it->model.trouble == REFUSED_START ? fmi3Error : fmi3OK, "100 % refused", 0.0);
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    (void)instance;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 length, fmi3Boolean no_going_back,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached)
{
    Instance *it = instance;
    if (!no_going_back || it->is_initializing)
        return tell(it, fmi3Error, "not now", time);
    const bool is_due = time >= it->model.when;
    *event = false;
    *early = is_due && it->model.trouble == COMES_BACK_EARLY;
    const bool is_short = *early || (is_due && it->model.trouble == STOPS_SHORT);
    const int status = model_step(&it->model, time, length);
    *terminate = it->model.has_ended;
    *reached = is_short ? time + 0.5 * length : it->model.reached;
    return tell(it, status, "trouble", time);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference r[], size_t n,
                          const fmi3Float64 value[], size_t size)
{
    Model *m = instance;
    for (size_t i = 0; i < n; ++i)
        *(r[i] == GAIN ? &m->gain : r[i] == WHEN ? &m->when : r[i] == DELAY ? &m->delay : &m->u) = value[i];
    return n == size ? fmi3OK : fmi3Error;
}

fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference r[], size_t n, const fmi3Int32 value[],
                        size_t size)
{
    if (n != 1 || size != 1 || r[0] != TROUBLE)
        return fmi3Error;
    ((Model *)instance)->trouble = value[0];
    return fmi3OK;
}

fmi3Status fmi3SetInt8(fmi3Instance instance, const fmi3ValueReference r[], size_t n, const fmi3Int8 value[],
                       size_t size)
{
    if (n != 1 || size != 1 || r[0] != TINY)
        return fmi3Error;
    ((Model *)instance)->tiny = value[0];
    return fmi3OK;
}

fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference r[], size_t n,
                          const fmi3Boolean value[], size_t size)
{
    if (n != 1 || size != 1 || r[0] != FLAG)
        return fmi3Error;
    ((Model *)instance)->flag = value[0];
    return fmi3OK;
}

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference r[], size_t n,
                         const fmi3String value[], size_t size)
{
    if (n != 1 || size != 1 || r[0] != LABEL)
        return fmi3Error;
    strncpy(((Model *)instance)->label, value[0], sizeof((Model *)instance)->label - 1);
    return fmi3OK;
}

/* The outputs, each of another type: the same numbers over and over where nothing better is at hand. */
#define GETTER(name, type, expression)                                                                          \
    fmi3Status fmi3Get##name(fmi3Instance instance, const fmi3ValueReference r[], size_t n, type value[],      \
                             size_t size)                                                                      \
    {                                                                                                          \
        const Model *m = instance;                                                                             \
        (void)r, (void)m;                                                                                      \
        for (size_t i = 0; i < n; ++i)                                                                         \
            value[i] = expression;                                                                             \
        return n == size ? fmi3OK : fmi3Error;                                                                 \
    }

GETTER(Float64, fmi3Float64, r[i] == U ? m->u : m->y)
GETTER(Float32, fmi3Float32, (fmi3Float32)(m->y / 3.0))
GETTER(Int8, fmi3Int8, (fmi3Int8)(2 * m->tiny))
GETTER(UInt8, fmi3UInt8, (fmi3UInt8)(200 + m->steps))
GETTER(Int16, fmi3Int16, (fmi3Int16)(-30000 - m->steps))
GETTER(UInt16, fmi3UInt16, (fmi3UInt16)(60000 + m->steps))
GETTER(Int32, fmi3Int32, r[i] == LENGTH ? (fmi3Int32)strlen(m->label) : -m->steps)
GETTER(UInt32, fmi3UInt32, 4000000000U + (fmi3UInt32)m->steps)
GETTER(Int64, fmi3Int64, INT64_C(-9007199254740993) - m->steps)
GETTER(UInt64, fmi3UInt64, UINT64_C(18000000000000000000) + (fmi3UInt64)m->steps)
GETTER(Boolean, fmi3Boolean, !m->flag)
GETTER(String, fmi3String, m->label)
