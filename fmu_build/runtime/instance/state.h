/* state.h - a copy of everything that makes an instance continue the way it would have: values, place in the
 * life cycle, and how far the integrator is ahead. */
#ifndef STATE_H
#define STATE_H

#include "instance.h"

typedef struct SavedState SavedState;

/* Saves into *state, which is allocated where it is NULL; false where memory is short. */
bool state_save(const Instance *instance, SavedState **state);
/* False, after a message, where the state is not one of such an instance. */
bool state_restore(Instance *instance, const SavedState *state);
void state_free(SavedState *state);

/* The state as bytes, for the same model in the same kind of binary. */
size_t state_size(const Instance *instance);
void state_write(const SavedState *state, void *bytes);

/* NULL, after a message, where the bytes are not a whole state of this model. */
SavedState *state_read(const Instance *instance, const void *bytes, size_t size);

#endif
