/// Molecular viscosity, unresolved turbulence and walls that hold the water: against all pairs in
/// double and against derivatives; flows are in test_viscous_flow.c.
#include "water_block.h"

#include "physics/viscous.h"

enum { NX = 12, NY = 10, NZ = 9, N = NX * NY * NZ, DUMMIES = NX * NY * 3 };
enum { SIDE = 17, MOST = SIDE * SIDE * SIDE }; ///< twice the support each way from the middle
static const double NU = 0.02;
static Vec3 place[MOST], velocity[MOST], dummy[DUMMIES];
static float excess[MOST];
static int16_t owner[DUMMIES];

/// A block of water, at rest density and without gravity. @param disorder  in spacings
static BackendSetup water(int dimensions, double disorder, unsigned seed)
{
    for (int i = 0; i < N; i++) {
        int at[3] = {i % NX, i / NX % NY, i / (NX * NY)};
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = DP * (at[a] + 0.5 + disorder * (random_unit(&seed) - 0.5));
        place[i] = vec3(x[0], dimensions == 2 ? 0 : x[1], x[2]);
        velocity[i] = vec3(0, 0, 0);
        excess[i] = 0;
    }
    BackendSetup s = water_setup(dimensions);
    s.alpha = 0.05;
    s.viscosity = NU;
    s.level = DP * NZ;
    s.pair_mask = PAIR_LAMINAR;
    return s;
}

/// Water in disorder, with random velocities and pressures.
static BackendSetup random_water(int dimensions, unsigned mask, unsigned seed)
{
    BackendSetup setup = water(dimensions, 0.5, seed);
    for (int i = 0; i < N; i++) {
        velocity[i] = vec3(random_unit(&seed) - 0.5, dimensions == 2 ? 0 : random_unit(&seed) - 0.5,
                           random_unit(&seed) - 0.5);
        excess[i] = (float)(0.02 * random_unit(&seed));
    }
    setup.gravity = 9.81;
    setup.pair_mask = mask;
    return setup;
}

/// Three layers of fixed dummies under the block.
static void lay_bed(int dimensions)
{
    for (int i = 0; i < DUMMIES; i++) {
        double y = DP * (i / NX % NY + 0.5);
        dummy[i] = vec3(DP * (i % NX + 0.5), dimensions == 2 ? 0 : y, -DP * (i / (NX * NY) + 0.5));
        owner[i] = OWNER_FIXED;
    }
}

static void rates(const BackendSetup *setup, int count, int dummies, float (*a)[3])
{
    static float density_rate[MOST];
    ParticleStart start;
    memset(&start, 0, sizeof start);
    start.fluid_count = count;
    start.fluid_position = place;
    start.fluid_velocity = velocity;
    start.fluid_excess = excess;
    start.dummy_count = dummies;
    start.dummy_reference = dummy;
    start.dummy_owner = owner;
    water_rates(setup, &start, a, density_rate);
}

/// -(dW/dr)/r, W of a pair
static double slope_of(const BackendSetup *s, double r)
{
    return kernel_slope_at(s->kernel, s->dimensions, s->smoothing_length, r);
}

/// The same of Wendland's, in which viscosity is summed.
static double drag_slope_of(const BackendSetup *s, double r)
{
    return kernel_slope_at(KERNEL_WENDLAND, s->dimensions, s->smoothing_length, r);
}

/// W over W(0) of either kernel.
static double value_of(Kernel kernel, const BackendSetup *s, double r)
{
    double x = r / (2 * s->smoothing_length), y = 1 - x;
    if (y <= 0) return 0;
    return kernel == KERNEL_YIELDING
               ? pow(y, 8) * (577.5 - 1375 * y + 1105.5 * y * y - 300 * y * y * y) / 8
               : pow(y, 4) * (1 + 4 * x);
}

static double pressure_of(double density_excess)
{
    return C0 * C0 * RHO0 / 7 * (pow(1 + density_excess, 7) - 1);
}

/// p/rho^2
static double push_of(double p)
{
    double rho = RHO0 * pow(1 + 7 * p / (C0 * C0 * RHO0), 1.0 / 7);
    return p / (rho * rho);
}

typedef struct Matrix {
    double at[3][3];
} Matrix;

/// tau/rho of one particle by the formulas of physics/viscous.h, in double.
static Matrix stress_of(const BackendSetup *s, int i)
{
    Matrix gradient = {{{0}}}, stress;
    double volume = s->particle_mass / RHO0, square = 0, trace = 0;
    for (int k = 0; k < N; k++) {
        Vec3 x = vec3_sub(place[i], place[k]), v = vec3_sub(velocity[k], velocity[i]);
        double f = -slope_of(s, vec3_norm(x)) * volume;
        if (f == 0) continue;
        const double d[3] = {x.x, x.y, x.z}, w[3] = {v.x, v.y, v.z};
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                gradient.at[r][c] += f * w[r] * d[c];
    }
    for (int r = 0; r < 3; r++) {
        trace += gradient.at[r][r];
        for (int c = 0; c < 3; c++)
            square += 0.5 * pow(gradient.at[r][c] + gradient.at[c][r], 2);
    }
    double eddy = pow(0.12 * DP, 2) * sqrt(square);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            double even = 2.0 / 3 * eddy * trace + 2.0 / 3 * 0.0066 * DP * DP * square;
            stress.at[r][c] = eddy * (gradient.at[r][c] + gradient.at[c][r]) - (r == c ? even : 0);
        }
    return stress;
}

/// Water on water: pressure, artificial and molecular viscosity, stresses.
static Vec3 reference_of_water(const BackendSetup *s, const Matrix *stress, int i)
{
    Vec3 sum = vec3(0, 0, -s->gravity);
    double h = s->smoothing_length, m = s->particle_mass;
    for (int k = 0; k < N; k++) {
        Vec3 x = vec3_sub(place[i], place[k]), v = vec3_sub(velocity[i], velocity[k]);
        double r = vec3_norm(x), f = -slope_of(s, r), vx = vec3_dot(v, x);
        if (k == i || f == 0) continue;
        double push = push_of(pressure_of(excess[i])) + push_of(pressure_of(excess[k]));
        if (s->pair_mask & PAIR_VISCOSITY && vx < 0)
            push -= s->alpha * C0 * h * vx / (r * r + 0.01 * h * h) / RHO0;
        double drag = 2 * (s->dimensions + 2) * NU * vx / (r * r) / RHO0;
        sum = vec3_add(sum, vec3_scale(x, -m * (push * f + drag * drag_slope_of(s, r))));
        if (!(s->pair_mask & PAIR_TURBULENCE)) continue;
        double d[3] = {x.x, x.y, x.z}, t[3] = {0, 0, 0};
        for (int a = 0; a < 3; a++)
            for (int c = 0; c < 3; c++)
                t[a] += m * f / RHO0 * (stress[i].at[a][c] + stress[k].at[a][c]) * d[c];
        sum = vec3_add(sum, vec3(t[0], t[1], t[2]));
    }
    return sum;
}

/// What the water gives to one dummy at rest (Adami et al. 2012, eq. 22, 23 and 27).
typedef struct DummyState {
    double push; ///< p/rho^2
    Vec3 mirror; ///< velocity that viscosity meets
} DummyState;

static DummyState state_of_dummy(const BackendSetup *s, int w)
{
    Vec3 flow = vec3(0, 0, 0);
    double weights = 0, drag_weights = 0, p = 0;
    for (int k = 0; k < N; k++) {
        Vec3 d = vec3_sub(dummy[w], place[k]);
        double weight = value_of(s->kernel, s, vec3_norm(d)), density = 1 + (double)excess[k];
        double drag_weight = value_of(KERNEL_WENDLAND, s, vec3_norm(d));
        if (drag_weight == 0) continue;
        weights += weight;
        drag_weights += drag_weight;
        // the sweeps keep P = p/rho^2 and take p = P rho0^2 (1 + s)^2
        p += weight * density *
             (push_of(pressure_of(excess[k])) * RHO0 * RHO0 * density - RHO0 * s->gravity * d.z);
        flow = vec3_add(flow, vec3_scale(velocity[k], drag_weight));
    }
    DummyState state = {push_of(p > 0 ? p / weights : 0), vec3_scale(flow, -1 / drag_weights)};
    return state;
}

static Vec3 reference_of_dummy(const BackendSetup *s, DummyState state, int i, int w)
{
    Vec3 x = vec3_sub(place[i], dummy[w]), v = vec3_sub(velocity[i], state.mirror);
    double f = -slope_of(s, vec3_norm(x)), m = s->particle_mass;
    if (f == 0) return vec3(0, 0, 0);
    double push = f * (push_of(pressure_of(excess[i])) + state.push);
    if (s->pair_mask & PAIR_NO_SLIP)
        push += 2 * (s->dimensions + 2) * NU * vec3_dot(v, x) / vec3_dot(x, x) / RHO0 *
                drag_slope_of(s, vec3_norm(x));
    return vec3_scale(x, -m * push);
}

/// @return rms difference from the reference over its rms
static double difference(const BackendSetup *setup, int dummies)
{
    static float a[N][3];
    static Matrix stress[N];
    static DummyState state[DUMMIES];
    rates(setup, N, dummies, a);
    for (int w = 0; w < dummies; w++)
        state[w] = state_of_dummy(setup, w);
    double error2 = 0, sum2 = 0;
    for (int i = 0; i < N && setup->pair_mask & PAIR_TURBULENCE; i++)
        stress[i] = stress_of(setup, i);
    for (int i = 0; i < N; i += 3) {
        Vec3 r = reference_of_water(setup, stress, i);
        for (int w = 0; w < dummies; w++)
            r = vec3_add(r, reference_of_dummy(setup, state[w], i, w));
        if (setup->dimensions == 2) r.y = a[i][1];
        error2 += pow(a[i][0] - r.x, 2) + pow(a[i][1] - r.y, 2) + pow(a[i][2] - r.z, 2);
        sum2 += vec3_dot(r, r);
    }
    return sqrt(error2 / sum2);
}

TEST(rates_agree_with_all_pairs_in_double)
{
    static const unsigned masks[] = {PAIR_LAMINAR, PAIR_LAMINAR | PAIR_VISCOSITY,
                                     PAIR_LAMINAR | PAIR_TURBULENCE,
                                     PAIR_LAMINAR | PAIR_TURBULENCE | PAIR_VISCOSITY};
    for (int d = 2; d <= 3; d++)
        for (int m = 0; m < 4; m++) {
            BackendSetup setup = random_water(d, masks[m], 11);
            CHECK_NEAR(difference(&setup, 0), 0, 5e-5);
            setup.kernel = KERNEL_YIELDING;
            CHECK_NEAR(difference(&setup, 0), 0, 5e-5);
        }
}

TEST(rates_over_a_bed_agree_with_all_pairs_in_double)
{
    static const unsigned masks[] = {
        PAIR_LAMINAR, PAIR_LAMINAR | PAIR_NO_SLIP, PAIR_LAMINAR | PAIR_NO_SLIP | PAIR_VISCOSITY,
        PAIR_LAMINAR | PAIR_NO_SLIP | PAIR_TURBULENCE,
        PAIR_LAMINAR | PAIR_NO_SLIP | PAIR_TURBULENCE | PAIR_VISCOSITY};
    for (int d = 2; d <= 3; d++)
        for (int m = 0; m < 5; m++) {
            BackendSetup setup = random_water(d, masks[m], 12);
            lay_bed(d);
            CHECK_NEAR(difference(&setup, DUMMIES), 0, 5e-5);
            setup.kernel = KERNEL_YIELDING;
            CHECK_NEAR(difference(&setup, DUMMIES), 0, 5e-5);
        }
}

TEST(internal_forces_sum_to_zero)
{
    static float a[N][3];
    BackendSetup setup = random_water(3, PAIR_LAMINAR | PAIR_TURBULENCE, 13);
    rates(&setup, N, 0, a);
    check_momentum_is_kept(a, N, 1e-6);
}

TEST(bits_do_not_depend_on_the_thread_count)
{
    static float a[2][N][3];
    for (int t = 0; t < 2; t++) {
        BackendSetup setup =
            random_water(3, PAIR_LAMINAR | PAIR_TURBULENCE | PAIR_NO_SLIP | PAIR_VISCOSITY, 14);
        setup.threads = t ? 3 : 1;
        lay_bed(3);
        rates(&setup, N, DUMMIES, a[t]);
    }
    CHECK(!memcmp(a[0], a[1], sizeof a[0]));
}

TEST(water_that_turns_as_one_feels_no_viscosity)
{
    static float with[N][3], without[N][3];
    for (int t = 0; t < 2; t++) {
        BackendSetup setup = random_water(3, t ? PAIR_LAMINAR | PAIR_TURBULENCE : 0, 15);
        for (int i = 0; i < N; i++) {
            velocity[i] = vec3_cross(vec3(1, 2, 3), place[i]);
            excess[i] = 0;
        }
        rates(&setup, N, 0, t ? with : without);
    }
    double worst = 0; // what floats leave of forces of some m/s^2 each
    for (int i = 0; i < N; i++)
        for (int c = 0; c < 3; c++)
            worst = fmax(worst, fabs((double)with[i][c] - without[i][c]));
    CHECK_NEAR(worst, 0, 1e-3);
}

/// u = slope z + curve z^2/2 on a lattice. @return acceleration along x of its middle particle
/// @param tilt  of the lattice about y [rad]
static double sheared(int dimensions, unsigned mask, double slope, double curve, double tilt)
{
    static float a[MOST][3];
    BackendSetup setup = water(dimensions, 0, 1);
    setup.pair_mask = mask;
    int count = dimensions == 2 ? SIDE * SIDE : MOST;
    for (int i = 0; i < count; i++) {
        double along = DP * (i % SIDE - SIDE / 2), up = DP * (i / SIDE % SIDE - SIDE / 2);
        double z = up * cos(tilt) + along * sin(tilt);
        place[i] = vec3(along * cos(tilt) - up * sin(tilt), DP * (i / (SIDE * SIDE)), z);
        velocity[i] = vec3(slope * z + 0.5 * curve * z * z, 0, 0);
        excess[i] = 0;
    }
    rates(&setup, count, 0, a);
    return a[count / 2][0];
}

TEST(quadratic_shear_is_slowed_by_nu_times_its_curvature)
{
    for (int d = 2; d <= 3; d++) {
        double along = sheared(d, PAIR_LAMINAR, 0, 3, 0) / (NU * 3);
        double across = sheared(d, PAIR_LAMINAR, 0, 3, PI / 4) / (NU * 3);
        printf("  %d-D: %.4f of nu u'', %.4f where the lattice is aslant\n", d, along, across);
        CHECK_NEAR(along, 1, 0.05);
        CHECK_NEAR(across, 1, 0.05);
        CHECK_NEAR(sheared(d, PAIR_LAMINAR, 2, 0, 0), 0, 1e-5); // linear shear: none
        CHECK_NEAR(sheared(d, PAIR_LAMINAR, 2, 3, 0) / (NU * 3), along, 1e-4);
    }
}

TEST(eddies_slow_quadratic_shear_by_the_gradient_of_their_stress)
{
    // d/dz (C_s dp)^2 u'|u'| = 2 (C_s dp)^2 u' u''
    const double expected = 2 * pow(0.12 * DP, 2) * 20 * 30;
    for (int d = 2; d <= 3; d++) {
        double with = sheared(d, PAIR_LAMINAR | PAIR_TURBULENCE, 20, 30, 0);
        double share = (with - sheared(d, PAIR_LAMINAR, 20, 30, 0)) / expected;
        printf("  %d-D: %.4f of 2 (C_s dp)^2 u' u''\n", d, share);
        CHECK_NEAR(share, 1, 0.03);
    }
}
