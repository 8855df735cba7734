#include "iteration.h"
#include "block.h"
#include "time_events.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Equations that depend on each other may oscillate forever if they all change at once, but settle if they change in
 * turn: after ROUNDS_AT_ONCE rounds they change one at a time. If they have not settled after MAX_TURNS turns each, all
 * combinations of at most MAX_CIRCLING relations are tried. */
enum { ROUNDS_AT_ONCE = 100, MAX_TURNS = 100, MAX_CIRCLING = 10 };
static const double ROUNDING = 1e-12;

bool iteration_create(Iteration *iteration)
{
    const size_t n_roots = model.n_roots + model.n_time_relations;
    const size_t n_doubles = 3 * n_roots + model.n_discrete;
    iteration->memory = malloc(n_doubles * sizeof(double) + (model.n_actions + 3 * model.n_relations) * sizeof(bool) + 1);
    if (iteration->memory == NULL)
        return false;
    iteration->root = iteration->memory;
    iteration->before = iteration->root + n_roots;
    iteration->largest = iteration->before + n_roots;
    iteration->value = iteration->largest + n_roots;
    iteration->active = (bool *)(iteration->memory + n_doubles);
    iteration->at_zero = iteration->active + model.n_actions;
    iteration->circling = iteration->at_zero + model.n_relations;
    iteration->held = iteration->circling + model.n_relations;
    iteration->any_at_zero = false;
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

bool iteration_leave_zero(Iteration *iteration)
{
    bool changes = false;
    for (size_t i = 0; iteration->any_at_zero && i < model.n_relations; ++i) {
        const Relation *r = &model.relations[i];
        changes |= iteration->at_zero[i] && relation_holds(r, iteration->root[r->root]) != r->holds_at_zero;
    }
    iteration->any_at_zero = false;
    return changes;
}

static double truth(const Iteration *iteration, size_t relation)
{
    const Relation *r = &model.relations[relation];
    const bool is_zero = iteration->any_at_zero && iteration->at_zero[relation];
    return is_zero ? r->holds_at_zero : relation_holds(r, iteration->root[r->root]);
}

static bool update_relations(const Iteration *iteration, Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_relations; ++i)
        changed |= set(&values->p[model.relations[i].memory], truth(iteration, i));
    return changed;
}

static bool assign(const Iteration *iteration, Values *values, size_t row)
{
    const DiscreteTarget *target = &model.discrete[row];
    return target->kind == DISCRETE_ASSIGN && set(slot(values, target->store, target->index), iteration->value[row]);
}

static bool update_assigned(const Iteration *iteration, Values *values)
{
    bool changed = false;
    for (size_t i = 0; i < model.n_discrete; ++i)
        changed |= assign(iteration, values, i);
    return changed;
}

/* The relation and the discrete equation whose turn it is. */
typedef struct {
    size_t relation, row;
} Turn;

/* Updates one outdated relation, in turn, or else one discrete equation. */
static bool update_one(const Iteration *iteration, Values *values, Turn *turn)
{
    for (size_t k = 0; k < model.n_relations; ++k) {
        const size_t i = (turn->relation + k) % model.n_relations;
        if (set(&values->p[model.relations[i].memory], truth(iteration, i))) {
            turn->relation = i + 1;
            return true;
        }
    }
    model_discrete(values->time, values->y, values->p, iteration->value);
    for (size_t k = 0; k < model.n_discrete; ++k) {
        const size_t i = (turn->row + k) % model.n_discrete;
        if (assign(iteration, values, i)) {
            turn->row = i + 1;
            return true;
        }
    }
    return false;
}

static bool update_all(const Iteration *iteration, Values *values)
{
    const bool changed = update_relations(iteration, values);
    model_discrete(values->time, values->y, values->p, iteration->value);
    return update_assigned(iteration, values) || changed;
}

/* Updates everything that the relations and discrete equations read. */
static bool refresh(Iteration *iteration, Values *values)
{
    if ((model.discrete_reads_algebraic && !model_algebraics(values->time, values->y, values->p)) ||
        !model_roots(values->time, values->y, values->p, iteration->root))
        return false;
    model_time_relations(time_just_after(values->time), values->p, iteration->root + model.n_roots);
    return true;
}

/* Other relations of the same root are at zero, too, also those that hold there, and s > k beside s > 0 where k is 0. */
static void find_the_same(Iteration *iteration)
{
    for (size_t i = 0; i < model.n_relations; ++i)
        for (size_t j = 0; iteration->at_zero[i] && j < model.n_relations; ++j) {
            const double one = iteration->root[model.relations[i].root], other = iteration->root[model.relations[j].root];
            iteration->at_zero[j] |= fabs(one) == fabs(other);
        }
}

void iteration_stop_at_zero(Iteration *iteration, Values *values)
{
    if (model.opposites == NULL || !refresh(iteration, values))
        return;
    for (size_t i = 0; i < model.n_relations; ++i) {
        const Relation *relation = &model.relations[i];
        const size_t opposite = model.opposites[i];
        const bool was_opposite = opposite < model.n_relations && values->p[model.relations[opposite].memory] != 0.0;
        iteration->at_zero[i] = was_opposite && relation_holds(relation, iteration->root[relation->root]);
        iteration->any_at_zero |= iteration->at_zero[i];
    }
    if (iteration->any_at_zero)
        find_the_same(iteration);
}

/* The states are constant, so a root moves only with a relation or discrete variable that is part of the circle. */
static void note_circling(Iteration *iteration, const Values *values, bool is_first)
{
    for (size_t i = 0; i < model.n_relations; ++i) {
        const size_t root = model.relations[i].root;
        const bool moved = !is_first && iteration->root[root] != iteration->before[root];
        iteration->circling[i] |= moved || values->p[model.relations[i].memory] != truth(iteration, i);
        const double size = fabs(iteration->root[root]);
        iteration->largest[root] = is_first ? size : fmax(iteration->largest[root], size);
    }
    memcpy(iteration->before, iteration->root, (model.n_roots + model.n_time_relations) * sizeof(double));
}

/* Changes relations and discrete equations until they settle; returns NULL on success, else a description of the
 * failure. */
static const char *change_in_turn(Iteration *iteration, Values *values)
{
    memset(iteration->circling, 0, model.n_relations * sizeof(bool));
    const size_t rounds = ROUNDS_AT_ONCE + MAX_TURNS * (model.n_relations + model.n_discrete);
    Turn turn = {0, 0};
    for (size_t round = 0; round < rounds; ++round) {
        if (!refresh(iteration, values))
            return blocks_explain(values->time, values->y, values->p, iteration->text);
        if (round >= ROUNDS_AT_ONCE / 2)
            note_circling(iteration, values, round == ROUNDS_AT_ONCE / 2);
        if (!(round < ROUNDS_AT_ONCE ? update_all(iteration, values) : update_one(iteration, values, &turn)))
            return NULL;
    }
    return "the discrete equations do not settle: relations or discrete variables change in a circle";
}

/* Returns whether a relation has its value or, if `rounds`, was never farther from its zero than rounding errors. */
static bool is_right(const Iteration *iteration, const Values *values, size_t relation, bool rounds)
{
    const Relation *r = &model.relations[relation];
    return values->p[r->memory] == truth(iteration, relation) ||
           (rounds && fmax(iteration->largest[r->root], fabs(iteration->root[r->root])) <= ROUNDING);
}

/* Settles everything but the circling relations; returns whether these have the assumed values. */
static bool is_consistent(Iteration *iteration, Values *values, bool rounds)
{
    bool changed = true;
    for (int round = 0; changed && round < ROUNDS_AT_ONCE; ++round) {
        if (!refresh(iteration, values))
            return false;
        changed = false;
        for (size_t i = 0; i < model.n_relations; ++i)
            if (!iteration->circling[i])
                changed |= set(&values->p[model.relations[i].memory], truth(iteration, i));
        model_discrete(values->time, values->y, values->p, iteration->value);
        changed |= update_assigned(iteration, values);
    }
    for (size_t i = 0; i < model.n_relations; ++i)
        if (iteration->circling[i] && !is_right(iteration, values, i, rounds))
            return false;
    return !changed;
}

/* Lists the circling relations; returns how many there are, 0 for more than MAX_CIRCLING. */
static size_t list_circling(const Iteration *iteration, size_t relation[MAX_CIRCLING])
{
    size_t n = 0;
    for (size_t i = 0; i < model.n_relations; ++i)
        if (iteration->circling[i]) {
            if (n == MAX_CIRCLING)
                return 0;
            relation[n++] = i;
        }
    return n;
}

/* Tries all combinations of the circling relations. Relations in an algebraic loop can contradict each other in turn
 * although some combination is consistent: an amplifier with positive feedback jumps from one limit to the other, and
 * no combination in between is consistent. If none is, because of rounding errors at the event, as where friction
 * breaks away, a relation that `rounds` to its zero on both sides may have either value; it changes rather than
 * stays. */
static bool find_consistent(Iteration *iteration, Values *values, bool rounds)
{
    size_t relation[MAX_CIRCLING];
    const size_t n = list_circling(iteration, relation);
    double *start = n == 0 ? NULL : malloc((model.n_y + model.n_p) * sizeof(double));
    if (start == NULL)
        return false;
    memcpy(start, values->y, model.n_y * sizeof(double));
    memcpy(start + model.n_y, values->p, model.n_p * sizeof(double));
    bool found = false;
    for (size_t combination = 0; !found && combination < (size_t)1 << n; ++combination) {
        memcpy(values->y, start, model.n_y * sizeof(double));
        memcpy(values->p, start + model.n_y, model.n_p * sizeof(double));
        for (size_t k = 0; k < n; ++k) {
            const bool bit = (combination >> k & 1) != 0;
            values->p[model.relations[relation[k]].memory] = rounds ? bit == iteration->held[relation[k]] : bit;
        }
        found = is_consistent(iteration, values, rounds);
    }
    free(start);
    return found;
}

const char *iteration_settle(Iteration *iteration, Values *values)
{
    for (size_t i = 0; i < model.n_relations; ++i)
        iteration->held[i] = values->p[model.relations[i].memory] != 0.0;
    const char *problem = change_in_turn(iteration, values);
    if (problem == NULL || find_consistent(iteration, values, false) || find_consistent(iteration, values, true))
        return NULL;
    return problem;
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
