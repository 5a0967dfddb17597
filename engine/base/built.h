/// What a build can do. Leaving all effects out is for comparison only: tests/effects holds the
/// time of a case that switches them off against it.
#ifndef FAIRLEAD_BASE_BUILT_H
#define FAIRLEAD_BASE_BUILT_H

#ifdef WITHOUT_EFFECTS
enum { EFFECTS_BUILT = 0, WALL_SETS = 1 };
#else
enum { EFFECTS_BUILT = 1, WALL_SETS = 2 };
#endif

#endif
