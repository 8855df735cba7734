#include "cosimulation.h"
#include "block.h"
#include "evaluation.h"
#include "extremes.h"
#include "time_events.h"
#include "variables.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

enum { MAX_CROWD = 1000 };

/* Each group of this many integrator steps must reach the communication point or cover a thousandth of the experiment:
 * otherwise a run would take more than a billion steps, a quarter of an hour for a small model. Legitimately long runs,
 * with thousands of events or a million oscillations, stay far below that. */
#ifndef PATIENCE
#define PATIENCE 1000000
#endif
enum { PARTS = 1000 };

/* The width of a crowd of events, in instants; an event is located to about a thousandth of that. */
static const double crowd_width = 100.0;

double cosimulation_instant(double time)
{
    return instant_at(time);
}

bool cosimulation_is_before(double time, double other)
{
    return time < other - instant_at(other);
}

static Status fail(Instance *instance, double time, const char *why)
{
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "The simulation stopped at time %.17g: %s", time, why);
    return STATUS_ERROR;
}

static void restart(Instance *instance)
{
    const Values *values = &instance->values;
    Progress *progress = &instance->progress;
    progress->event_pending = false;
    progress->next_time_event = event_next_time(values);
    *instance->roots.agrees = 0.0;
    integrator_restart(&instance->integrator, values->time, values->y);
    double *suggestion = &instance->integrator.record.suggestion;
    *suggestion = step_memory_switch(&instance->steps, values->p, *suggestion);
}

/* Carries out the event at values.time, with all events that follow from it at the same instant. */
static Status carry_out_event(Instance *instance, bool continuous)
{
    const EventReporter reporter = instance_reporter(instance);
    bool states_changed = false;
    ++instance->progress.events;
    switch (event_update(&instance->values, continuous, &reporter, &states_changed)) {
    case EVENT_OK:
        evaluation_invalidate(instance);
        restart(instance);
        return STATUS_OK;
    case EVENT_TERMINATE:
        return STATUS_DISCARD;
    case EVENT_ERROR:
        break;
    }
    return fail(instance, instance->values.time, "an event failed.");
}

static const char *relation_text(size_t relation)
{
    return model.root_texts[model.relations[relation].root];
}

/* Guards against endless events without progress in time (Zeno behaviour, chattering). */
static Status count_event(Instance *instance, double time)
{
    Progress *progress = &instance->progress;
    if (time - progress->crowd_start > crowd_width * instant_at(time)) {
        progress->crowd_start = time;
        progress->crowd = 0;
    }
    if (++progress->crowd <= MAX_CROWD)
        return STATUS_OK;
    char why[512];
    if (progress->relation < model.n_relations)
        snprintf(why, sizeof why, "%d events at practically the same time, the last where %s changed its sign.",
                 MAX_CROWD, relation_text(progress->relation));
    else
        snprintf(why, sizeof why, "%d events at practically the same time, the last a time event.", MAX_CROWD);
    return fail(instance, time, why);
}

/* Sets time, states and inputs to those at a time within the last integrator step. */
static void move_to(Instance *instance, double time)
{
    integrator_interpolate(&instance->integrator, time, instance->values.y);
    inputs_apply(&instance->inputs, time, instance->values.p);
    instance->values.time = time;
    evaluation_invalidate(instance);
}

/* Goes to the pending event, logs it and counts it. */
static Status reach_pending_event(Instance *instance)
{
    const Progress *progress = &instance->progress;
    const double time = instance->integrator.record.time;
    move_to(instance, time);
    if (log_is_on(&instance->log, LOG_EVENTS)) {
        if (progress->relation < model.n_relations)
            log_message(&instance->log, LOG_EVENTS, STATUS_OK, "State event at time %.17g: %s changes its sign.",
                        time, relation_text(progress->relation));
        else
            log_message(&instance->log, LOG_EVENTS, STATUS_OK, "Time event at time %.17g.", time);
    }
    return count_event(instance, time);
}

/* Returns whether the communication step ends before the pending event, which the importer then carries out. */
static bool leaves_event_to_importer(const Instance *instance, double target)
{
    const Attendance *attendance = &instance->attendance;
    return attendance->event_mode &&
           (attendance->early_return || !cosimulation_is_before(instance->integrator.record.time, target));
}

/* Carries out the event at the end of the last integrator step, or leaves it to the importer. */
static Status take_event(Instance *instance, double target)
{
    Progress *progress = &instance->progress;
    const Status status = reach_pending_event(instance);
    if (status != STATUS_OK)
        return status;
    progress->ended_at_event = leaves_event_to_importer(instance, target);
    if (!progress->ended_at_event && !evaluation_meet_event(instance))
        return STATUS_ERROR;
    if (!progress->ended_at_event)
        return carry_out_event(instance, instance->inputs.ask == NULL);
    ++progress->events;
    return STATUS_OK;
}

/* Checks the assertions that apply between events at the present point. */
static Status check_asserts_here(Instance *instance)
{
    const EventReporter reporter = instance_reporter(instance);
    switch (event_check_asserts(&instance->values, &reporter)) {
    case EVENT_OK:
        return STATUS_OK;
    case EVENT_TERMINATE:
        return STATUS_DISCARD;
    case EVENT_ERROR:
        break;
    }
    return fail(instance, instance->values.time, "an assertion is violated.");
}

COLD static Status fail_not_finite(Instance *instance, double time)
{
    char names[256], why[320];
    variables_not_finite(&instance->values, integrator_find_failure(&instance->integrator), names, sizeof names);
    snprintf(why, sizeof why, "the derivatives are not finite%s%s.", names[0] == '\0' ? "" : ": ", names);
    return fail(instance, time, why);
}

/* The states are still those at which derivatives or roots could not be computed. */
COLD static Status fail_to_compute(Instance *instance, double time)
{
    const Values *values = &instance->values;
    char why[NEWTON_TEXT_SIZE];
    if (isnan(instance->failed_at))
        return fail_not_finite(instance, time);
    return fail(instance, time, blocks_explain(instance->failed_at, values->y, values->p, why));
}

/* Checks the assertions at the end of the last integrator step, if that is ahead of the present time. */
static Status check_asserts(Instance *instance)
{
    if (!model.actions_follow_states || instance->integrator.record.time <= instance->values.time)
        return STATUS_OK;
    move_to(instance, instance->integrator.record.time);
    return check_asserts_here(instance);
}

/* Ends the last integrator step at a crossing. */
static void end_at(Instance *instance, Crossing crossing)
{
    Progress *progress = &instance->progress;
    integrator_truncate(&instance->integrator, crossing.time);
    progress->relation = crossing.relation;
    progress->event_pending = true;
}

/* Takes one integrator step, truncated at the first event in it. */
static Status take_step(Instance *instance, double limit)
{
    Progress *progress = &instance->progress;
    const Integrator *integrator = &instance->integrator;
    const double from = integrator->record.time, next = progress->next_time_event;
    const bool event_due = next <= DBL_MAX && next <= limit + instant_at(limit);
    switch (integrator_step(&instance->integrator, event_due ? next : limit)) {
    case STEP_DONE:
        break;
    case STEP_TOO_SMALL:
        return fail(instance, from, "the tolerance cannot be kept with the smallest step.");
    case STEP_NOT_COMPUTABLE:
        return fail_to_compute(instance, from);
    }
    const Crossing crossing = roots_search(&instance->roots, instance->values.p, from, integrator->record.time);
    switch (crossing.result) {
    case ROOTS_NOT_COMPUTABLE:
        return fail_to_compute(instance, from);
    case ROOTS_CROSSED:
        end_at(instance, crossing);
        break;
    case ROOTS_NOT_CROSSED:
        progress->relation = model.n_relations;
        progress->event_pending = integrator->record.time >= next;
        break;
    }
    return STATUS_OK;
}

/* Reports the end of the last integrator step to the importer. */
COLD static Status show_step(Instance *instance, double *target)
{
    const Attendance *attendance = &instance->attendance;
    move_to(instance, instance->integrator.record.time);
    if (model.actions_follow_states && !instance->progress.event_pending) {
        const Status status = check_asserts_here(instance);
        if (status != STATUS_OK)
            return status;
    }
    if (attendance->step_finished(attendance->context, instance->values.time, target))
        return STATUS_OK;
    return fail(instance, instance->values.time, "a call of the importer during the communication step failed.");
}

/* Goes back to the communication point and applies the changes that the importer made there. */
static Status absorb_changes(Instance *instance)
{
    Changes *changed = &instance->changed;
    evaluation_update_parameters(instance);
    bool event = changed->discrete;
    if (!event && model.n_roots > 0) {
        double *root = instance->roots.start;
        if (!evaluation_roots(instance, root))
            return STATUS_ERROR;
        event = roots_first_changed(root, instance->values.p) < model.n_relations;
    }
    *changed = (Changes){0};
    if (event)
        return carry_out_event(instance, false);
    restart(instance);
    return STATUS_OK;
}

void cosimulation_start(Instance *instance)
{
    instance->progress = (Progress){.crowd_start = instance->values.time};
    instance->changed = (Changes){0};
    restart(instance);
}

void cosimulation_resume(Instance *instance)
{
    restart(instance);
}

static bool reaches(const Instance *instance, double target)
{
    const double end = instance->integrator.record.time;
    return instance->progress.event_pending ? end > target + instant_at(target) : end >= target;
}

/* Returns the length of the experiment: up to the communication point if the importer gives no stop time. */
static double span(const Instance *instance, double target)
{
    const Experiment *experiment = &instance->experiment;
    return (isfinite(experiment->stop_time) ? experiment->stop_time : target) - experiment->start_time;
}

/* A root that depends on time or an input may cross zero and return while the states are constant and steps are long.
 * Limiting the steps ensures that such roots are checked at every communication point and in every thousandth of the
 * experiment. */
static double limit_steps(Instance *instance, double target, double limit)
{
    if (!model.roots_follow_time && !model.roots_follow_inputs)
        return limit;
    instance_apply_experiment(instance);
    if (!model.roots_follow_time && !instance->inputs.active)
        return limit;
    double *largest = &instance->integrator.largest_step;
    *largest = smaller(*largest, span(instance, target) / PARTS);
    return target;
}

/* The time at which the counted steps began, and their number. */
typedef struct {
    double since;
    size_t steps;
} Pace;

/* Counts a step; fails if the counted steps have made too little progress. */
static Status keep_pace(Instance *instance, Pace *pace, double wanted)
{
    const double now = instance->integrator.record.time, covered = now - pace->since;
    if (++pace->steps < PATIENCE)
        return STATUS_OK;
    *pace = (Pace){.since = now};
    if (covered >= wanted)
        return STATUS_OK;
    char why[128];
    snprintf(why, sizeof why, "the model is too stiff for this solver: the last %d steps were of about %.1g s.", PATIENCE,
             covered / PATIENCE);
    return fail(instance, now, why);
}

/* Goes to a communication point. Where it lies within the last integrator step, relations and the rest of the model must
 * agree: a change that the step has passed over since the communication point `since` becomes its end. */
static Status arrive(Instance *instance, double since, double target)
{
    const StepRecord *record = &instance->integrator.record;
    const Values *values = &instance->values;
    if (values->time != target || record->time != target)
        move_to(instance, target);
    if (model.n_roots == 0 || target >= record->time)
        return STATUS_OK;
    RootFinder *finder = &instance->roots;
    if (!evaluation_roots(instance, finder->sample))
        return STATUS_ERROR;
    if (roots_first_changed(finder->sample, values->p) == model.n_relations)
        return STATUS_OK;
    const Crossing crossing = roots_locate(finder, values->p, larger(since, record->base), target);
    if (crossing.result == ROOTS_NOT_COMPUTABLE)
        return fail_to_compute(instance, target);
    end_at(instance, crossing);
    return STATUS_OK;
}

/* Takes steps and events until the last step reaches the communication point. */
static Status step_to(Instance *instance, double *target, double limit)
{
    Status status = STATUS_OK;
    const bool attended = instance->attendance.step_finished != NULL;
    const bool *ended = &instance->progress.ended_at_event;
    const double since = instance->values.time;
    const double wanted = smaller(*target - since, span(instance, *target) / PARTS);
    Pace pace = {.since = since};
    do {
        while (status == STATUS_OK && !*ended && !reaches(instance, *target)) {
            if (instance->progress.event_pending)
                status = take_event(instance, *target);
            else if ((status = check_asserts(instance)) == STATUS_OK &&
                     (status = take_step(instance, limit)) == STATUS_OK &&
                     (status = keep_pace(instance, &pace, wanted)) == STATUS_OK && attended)
                status = show_step(instance, target);
        }
        if (status == STATUS_OK && !*ended)
            /* an event at practically the same time may have led slightly beyond the target */
            status = arrive(instance, since, larger(*target, instance->values.time));
    } while (status == STATUS_OK && !*ended && !reaches(instance, *target));
    return status;
}

Status cosimulation_advance(Instance *instance, double target)
{
    Status status = STATUS_OK;
    double limit = smaller(larger(target, instance->experiment.stop_time), DBL_MAX);
    target = larger(target, instance->values.time);
    instance->progress.ended_at_event = false;
    inputs_begin(&instance->inputs, instance->values.time, instance->values.p);
    instance->changed.any = instance->changed.any || instance->inputs.active;
    if (instance->changed.any) {
        /* An importer that has changed something is likely to do so at the next point too: do not step past it. */
        limit = target;
        status = absorb_changes(instance);
    }
    limit = limit_steps(instance, target, limit);
    if (instance->attendance.step_finished != NULL)
        limit = target; /* the importer gets and sets values within this communication step only */
    if (status == STATUS_OK)
        status = step_to(instance, &target, limit);
    if (status != STATUS_OK)
        return status;
    instance->changed.any = instance->inputs.active;
    inputs_end(&instance->inputs);
    return STATUS_OK;
}
