/* fmi2_calls.c - libFuzzer target: any FMI 2.0 calls in any order, with any arguments and callbacks that call back.
 *
 * Sanitizers see what is wrong with memory. Beyond that: a restored state repeats the step bit by bit, a serialized one
 * comes back the same, and at the end nothing stays allocated. */
#include "bytes.h"
#include "fmi2Functions.h"
#include "token.h"

typedef struct {
    Bytes bytes;
    fmi2Component instance;
    fmi2FMUstate states[MAX_STATES];
    double time;
    int calls_back; /* what the logger does */
} Fuzz;

static Fuzz *now;

static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String format, ...)
{
    (void)environment, (void)status;
    demand(name != NULL && category != NULL && format != NULL, "a message has a name, a category and a text");
    Fuzz *f = now;
    double value = 0.0;
    const int what = f->calls_back;
    f->calls_back = 0;
    if (what == 1)
        fmi2GetReal(f->instance, &(unsigned){1}, 1, &value);
    else if (what == 2)
        fmi2SetReal(f->instance, &(unsigned){1}, 1, &value);
    else if (what == 3)
        fmi2DoStep(f->instance, f->time, 0.01, fmi2False);
    else if (what == 4)
        fmi2Reset(f->instance);
    f->calls_back = what;
}

static void values(Fuzz *f, unsigned kind)
{
    unsigned references[MAX_REFERENCES];
    const size_t n = take_references(&f->bytes, references);
    double numbers[MAX_REFERENCES];
    int integers[MAX_REFERENCES];
    const char *strings[MAX_REFERENCES] = {"", NULL, "text", ""};
    take_numbers(&f->bytes, numbers, n);
    for (size_t i = 0; i < n; ++i)
        integers[i] = fabs(numbers[i]) < 1e9 ? (int)numbers[i] : (int)(i - 1);
    double *const reals = kind & 8 ? NULL : numbers;
    switch (kind & 7) {
    case 0: fmi2GetReal(f->instance, references, n, reals); break;
    case 1: fmi2GetInteger(f->instance, references, n, integers); break;
    case 2: fmi2GetBoolean(f->instance, references, n, integers); break;
    case 3: fmi2GetString(f->instance, references, n, strings); break;
    case 4: fmi2SetInteger(f->instance, references, n, integers); break;
    case 5: fmi2SetBoolean(f->instance, references, n, integers); break;
    case 6: fmi2SetString(f->instance, references, n, strings); break;
    default: fmi2SetReal(f->instance, references, n, reals); break;
    }
}

static void derivatives(Fuzz *f, unsigned kind)
{
    unsigned unknowns[MAX_REFERENCES], knowns[MAX_REFERENCES];
    const size_t n = take_references(&f->bytes, unknowns), m = take_references(&f->bytes, knowns);
    double seeds[MAX_REFERENCES], results[MAX_REFERENCES];
    int orders[MAX_REFERENCES];
    take_numbers(&f->bytes, seeds, m);
    for (size_t i = 0; i < MAX_REFERENCES; ++i)
        orders[i] = (int)below(&f->bytes, 4);
    if (kind == 0)
        fmi2GetDirectionalDerivative(f->instance, unknowns, n, knowns, m, seeds, results);
    else if (kind == 1)
        fmi2GetRealOutputDerivatives(f->instance, unknowns, n, orders, results);
    else
        fmi2SetRealInputDerivatives(f->instance, knowns, m, orders, seeds);
}

static void model_exchange(Fuzz *f, unsigned kind)
{
    double numbers[MAX_NUMBERS];
    const size_t n = below(&f->bytes, MAX_NUMBERS);
    fmi2EventInfo info = {0};
    fmi2Boolean entered, terminate;
    take_numbers(&f->bytes, numbers, n);
    switch (kind) {
    case 0: fmi2EnterEventMode(f->instance); break;
    case 1: fmi2NewDiscreteStates(f->instance, &info); break;
    case 2: fmi2EnterContinuousTimeMode(f->instance); break;
    case 3: fmi2CompletedIntegratorStep(f->instance, (int)below(&f->bytes, 2), &entered, &terminate); break;
    case 4: fmi2SetTime(f->instance, take_number(&f->bytes)); break;
    case 5: fmi2SetContinuousStates(f->instance, numbers, n); break;
    case 6: fmi2GetDerivatives(f->instance, numbers, n); break;
    case 7: fmi2GetEventIndicators(f->instance, numbers, n); break;
    case 8: fmi2GetContinuousStates(f->instance, numbers, n); break;
    default: fmi2GetNominalsOfContinuousStates(f->instance, numbers, n); break;
    }
}

static fmi2Status step(Fuzz *f, double size)
{
    const fmi2Status status = fmi2DoStep(f->instance, f->time, size, fmi2False);
    if (status == fmi2OK)
        f->time += size;
    return status;
}

typedef fmi2FMUstate State;
#define OK fmi2OK
#define GET_STATE fmi2GetFMUstate
#define SET_STATE fmi2SetFMUstate
#define FREE_STATE fmi2FreeFMUstate
#define SERIALIZED_SIZE fmi2SerializedFMUstateSize
#define SERIALIZE(INSTANCE, STATE, BYTES, SIZE) fmi2SerializeFMUstate(INSTANCE, STATE, (fmi2Byte *)(BYTES), SIZE)
#define DESERIALIZE(INSTANCE, BYTES, SIZE, STATE) \
    fmi2DeSerializeFMUstate(INSTANCE, (const fmi2Byte *)(BYTES), SIZE, STATE)
#include "states.h"

static void status(Fuzz *f)
{
    const fmi2StatusKind kind = (fmi2StatusKind)below(&f->bytes, 5);
    fmi2Status s;
    double number;
    int integer;
    fmi2String text;
    fmi2GetStatus(f->instance, kind, &s);
    if (fmi2GetRealStatus(f->instance, kind, &number) == fmi2OK)
        demand(isfinite(number), "the last successful time is a number");
    fmi2GetIntegerStatus(f->instance, kind, &integer);
    fmi2GetBooleanStatus(f->instance, kind, &integer);
    fmi2GetStringStatus(f->instance, kind, &text);
}

static void life(Fuzz *f, unsigned kind)
{
    const fmi2String category = "logStatusError";
    switch (kind) {
    case 0:
        fmi2SetupExperiment(f->instance, (int)below(&f->bytes, 2), take_number(&f->bytes), f->time,
                            (int)below(&f->bytes, 2), take_number(&f->bytes));
        break;
    case 1: fmi2EnterInitializationMode(f->instance); break;
    case 2: fmi2ExitInitializationMode(f->instance); break;
    case 3: fmi2Terminate(f->instance); break;
    case 4: fmi2Reset(f->instance), f->time = 0.0; break;
    case 5: fmi2SetDebugLogging(f->instance, (int)below(&f->bytes, 2), below(&f->bytes, 2), &category); break;
    case 6: test_fail_after((long)below(&f->bytes, 4)); break;
    case 7: f->time = take_number(&f->bytes); break;
    default: f->calls_back = (int)below(&f->bytes, 5); break;
    }
}

/* As importers do it, so that most inputs come further than the first wrong call. */
static void start(Fuzz *f)
{
    fmi2SetupExperiment(f->instance, fmi2False, 0.0, 0.0, fmi2True, 10.0);
    values(f, 7);
    fmi2EnterInitializationMode(f->instance);
    values(f, 7);
    fmi2ExitInitializationMode(f->instance);
}

static void call(Fuzz *f)
{
    switch (below(&f->bytes, 12)) {
    case 0: values(f, below(&f->bytes, 16)); break;
    case 1: derivatives(f, below(&f->bytes, 3)); break;
    case 2:
    case 3: model_exchange(f, below(&f->bytes, 10)); break;
    case 4:
    case 5: state(f, below(&f->bytes, 6)); break;
    case 6: life(f, below(&f->bytes, 9)); break;
    case 7: status(f); break;
    case 8: values(f, 7); break;
    case 9: fmi2DoStep(f->instance, take_number(&f->bytes), short_step(f), (int)below(&f->bytes, 2)); break;
    default: step(f, short_step(f)); break;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const fmi2CallbackFunctions callbacks = {.logger = logger};
    Fuzz f = {.bytes = {data, data + size}};
    now = &f;
    const unsigned first = take(&f.bytes);
    f.instance = fmi2Instantiate("fuzz", first & 1 ? fmi2CoSimulation : fmi2ModelExchange, MODEL_TOKEN, NULL,
                                  first & 2 ? NULL : &callbacks, fmi2False, first >> 2 & 1);
    if (f.instance != NULL) {
        if (first & 8)
            start(&f);
        for (int i = 0; i < MAX_CALLS && f.bytes.at < f.bytes.end; ++i)
            call(&f);
        f.calls_back = 0;
        for (size_t i = 0; i < MAX_STATES; ++i)
            fmi2FreeFMUstate(f.instance, &f.states[i]);
        fmi2FreeInstance(f.instance);
    }
    test_fail_after(-1);
    demand(test_live() == 0, "all memory is given back");
    return 0;
}
