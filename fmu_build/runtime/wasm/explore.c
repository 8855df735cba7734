#include "explore.h"
#include "fmi2Functions.h"
#include "messages.h"
#include "model.h"

#include <stddef.h>

/* The arguments of explore_inputs. */
typedef struct {
    size_t n;
    const uint32_t *references;
    int32_t rows;
    const double *values, *slopes;
} InputTable;

/* The variables of a table, see explore_run. */
typedef struct {
    size_t n;
    const uint32_t *references;
    const char *kinds;
} Columns;

/* The communication points of a run. */
typedef struct {
    const double *times; /* or NULL: */
    double start, step;
} Points;

static fmi2Component component;
static InputTable inputs;
static int32_t failed_status;

static bool is_good(fmi2Status status)
{
    return status == fmi2OK || status == fmi2Warning;
}

static int32_t finish(fmi2Status status)
{
    messages_end_call(!is_good(status));
    if (is_good(status))
        return 0;
    return failed_status = (int32_t)status;
}

/* A page may forget explore_begin; the FMI functions would not report it. */
static int32_t refuse_without_begin(void)
{
    messages_add(NULL, "", fmi2Error, "", "explore_begin must be called first.");
    return finish(fmi2Error);
}

int32_t explore_status(void)
{
    return failed_status;
}

const char *explore_message(void)
{
    return messages_of_failure();
}

static bool renew(void)
{
    static const fmi2CallbackFunctions functions = {.logger = messages_add};
    if (component != NULL && fmi2Reset(component) == fmi2OK)
        return true;
    fmi2FreeInstance(component);
    component = fmi2Instantiate(model.name, fmi2CoSimulation, model.token, NULL, &functions, fmi2False, fmi2False);
    return component != NULL;
}

int32_t explore_begin(double start, double stop, double tolerance)
{
    messages_clear();
    failed_status = 0;
    inputs = (InputTable){0};
    if (!renew())
        return finish(fmi2Error);
    return finish(fmi2SetupExperiment(component, tolerance != 0.0, tolerance, start, fmi2True, stop));
}

int32_t explore_set_real(int32_t n, const uint32_t *references, const double *values)
{
    return component == NULL ? refuse_without_begin()
                             : finish(fmi2SetReal(component, references, (size_t)n, values));
}

int32_t explore_set_integer(int32_t n, const uint32_t *references, const int32_t *values)
{
    return component == NULL ? refuse_without_begin()
                             : finish(fmi2SetInteger(component, references, (size_t)n, values));
}

int32_t explore_set_boolean(int32_t n, const uint32_t *references, const int32_t *values)
{
    return component == NULL ? refuse_without_begin()
                             : finish(fmi2SetBoolean(component, references, (size_t)n, values));
}

int32_t explore_initialize(void)
{
    if (component == NULL)
        return refuse_without_begin();
    const int32_t failed = finish(fmi2EnterInitializationMode(component));
    return failed != 0 ? failed : finish(fmi2ExitInitializationMode(component));
}

void explore_inputs(int32_t n, const uint32_t *references, int32_t rows, const double *values, const double *slopes)
{
    inputs = (InputTable){rows > 0 ? (size_t)n : 0, references, rows, values, slopes};
}

/* Sets the inputs of a row and, unless it is the last, their slopes, which are valid for one step. */
static fmi2Status set_inputs(int32_t row, bool is_last)
{
    const size_t at = (size_t)(row < inputs.rows ? row : inputs.rows - 1) * inputs.n;
    fmi2Status status = fmi2SetReal(component, inputs.references, inputs.n, inputs.values + at);
    if (inputs.slopes == NULL || is_last || row >= inputs.rows)
        return status;
    for (size_t i = 0; i < inputs.n && is_good(status); ++i) {
        const fmi2Integer order = 1;
        /* Discrete inputs have no slope, not even zero. */
        if (inputs.slopes[at + i] != 0.0)
            status = fmi2SetRealInputDerivatives(component, &inputs.references[i], 1, &order, &inputs.slopes[at + i]);
    }
    return status;
}

enum { MOST = 64 }; /* Integer or Boolean variables of one call */

static fmi2Status get(char kind, const uint32_t *references, size_t n, double *values)
{
    fmi2Integer numbers[MOST];
    fmi2Status status = fmi2Error;
    switch (kind) {
    case 'r':
        return fmi2GetReal(component, references, n, values);
    case 'i':
        status = fmi2GetInteger(component, references, n, numbers);
        break;
    case 'b':
        status = fmi2GetBoolean(component, references, n, numbers);
        break;
    default:
        messages_add(NULL, "", fmi2Error, "", "a kind of variable is none of 'r', 'i' and 'b'.");
    }
    for (size_t i = 0; i < n && is_good(status); ++i)
        values[i] = numbers[i];
    return status;
}

/* Reads consecutive variables of one kind with one call. */
static fmi2Status fill(const Columns *columns, double *row)
{
    fmi2Status status = fmi2OK;
    size_t end = 0;
    for (size_t i = 0; i < columns->n && is_good(status); i = end) {
        const char kind = columns->kinds[i];
        const size_t most = kind == 'r' ? columns->n : MOST;
        for (end = i + 1; end < columns->n && end - i < most && columns->kinds[end] == kind; ++end) {}
        status = get(kind, &columns->references[i], end - i, &row[i]);
    }
    return status;
}

static double time_of(const Points *points, int32_t row)
{
    return points->times != NULL ? points->times[row] : points->start + points->step * row;
}

static int32_t run(const Columns *columns, int32_t rows, const Points *points, double *table)
{
    if (component == NULL) {
        refuse_without_begin();
        return 0;
    }
    for (int32_t row = 0; row < rows; ++row) {
        fmi2Status status = fmi2OK;
        if (row > 0) {
            const double time = time_of(points, row - 1);
            status = fmi2DoStep(component, time, time_of(points, row) - time, fmi2True);
        }
        if (is_good(status) && inputs.n > 0)
            status = set_inputs(row, row + 1 == rows);
        if (is_good(status))
            status = fill(columns, table + (size_t)row * columns->n);
        if (finish(status) != 0)
            return row;
    }
    return rows;
}

int32_t explore_run(int32_t n, const uint32_t *references, const char *kinds, int32_t rows, double start, double step,
                    double *table)
{
    return run(&(Columns){(size_t)n, references, kinds}, rows, &(Points){NULL, start, step}, table);
}

int32_t explore_record(int32_t n, const uint32_t *references, const char *kinds, int32_t rows, const double *times,
                       double *table)
{
    return run(&(Columns){(size_t)n, references, kinds}, rows, &(Points){times, 0.0, 0.0}, table);
}

int32_t explore_step(double time, double step)
{
    return component == NULL ? refuse_without_begin() : finish(fmi2DoStep(component, time, step, fmi2True));
}

double explore_time(void)
{
    double time = 0.0;
    if (component != NULL)
        fmi2GetRealStatus(component, fmi2LastSuccessfulTime, &time);
    return time;
}
