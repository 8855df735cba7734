/* FMI 3.0: functions for features that no model has: variables of other types, clocks, structural parameters,
 * dependencies by element, model partitions. A call for zero variables is valid. */
#include "fmi3_component.h"

#if defined __GNUC__
#pragma GCC diagnostic ignored "-Wunused-parameter" /* the arguments are not used */
#endif

static fmi3Status nothing(fmi3Instance instance, Call call, const char *type, size_t n)
{
    return fmi3_leave(instance, call_access_nothing(fmi3_enter(instance, call), type, n));
}

#define NO_VARIABLES(TYPE)                                                                                            \
    fmi3Status fmi3Get##TYPE(fmi3Instance instance, const fmi3ValueReference references[], size_t n,                  \
                             fmi3##TYPE values[], size_t n_values)                                                    \
    {                                                                                                                 \
        return nothing(instance, CALL_Get##TYPE, #TYPE, n);                                                           \
    }                                                                                                                 \
    fmi3Status fmi3Set##TYPE(fmi3Instance instance, const fmi3ValueReference references[], size_t n,                  \
                             const fmi3##TYPE values[], size_t n_values)                                              \
    {                                                                                                                 \
        return nothing(instance, CALL_Set##TYPE, #TYPE, n);                                                           \
    }

#define NO_CLOCKS(NAME, ...)                                                                                          \
    fmi3Status fmi3##NAME(fmi3Instance instance, const fmi3ValueReference references[], size_t n, __VA_ARGS__)        \
    {                                                                                                                 \
        return nothing(instance, CALL_##NAME, "Clock", n);                                                            \
    }

#define NEVER_ALLOWED(NAME, ...)                                                                                      \
    fmi3Status fmi3##NAME(__VA_ARGS__)                                                                                \
    {                                                                                                                 \
        return nothing(instance, CALL_##NAME, "", 0);                                                                 \
    }

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(UInt64)
NO_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t n, size_t sizes[],
                         fmi3Binary values[], size_t n_values)
{
    return nothing(instance, CALL_GetBinary, "Binary", n);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t n, const size_t sizes[],
                         const fmi3Binary values[], size_t n_values)
{
    return nothing(instance, CALL_SetBinary, "Binary", n);
}

NO_CLOCKS(GetClock, fmi3Clock values[])
NO_CLOCKS(SetClock, const fmi3Clock values[])
NO_CLOCKS(GetIntervalDecimal, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
NO_CLOCKS(GetIntervalFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
NO_CLOCKS(GetShiftDecimal, fmi3Float64 shifts[])
NO_CLOCKS(GetShiftFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
NO_CLOCKS(SetIntervalDecimal, const fmi3Float64 intervals[])
NO_CLOCKS(SetIntervalFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NO_CLOCKS(SetShiftDecimal, const fmi3Float64 shifts[])
NO_CLOCKS(SetShiftFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])

NEVER_ALLOWED(EnterConfigurationMode, fmi3Instance instance)
NEVER_ALLOWED(ExitConfigurationMode, fmi3Instance instance)
NEVER_ALLOWED(GetNumberOfVariableDependencies, fmi3Instance instance, fmi3ValueReference reference, size_t *number)
NEVER_ALLOWED(GetVariableDependencies, fmi3Instance instance, fmi3ValueReference dependent, size_t of_dependent[],
              fmi3ValueReference independents[], size_t of_independents[], fmi3DependencyKind kinds[], size_t n)
NEVER_ALLOWED(ActivateModelPartition, fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 time)
