/* fmi3_intermediate.h - FMI 3.0: intermediate updates, in which the importer takes part in a communication step. */
#ifndef FMI3_INTERMEDIATE_H
#define FMI3_INTERMEDIATE_H

#include "fmi3_component.h"

/* Has component->intermediate_update called, if there is one: after every step of the integrator, and wherever the
 * integrator needs the inputs among the variables. Why these variables cannot be had, or NULL. */
const char *intermediate_attend(Component *component, const fmi3ValueReference variables[], size_t n);

/* False, after a message, where an intermediate update is under way that allows no such access. */
bool intermediate_allows(const Component *component, bool setting, const fmi3ValueReference variables[], size_t n);

#endif
