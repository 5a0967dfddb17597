/// Momentum with corrected kernel gradients, against all pairs in double.
#include "water_block.h"

#include "physics/gradient.h"

enum { NX = 12, NY = 10, NZ = 9, N = NX * NY * NZ };
static Vec3 place[N], velocity[N];
static float excess[N];

/// A block of water on its own. @param disorder  of its lattice, in spacings
static BackendSetup water(int dimensions, double disorder, unsigned seed)
{
    for (int i = 0; i < N; i++) {
        int at[3] = {i % NX, i / NX % NY, i / (NX * NY)};
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = DP * (at[a] + 0.5 + disorder * (random_unit(&seed) - 0.5));
        place[i] = vec3(x[0], dimensions == 2 ? 0 : x[1], x[2]);
        velocity[i] =
            vec3(random_unit(&seed) - 0.5, random_unit(&seed) - 0.5, random_unit(&seed) - 0.5);
        excess[i] = (float)(0.02 * random_unit(&seed));
    }
    BackendSetup s = water_setup(dimensions);
    s.alpha = 0.05;
    s.gravity = 9.81;
    s.level = DP * NZ;
    s.pair_mask = PAIR_VISCOSITY | PAIR_GRADIENT;
    return s;
}

static void rates(const BackendSetup *setup, int count, float (*a)[3])
{
    static float density_rate[N];
    ParticleStart start;
    memset(&start, 0, sizeof start);
    start.fluid_count = count;
    start.fluid_position = place;
    start.fluid_velocity = velocity;
    start.fluid_excess = excess;
    water_rates(setup, &start, a, density_rate);
}

/// grad_i W [1/m^4 or 1/m^3]
static Vec3 kernel_gradient(const BackendSetup *s, Vec3 x)
{
    return vec3_scale(
        x, -kernel_slope_at(s->kernel, s->dimensions, s->smoothing_length, vec3_norm(x)));
}

typedef struct Matrix {
    double at[3][3];
} Matrix;

static double determinant(Matrix m)
{
    double sum = 0;
    for (int a = 0; a < 3; a++)
        sum += m.at[0][a] * (m.at[1][(a + 1) % 3] * m.at[2][(a + 2) % 3] -
                             m.at[1][(a + 2) % 3] * m.at[2][(a + 1) % 3]);
    return sum;
}

/// B as the header says it, by cofactors.
static Matrix correction(const BackendSetup *s, int count, int i)
{
    Matrix m = {{{0}}}, b = {{{0}}};
    for (int k = 0; k < count; k++) {
        Vec3 x = vec3_sub(place[i], place[k]), g = kernel_gradient(s, x);
        const double d[3] = {-x.x, -x.y, -x.z}, w[3] = {g.x, g.y, g.z};
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                m.at[r][c] += s->particle_mass / RHO0 * d[r] * w[c];
    }
    if (s->dimensions == 2) m.at[1][1] = 1;
    double det = determinant(m), low = pow(0.84, s->dimensions), high = pow(0.975, s->dimensions);
    double share = (det - low) / (high - low);
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            int r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
            double cofactor = m.at[r1][c1] * m.at[r2][c2] - m.at[r1][c2] * m.at[r2][c1];
            b.at[r][c] = (share > 0 ? share * cofactor / det : 0) + (1 - share) * (r == c);
        }
    return b;
}

static Vec3 apply(Matrix m, Vec3 v)
{
    double x[3] = {v.x, v.y, v.z}, y[3] = {0, 0, 0};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            y[r] += m.at[r][c] * x[c];
    return vec3(y[0], y[1], y[2]);
}

/// P = p/rho^2
static double pressure_term(int i)
{
    double rho = RHO0 * (1 + (double)excess[i]);
    return C0 * C0 * RHO0 / 7 * (pow(rho / RHO0, 7) - 1) / (rho * rho);
}

static Vec3 reference(const BackendSetup *s, int count, const Matrix *b, int i)
{
    Vec3 sum = vec3(0, 0, -s->gravity);
    double h = s->smoothing_length;
    for (int k = 0; k < count; k++) {
        Vec3 x = vec3_sub(place[i], place[k]), g = kernel_gradient(s, x);
        double vx = vec3_dot(vec3_sub(velocity[i], velocity[k]), x), r2 = vec3_dot(x, x);
        double pi = k != i && vx < 0 ? -s->alpha * C0 * h * vx / ((r2 + 0.01 * h * h) * RHO0) : 0;
        Vec3 force = vec3_add(vec3_scale(apply(b[i], g), pressure_term(i)),
                              vec3_scale(apply(b[k], g), pressure_term(k)));
        force = vec3_add(force, vec3_scale(g, pi));
        sum = vec3_sub(sum, vec3_scale(force, s->particle_mass));
    }
    return sum;
}

static void compare(Kernel kernel, int dimensions, unsigned seed)
{
    static float a[N][3];
    static Matrix b[N];
    int count = dimensions == 2 ? NX * NY : N; // 2-D: one particle a place
    BackendSetup s = water(dimensions, 0.5, seed);
    s.kernel = kernel;
    if (dimensions == 2)
        for (int i = 0; i < count; i++)
            place[i] = vec3(place[i].x, 0, DP * (i / NX + 0.5));
    rates(&s, count, a);
    for (int i = 0; i < count; i++)
        b[i] = correction(&s, count, i);
    double error2 = 0, scale2 = 0, corrected = 0;
    for (int i = 0; i < count; i++) {
        Vec3 r = reference(&s, count, b, i);
        Vec3 d = vec3_sub(vec3(a[i][0], a[i][1], a[i][2]), r);
        error2 += vec3_dot(d, d);
        scale2 += vec3_dot(r, r);
        corrected += fabs(b[i].at[0][0] - 1) > 0.01;
    }
    CHECK_NEAR(sqrt(error2 / scale2), 0, 2e-5);
    CHECK(corrected > 0.1 * count); // or nothing was tried
}

TEST(corrected_forces_agree_with_all_pairs_in_double_3d)
{
    compare(KERNEL_WENDLAND, 3, 1);
    compare(KERNEL_YIELDING, 3, 1);
}

TEST(corrected_forces_agree_with_all_pairs_in_double_2d)
{
    compare(KERNEL_WENDLAND, 2, 2);
    compare(KERNEL_YIELDING, 2, 2);
}

TEST(corrected_forces_sum_to_zero)
{
    static float a[N][3];
    BackendSetup s = water(3, 0.5, 3);
    s.gravity = 0;
    rates(&s, N, a);
    double sum[3] = {0, 0, 0}, size = 0;
    for (int i = 0; i < N; i++)
        for (int c = 0; c < 3; c++) {
            sum[c] += a[i][c];
            size += fabs((double)a[i][c]);
        }
    for (int c = 0; c < 3; c++)
        CHECK_NEAR(sum[c] / size, 0, 1e-6);
}

TEST(corrected_forces_have_the_same_bits_for_any_thread_count)
{
    static float a[2][N][3];
    for (int t = 0; t < 2; t++) {
        BackendSetup s = water(3, 0.5, 4);
        s.threads = t ? 3 : 1;
        rates(&s, N, a[t]);
    }
    CHECK(!memcmp(a[0], a[1], sizeof a[0]));
}

TEST(too_few_neighbours_leave_the_gradient_as_it_is)
{
    static float plain[N][3], corrected[N][3];
    BackendSetup s = water(3, 0.5, 5);
    rates(&s, 2, corrected); // two particles: M has rank one
    s.pair_mask = PAIR_VISCOSITY;
    rates(&s, 2, plain);
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++)
            CHECK_NEAR(corrected[i][c], plain[i][c], 1e-5 * (1 + fabs((double)plain[i][c])));
}
