/* cold.h - marks rarely called functions, so that compilers place them apart from hot code. */
#ifndef COLD_H
#define COLD_H

#if defined __GNUC__
#define COLD __attribute__((cold))
#else
#define COLD
#endif

#endif
