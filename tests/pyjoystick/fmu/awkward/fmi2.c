/* fmi2.c - the awkward model through FMI 2.0 Co-Simulation. */
#define _POSIX_C_SOURCE 200809L
#include "model.h"

#include "fmi2Functions.h"

typedef struct {
    Model model;
    const fmi2CallbackFunctions *callbacks;
} Instance;

static int alive; /* instances; more than one is refused where the GUID says so */

static fmi2Status tell(const Instance *it, int status, const char *what, double time)
{
    if (status != fmi2OK)
        it->callbacks->logger(it->callbacks->componentEnvironment, "awkward", (fmi2Status)status, "log",
                              "%s at %g", what, time);
    return (fmi2Status)status;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)resources, (void)visible, (void)logging;
    Instance *it = calloc(1, sizeof *it);
    if (it == NULL)
        return NULL;
    it->callbacks = callbacks;
    if (strcmp(guid, "exits") == 0)
        exit(0);
    if (strcmp(guid, "only-one") == 0 && alive > 0) {
        tell(it, fmi2Error, "a second instance", 0.0);
        free(it);
        return NULL;
    }
    ++alive;
    model_start(&it->model);
    return it;
}

void fmi2FreeInstance(fmi2Component c)
{
    model_end(&((Instance *)c)->model);
    --alive;
    free(c);
}

fmi2Status fmi2Reset(fmi2Component c)
{
    return tell(c, model_reset(&((Instance *)c)->model), "reset", 0.0);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    (void)has_tolerance, (void)tolerance, (void)start;
    if (has_stop)
        ((Model *)c)->stop = stop;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    const bool refuses = ((Instance *)c)->model.trouble == REFUSED_START;
    return tell(c, refuses ? fmi2Error : fmi2OK, "100 % refused", 0.0);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real length, fmi2Boolean no_going_back)
{
    (void)no_going_back;
    Instance *it = c;
    const int status = model_step(&it->model, time, length);
    return tell(it, it->model.has_ended ? fmi2Discard : status, "trouble", time);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    *value = kind == fmi2Terminated && ((const Model *)c)->has_ended;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    *value = ((const Model *)c)->reached;
    return kind == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    if (n != 1 || r[0] != U || order[0] != 1)
        return tell(c, fmi2Error, "no such derivative", 0.0);
    ((Instance *)c)->model.slope = value[0];
    return fmi2OK;
}

/* Where a number is. */
static double *real(Model *m, fmi2ValueReference r)
{
    switch (r) {
    case GAIN:
        return &m->gain;
    case WHEN:
        return &m->when;
    case DELAY:
        return &m->delay;
    case U:
        return &m->u;
    case Y:
        return &m->y;
    default:
        return &m->stop;
    }
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real value[])
{
    for (size_t i = 0; i < n; ++i)
        *real(c, r[i]) = value[i];
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real value[])
{
    for (size_t i = 0; i < n; ++i)
        value[i] = *real(c, r[i]);
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer value[])
{
    Model *m = c;
    for (size_t i = 0; i < n; ++i) {
        if (r[i] == TROUBLE)
            m->trouble = value[i];
        else
            m->tiny = (int8_t)value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer value[])
{
    const Model *m = c;
    for (size_t i = 0; i < n; ++i)
        value[i] = r[i] == STEPS ? m->steps : r[i] == LENGTH ? (int)strlen(m->label) : 2 * m->tiny;
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Boolean value[])
{
    for (size_t i = 0; i < n; ++i)
        if (r[i] == FLAG)
            ((Model *)c)->flag = value[i];
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Boolean value[])
{
    for (size_t i = 0; i < n; ++i)
        value[i] = r[i] == NEGATED && !((const Model *)c)->flag;
    return fmi2OK;
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2String value[])
{
    for (size_t i = 0; i < n; ++i)
        if (r[i] == LABEL)
            strncpy(((Model *)c)->label, value[i], sizeof((Model *)c)->label - 1);
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2String value[])
{
    (void)r;
    for (size_t i = 0; i < n; ++i)
        value[i] = ((Model *)c)->label;
    return fmi2OK;
}
