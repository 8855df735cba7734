/* states.h - saved states under fuzz. The file that includes it defines Fuzz and step(), and says how its standard names
 * what is done with a state: State, GET_STATE, SET_STATE, FREE_STATE, SERIALIZED_SIZE, SERIALIZE, DESERIALIZE and OK. */
static double short_step(Fuzz *f)
{
    return 1e-3 * (1 + below(&f->bytes, 100));
}

/* The bytes of a state in memory of their own, so that AddressSanitizer sees each step over their end. */
static uint8_t *serialized(Fuzz *f, State state, size_t *size)
{
    if (SERIALIZED_SIZE(f->instance, state, size) != OK)
        return NULL;
    uint8_t *bytes = malloc(*size);
    if (bytes != NULL && SERIALIZE(f->instance, state, bytes, *size) != OK) {
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
    State read = NULL;
    const size_t given = take(&f->bytes) == 255 ? size - 1 : size;
    if (DESERIALIZE(f->instance, bytes, given, &read) == OK) {
        uint8_t *again = serialized(f, read, &size);
        demand(again == NULL || memcmp(bytes, again, size) == 0, "a state that was read is written the same");
        free(again);
        FREE_STATE(f->instance, &f->states[to]);
        f->states[to] = read;
    }
    free(bytes);
}

static void repeat_step(Fuzz *f)
{
    State before = NULL, first = NULL, second = NULL;
    const double time = f->time, size = short_step(f);
    size_t n;
    const int back = f->calls_back;
    f->calls_back = 0;
    if (GET_STATE(f->instance, &before) == OK && step(f, size) == OK &&
        GET_STATE(f->instance, &first) == OK) {
        f->time = time;
        demand(SET_STATE(f->instance, before) == OK, "a state of this instance can be restored");
        if (step(f, size) == OK && GET_STATE(f->instance, &second) == OK) {
            uint8_t *a = serialized(f, first, &n), *b = serialized(f, second, &n);
            demand(a == NULL || b == NULL || memcmp(a, b, n) == 0, "a restored state repeats the step");
            free(a), free(b);
        }
    }
    f->calls_back = back;
    FREE_STATE(f->instance, &before);
    FREE_STATE(f->instance, &first);
    FREE_STATE(f->instance, &second);
}

static void state(Fuzz *f, unsigned kind)
{
    const unsigned i = below(&f->bytes, MAX_STATES), j = below(&f->bytes, MAX_STATES);
    switch (kind) {
    case 0: GET_STATE(f->instance, &f->states[i]); break;
    case 1: SET_STATE(f->instance, f->states[i]); break;
    case 2: FREE_STATE(f->instance, &f->states[i]); break;
    case 3: repeat_step(f); break;
    default: exchange_bytes(f, i, j); break;
    }
}
