/// The smoothing kernels, and what they let lattices of particles do.
#include "water_block.h"

#include "physics/kernel.h"

static const double H = 2; ///< two spacings, the default

static double value_at(Kernel kernel, double r, int dimensions)
{
    float s = (float)(1 - r / (2 * H));
    if (s <= 0) return 0;
    return kernel_constant(kernel, H, dimensions) *
           (double)(kernel == KERNEL_YIELDING ? yielding_value(s) : wendland_value(s));
}

TEST(the_integral_of_a_kernel_is_one)
{
    enum { PARTS = 4000 };
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int k = 0; k < 2; k++) {
            double sum = 0, width = 2 * H / PARTS;
            for (int i = 0; i < PARTS; i++) {
                double r = (i + 0.5) * width, shell = dimensions == 2 ? 2 * PI * r : 4 * PI * r * r;
                sum += value_at((Kernel)k, r, dimensions) * shell * width;
            }
            CHECK_NEAR(sum, 1, 1e-5);
        }
}

TEST(its_slope_is_its_derivative)
{
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int k = 0; k < 2; k++)
            for (int i = 1; i < 20; i++) {
                Kernel kernel = (Kernel)k;
                double r = 2 * H * i / 20, e = 0.02,
                       factor = kernel_slope_constant(kernel, H, dimensions);
                double by_difference =
                    (value_at(kernel, r - e, dimensions) - value_at(kernel, r + e, dimensions)) /
                    (2 * e);
                float s = (float)(1 - r / (2 * H));
                double slope =
                    (double)(k == KERNEL_YIELDING ? yielding_slope(s) : wendland_slope(s));
                CHECK_NEAR(factor * slope * r, by_difference, 2e-3 * factor);
                CHECK_NEAR(factor * slope, kernel_slope_at(kernel, dimensions, H, r),
                           1e-5 * factor);
            }
}

/// Stiffness of a square or cubic lattice of spacing 1 against shear of wave vector k, over
/// pressure and k^2, in the weakest direction across k: particles push each other with the
/// potential 2 P V W (docs/physics.md).
static double shear_stiffness(Kernel kernel, int dimensions, Vec3 k)
{
    double d[3][3] = {{0}}, step = 1e-4, norm = vec3_norm(k);
    int reach = 4, deep = dimensions == 2 ? 0 : reach;
    for (int x = -reach; x <= reach; x++)
        for (int z = -reach; z <= reach; z++)
            for (int y = -deep; y <= deep; y++) {
                double at[3] = {x, y, z}, r = sqrt((double)(x * x + y * y + z * z));
                if (r == 0 || r >= 2 * H) continue;
                double wave = 1 - cos(k.x * x + k.y * y + k.z * z);
                double f = kernel_slope_at(kernel, dimensions, H, r);
                double bend = r *
                              (kernel_slope_at(kernel, dimensions, H, r + step) -
                               kernel_slope_at(kernel, dimensions, H, r - step)) /
                              (2 * step);
                for (int a = 0; a < 3; a++)
                    for (int b = 0; b < 3; b++)
                        d[a][b] += wave * ((a == b ? -f : 0) - bend * at[a] * at[b] / (r * r));
            }
    Vec3 along = vec3_scale(k, 1 / norm),
         helper = vec3(fabs(along.x) < 0.9, fabs(along.x) >= 0.9, 0);
    Vec3 first = dimensions == 2 ? vec3(-along.z, 0, along.x) : vec3_cross(along, helper);
    first = vec3_scale(first, 1 / vec3_norm(first));
    Vec3 second = vec3_cross(along, first);
    double p[3] = {first.x, first.y, first.z}, q[3] = {second.x, second.y, second.z};
    double pp = 0, qq = 0, pq = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            pp += p[a] * d[a][b] * p[b];
            qq += q[a] * d[a][b] * q[b];
            pq += p[a] * d[a][b] * q[b];
        }
    double weakest = dimensions == 2 ? pp : 0.5 * (pp + qq) - hypot(0.5 * (pp - qq), pq);
    return weakest / (norm * norm);
}

/// The least and the most over wave vectors of the first Brillouin zone.
static void stiffness_range(Kernel kernel, int dimensions, double range[2])
{
    enum { CUTS = 8 };
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int a = 1; a <= CUTS; a++)
        for (int b = 0; b <= a; b++)
            for (int c = 0; c <= (dimensions == 2 ? 0 : b); c++) {
                Vec3 k = vec3(PI * a / CUTS, PI * c / CUTS, PI * b / CUTS);
                double stiffness = shear_stiffness(kernel, dimensions, k);
                range[0] = mind(range[0], stiffness);
                range[1] = maxd(range[1], stiffness);
            }
}

TEST(lattices_under_the_yielding_kernel_nearly_stay_and_in_space_shear_freely)
{
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        double soft[2], stiff[2];
        stiffness_range(KERNEL_YIELDING, dimensions, soft);
        stiffness_range(KERNEL_WENDLAND, dimensions, stiff);
        printf("  %d-D: %.2g to %.2g of the pressure, Wendland's %.2g to %.2g\n", dimensions,
               soft[0], soft[1], stiff[0], stiff[1]);
        CHECK(soft[0] > (dimensions == 2 ? -7e-5 : -4e-5)); // Wendland's C6: -30e-5, -17e-5
        if (dimensions == 3) CHECK(soft[1] < 0.2 * stiff[1]);
    }
}

/// Fourier transform of a kernel in space at wave number k.
static double transform(Kernel kernel, double k)
{
    enum { PARTS = 2000 };
    double sum = 0, width = 2 * H / PARTS;
    for (int i = 0; i < PARTS; i++) {
        double r = (i + 0.5) * width;
        sum += value_at(kernel, r, 3) * 4 * PI * r * sin(k * r) / k * width;
    }
    return sum;
}

TEST(its_transform_is_hardly_negative_so_that_particles_do_not_pair)
{
    double least = 0;
    for (double k = 0.1; k < 12; k += 0.1)
        least = mind(least, transform(KERNEL_YIELDING, k));
    printf("  least %.3g\n", least);
    CHECK(least > -5e-6);
}

TEST(molten_water_is_held_by_a_tenth_of_what_holds_it_under_wendlands_kernel)
{
    // where its structure is strongest: the first ring of a close packing of spacing 1
    double k = 1.09 * 2 * PI, soft = transform(KERNEL_YIELDING, k),
           stiff = transform(KERNEL_WENDLAND, k);
    printf("  %.2g, Wendland's %.2g\n", soft, stiff);
    CHECK(fabs(soft) < 0.1 * stiff);
}
