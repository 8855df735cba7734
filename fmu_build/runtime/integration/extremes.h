/* extremes.h - the smaller and the larger of two numbers of which neither is NaN: one instruction, where fmin() and
 * fmax() take five. */
#ifndef EXTREMES_H
#define EXTREMES_H

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

#endif
