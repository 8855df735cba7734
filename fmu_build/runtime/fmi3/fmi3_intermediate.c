#include "fmi3_intermediate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns false if a call of the importer during the update has ended the simulation. */
static bool update(Component *component, double time, bool finished, bool *early, double *early_time)
{
    Instance *instance = component->instance;
    if (instance->phase != PHASE_STEP_COMPLETE)
        return false;
    const char *call = instance->call;
    component->may_get = finished;
    component->may_set = !finished;
    instance->phase = PHASE_INTERMEDIATE;
    component->intermediate_update(component->environment, time, component->may_set, component->may_get, finished,
                                   finished && instance->attendance.early_return, early, early_time);
    instance->call = call;
    if (instance->phase != PHASE_INTERMEDIATE)
        return false;
    instance->phase = PHASE_STEP_COMPLETE;
    return true;
}

static bool step_finished(void *context, double time, double *end)
{
    Component *component = context;
    bool early = false;
    double early_time = time;
    if (!update(component, time, true, &early, &early_time))
        return false;
    if (early && component->instance->attendance.early_return)
        *end = fmin(*end, fmax(time, early_time));
    return true;
}

static void ask(void *context, double time)
{
    bool early = false;
    double early_time = time;
    update(context, time, false, &early, &early_time);
}

static const char *fault(fmi3ValueReference reference)
{
    if (reference >= model.n_variables)
        return "A required intermediate variable does not exist.";
    const Variable *variable = &model.variables[reference];
    if (variable->type != TYPE_REAL || variable->variability != VARIABILITY_CONTINUOUS ||
        (variable->causality != CAUSALITY_INPUT && variable->causality != CAUSALITY_OUTPUT))
        return "A required intermediate variable is not a continuous input or output.";
    return NULL;
}

const char *intermediate_attend(Component *component, const fmi3ValueReference variables[], size_t n)
{
    Instance *instance = component->instance;
    bool inputs = false;
    if (component->intermediate_update == NULL)
        return n == 0 ? NULL : "Intermediate variables are required, but no function for the intermediate update.";
    if (n > 0 && variables == NULL)
        return "The required intermediate variables are a null pointer.";
    for (size_t i = 0; i < n; ++i) {
        const char *why = fault(variables[i]);
        if (why != NULL)
            return why;
        inputs = inputs || model.variables[variables[i]].causality == CAUSALITY_INPUT;
    }
    component->intermediate = malloc((n + 1) * sizeof *variables);
    if (component->intermediate == NULL)
        return "Out of memory.";
    if (n > 0)
        memcpy(component->intermediate, variables, n * sizeof *variables);
    component->n_intermediate = n;
    instance->attendance.step_finished = step_finished;
    instance->attendance.context = component;
    instance->inputs.ask = inputs ? ask : NULL;
    instance->inputs.context = component;
    return NULL;
}

static bool is_listed(const Component *component, fmi3ValueReference reference)
{
    for (size_t i = 0; i < component->n_intermediate; ++i)
        if (component->intermediate[i] == reference)
            return true;
    return false;
}

bool intermediate_allows(const Component *component, bool setting, const fmi3ValueReference variables[], size_t n)
{
    const Instance *instance = component->instance;
    if (instance->phase != PHASE_INTERMEDIATE)
        return true;
    if (!(setting ? component->may_set : component->may_get)) {
        call_refuse(instance, "this intermediate update does not allow it.");
        return false;
    }
    for (size_t i = 0; i < n; ++i) {
        if (!is_listed(component, variables[i])) {
            call_refuse(instance, "value reference %u is not among the required intermediate variables.",
                        (unsigned)variables[i]);
            return false;
        }
    }
    return true;
}
