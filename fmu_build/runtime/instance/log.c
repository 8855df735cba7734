#include "log.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MESSAGE_SIZE = 2048 };

static const char *const category_names[LOG_CATEGORY_COUNT] = {
    [LOG_EVENTS] = "logEvents",
    [LOG_STATUS_WARNING] = "logStatusWarning",
    [LOG_STATUS_DISCARD] = "logStatusDiscard",
    [LOG_STATUS_ERROR] = "logStatusError",
    [LOG_ALL] = "logAll",
};

bool log_switch(Log *log, const char *category, bool on)
{
    for (unsigned i = 0; i < LOG_CATEGORY_COUNT; ++i) {
        if (strcmp(category, category_names[i]) == 0) {
            const unsigned mask = i == LOG_ALL ? LOG_EVERYTHING : 1u << i;
            log->enabled = on ? log->enabled | mask : log->enabled & ~mask;
            return true;
        }
    }
    return false;
}

static void escape(char *escaped, size_t size, const char *text, const char *signs)
{
    size_t length = 0;
    for (; *text != '\0' && length + 3 <= size; ++text) {
        if (strchr(signs, *text) != NULL)
            escaped[length++] = *text;
        escaped[length++] = *text;
    }
    escaped[length] = '\0';
}

void log_message(const Log *log, LogCategory category, Status status, const char *format, ...)
{
    if (log->write == NULL || !log_is_on(log, category))
        return;
    char text[MESSAGE_SIZE], escaped[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    escape(escaped, sizeof escaped, text, log->escaped);
    log->write(log->context, status, category_names[category], escaped);
}
