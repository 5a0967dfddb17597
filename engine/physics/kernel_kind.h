/// Which smoothing kernel, and its constants; what is evaluated for every pair is in kernel.h.
#ifndef FAIRLEAD_PHYSICS_KERNEL_KIND_H
#define FAIRLEAD_PHYSICS_KERNEL_KIND_H

#include "base/portable.h"

typedef enum Kernel { KERNEL_WENDLAND, KERNEL_YIELDING } Kernel;

/// alpha_D [1/m^3] in 3-D, [1/m^2] in 2-D. @param h  smoothing length [m]
FN double kernel_constant(Kernel kernel, double h, int dimensions)
{
    if (kernel == KERNEL_YIELDING)
        return dimensions == 2 ? 312.0 / (115.0 * PI * h * h) : 273.0 / (106.0 * PI * h * h * h);
    return dimensions == 2 ? 7.0 / (4.0 * PI * h * h) : 21.0 / (16.0 * PI * h * h * h);
}

/// K [1/m^5] in 3-D, [1/m^4] in 2-D.
FN double kernel_slope_constant(Kernel kernel, double h, int dimensions)
{
    double ratio = kernel == KERNEL_YIELDING ? 165.0 / 32.0 : 5.0;
    return ratio * kernel_constant(kernel, h, dimensions) / (h * h);
}

#endif
