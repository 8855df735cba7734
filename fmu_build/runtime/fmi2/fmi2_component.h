/* fmi2_component.h - what the files of the FMI 2.0 face share: the component behind the importer's handle and the
 * functions that are allowed in each phase. */
#ifndef FMI2_COMPONENT_H
#define FMI2_COMPONENT_H

#include "calls.h"
#include "fmi2Functions.h"

typedef struct {
    Instance *instance;
    char *name;
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
} Component;

typedef enum {
    CALL_SET_DEBUG_LOGGING,
    CALL_SETUP_EXPERIMENT,
    CALL_ENTER_INITIALIZATION_MODE,
    CALL_EXIT_INITIALIZATION_MODE,
    CALL_TERMINATE,
    CALL_RESET,
    CALL_GET_REAL,
    CALL_GET_INTEGER,
    CALL_GET_BOOLEAN,
    CALL_GET_STRING,
    CALL_SET_REAL,
    CALL_SET_INTEGER,
    CALL_SET_BOOLEAN,
    CALL_SET_STRING,
    CALL_GET_FMU_STATE,
    CALL_SET_FMU_STATE,
    CALL_FREE_FMU_STATE,
    CALL_SERIALIZED_FMU_STATE_SIZE,
    CALL_SERIALIZE_FMU_STATE,
    CALL_DESERIALIZE_FMU_STATE,
    CALL_GET_DIRECTIONAL_DERIVATIVE,
    CALL_ENTER_EVENT_MODE,
    CALL_NEW_DISCRETE_STATES,
    CALL_ENTER_CONTINUOUS_TIME_MODE,
    CALL_COMPLETED_INTEGRATOR_STEP,
    CALL_SET_TIME,
    CALL_SET_CONTINUOUS_STATES,
    CALL_GET_DERIVATIVES,
    CALL_GET_EVENT_INDICATORS,
    CALL_GET_CONTINUOUS_STATES,
    CALL_GET_NOMINALS,
    CALL_SET_REAL_INPUT_DERIVATIVES,
    CALL_GET_REAL_OUTPUT_DERIVATIVES,
    CALL_DO_STEP,
    CALL_CANCEL_STEP,
    CALL_GET_STATUS,
    CALL_GET_REAL_STATUS,
    CALL_GET_INTEGER_STATUS,
    CALL_GET_BOOLEAN_STATUS,
    CALL_GET_STRING_STATUS,
    CALL_COUNT
} Call;

extern const Face fmi2_face;

/* The instance behind a handle where the call is allowed in its phase; else NULL, after a message. */
Instance *fmi2_enter(fmi2Component handle, Call call);

static inline fmi2Status fmi2_status(Status status)
{
    _Static_assert((int)fmi2OK == (int)STATUS_OK && (int)fmi2Warning == (int)STATUS_WARNING &&
                       (int)fmi2Discard == (int)STATUS_DISCARD && (int)fmi2Error == (int)STATUS_ERROR &&
                       (int)fmi2Fatal == (int)STATUS_FATAL,
                   "the severities of FMI 2.0");
    return (fmi2Status)status;
}

#endif
