#include "state.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FORMAT_VERSION = 2, TOKEN_SIZE = 64 };
static const char magic[8] = {'F', 'M', 'U', 's', 't', 'a', 't', 'e'};
static const uint32_t byte_order = 0x01020304u;
static const char other_interface[] = "it belongs to the other of Model Exchange and Co-Simulation";

typedef struct {
    char magic[8];
    uint32_t version, byte_order;
    uint64_t size; /* of the whole state in bytes */
    uint64_t checksum; /* of the content after the header */
    char token[TOKEN_SIZE];
} Header;

typedef struct {
    Phase phase;
    bool co_simulation;
    Experiment experiment;
    Changes changed;
    UpToDate current;
    Progress progress;
    StepMemory steps;
    StepRecord step;
    double time;
} Plain;

struct SavedState {
    Header header;
    Plain plain;
    double block[];
};

size_t state_size(const Instance *instance)
{
    return sizeof(SavedState) + instance->block_count * sizeof(double);
}

/* FNV-1a. */
static uint64_t checksum(const SavedState *state)
{
    const unsigned char *bytes = (const unsigned char *)state;
    uint64_t hash = 14695981039346656037u;
    for (size_t i = sizeof(Header); i < state->header.size; ++i)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

bool state_save(const Instance *instance, SavedState **state)
{
    const size_t size = state_size(instance);
    if (*state == NULL)
        *state = calloc(1, size);
    SavedState *saved = *state;
    if (saved == NULL)
        return false;
    memcpy(saved->header.magic, magic, sizeof magic);
    saved->header.version = FORMAT_VERSION;
    saved->header.byte_order = byte_order;
    saved->header.size = size;
    strncpy(saved->header.token, model.token, TOKEN_SIZE - 1);
    Plain *plain = &saved->plain;
    plain->phase = instance->phase;
    plain->co_simulation = instance->co_simulation;
    plain->experiment = instance->experiment;
    plain->changed = instance->changed;
    plain->current = instance->current;
    plain->progress = instance->progress;
    plain->steps = instance->steps;
    plain->step = instance->integrator.record;
    plain->time = instance->values.time;
    memcpy(saved->block, instance->block, instance->block_count * sizeof(double));
    return true;
}

static void refuse(const Instance *instance, const char *why)
{
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "The saved FMU state is refused: %s.", why);
}

bool state_restore(Instance *instance, const SavedState *state)
{
    const Plain *plain = &state->plain;
    if (plain->co_simulation != instance->co_simulation) {
        refuse(instance, other_interface);
        return false;
    }
    instance->phase = plain->phase;
    instance->experiment = plain->experiment;
    instance->changed = plain->changed;
    instance->current = plain->current;
    instance->progress = plain->progress;
    instance->steps = plain->steps;
    instance->integrator.record = plain->step;
    instance->values.time = plain->time;
    memcpy(instance->block, state->block, instance->block_count * sizeof(double));
    instance_apply_experiment(instance);
    return true;
}

void state_free(SavedState *state)
{
    free(state);
}

void state_write(const SavedState *state, void *bytes)
{
    Header header = state->header;
    header.checksum = checksum(state);
    memcpy(bytes, state, state->header.size);
    memcpy(bytes, &header, sizeof header);
}

/* Offsets of the bools, for which values other than 0 and 1 are undefined behavior in C. */
static const size_t truths[] = {
    offsetof(Plain, co_simulation),       offsetof(Plain, changed.any),
    offsetof(Plain, changed.parameters),  offsetof(Plain, changed.discrete),
    offsetof(Plain, current.initialization), offsetof(Plain, current.algebraics),
    offsetof(Plain, current.derivatives), offsetof(Plain, progress.event_pending),
    offsetof(Plain, progress.ended_at_event), offsetof(Plain, step.slope_known),
};

static bool truths_are_sound(const Plain *plain)
{
    _Static_assert(sizeof(bool) == 1, "a truth value is one byte");
    for (size_t i = 0; i < sizeof truths / sizeof *truths; ++i)
        if (((const unsigned char *)plain)[truths[i]] > 1)
            return false;
    return true;
}

/* Returns whether an instance of this kind can be in this phase and be saved there. */
static bool phase_is_sound(const Instance *instance, Phase phase)
{
    switch (phase) {
    case PHASE_INSTANTIATED:
    case PHASE_INITIALIZATION:
    case PHASE_TERMINATED:
        return true;
    case PHASE_ERROR:
        return !instance->face->errors_terminate;
    case PHASE_EVENT:
        return !instance->co_simulation || instance->attendance.event_mode;
    case PHASE_CONTINUOUS_TIME:
        return !instance->co_simulation;
    case PHASE_STEP_COMPLETE:
    case PHASE_STEP_DISCARDED:
        return instance->co_simulation;
    case PHASE_INTERMEDIATE:
        break;
    }
    return false;
}

/* Checks the steps of the integrator: sizes are not negative, and the last step covers the present time and is
 * consistent with its own start and size. */
static bool steps_are_sound(const Plain *plain)
{
    const StepRecord *step = &plain->step;
    for (size_t i = 0; i < STEP_MEMORY_SIZE; ++i)
        if (!(plain->steps.step[i] >= 0.0))
            return false;
    if (!(step->suggestion >= 0.0) || !isfinite(step->time) || !isfinite(step->base) || !isfinite(step->step))
        return false;
    if (plain->phase != PHASE_STEP_COMPLETE)
        return true;
    const double rounding = 16.0 * DBL_EPSILON * fabs(step->time);
    return step->base <= plain->time && plain->time <= step->time && step->time - step->base <= step->step + rounding;
}

/* Checks that ticks are counted from time 0, as before initialization, or from where the model says. */
static bool clocks_are_sound(const Instance *instance, const SavedState *state)
{
    const double *tick = state->block + (instance->values.clock_tick - instance->block);
    const double *zero = state->block + (instance->values.clock_zero - instance->block);
    for (size_t i = 0; i < model.n_clocks; ++i) {
        const bool from_start = model.clocks[i].counts_from_start && zero[i] == state->plain.experiment.start_time;
        if (!(tick[i] >= 0.0 && isfinite(tick[i]) && tick[i] == floor(tick[i])) || !(zero[i] == 0.0 || from_start))
            return false;
    }
    return true;
}

static bool experiment_is_sound(const Experiment *experiment)
{
    return isfinite(experiment->start_time) && experiment->stop_time >= experiment->start_time &&
           experiment->tolerance > 0.0 && isfinite(experiment->tolerance);
}

static bool progress_is_sound(const Progress *progress)
{
    return progress->relation <= model.n_relations && !isnan(progress->next_time_event) &&
           isfinite(progress->crowd_start) && (unsigned)progress->last_step <= STATUS_FATAL;
}

/* A valid checksum can be forged, so the values that are used as indices, conditions and times are checked too. */
static const char *fault_of_content(const Instance *instance, const SavedState *state)
{
    const Plain *plain = &state->plain;
    if (!truths_are_sound(plain))
        return "a truth value is neither false nor true";
    if (plain->co_simulation != instance->co_simulation)
        return other_interface;
    if (!phase_is_sound(instance, plain->phase))
        return "this instance cannot be in such a phase";
    if (!experiment_is_sound(&plain->experiment))
        return "start time, stop time and tolerance are impossible";
    if (!progress_is_sound(&plain->progress) || !steps_are_sound(plain) || !clocks_are_sound(instance, state) ||
        !isfinite(plain->time))
        return "times, steps and events contradict each other";
    return NULL;
}

static const char *fault(const Instance *instance, const Header *header, size_t size)
{
    if (memcmp(header->magic, magic, sizeof magic) != 0)
        return "it is not a saved FMU state";
    if (header->version != FORMAT_VERSION || header->byte_order != byte_order)
        return "it was written by another version or on another kind of machine";
    if (strncmp(header->token, model.token, TOKEN_SIZE - 1) != 0)
        return "it belongs to another model";
    if (size != state_size(instance) || header->size != size)
        return "its size is wrong";
    return NULL;
}

SavedState *state_read(const Instance *instance, const void *bytes, size_t size)
{
    Header header;
    const char *why = "it is too short";
    SavedState *state = NULL;
    if (size >= sizeof header) {
        memcpy(&header, bytes, sizeof header);
        why = fault(instance, &header, size);
    }
    if (why == NULL) {
        state = malloc(size);
        if (state == NULL) {
            why = "out of memory";
        } else {
            memcpy(state, bytes, size);
            why = checksum(state) != header.checksum ? "its content is damaged" : fault_of_content(instance, state);
        }
    }
    if (why == NULL)
        return state;
    free(state);
    refuse(instance, why);
    return NULL;
}
