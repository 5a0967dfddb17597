#include <stdlib.h>
#include <unistd.h>

#include "commands.h"

/// OpenMP's threads spin at the end of every loop unless told otherwise before the program starts;
/// on a machine that also draws and serves, spinning takes the very core the others need (measured
/// at load 10: steps 3.7 times longer). Sleeping at once costs an idle machine as much as 40 % of a
/// small scene's step: so they look around for some tens of microseconds and then sleep.
static void let_threads_sleep(char **argv)
{
    if (getenv("OMP_WAIT_POLICY")) return;
    setenv("OMP_WAIT_POLICY", "passive", 1);
    setenv("GOMP_SPINCOUNT", "10000", 0); // turns of gcc's waiting loop
    execv("/proc/self/exe", argv);
    // without /proc the program runs on as it is
}

int main(int argc, char **argv)
{
    let_threads_sleep(argv);
    return fairlead_main(argc, argv);
}
