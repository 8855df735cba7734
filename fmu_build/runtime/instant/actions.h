/* actions.h - assert(), warnings and terminate(). */
#ifndef ACTIONS_H
#define ACTIONS_H

#include "events.h"

/* Takes the actions whose condition holds, a warning only once while its condition holds. `active` is scratch space for
 * model.n_actions values. */
EventStatus actions_take(Values *values, bool *active, const EventReporter *reporter);

#endif
