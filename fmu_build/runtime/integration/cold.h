/* cold.h - marks functions that are rarely called, so that compilers place them apart from hot code. */
#ifndef COLD_H
#define COLD_H

#if defined __GNUC__
#define COLD __attribute__((cold))
#else
#define COLD
#endif

#endif
