/* FMI 2.0: saving, restoring and serializing the state of an instance. */
#include "fmi2_component.h"

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    return fmi2_status(call_get_state(fmi2_enter(c, CALL_GetFMUstate), FMUstate));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate)
{
    return fmi2_status(call_set_state(fmi2_enter(c, CALL_SetFMUstate), FMUstate));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    return fmi2_status(call_free_state(fmi2_enter(c, CALL_FreeFMUstate), FMUstate));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size)
{
    return fmi2_status(call_state_size(fmi2_enter(c, CALL_SerializedFMUstateSize), FMUstate, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size)
{
    return fmi2_status(
        call_serialize_state(fmi2_enter(c, CALL_SerializeFMUstate), FMUstate, serializedState, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate)
{
    return fmi2_status(
        call_deserialize_state(fmi2_enter(c, CALL_DeSerializeFMUstate), serializedState, size, FMUstate));
}
