/// Functions compiled for several instruction levels; the best is chosen when the program starts.
#ifndef FAIRLEAD_BASE_CLONES_H
#define FAIRLEAD_BASE_CLONES_H

// Sanitizers are not ready yet when that choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CLONES(...) __attribute__((target_clones(__VA_ARGS__)))
#else
#define CLONES(...)
#endif

#endif
