#include "messages.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 4096 };

static char present[SIZE], failure[SIZE];

/* "##" stands for "#", which otherwise begins a reference to a variable. */
static void append(const char *text)
{
    size_t length = strlen(present);
    if (length > 0 && length + 1 < SIZE)
        present[length++] = '\n';
    for (; *text != '\0' && length + 1 < SIZE; ++text) {
        if (text[0] == '#' && text[1] == '#')
            ++text;
        present[length++] = *text;
    }
    present[length] = '\0';
}

void messages_add(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                  fmi2String format, ...)
{
    (void)environment;
    (void)name;
    (void)category;
    if (status == fmi2OK || status == fmi2Warning)
        return;
    char text[SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    append(text);
}

void messages_end_call(bool failed)
{
    if (failed)
        memcpy(failure, present, SIZE);
    present[0] = '\0';
}

void messages_clear(void)
{
    present[0] = failure[0] = '\0';
}

const char *messages_of_failure(void)
{
    return failure;
}
