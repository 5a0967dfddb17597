/// The second-order piston against its limits, figures of another program, and the piston's path.
#include "piston_second.h"

#include <time.h>

#include "engine.h"
#include "piston.h"
#include "sea.h"
#include "test.h"

static const double DEPTH = 0.5, GRAVITY = 9.81;
static Error error;
static Arena arena;

static PistonModes modes_of(double kd)
{
    return piston_modes(sqrt(GRAVITY * kd / DEPTH * tanh(kd)), DEPTH, GRAVITY);
}

/// Amplitude of the paddle's second harmonic over the squared height of the wave [1/m]:
/// (1/32d) (3 cosh kd/sinh^3 kd - 2 S/H). Source: Madsen (1971), J. Geophys. Res. 76(36), 8672,
/// doi:10.1029/JC076i036p08672.
static double madsens(double kd)
{
    return (3 * cosh(kd) / pow(sinh(kd), 3) - 2 * piston_stroke_ratio(kd)) / (32 * DEPTH);
}

/// In shallow water the evanescent modes vanish, and Madsen's second harmonic is exact: at kd 0.2
/// his falls short by 1 part in 1000, at 0.3 by 5, at 0.5 by 49.
TEST(a_component_with_itself_is_madsens_in_shallow_water)
{
    const double kd[] = {0.2, 0.3, 0.5}, most[] = {0.0012, 0.006, 0.05};
    for (int i = 0; i < 3; i++) {
        PistonModes m = modes_of(kd[i]);
        PistonTransfer t = piston_transfer(&m, &m, PISTON_SUM, DEPTH, GRAVITY);
        double madsen = 4 * madsens(kd[i]); // of an amplitude of 1 m
        CHECK_NEAR(-t.imaginary / madsen, 1, most[i]);
        CHECK(fabs(t.real / madsen) < 0.001);
    }
}

/// Of a slow group the paddle makes the flow that belongs to the set-down, c_g eta: by
/// conservation of mass, with eta = -g (2n - 1/2)/(g d - c_g^2) a1 a2 of Longuet-Higgins & Stewart
/// (1962), doi:10.1017/S0022112062000877.
TEST(a_slow_difference_makes_the_flow_of_the_set_down)
{
    const double kd[] = {0.3, 0.5, 1, 2, 3};
    for (int i = 0; i < 5; i++) {
        double omega = sqrt(GRAVITY * kd[i] / DEPTH * tanh(kd[i])), gap = 1e-4 * omega;
        double n = 0.5 * (1 + 2 * kd[i] / sinh(2 * kd[i])), speed = n * omega * DEPTH / kd[i];
        double down = -GRAVITY * (2 * n - 0.5) / (GRAVITY * DEPTH - speed * speed);
        PistonModes fast = piston_modes(omega + gap / 2, DEPTH, GRAVITY);
        PistonModes slow = piston_modes(omega - gap / 2, DEPTH, GRAVITY);
        PistonTransfer t = piston_transfer(&fast, &slow, PISTON_DIFFERENCE, DEPTH, GRAVITY);
        // the flow is d times the velocity, i Omega x
        CHECK_NEAR(-gap * t.imaginary * DEPTH / (speed * down), 1, 0.002);
        CHECK(fabs(t.real) < 0.01 * fabs(t.imaginary));
    }
}

/// Ten times as many modes, written a second time in other terms (sums over all pairs of complex
/// modes): transfers times the depth.
TEST(transfers_are_those_of_160_modes)
{
    static const struct {
        double fast, slow;
        PistonProduct product;
        double real, imaginary;
    } rows[] = {
        {2.0, 1.2, PISTON_SUM, 0.20987, -0.43546}, {2.0, 1.2, PISTON_DIFFERENCE, 0.04843, 1.27105},
        {1, 1, PISTON_SUM, 0.03543, -0.36376},     {3, 0.8, PISTON_DIFFERENCE, 0.04474, 0.38680},
        {3, 0.8, PISTON_SUM, 0.20260, -0.57863},   {6, 5, PISTON_DIFFERENCE, 0.60771, 0.49910},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        PistonModes fast = modes_of(rows[i].fast), slow = modes_of(rows[i].slow);
        PistonTransfer t = piston_transfer(&fast, &slow, rows[i].product, DEPTH, GRAVITY);
        double size = hypot(rows[i].real, rows[i].imaginary), most = i < 5 ? 0.003 : 0.01;
        CHECK_NEAR(t.real * DEPTH, rows[i].real, most * size);
        CHECK_NEAR(t.imaginary * DEPTH, rows[i].imaginary, most * size);
    }
}

/// The forced wave number of a difference may be the free wave's of one of the two: a limit.
TEST(a_difference_as_fast_as_its_slower_wave_is_no_exception)
{
    PistonModes slow = modes_of(0.8);
    double omega = slow.angular_frequency, at[3], across[3];
    for (int i = 0; i < 3; i++) {
        PistonModes fast = piston_modes(omega * (2 + 1e-5 * (i - 1)), DEPTH, GRAVITY);
        PistonTransfer t = piston_transfer(&fast, &slow, PISTON_DIFFERENCE, DEPTH, GRAVITY);
        at[i] = t.real, across[i] = t.imaginary;
    }
    CHECK_NEAR(at[1], (at[0] + at[2]) / 2, 1e-5 * hypot(at[1], across[1]));
    CHECK_NEAR(across[1], (across[0] + across[2]) / 2, 1e-5 * hypot(at[1], across[1]));
}

/// A flume 20 m long with 0.5 m of water.
static Scene *flume_of(WaveKind kind, int order)
{
    static Scene scene;
    scene = scene_default();
    scene.domain.kind = DOMAIN_FLUME;
    scene.domain.dimensions = 2;
    scene.domain.min = vec3(0, -0.5, -0.5);
    scene.domain.max = vec3(20, 0.5, 0.3);
    scene.fluid.spacing = 0.05;
    scene.waves.kind = kind;
    scene.waves.start = WAVE_START_HOT;
    scene.waves.piston_order = order;
    scene.waves.initial = (WaveTarget){0.1, 1.6, 0};
    scene.waves.height_limits = (Range){0, 0.1};
    scene.waves.period_limits = (Range){1.6, 1.6};
    scene.waves.focus = (Focus){8, 0, 15};
    return &scene;
}

static WaveState sea_of(const Scene *scene)
{
    WaveState waves = waves_create(scene);
    CHECK(waves_take_sea(&waves, scene, &arena, &error));
    return waves;
}

static PistonTransfer transfer(const SeaLayer *layer, int n, int m, PistonProduct product)
{
    PistonModes fast = piston_modes(layer->angular_frequency[n], DEPTH, GRAVITY);
    PistonModes slow = piston_modes(layer->angular_frequency[m], DEPTH, GRAVITY);
    return piston_transfer(&fast, &slow, product, DEPTH, GRAVITY);
}

/// Second-order displacement, pair by pair; differences below `slowest` fade.
static double pair_by_pair(const SeaLayer *layer, int count, double slowest, double time)
{
    double sum = 0;
    for (int n = 0; n < count; n++)
        for (int m = 0; m <= n; m++) {
            double a = layer->amplitude[n] * (1 - layer->depth_ratio[n]);
            double b = layer->amplitude[m] * (1 - layer->depth_ratio[m]);
            double p = layer->angular_frequency[n] * time - 2 * PI * layer->turns[n];
            double q = layer->angular_frequency[m] * time - 2 * PI * layer->turns[m];
            double gap = layer->angular_frequency[n] - layer->angular_frequency[m];
            double kept = slowest > 0 ? 1 - exp(-gap * gap / (slowest * slowest)) : 1;
            PistonTransfer s = transfer(layer, n, m, PISTON_SUM);
            PistonTransfer d = transfer(layer, n, m, PISTON_DIFFERENCE);
            sum += a * b * (s.real * cos(p + q) - s.imaginary * sin(p + q));
            sum += a * b * kept * (d.real * cos(p - q) - d.imaginary * sin(p - q));
        }
    return sum;
}

/// From its mean place on; only an irregular sea's differences below the flume's seiche fade.
TEST(the_path_of_second_order_is_the_sum_of_its_pairs)
{
    const WaveKind kinds[] = {WAVES_FOCUSED, WAVES_IRREGULAR};
    const double slowest[] = {0, PI * sqrt(GRAVITY * DEPTH) / 20}; // the flume is 20 m long
    for (int i = 0; i < 2; i++) {
        Scene *scene = flume_of(kinds[i], 2);
        scene->waves.spectrum.components = 12;
        WaveState second = sea_of(scene);
        scene->waves.piston_order = 1;
        WaveState first = sea_of(scene);
        const SeaLayer *layer = &second.sea->layers[0];
        double start = pair_by_pair(layer, 12, slowest[i], 0);
        for (int step = 0; step < 5; step++) {
            double t = 11 + 0.37 * step, sum = pair_by_pair(layer, 12, slowest[i], t) - start;
            double beyond = piston_displacement(&second, t) - piston_displacement(&first, t);
            CHECK(fabs(sum) > 1e-5);
            CHECK_NEAR(beyond, sum, 1e-12);
        }
        CHECK_NEAR(piston_displacement(&second, 0), piston_displacement(&first, 0), 1e-15);
    }
}

/// Twice the height: four times the second order. A live change blends it smoothly.
TEST(second_order_grows_with_the_square_and_blends)
{
    double beyond[2];
    for (int i = 0; i < 2; i++) {
        Scene *scene = flume_of(WAVES_IRREGULAR, 2);
        scene->waves.initial.height = 0.04 * (i + 1);
        WaveState second = sea_of(scene);
        scene->waves.piston_order = 1;
        WaveState first = sea_of(scene);
        beyond[i] = piston_displacement(&second, 7.3) - piston_displacement(&first, 7.3);
    }
    CHECK_NEAR(beyond[1] / beyond[0], 4, 1e-9);
    Scene *scene = flume_of(WAVES_IRREGULAR, 2);
    WaveState waves = sea_of(scene);
    WaveTarget lower = {0.05, 1.6, 0};
    double dt = 0.002, last[3] = {0}, jerk = 0, calm = 0;
    for (int n = 0; n < 5000; n++) {
        double t = dt * n;
        if (n == 2500) waves_command(&waves, scene, &lower, t);
        waves_update(&waves, scene, t);
        double x = piston_displacement(&waves, t);
        if (n > 2) {
            double third = fabs(x - 3 * last[0] + 3 * last[1] - last[2]) / (dt * dt * dt);
            *(n < 2500 ? &calm : &jerk) = maxd(n < 2500 ? calm : jerk, third);
        }
        last[2] = last[1], last[1] = last[0], last[0] = x;
    }
    CHECK(calm > 0 && jerk < 1.5 * calm); // a step of 1e-5 m would be a thousand times that
}

/// What the plan keeps free behind the walls holds the path; the differences of long waves in
/// shallow water take more than first order's bound.
TEST(the_travel_is_sized_for_second_order)
{
    static const struct {
        WaveKind kind;
        double height, period;
        bool more;
    } rows[] = {{WAVES_IRREGULAR, 0.1, 1.6, false},
                {WAVES_FOCUSED, 0.1, 1.6, false},
                {WAVES_FOCUSED, 0.06, 4, true}};
    for (int i = 0; i < 3; i++) {
        Scene *scene = flume_of(rows[i].kind, 2);
        scene->waves.initial = (WaveTarget){rows[i].height, rows[i].period, 0};
        scene->waves.height_limits.max = rows[i].height;
        scene->waves.period_limits.max = rows[i].period;
        double reach, farthest = 0, first = waves_wall_reach(scene);
        CHECK(piston_reach(scene, &reach, &error));
        WaveState waves = sea_of(scene);
        for (int n = 0; n < 4000; n++)
            farthest = maxd(farthest, fabs(piston_displacement(&waves, 0.05 * n)));
        printf("  reach %.3g m, of first order %.3g m, farthest in 200 s %.3g m\n", reach, first,
               farthest);
        CHECK(farthest < reach && reach < 2 * farthest);
        CHECK((reach > first) == rows[i].more);
    }
}

/// Processor time of one evaluation with 64 components [us], and of a layer's table [ms].
TEST(sixty_four_components_cost_little)
{
    WaveState second = sea_of(flume_of(WAVES_IRREGULAR, 2));
    WaveState first = sea_of(flume_of(WAVES_IRREGULAR, 1));
    const WaveState *states[] = {&first, &second};
    double spent[2] = {INFINITY, INFINITY}, sum = 0;
    for (int round = 0; round < 10; round++)
        for (int i = 0; i < 2; i++) {
            clock_t begin = clock();
            for (int n = 0; n < 200; n++)
                sum += piston_displacement(states[i], 0.01 * n);
            spent[i] = mind(spent[i], (double)(clock() - begin) / CLOCKS_PER_SEC / 200 * 1e6);
        }
    SeaLayer *layer = &second.sea->layers[0];
    clock_t begin = clock();
    layer->made = false;
    waves_refresh(&second);
    printf("  %.1f us first order, %.1f us second; its table %.1f ms (%g)\n", spent[0], spent[1],
           (double)(clock() - begin) / CLOCKS_PER_SEC * 1e3, sum > 0 ? 1.0 : 0.0);
    CHECK(spent[1] < 20 * spent[0]);
}

/// A regular wave is one component: its own sum, and for short waves that of a depth of kd 8.
TEST(a_regular_wave_s_piston_moves_by_its_component_with_itself)
{
    const double periods[] = {1.6, 0.35};
    for (int i = 0; i < 2; i++) {
        Scene *scene = flume_of(WAVES_REGULAR, 2);
        scene->waves.initial = (WaveTarget){0.01, periods[i], 0};
        WaveState second = waves_create(scene);
        scene->waves.piston_order = 1;
        WaveState first = waves_create(scene);
        const WaveTrain *train = &second.layers[0].train;
        double k = train->terms.wave_number, a = train->terms.crest[1];
        PistonModes modes =
            piston_modes(2 * PI / periods[i], mind(DEPTH, 8 / k), scene->fluid.gravity);
        PistonTransfer x =
            piston_transfer(&modes, &modes, PISTON_SUM, mind(DEPTH, 8 / k), scene->fluid.gravity);
        CHECK((k * DEPTH > 8) == (i == 1));
        for (int step = 0; step < 5; step++) {
            double t = 0.11 * step;
            double angle = 2 * PI * t / periods[i] - train->phase -
                           k * (second.interior.min[0] - train->centre_x);
            double beyond = piston_displacement(&second, t) - piston_displacement(&first, t);
            CHECK_NEAR(beyond, a * a * (x.real * cos(2 * angle) - x.imaginary * sin(2 * angle)),
                       1e-12);
        }
    }
}

/// Where second order is no wave, the piston carries what passes it: v (d + eta) = c eta.
TEST(the_piston_of_a_long_wave_moves_with_the_water_that_passes_it)
{
    Scene *scene = flume_of(WAVES_REGULAR, 2);
    scene->waves.initial = (WaveTarget){0.15, 4.2, 0}; // Ursell's number 75
    WaveState waves = waves_create(scene);
    const WaveTerms *w = &waves.layers[0].train.terms;
    double speed = w->angular_frequency / w->wave_number, most = 0;
    CHECK(waves.layers[0].train.is_long);
    for (int step = 0; step < 42; step++) {
        double t = 0.1 * step, dt = 1e-4, x = piston_displacement(&waves, t);
        double v =
            (piston_displacement(&waves, t + dt) - piston_displacement(&waves, t - dt)) / (2 * dt);
        double eta = waves_elevation(&waves, x, 0, t);
        CHECK_NEAR(v * (0.5 + eta), speed * eta, 1e-5);
        CHECK_NEAR(piston_displacement(&waves, t + 2 * PI / w->angular_frequency), x, 1e-9);
        most = maxd(most, fabs(x));
    }
    CHECK(most < waves_wall_reach(scene) && most > 0.1);
    scene->waves.initial.height = 0.03; // 19
    waves = waves_create(scene);
    CHECK(!waves.layers[0].train.is_long);
}
