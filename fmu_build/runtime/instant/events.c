#include "events.h"
#include "actions.h"
#include "block.h"
#include "iteration.h"
#include "sensitivity.h"
#include "time_events.h"

#include <math.h>

/* A chain of when-clauses that needs more passes than this is considered endless. */
enum { MAX_PASSES = 1000 };

static EventStatus fail(const EventReporter *reporter, const char *what)
{
    reporter->report(reporter->context, ACTION_ERROR, what);
    return EVENT_ERROR;
}

static EventStatus worse(EventStatus a, EventStatus b)
{
    if (a == EVENT_ERROR || b == EVENT_ERROR)
        return EVENT_ERROR;
    return a == EVENT_OK ? b : a;
}

/* Repeats passes, each with constant pre() values, until a pass changes nothing. Clocks tick only in the first pass. A
 * root that passes through zero causes one event at zero and another one after it. */
static EventStatus iterate(Iteration *iteration, Values *values, bool continuous, const EventReporter *reporter,
                           bool *states_changed)
{
    EventStatus status = EVENT_OK;
    if (model.has_left_limits && !model_algebraics(values->time, values->y, values->p))
        return fail(reporter, blocks_explain(values->time, values->y, values->p, iteration->text));
    bool again = clocks_tick(values);
    iteration_copy_pre(values);
    if (continuous)
        iteration_stop_at_zero(iteration, values);
    for (int pass = 0; pass < MAX_PASSES; ++pass) {
        const char *problem = iteration_settle(iteration, values);
        if (problem != NULL)
            return fail(reporter, problem);
        status = worse(status, actions_take(values, iteration->active, reporter));
        if (status == EVENT_ERROR)
            return status;
        const bool jumped = iteration_commit_states(iteration, values);
        *states_changed |= jumped;
        again |= jumped;
        again |= iteration_commit_conditions(iteration, values);
        again |= iteration_copy_pre(values);
        if (!again && !iteration_leave_zero(iteration))
            return status;
        clocks_release(values);
        again = false;
    }
    return fail(reporter, "the event iteration does not end: when-clauses trigger each other in a circle");
}

EventStatus event_update(Values *values, bool continuous, const EventReporter *reporter, bool *states_changed)
{
    Iteration iteration;
    if (!iteration_create(&iteration))
        return fail(reporter, "out of memory");
    bool moves = false;
    const char *problem = sensitivity_enter_event(values, &moves);
    EventStatus status = EVENT_OK;
    if (problem == NULL) {
        status = iterate(&iteration, values, continuous, reporter, states_changed);
        problem = status != EVENT_ERROR && moves ? sensitivity_leave_event(values) : NULL;
    }
    *states_changed |= moves;
    iteration_free(&iteration);
    return problem == NULL ? status : fail(reporter, problem);
}
