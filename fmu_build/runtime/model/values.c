#include "values.h"

#include <string.h>

size_t values_count(void)
{
    return model.n_y + model.n_p + 2 * model.n_clocks + model.n_actions + 1;
}

void values_bind(Values *values, double *block)
{
    values->y = block;
    values->p = values->y + model.n_y;
    values->clock_tick = values->p + model.n_p;
    values->clock_zero = values->clock_tick + model.n_clocks;
    values->reported = values->clock_zero + model.n_clocks;
    values->any_reported = values->reported + model.n_actions;
}

void values_reset(Values *values)
{
    values->time = 0.0;
    if (model.n_y > 0)
        memcpy(values->y, model.y_start, model.n_y * sizeof(double));
    if (model.n_p > 0)
        memcpy(values->p, model.p_start, model.n_p * sizeof(double));
}
