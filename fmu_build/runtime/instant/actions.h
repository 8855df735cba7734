/* actions.h - assert(), warnings and terminate(). */
#ifndef ACTIONS_H
#define ACTIONS_H

#include "events.h"

/* Executes the actions whose condition is true, warnings only when it becomes true. `active` is scratch space for
 * model.n_actions values. */
EventStatus actions_take(Values *values, bool *active, const EventReporter *reporter);

#endif
