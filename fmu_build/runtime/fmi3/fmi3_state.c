/* FMI 3.0: saving, restoring and serializing the state of an instance. */
#include "fmi3_component.h"

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    return fmi3_leave(instance, call_get_state(fmi3_enter(instance, CALL_GetFMUState), FMUState));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState)
{
    return fmi3_leave(instance, call_set_state(fmi3_enter(instance, CALL_SetFMUState), FMUState));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    return fmi3_leave(instance, call_free_state(fmi3_enter(instance, CALL_FreeFMUState), FMUState));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size)
{
    return fmi3_leave(instance, call_state_size(fmi3_enter(instance, CALL_SerializedFMUStateSize), FMUState, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size)
{
    Instance *entered = fmi3_enter(instance, CALL_SerializeFMUState);
    return fmi3_leave(instance, call_serialize_state(entered, FMUState, serializedState, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState)
{
    Instance *entered = fmi3_enter(instance, CALL_DeserializeFMUState);
    return fmi3_leave(instance, call_deserialize_state(entered, serializedState, size, FMUState));
}
