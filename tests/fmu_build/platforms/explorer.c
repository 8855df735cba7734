/* Runs of a model through the face of its WebAssembly module, compiled for this machine. A line of standard input holds
 * pairs of a value reference and a value, the parameters of a run; its table goes to standard output in binary.
 *
 * Arguments: stop time, tolerance, number of rows, value references of Real variables to record. */
#include "explore.h"

#include <stdio.h>
#include <stdlib.h>

int main(int count, char **arguments)
{
    enum { MOST = 64 };
    const double stop = atof(arguments[1]), tolerance = atof(arguments[2]);
    const int rows = atoi(arguments[3]), n = count - 4;
    uint32_t references[MOST];
    char kinds[MOST], line[4096];
    double *table = malloc(sizeof(double) * (size_t)(rows * n));
    for (int i = 0; i < n; ++i) {
        references[i] = (uint32_t)atoi(arguments[4 + i]);
        kinds[i] = 'r';
    }
    while (fgets(line, sizeof line, stdin) != NULL) {
        if (explore_begin(0.0, stop, tolerance) != 0)
            return 1;
        char *rest = line;
        for (;;) {
            char *end;
            const uint32_t reference = (uint32_t)strtoul(rest, &end, 10);
            if (end == rest)
                break;
            const double value = strtod(end, &rest);
            if (explore_set_real(1, &reference, &value) != 0)
                return 2;
        }
        if (explore_initialize() != 0 || explore_run(n, references, kinds, rows, 0.0, stop / (rows - 1), table) != rows)
            return 3;
        fwrite(table, sizeof(double), (size_t)(rows * n), stdout);
    }
    free(table);
    return 0;
}
