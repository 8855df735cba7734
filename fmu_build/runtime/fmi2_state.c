/* FMI 2.0: saving, restoring and serializing the state of an instance. */
#include "fmi2_component.h"
#include "state.h"

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    const Instance *instance = fmi2_enter(c, CALL_GET_FMU_STATE);
    if (instance == NULL || !fmi2_has_array(instance, CALL_GET_FMU_STATE, 1, FMUstate))
        return fmi2Error;
    SavedState *state = *FMUstate;
    if (!state_save(instance, &state))
        return fmi2_refuse(instance, CALL_GET_FMU_STATE, "memory is short.");
    *FMUstate = state;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate)
{
    Instance *instance = fmi2_enter(c, CALL_SET_FMU_STATE);
    if (instance == NULL || !fmi2_has_array(instance, CALL_SET_FMU_STATE, 1, FMUstate))
        return fmi2Error;
    return state_restore(instance, FMUstate) ? fmi2OK : fmi2Error;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    const Instance *instance = fmi2_enter(c, CALL_FREE_FMU_STATE);
    if (instance == NULL)
        return fmi2Error;
    if (FMUstate == NULL)
        return fmi2OK;
    state_free(*FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size)
{
    const Instance *instance = fmi2_enter(c, CALL_SERIALIZED_FMU_STATE_SIZE);
    if (instance == NULL || !fmi2_has_array(instance, CALL_SERIALIZED_FMU_STATE_SIZE, 1, FMUstate) ||
        !fmi2_has_array(instance, CALL_SERIALIZED_FMU_STATE_SIZE, 1, size))
        return fmi2Error;
    *size = state_size(instance);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size)
{
    const Instance *instance = fmi2_enter(c, CALL_SERIALIZE_FMU_STATE);
    if (instance == NULL || !fmi2_has_array(instance, CALL_SERIALIZE_FMU_STATE, 1, FMUstate) ||
        !fmi2_has_array(instance, CALL_SERIALIZE_FMU_STATE, 1, serializedState))
        return fmi2Error;
    if (size < state_size(instance))
        return fmi2_refuse(instance, CALL_SERIALIZE_FMU_STATE, "there is not enough room for the state.");
    state_write(FMUstate, serializedState);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate)
{
    const Instance *instance = fmi2_enter(c, CALL_DESERIALIZE_FMU_STATE);
    if (instance == NULL || !fmi2_has_array(instance, CALL_DESERIALIZE_FMU_STATE, 1, serializedState) ||
        !fmi2_has_array(instance, CALL_DESERIALIZE_FMU_STATE, 1, FMUstate))
        return fmi2Error;
    SavedState *state = state_read(instance, serializedState, size);
    if (state == NULL)
        return fmi2Error;
    state_free(*FMUstate);
    *FMUstate = state;
    return fmi2OK;
}
