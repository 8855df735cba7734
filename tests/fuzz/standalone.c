/* standalone.c - a target of libFuzzer without libFuzzer: so many inputs of random bytes, the same for the same seed.
 *
 * Arguments: seed, number of inputs. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* The bytes are not of the instance, whose memory the target counts. */
#undef malloc
#undef free

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST = 512 };

/* SplitMix64. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

int main(int count, char **arguments)
{
    if (count != 3)
        return 1;
    uint64_t state = strtoull(arguments[1], NULL, 10);
    for (long left = strtol(arguments[2], NULL, 10); left > 0; --left) {
        /* In memory of its own, so that a sanitizer sees each step over its end. */
        const size_t size = 1 + next(&state) % MOST;
        uint8_t *bytes = malloc(size);
        if (bytes == NULL)
            return 1;
        for (size_t i = 0; i < size; ++i)
            bytes[i] = (uint8_t)next(&state);
        /* As importers begin, and two of three in Co-Simulation with messages: see the targets' first byte. */
        if (left % 4 != 0)
            bytes[0] = (uint8_t)((bytes[0] & ~2u) | 8u | (left % 4 > 1));
        LLVMFuzzerTestOneInput(bytes, size);
        free(bytes);
    }
    return 0;
}
