#include "calls.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

Instance *call_enter(Instance *instance, const Rule *rule)
{
    const unsigned allowed = instance->co_simulation ? rule->co_simulation : rule->model_exchange;
    instance->call = rule->name;
    if ((allowed >> instance->phase & 1u) != 0)
        return instance;
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "%s is not allowed in %s of %s.", rule->name,
                instance->face->phase_names[instance->phase],
                instance->co_simulation ? "Co-Simulation" : "Model Exchange");
    return NULL;
}

Status call_refuse(const Instance *instance, const char *format, ...)
{
    char why[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why, sizeof why, format, arguments);
    va_end(arguments);
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "%s: %s", instance->call, why);
    return STATUS_ERROR;
}

bool call_has(const Instance *instance, size_t n, const void *array)
{
    if (instance != NULL && (n == 0 || array != NULL))
        return true;
    if (instance != NULL)
        call_refuse(instance, "an argument that must be an array is a null pointer.");
    return false;
}

Status call_finish(Instance *instance, Status status)
{
    if (status >= STATUS_ERROR)
        instance->phase = PHASE_ERROR;
    if (status == STATUS_OK && instance->warned)
        status = STATUS_WARNING;
    instance->warned = false;
    return status;
}

const char *call_fault_of_creation(const char *name, const char *token)
{
    if (name == NULL || name[strspn(name, " \t\r\n")] == '\0')
        return "The instance has no name.";
    if (token == NULL || strcmp(token, model.token) != 0)
        return "The GUID is not that of this model: modelDescription.xml belongs to another binary.";
    return NULL;
}
