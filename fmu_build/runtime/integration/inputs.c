#include "inputs.h"

size_t inputs_of_model(size_t *index)
{
    size_t count = 0;
    for (size_t i = 0; i < model.n_variables; ++i) {
        const Variable *variable = &model.variables[i];
        if (variable->causality != CAUSALITY_INPUT || variable->variability != VARIABILITY_CONTINUOUS ||
            variable->store != STORE_PARAMETER)
            continue;
        if (index != NULL)
            index[count] = variable->index;
        ++count;
    }
    return count;
}

void inputs_set_slope(Inputs *inputs, size_t index, double slope)
{
    for (size_t i = 0; i < inputs->count; ++i) {
        if (inputs->index[i] == index)
            inputs->slope[i] = slope;
    }
}

void inputs_begin(Inputs *inputs, double time, const double *p)
{
    inputs->since = time;
    inputs->active = inputs->ask != NULL;
    for (size_t i = 0; i < inputs->count; ++i)
        inputs->active = inputs->active || inputs->slope[i] != 0.0;
    for (size_t i = 0; inputs->active && i < inputs->count; ++i)
        inputs->base[i] = p[inputs->index[i]];
}

void inputs_move(const Inputs *inputs, double time, double *p)
{
    if (inputs->ask != NULL) {
        inputs->ask(inputs->context, time);
        return;
    }
    for (size_t i = 0; i < inputs->count; ++i)
        p[inputs->index[i]] = inputs->base[i] + inputs->slope[i] * (time - inputs->since);
}

void inputs_end(Inputs *inputs)
{
    for (size_t i = 0; inputs->active && i < inputs->count; ++i)
        inputs->slope[i] = 0.0;
    inputs->active = false;
}
