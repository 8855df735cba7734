/* log.h - messages to the importer, in the FMI 2 standard log categories that the runtime uses. */
#ifndef LOG_H
#define LOG_H

#include <stdbool.h>
#include <stddef.h>

/* The status of a call, in FMI's order of severity. */
typedef enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR, STATUS_FATAL } Status;

typedef enum {
    LOG_EVENTS,
    LOG_STATUS_WARNING,
    LOG_STATUS_DISCARD,
    LOG_STATUS_ERROR,
    LOG_ALL,
    LOG_CATEGORY_COUNT
} LogCategory;

typedef struct {
    void *context;
    void (*write)(void *context, Status status, const char *category, const char *message); /* may be NULL */
    unsigned enabled;     /* bit n: category n */
    const char *escaped;  /* characters that must be doubled for the importer */
} Log;

/* Sets of categories. */
#define LOG_FAILURES (1u << LOG_STATUS_ERROR)
#define LOG_PROBLEMS (1u << LOG_STATUS_WARNING | 1u << LOG_STATUS_DISCARD | LOG_FAILURES)
#define LOG_EVERYTHING ((1u << LOG_CATEGORY_COUNT) - 1u)

/* Switches one category by name, or all of them for "logAll"; returns false if there is no such category. */
bool log_switch(Log *log, const char *category, bool on);

#if defined __GNUC__
__attribute__((format(printf, 4, 5)))
#endif
void log_message(const Log *log, LogCategory category, Status status, const char *format, ...);

static inline bool log_is_on(const Log *log, LogCategory category)
{
    return (log->enabled >> category & 1u) != 0;
}

#endif
