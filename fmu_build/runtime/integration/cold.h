/* cold.h - marks functions that are seldom called, so that compilers keep them out of the way of the rest. */
#ifndef COLD_H
#define COLD_H

#if defined __GNUC__
#define COLD __attribute__((cold))
#else
#define COLD
#endif

#endif
