/* messages.h - what the instance of a WebAssembly module said in the last call that failed. */
#ifndef MESSAGES_H
#define MESSAGES_H

#include "fmi2FunctionTypes.h"

#include <stdbool.h>

/* The logger: keeps problems of the present call; warnings are dropped. */
void messages_add(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                  fmi2String format, ...);
/* Ends the present call: what it said replaces what an earlier one said if it failed, and is dropped if not. */
void messages_end_call(bool failed);
void messages_clear(void);
const char *messages_of_failure(void); /* one a line */

#endif
