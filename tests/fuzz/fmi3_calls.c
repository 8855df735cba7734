/* fmi3_calls.c - libFuzzer target: any FMI 3.0 calls in any order, with any arguments and callbacks that call back.
 *
 * Sanitizers see what is wrong with memory. Beyond that: a restored state repeats the step bit by bit, a serialized one
 * comes back the same, and at the end nothing stays allocated. */
#include "bytes.h"
#include "fmi3Functions.h"
#include "token.h"

typedef struct {
    Bytes bytes;
    fmi3Instance instance;
    fmi3FMUState states[MAX_STATES];
    double time;
    int calls_back; /* what the callbacks do */
} Fuzz;

static Fuzz *now;

static fmi3Status step(Fuzz *f, double size)
{
    bool event, terminate, early;
    double last;
    const fmi3Status status =
        fmi3DoStep(f->instance, f->time, size, true, &event, &terminate, &early, &last);
    if (status == fmi3OK) {
        demand(isfinite(last) && last >= f->time, "a step ends at a time that is not before its start");
        f->time = last;
    }
    return status;
}

typedef fmi3FMUState State;
#define OK fmi3OK
#define GET_STATE fmi3GetFMUState
#define SET_STATE fmi3SetFMUState
#define FREE_STATE fmi3FreeFMUState
#define SERIALIZED_SIZE fmi3SerializedFMUStateSize
#define SERIALIZE fmi3SerializeFMUState
#define DESERIALIZE fmi3DeserializeFMUState
#include "states.h"

static void call_back(void)
{
    Fuzz *f = now;
    double value = 0.0;
    const int what = f->calls_back;
    f->calls_back = 0;
    if (what == 1)
        fmi3GetFloat64(f->instance, &(unsigned){1}, 1, &value, 1);
    else if (what == 2)
        fmi3SetFloat64(f->instance, &(unsigned){4}, 1, &value, 1);
    else if (what == 3)
        step(f, 0.01);
    else if (what == 4)
        fmi3Reset(f->instance);
    f->calls_back = what;
}

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    (void)environment, (void)status;
    demand(category != NULL && text != NULL, "a message has a category and a text");
    call_back();
}

static void intermediate_update(fmi3InstanceEnvironment environment, double time, bool set, bool get, bool finished,
                                bool may_return, bool *early, double *until)
{
    (void)environment, (void)set, (void)get, (void)finished;
    demand(isfinite(time), "an intermediate time is a number");
    call_back();
    *early = may_return && now->calls_back == 2;
    *until = time;
}

static void integers(Fuzz *f, unsigned kind, const unsigned *references, size_t n, size_t n_values)
{
    int64_t large[2 * MAX_REFERENCES] = {0};
    bool truths[2 * MAX_REFERENCES] = {0};
    fmi3String strings[2 * MAX_REFERENCES] = {"", NULL};
    for (size_t i = 0; i < MAX_REFERENCES; ++i)
        large[i] = (int)take(&f->bytes) - 3, truths[i] = large[i] > 0;
    switch (kind) {
    case 0: fmi3GetInt32(f->instance, references, n, (int32_t *)large, n_values); break;
    case 1: fmi3SetInt32(f->instance, references, n, (int32_t *)large, n_values); break;
    case 2: fmi3GetInt64(f->instance, references, n, large, n_values); break;
    case 3: fmi3SetInt64(f->instance, references, n, large, n_values); break;
    case 4: fmi3GetBoolean(f->instance, references, n, truths, n_values); break;
    case 5: fmi3SetBoolean(f->instance, references, n, truths, n_values); break;
    case 6: fmi3GetString(f->instance, references, n, strings, n_values); break;
    case 7: fmi3SetString(f->instance, references, n, strings, n_values); break;
    case 8: fmi3GetUInt8(f->instance, references, n, (uint8_t *)large, n_values); break;
    case 9: fmi3GetClock(f->instance, references, n, truths); break;
    case 10: fmi3SetClock(f->instance, references, n, truths); break;
    default: fmi3GetFloat32(f->instance, references, n, (float *)large, n_values); break;
    }
}

static void values(Fuzz *f, unsigned kind)
{
    unsigned references[MAX_REFERENCES];
    const size_t n = take_references(&f->bytes, references), n_values = take(&f->bytes) > 250 ? n + 1 : n;
    double numbers[2 * MAX_REFERENCES] = {0};
    if (kind == 0) {
        fmi3GetFloat64(f->instance, references, n, numbers, n_values);
    } else if (kind == 1) {
        take_numbers(&f->bytes, numbers, n);
        fmi3SetFloat64(f->instance, references, n, numbers, n_values);
    } else {
        integers(f, kind - 2, references, n, n_values);
    }
}

static void derivatives(Fuzz *f, unsigned kind)
{
    unsigned unknowns[MAX_REFERENCES], knowns[MAX_REFERENCES];
    const size_t n = take_references(&f->bytes, unknowns), m = take_references(&f->bytes, knowns);
    double seeds[MAX_REFERENCES], results[MAX_REFERENCES];
    int32_t orders[MAX_REFERENCES];
    take_numbers(&f->bytes, seeds, MAX_REFERENCES);
    for (size_t i = 0; i < MAX_REFERENCES; ++i)
        orders[i] = (int)below(&f->bytes, 4);
    if (kind == 0)
        fmi3GetDirectionalDerivative(f->instance, unknowns, n, knowns, m, seeds, m, results, n);
    else if (kind == 1)
        fmi3GetAdjointDerivative(f->instance, unknowns, n, knowns, m, seeds, n, results, m);
    else
        fmi3GetOutputDerivatives(f->instance, unknowns, n, orders, results, n);
}

static void events(Fuzz *f, unsigned kind)
{
    double numbers[MAX_NUMBERS];
    const size_t n = below(&f->bytes, MAX_NUMBERS);
    bool flags[5];
    double next;
    take_numbers(&f->bytes, numbers, n);
    switch (kind) {
    case 0: fmi3EnterEventMode(f->instance); break;
    case 1: fmi3UpdateDiscreteStates(f->instance, flags, flags + 1, flags + 2, flags + 3, flags + 4, &next); break;
    case 2: fmi3EnterContinuousTimeMode(f->instance); break;
    case 3: fmi3CompletedIntegratorStep(f->instance, take(&f->bytes) & 1, flags, flags + 1); break;
    case 4: fmi3SetTime(f->instance, take_number(&f->bytes)); break;
    case 5: fmi3SetContinuousStates(f->instance, numbers, n); break;
    case 6: fmi3GetContinuousStateDerivatives(f->instance, numbers, n); break;
    case 7: fmi3GetEventIndicators(f->instance, numbers, n); break;
    case 8: fmi3GetContinuousStates(f->instance, numbers, n); break;
    case 9: fmi3GetNominalsOfContinuousStates(f->instance, numbers, n); break;
    case 10: fmi3EnterStepMode(f->instance); break;
    case 11: fmi3EvaluateDiscreteStates(f->instance); break;
    default: fmi3EnterConfigurationMode(f->instance); break;
    }
}

static void life(Fuzz *f, unsigned kind)
{
    const fmi3String category = "logStatusError";
    const bool tolerance = take(&f->bytes) & 1, stop = take(&f->bytes) & 1;
    switch (kind) {
    case 0:
        fmi3EnterInitializationMode(f->instance, tolerance, take_number(&f->bytes), f->time, stop,
                                    take_number(&f->bytes));
        break;
    case 1: fmi3ExitInitializationMode(f->instance); break;
    case 2: fmi3Terminate(f->instance); break;
    case 3: fmi3Reset(f->instance), f->time = 0.0; break;
    case 4: fmi3SetDebugLogging(f->instance, stop, tolerance, &category); break;
    case 5: test_fail_after((long)below(&f->bytes, 4)); break;
    case 6: f->time = take_number(&f->bytes); break;
    default: f->calls_back = (int)below(&f->bytes, 5); break;
    }
}

/* As importers do it, so that most inputs come further than the first wrong call. */
static void start(Fuzz *f)
{
    values(f, 1);
    fmi3EnterInitializationMode(f->instance, false, 0.0, 0.0, true, 10.0);
    values(f, 1);
    fmi3ExitInitializationMode(f->instance);
    if (take(&f->bytes) & 1) {
        events(f, 1);
        events(f, 10);
    }
}

static void call(Fuzz *f)
{
    switch (below(&f->bytes, 12)) {
    case 0: values(f, below(&f->bytes, 14)); break;
    case 1: derivatives(f, below(&f->bytes, 3)); break;
    case 2:
    case 3: events(f, below(&f->bytes, 13)); break;
    case 4:
    case 5: state(f, below(&f->bytes, 6)); break;
    case 6: life(f, below(&f->bytes, 8)); break;
    case 7: values(f, 0); break;
    case 8: values(f, 1); break;
    default: step(f, take(&f->bytes) == 255 ? take_number(&f->bytes) : short_step(f)); break;
    }
}

static fmi3Instance instantiate(Fuzz *f, unsigned kind)
{
    const fmi3LogMessageCallback log = kind & 2 ? NULL : log_message;
    const bool logging = kind & 4, event_mode = kind & 16, early_return = kind & 32;
    if (!(kind & 1))
        return fmi3InstantiateModelExchange("fuzz", MODEL_TOKEN, NULL, false, logging, f, log);
    unsigned references[MAX_REFERENCES];
    const size_t n = take_references(&f->bytes, references);
    return fmi3InstantiateCoSimulation("fuzz", MODEL_TOKEN, NULL, false, logging, event_mode, early_return, references,
                                       n, f, log, kind & 64 ? intermediate_update : NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Fuzz f = {.bytes = {data, data + size}};
    now = &f;
    const unsigned first = take(&f.bytes);
    f.instance = instantiate(&f, first);
    if (f.instance != NULL) {
        if (first & 8)
            start(&f);
        for (int i = 0; i < MAX_CALLS && f.bytes.at < f.bytes.end; ++i)
            call(&f);
        f.calls_back = 0;
        for (size_t i = 0; i < MAX_STATES; ++i)
            fmi3FreeFMUState(f.instance, &f.states[i]);
        fmi3FreeInstance(f.instance);
    }
    test_fail_after(-1);
    demand(test_live() == 0, "all memory is given back");
    return 0;
}
