#include "iteration.h"
#include "block.h"
#include "time_events.h"

#include <math.h>
#include <stdlib.h>

/* A discrete system that has not settled after so many rounds changes for ever. */
enum { MAX_ROUNDS = 1000 };

bool iteration_create(Iteration *iteration)
{
    const size_t n_roots = model.n_roots + model.n_time_relations;
    const size_t n_doubles = n_roots + model.n_discrete;
    iteration->memory = malloc(n_doubles * sizeof(double) + model.n_actions * sizeof(bool) + 1);
    if (iteration->memory == NULL)
        return false;
    iteration->root = iteration->memory;
    iteration->value = iteration->root + n_roots;
    iteration->active = (bool *)(iteration->memory + n_doubles);
    return true;
}

void iteration_free(Iteration *iteration)
{
    free(iteration->memory);
}

static double *slot(Values *values, Store store, size_t index)
{
    return store == STORE_PARAMETER ? &values->p[index] : &values->y[index];
}

static bool set(double *place, double value)
{
    const bool changed = *place != value;
    *place = value;
    return changed;
}

bool iteration_copy_pre(Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_pre; ++i) {
        const PreBinding *pre = &model.pre[i];
        changed |= set(&values->p[pre->slot], *slot(values, pre->source_store, pre->source));
    }
    return changed;
}

static bool update_relations(const Iteration *iteration, Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_relations; ++i) {
        const Relation *relation = &model.relations[i];
        changed |= set(&values->p[relation->memory], relation_holds(relation, iteration->root[relation->root]));
    }
    return changed;
}

static bool update_assigned(const Iteration *iteration, Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_discrete; ++i)
        if (model.discrete[i].kind == DISCRETE_ASSIGN)
            changed |= set(slot(values, model.discrete[i].store, model.discrete[i].index), iteration->value[i]);
    return changed;
}

const char *iteration_settle(Iteration *iteration, Values *values)
{
    for (int round = 0; round < MAX_ROUNDS; ++round) {
        if ((model.discrete_reads_algebraic && !model_algebraics(values->time, values->y, values->p)) ||
            !model_roots(values->time, values->y, values->p, iteration->root))
            return blocks_explain(values->time, values->y, values->p, iteration->text);
        model_time_relations(time_just_after(values->time), values->p, iteration->root + model.n_roots);
        bool changed = update_relations(iteration, values);
        model_discrete(values->time, values->y, values->p, iteration->value);
        changed |= update_assigned(iteration, values);
        if (!changed)
            return NULL;
    }
    return "the discrete equations do not settle: relations or discrete variables change in a circle";
}

bool iteration_commit_conditions(const Iteration *iteration, Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_discrete; ++i)
        if (model.discrete[i].kind == DISCRETE_CONDITION)
            changed |= set(&values->p[model.discrete[i].index], iteration->value[i]);
    return changed;
}

void iteration_hold_conditions(Values *values)
{
    for (size_t i = 0; i < model.n_discrete; ++i)
        if (model.discrete[i].kind == DISCRETE_CONDITION)
            values->p[model.discrete[i].index] = 1.0;
}

void iteration_arm_initial_conditions(const Iteration *iteration, Values *values)
{
    model_discrete(values->time, values->y, values->p, iteration->value);
    for (size_t i = 0; i < model.n_discrete; ++i)
        if (model.discrete[i].kind == DISCRETE_CONDITION) {
            double *before = &values->p[model.discrete[i].index];
            *before = iteration->value[i] != 0.0 && *before == 0.0 ? 0.0 : 1.0;
        }
}

bool iteration_commit_states(const Iteration *iteration, Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_discrete; ++i)
        if (model.discrete[i].kind == DISCRETE_REINIT)
            changed |= set(&values->y[model.discrete[i].index], iteration->value[i]);
    return changed;
}
