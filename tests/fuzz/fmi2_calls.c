/* fmi2_calls.c - libFuzzer target: any FMI 2.0 calls in any order, with any arguments and callbacks that call back.
 *
 * Sanitizers see what is wrong with memory. Beyond that: a restored state repeats the step bit by bit, a serialized one
 * comes back the same, and at the end nothing stays allocated. */
#include "bytes.h"
#include "fmi2Functions.h"
#include "token.h"

typedef struct {
    Bytes bytes;
    fmi2Component component;
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
        fmi2GetReal(f->component, &(unsigned){1}, 1, &value);
    else if (what == 2)
        fmi2SetReal(f->component, &(unsigned){1}, 1, &value);
    else if (what == 3)
        fmi2DoStep(f->component, f->time, 0.01, fmi2False);
    else if (what == 4)
        fmi2Reset(f->component);
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
    case 0: fmi2GetReal(f->component, references, n, reals); break;
    case 1: fmi2GetInteger(f->component, references, n, integers); break;
    case 2: fmi2GetBoolean(f->component, references, n, integers); break;
    case 3: fmi2GetString(f->component, references, n, strings); break;
    case 4: fmi2SetInteger(f->component, references, n, integers); break;
    case 5: fmi2SetBoolean(f->component, references, n, integers); break;
    case 6: fmi2SetString(f->component, references, n, strings); break;
    default: fmi2SetReal(f->component, references, n, reals); break;
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
        fmi2GetDirectionalDerivative(f->component, unknowns, n, knowns, m, seeds, results);
    else if (kind == 1)
        fmi2GetRealOutputDerivatives(f->component, unknowns, n, orders, results);
    else
        fmi2SetRealInputDerivatives(f->component, knowns, m, orders, seeds);
}

static void model_exchange(Fuzz *f, unsigned kind)
{
    double numbers[MAX_NUMBERS];
    const size_t n = below(&f->bytes, MAX_NUMBERS);
    fmi2EventInfo info = {0};
    fmi2Boolean entered, terminate;
    take_numbers(&f->bytes, numbers, n);
    switch (kind) {
    case 0: fmi2EnterEventMode(f->component); break;
    case 1: fmi2NewDiscreteStates(f->component, &info); break;
    case 2: fmi2EnterContinuousTimeMode(f->component); break;
    case 3: fmi2CompletedIntegratorStep(f->component, (int)below(&f->bytes, 2), &entered, &terminate); break;
    case 4: fmi2SetTime(f->component, take_number(&f->bytes)); break;
    case 5: fmi2SetContinuousStates(f->component, numbers, n); break;
    case 6: fmi2GetDerivatives(f->component, numbers, n); break;
    case 7: fmi2GetEventIndicators(f->component, numbers, n); break;
    case 8: fmi2GetContinuousStates(f->component, numbers, n); break;
    default: fmi2GetNominalsOfContinuousStates(f->component, numbers, n); break;
    }
}

static fmi2Status step(Fuzz *f, double size)
{
    const fmi2Status status = fmi2DoStep(f->component, f->time, size, fmi2False);
    if (status == fmi2OK)
        f->time += size;
    return status;
}

static double short_step(Fuzz *f)
{
    return 1e-3 * (1 + below(&f->bytes, 100));
}

static void status(Fuzz *f)
{
    const fmi2StatusKind kind = (fmi2StatusKind)below(&f->bytes, 5);
    fmi2Status s;
    double number;
    int integer;
    fmi2String text;
    fmi2GetStatus(f->component, kind, &s);
    if (fmi2GetRealStatus(f->component, kind, &number) == fmi2OK)
        demand(isfinite(number), "the last successful time is a number");
    fmi2GetIntegerStatus(f->component, kind, &integer);
    fmi2GetBooleanStatus(f->component, kind, &integer);
    fmi2GetStringStatus(f->component, kind, &text);
}

/* The bytes of a state in memory of their own, so that AddressSanitizer sees each step over their end. */
static uint8_t *serialized(Fuzz *f, fmi2FMUstate state, size_t *size)
{
    if (fmi2SerializedFMUstateSize(f->component, state, size) != fmi2OK)
        return NULL;
    uint8_t *bytes = malloc(*size);
    if (bytes != NULL && fmi2SerializeFMUstate(f->component, state, (fmi2Byte *)bytes, *size) != fmi2OK) {
        free(bytes);
        bytes = NULL;
    }
    return bytes;
}

static void exchange_bytes(Fuzz *f, unsigned from, unsigned to)
{
    size_t size;
    uint8_t *bytes = serialized(f, f->states[from], &size);
    if (bytes == NULL)
        return;
    damage(&f->bytes, bytes, size);
    fmi2FMUstate read = NULL;
    const size_t given = take(&f->bytes) == 255 ? size - 1 : size;
    if (fmi2DeSerializeFMUstate(f->component, (const fmi2Byte *)bytes, given, &read) == fmi2OK) {
        uint8_t *again = serialized(f, read, &size);
        demand(again == NULL || memcmp(bytes, again, size) == 0, "a state that was read is written the same");
        free(again);
        fmi2FreeFMUstate(f->component, &f->states[to]);
        f->states[to] = read;
    }
    free(bytes);
}

static void repeat_step(Fuzz *f)
{
    fmi2FMUstate before = NULL, first = NULL, second = NULL;
    const double time = f->time, size = short_step(f);
    size_t n;
    const int back = f->calls_back;
    f->calls_back = 0;
    if (fmi2GetFMUstate(f->component, &before) == fmi2OK && step(f, size) == fmi2OK &&
        fmi2GetFMUstate(f->component, &first) == fmi2OK) {
        f->time = time;
        demand(fmi2SetFMUstate(f->component, before) == fmi2OK, "a state of this instance can be restored");
        if (step(f, size) == fmi2OK && fmi2GetFMUstate(f->component, &second) == fmi2OK) {
            uint8_t *a = serialized(f, first, &n), *b = serialized(f, second, &n);
            demand(a == NULL || b == NULL || memcmp(a, b, n) == 0, "a restored state repeats the step");
            free(a), free(b);
        }
    }
    f->calls_back = back;
    fmi2FreeFMUstate(f->component, &before);
    fmi2FreeFMUstate(f->component, &first);
    fmi2FreeFMUstate(f->component, &second);
}

static void state(Fuzz *f, unsigned kind)
{
    const unsigned i = below(&f->bytes, MAX_STATES), j = below(&f->bytes, MAX_STATES);
    switch (kind) {
    case 0: fmi2GetFMUstate(f->component, &f->states[i]); break;
    case 1: fmi2SetFMUstate(f->component, f->states[i]); break;
    case 2: fmi2FreeFMUstate(f->component, &f->states[i]); break;
    case 3: repeat_step(f); break;
    default: exchange_bytes(f, i, j); break;
    }
}

static void life(Fuzz *f, unsigned kind)
{
    const fmi2String category = "logStatusError";
    switch (kind) {
    case 0:
        fmi2SetupExperiment(f->component, (int)below(&f->bytes, 2), take_number(&f->bytes), f->time,
                            (int)below(&f->bytes, 2), take_number(&f->bytes));
        break;
    case 1: fmi2EnterInitializationMode(f->component); break;
    case 2: fmi2ExitInitializationMode(f->component); break;
    case 3: fmi2Terminate(f->component); break;
    case 4: fmi2Reset(f->component), f->time = 0.0; break;
    case 5: fmi2SetDebugLogging(f->component, (int)below(&f->bytes, 2), below(&f->bytes, 2), &category); break;
    case 6: test_fail_after((long)below(&f->bytes, 4)); break;
    case 7: f->time = take_number(&f->bytes); break;
    default: f->calls_back = (int)below(&f->bytes, 5); break;
    }
}

/* As importers do it, so that most inputs come further than the first wrong call. */
static void start(Fuzz *f)
{
    fmi2SetupExperiment(f->component, fmi2False, 0.0, 0.0, fmi2True, 10.0);
    values(f, 7);
    fmi2EnterInitializationMode(f->component);
    values(f, 7);
    fmi2ExitInitializationMode(f->component);
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
    case 9: fmi2DoStep(f->component, take_number(&f->bytes), short_step(f), (int)below(&f->bytes, 2)); break;
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
    f.component = fmi2Instantiate("fuzz", first & 1 ? fmi2CoSimulation : fmi2ModelExchange, MODEL_TOKEN, NULL,
                                  first & 2 ? NULL : &callbacks, fmi2False, first >> 2 & 1);
    if (f.component != NULL) {
        if (first & 8)
            start(&f);
        for (int i = 0; i < MAX_CALLS && f.bytes.at < f.bytes.end; ++i)
            call(&f);
        f.calls_back = 0;
        for (size_t i = 0; i < MAX_STATES; ++i)
            fmi2FreeFMUstate(f.component, &f.states[i]);
        fmi2FreeInstance(f.component);
    }
    test_fail_after(-1);
    demand(test_live() == 0, "all memory is given back");
    return 0;
}
