#include "calls.h"
#include "state.h"

Status call_get_state(const Instance *instance, void **state)
{
    if (!call_has(instance, 1, state))
        return STATUS_ERROR;
    SavedState *saved = *state;
    if (!state_save(instance, &saved))
        return call_refuse(instance, "out of memory.");
    *state = saved;
    return STATUS_OK;
}

Status call_set_state(Instance *instance, const void *state)
{
    return call_has(instance, 1, state) && state_restore(instance, state) ? STATUS_OK : STATUS_ERROR;
}

Status call_free_state(const Instance *instance, void **state)
{
    if (instance == NULL)
        return STATUS_ERROR;
    if (state != NULL) {
        state_free(*state);
        *state = NULL;
    }
    return STATUS_OK;
}

Status call_state_size(const Instance *instance, const void *state, size_t *size)
{
    if (!call_has(instance, 1, state) || !call_has(instance, 1, size))
        return STATUS_ERROR;
    *size = state_size(instance);
    return STATUS_OK;
}

Status call_serialize_state(const Instance *instance, const void *state, void *bytes, size_t size)
{
    if (!call_has(instance, 1, state) || !call_has(instance, 1, bytes))
        return STATUS_ERROR;
    if (size < state_size(instance))
        return call_refuse(instance, "there is not enough room for the state.");
    state_write(state, bytes);
    return STATUS_OK;
}

Status call_deserialize_state(const Instance *instance, const void *bytes, size_t size, void **state)
{
    if (!call_has(instance, 1, bytes) || !call_has(instance, 1, state))
        return STATUS_ERROR;
    SavedState *read = state_read(instance, bytes, size);
    if (read == NULL)
        return STATUS_ERROR;
    state_free(*state);
    *state = read;
    return STATUS_OK;
}
