#undef malloc
#undef calloc
#undef free

#include <stdatomic.h>

#define EXPORTED __attribute__((visibility("default")))

static atomic_long live;
static atomic_long before_failure = -1;

/* How many blocks are allocated now. */
EXPORTED long test_live(void);
/* So many further allocations go well, the next one fails; none where the number is negative. */
EXPORTED void test_fail_after(long number);

long test_live(void)
{
    return atomic_load(&live);
}

void test_fail_after(long number)
{
    atomic_store(&before_failure, number);
}

static void *count(void *block)
{
    if (block != NULL)
        atomic_fetch_add(&live, 1);
    return block;
}

static int fails(void)
{
    return atomic_load(&before_failure) >= 0 && atomic_fetch_sub(&before_failure, 1) == 0;
}

void *test_malloc(size_t size)
{
    return fails() ? NULL : count(malloc(size));
}

void *test_calloc(size_t number, size_t size)
{
    return fails() ? NULL : count(calloc(number, size));
}

void test_free(void *block)
{
    if (block != NULL)
        atomic_fetch_sub(&live, 1);
    free(block);
}
