/* messages.h - the messages of the instance of a WebAssembly module in the last failed call. */
#ifndef MESSAGES_H
#define MESSAGES_H

#include "fmi2FunctionTypes.h"

#include <stdbool.h>

/* The logger: stores problems of the current call; warnings are dropped. */
void messages_add(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                  fmi2String format, ...);
/* Ends the current call: if it failed, its messages replace the earlier ones, else they are dropped. */
void messages_end_call(bool failed);
void messages_clear(void);
const char *messages_of_failure(void); /* one per line */

#endif
