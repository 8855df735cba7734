/* fmi3_intermediate.h - FMI 3.0: intermediate updates, in which the importer takes part in a communication step. */
#ifndef FMI3_INTERMEDIATE_H
#define FMI3_INTERMEDIATE_H

#include "fmi3_component.h"

/* Arranges calls of component->intermediate_update, if there is one: after every integrator step, and whenever the
 * integrator needs those inputs that are among the variables. Returns why the variables are not allowed, or NULL. */
const char *intermediate_attend(Component *component, const fmi3ValueReference variables[], size_t n);

/* Returns false, after a message, if an intermediate update is in progress that does not allow this access. */
bool intermediate_allows(const Component *component, bool setting, const fmi3ValueReference variables[], size_t n);

#endif
