/* model.h - a model that makes every kind of trouble on request; fmi2.c and fmi3.c are its two faces.
 *
 * y grows by gain times the integral of u, a straight line in each step; `trouble` comes with the first step that
 * begins at the time `when` or later. Needs POSIX. */
#ifndef MODEL_H
#define MODEL_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Value references. */
enum { GAIN = 1, WHEN, DELAY, TROUBLE, FLAG, LABEL, TINY, U = 11, Y = 21, STEPS, NEGATED, LENGTH, TWICE, STOP };

/* Values of `trouble`. */
enum {
    NONE,
    ERROR,
    DISCARD,
    FATAL,
    NO_STATUS,
    FOREVER,
    REFUSED_START,
    WARNINGS,
    NO_RESET,
    FATAL_RESET,
    ENDS,
    COMES_BACK_EARLY,
    EXITS,
    ABORTS,
    CRASHES,
    PRINTS,
    KEEPS_STATE,
    STOPS_SHORT,
    ABORTS_AFTERWARDS,
    CLOSES_STREAMS
};

/* The same in both versions of FMI. */
enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR, STATUS_FATAL };

typedef struct {
    double gain, when, delay /* ms a step */, u, slope, y, stop /* time, -1 where not told */;
    int32_t trouble, steps;
    int8_t tiny; /* twice has two times that */
    bool flag, is_dead, has_ended;
    double reached; /* the end of the last step, or where the model ended the run */
    char label[64];
} Model;

static void model_start(Model *model)
{
    *model = (Model){.gain = 1.0, .label = "label", .stop = -1.0};
}

static int model_reset(Model *model)
{
    if (model->is_dead)
        abort(); /* the importer must not call after a fatal error */
    if (model->trouble == NO_RESET)
        return STATUS_ERROR;
    if (model->trouble == FATAL_RESET) {
        model->is_dead = true;
        return STATUS_FATAL;
    }
    const double y = model->trouble == KEEPS_STATE ? model->y : 0.0;
    model_start(model);
    model->y = y;
    return STATUS_OK;
}

static void model_end(const Model *model)
{
    if (model->is_dead || model->trouble == ABORTS_AFTERWARDS)
        abort();
}

static void model_print(void)
{
    for (int i = 0; i < 20000; ++i)
        printf("line %d of what nobody asked for\n", i);
    fflush(stdout);
}

/* Closes the standard streams, and opens a file as standard error; whether nobody else has written to that. */
static bool model_close_streams(void)
{
    if (lseek(STDERR_FILENO, 0, SEEK_CUR) > 0)
        return false;
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        close(stream);
    char name[] = "/tmp/awkward-XXXXXX";
    const int file = mkstemp(name);
    unlink(name);
    return dup2(file, STDERR_FILENO) == STDERR_FILENO;
}

static void model_sleep(double milliseconds)
{
    const long nanoseconds = (long)(milliseconds * 1e6);
    nanosleep(&(struct timespec){nanoseconds / 1000000000L, nanoseconds % 1000000000L}, NULL);
}

static int model_step(Model *model, double time, double length)
{
    if (model->is_dead)
        abort();
    if (model->delay > 0.0)
        model_sleep(model->delay);
    const int trouble = time >= model->when ? model->trouble : NONE;
    if (trouble == ERROR)
        return STATUS_ERROR;
    if (trouble == DISCARD)
        return STATUS_DISCARD;
    if (trouble == NO_STATUS)
        return 17;
    if (trouble == FATAL) {
        model->is_dead = true;
        return STATUS_FATAL;
    }
    while (trouble == FOREVER)
        model_sleep(1000.0);
    if (trouble == EXITS)
        exit(0);
    if (trouble == ABORTS)
        abort();
    if (trouble == CRASHES)
        raise(SIGSEGV);
    if (trouble == PRINTS)
        model_print();
    if (trouble == CLOSES_STREAMS && !model_close_streams())
        return STATUS_ERROR;
    model->has_ended = trouble == ENDS;
    length *= model->has_ended ? 0.5 : 1.0;
    model->reached = time + length;
    model->y += model->gain * length * (model->u + 0.5 * length * model->slope);
    model->steps += 1;
    return trouble == WARNINGS ? STATUS_WARNING : STATUS_OK;
}

#endif
