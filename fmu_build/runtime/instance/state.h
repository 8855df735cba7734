/* state.h - saved states: a copy of everything that determines how an instance continues: its values, its phase in the
 * life cycle and the state of the integrator. */
#ifndef STATE_H
#define STATE_H

#include "instance.h"

typedef struct SavedState SavedState;

/* Saves to *state, which is allocated if it is NULL; returns false if memory runs out. */
bool state_save(const Instance *instance, SavedState **state);
/* Returns false, after a message, if the state was saved by the other FMI type (Model Exchange or Co-Simulation). */
bool state_restore(Instance *instance, const SavedState *state);
void state_free(SavedState *state);

/* The state as bytes, valid for the same model in the same kind of binary. */
size_t state_size(const Instance *instance);
void state_write(const SavedState *state, void *bytes);

/* Returns NULL, after a message, if the bytes are not a complete and consistent state of this model. */
SavedState *state_read(const Instance *instance, const void *bytes, size_t size);

#endif
