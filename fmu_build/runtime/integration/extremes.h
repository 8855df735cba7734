/* extremes.h - the smaller and the larger of two numbers that are not NaN: one instruction instead of the five of
 * fmin() and fmax(). */
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
