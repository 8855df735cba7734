#include "actions.h"
#include "block.h"

#include <stdlib.h>

static EventStatus fail(const EventReporter *reporter, const char *what)
{
    reporter->report(reporter->context, ACTION_ERROR, what);
    return EVENT_ERROR;
}

static void report(const Values *values, size_t action, const EventReporter *reporter)
{
    char message[1024];
    model_action_message(action, values->time, values->y, values->p, message, sizeof message);
    reporter->report(reporter->context, model.actions[action], message);
}

/* Evaluates the conditions. If any is true, sets *any and computes the algebraic variables that messages may read. */
static bool evaluate(Values *values, bool *active, bool *any)
{
    if (model.actions_read_algebraic && !model_algebraics(values->time, values->y, values->p))
        return false;
    model_actions(values->time, values->y, values->p, active);
    *any = false;
    for (size_t i = 0; i < model.n_actions; ++i)
        *any |= active[i];
    return !*any || model_algebraics(values->time, values->y, values->p);
}

EventStatus actions_take(Values *values, bool *active, const EventReporter *reporter)
{
    EventStatus status = EVENT_OK;
    bool any = false;
    if (!evaluate(values, active, &any)) {
        char text[NEWTON_TEXT_SIZE];
        return fail(reporter, blocks_explain(values->time, values->y, values->p, text));
    }
    for (size_t i = 0; any && i < model.n_actions; ++i) {
        if (active[i] && (model.actions[i] != ACTION_WARNING || values->reported[i] == 0.0))
            report(values, i, reporter);
        if (active[i] && model.actions[i] == ACTION_ERROR)
            status = EVENT_ERROR;
        else if (active[i] && model.actions[i] == ACTION_TERMINATE && status == EVENT_OK)
            status = EVENT_TERMINATE;
    }
    if (any || *values->any_reported != 0.0)
        for (size_t i = 0; i < model.n_actions; ++i)
            values->reported[i] = active[i];
    *values->any_reported = any;
    return status;
}

EventStatus event_check_asserts(Values *values, const EventReporter *reporter)
{
    bool due = false;
    if (!model.actions_follow_states)
        return EVENT_OK;
    if (model_watched_actions(values->time, values->y, values->p, &due) && !due && *values->any_reported == 0.0)
        return EVENT_OK;
    bool *active = malloc(model.n_actions * sizeof(bool));
    if (active == NULL)
        return fail(reporter, "out of memory");
    const EventStatus status = actions_take(values, active, reporter);
    free(active);
    return status;
}
