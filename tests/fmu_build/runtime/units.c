/* units.c - stands for the rest of the runtime where single files of it are tested: two states, one relation, three
 * actions, one algebraic loop. What a model computes comes from functions of the test. */
#include "actions.h"
#include "block.h"
#include "integrator.h"
#include "location.h"
#include "model.h"

#include <stdio.h>

static const ActionKind actions[] = {ACTION_ERROR, ACTION_WARNING, ACTION_TERMINATE};
static const Relation relations[] = {{0, 0, false}};

/* The loop, and whether it lets the algebraic variables be computed. */
Block test_loop;
bool test_solvable = true;
static const Block *const blocks[] = {&test_loop};

static const double y_start[] = {0.0, 0.0};

const Model model = {
    .n_states = 2,
    .n_y = 2,
    .n_p = 3,
    .y_start = y_start,
    .n_roots = 1,
    .n_relations = 1,
    .relations = relations,
    .n_actions = 3,
    .actions = actions,
    .actions_follow_states = true,
    .actions_read_algebraic = true,
    .n_blocks = 1,
    .blocks = blocks,
};

/* p has the truth of the three conditions. */
void model_actions(double time, const double *y, const double *p, bool *active)
{
    (void)time, (void)y;
    for (size_t i = 0; i < 3; ++i)
        active[i] = p[i] != 0.0;
}

bool model_watched_actions(double time, double *y, const double *p, bool *due)
{
    (void)time, (void)y;
    *due = p[0] != 0.0 || p[1] != 0.0 || p[2] != 0.0;
    return true;
}

void model_action_message(size_t action, double time, const double *y, const double *p, char *text, size_t size)
{
    (void)time, (void)y, (void)p;
    snprintf(text, size, "action %zu", action);
}

bool model_algebraics(double time, double *y, const double *p)
{
    (void)time, (void)y, (void)p;
    return test_solvable;
}

/* The context of an integrator or of a search: a function of the test. */
typedef struct {
    void (*at_time)(double time, double *values);
} Function;

bool integrator_derivatives(void *context, double time, StepPoint point, double *der)
{
    (void)point;
    ((const Function *)context)->at_time(time, der);
    return true;
}

bool roots_evaluate(void *context, double time, double *root)
{
    ((const Function *)context)->at_time(time, root);
    return true;
}
