/* allocations.h - comes before every file of the runtime that is tested: its allocations are counted, and one of them can
 * be made to fail. */
#ifndef ALLOCATIONS_H
#define ALLOCATIONS_H

#include <stdlib.h>

void *test_malloc(size_t size);
void *test_calloc(size_t count, size_t size);
void test_free(void *block);

#define malloc test_malloc
#define calloc test_calloc
#define free test_free

#endif
