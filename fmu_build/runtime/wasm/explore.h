/* explore.h - the face of a WebAssembly module: one instance for Co-Simulation, driven by few calls.
 *
 * JavaScript and WebAssembly runtimes cannot easily pass a function pointer, which fmi2Instantiate needs for its
 * logger, and a call into the module costs more than a communication step. Therefore one call carries out a whole run,
 * and the module stores the messages. It uses only functions of FMI 2.0 and the model's name and GUID.
 *
 * Functions return 0, or the fmi2Status of the failed call: 2 discard, 3 error, 4 fatal. */
#ifndef EXPLORE_H
#define EXPLORE_H

#include <stdint.h>

#define EXPLORE_EXPORT __attribute__((visibility("default")))

/* Resets the instance and sets up the experiment; tolerance 0 means the default. Works after any failure. */
EXPLORE_EXPORT int32_t explore_begin(double start, double stop, double tolerance);
/* Set n variables, before explore_initialize or between steps. */
EXPLORE_EXPORT int32_t explore_set_real(int32_t n, const uint32_t *references, const double *values);
EXPLORE_EXPORT int32_t explore_set_integer(int32_t n, const uint32_t *references, const int32_t *values);
EXPLORE_EXPORT int32_t explore_set_boolean(int32_t n, const uint32_t *references, const int32_t *values);
/* Enters and exits Initialization Mode. */
EXPLORE_EXPORT int32_t explore_initialize(void);

/* Real inputs for the following runs, until the next explore_begin: values and slopes (derivatives with respect to
 * time), each [rows][n], at the rows of a run. Later rows keep the last values. `slopes` may be NULL. The arrays are
 * not copied. */
EXPLORE_EXPORT void explore_inputs(int32_t n, const uint32_t *references, int32_t rows, const double *values,
                                   const double *slopes);
/* Fills table[rows][n] with variables of the kinds 'r' (Real), 'i' (Integer) and 'b' (Boolean): row 0 is the present
 * state, and one communication step leads to each further row. The rows are `step` apart. Returns the number of rows
 * filled; if it is too small, explore_status and explore_message say why. */
EXPLORE_EXPORT int32_t explore_run(int32_t n, const uint32_t *references, const char *kinds, int32_t rows, double start,
                                   double step, double *table);
/* The same with the rows at times[rows]. */
EXPLORE_EXPORT int32_t explore_record(int32_t n, const uint32_t *references, const char *kinds, int32_t rows,
                                      const double *times, double *table);
/* One communication step. */
EXPLORE_EXPORT int32_t explore_step(double time, double step);

/* The time (s) at which the last step ended: the end of the simulation if the model terminated it. */
EXPLORE_EXPORT double explore_time(void);
/* The status of the last failed call since explore_begin, or 0. */
EXPLORE_EXPORT int32_t explore_status(void);
/* Its messages in UTF-8, one per line; "" if there are none. */
EXPLORE_EXPORT const char *explore_message(void);

#endif
