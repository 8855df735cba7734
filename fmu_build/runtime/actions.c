#include "actions.h"

#include <stdlib.h>

static void report(const Values *values, size_t action, const EventReporter *reporter)
{
    char message[1024];
    model_action_message(action, values->time, values->y, values->p, message, sizeof message);
    reporter->report(reporter->context, model.actions[action], message);
}

EventStatus actions_take(Values *values, bool *active, const EventReporter *reporter)
{
    EventStatus status = EVENT_OK;
    model_actions(values->time, values->y, values->p, active);
    for (size_t i = 0; i < model.n_actions; ++i) {
        if (active[i] && (model.actions[i] != ACTION_WARNING || values->reported[i] == 0.0))
            report(values, i, reporter);
        values->reported[i] = active[i];
        if (active[i] && model.actions[i] == ACTION_ERROR)
            status = EVENT_ERROR;
        else if (active[i] && model.actions[i] == ACTION_TERMINATE && status == EVENT_OK)
            status = EVENT_TERMINATE;
    }
    return status;
}

EventStatus event_check_asserts(Values *values, const EventReporter *reporter)
{
    if (!model.actions_follow_states)
        return EVENT_OK;
    bool *active = malloc(model.n_actions * sizeof(bool));
    if (active == NULL || !model_algebraics(values->time, values->y, values->p)) {
        free(active);
        reporter->report(reporter->context, ACTION_ERROR, "the algebraic equations could not be solved");
        return EVENT_ERROR;
    }
    const EventStatus status = actions_take(values, active, reporter);
    free(active);
    return status;
}
