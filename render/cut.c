#include "cut.h"

#include <string.h>

/// Particles this near a side show on it, and reach of their kernel [dp].
static const double side_band = 1.5, kernel_reach = 1.6;

static bool lay_out(CutFaces *cut, const Snapshot *snapshot, Vec3 min, Vec3 max, Error *error)
{
    const double dp = snapshot->spacing;
    const double length[2] = {max.x - min.x, max.y - min.y};
    cut->width = 0;
    for (int side = 0; side < 4; side++) {
        cut->columns[side] = (int)maxd(1.0, round(length[side % 2] / dp)) + 1;
        cut->first[side] = cut->width;
        cut->width += cut->columns[side];
    }
    double top = maxd(snapshot->domain.max.z, snapshot->level + dp);
    cut->bed = min.z;
    cut->rows = (int)maxd(1.0, ceil((top - min.z) / dp)) + 1;
    cut->step = (top - min.z) / (cut->rows - 1);
    size_t cells = (size_t)cut->width * cut->rows;
    cut->value = scratch_need(&cut->storage, 2 * cells * sizeof *cut->value, error);
    TRY(cut->value);
    memset(cut->value, 0, 2 * cells * sizeof *cut->value);
    return true;
}

/// One particle into the sums of one side.
/// @param along  distance from the side's start [m]; NAN = all along it, as across a slice
static void add_particle(CutFaces *cut, int side, double length, double along, double height,
                         double reach, float value)
{
    float *weight = cut->value + (size_t)cut->width * cut->rows;
    double step = length / (cut->columns[side] - 1);
    const bool all = isnan(along);
    int x_begin = all ? 0 : (int)maxd(0.0, ceil((along - reach) / step));
    int x_last = all ? cut->columns[side] - 1 : (int)floor((along + reach) / step);
    int x_end = (int)mind(cut->columns[side] - 1.0, x_last) + 1;
    int z_begin = (int)maxd(0.0, ceil((height - reach) / cut->step));
    int z_end = (int)mind(cut->rows - 1.0, floor((height + reach) / cut->step)) + 1;
    for (int z = z_begin; z < z_end; z++)
        for (int x = x_begin; x < x_end; x++) {
            double dx = all ? 0.0 : x * step - along, dz = z * cut->step - height;
            double q = 1.0 - (dx * dx + dz * dz) / (reach * reach);
            if (q <= 0.0) continue;
            size_t cell = (size_t)z * cut->width + cut->first[side] + x;
            cut->value[cell] += (float)(q * q) * value;
            weight[cell] += (float)(q * q);
        }
}

/// Means from sums; cells without particles take the value below them, else the one above.
static void finish(CutFaces *cut)
{
    const float *weight = cut->value + (size_t)cut->width * cut->rows;
    for (int x = 0; x < cut->width; x++) {
        int lowest = -1;
        for (int z = 0; z < cut->rows; z++) {
            size_t cell = (size_t)z * cut->width + x;
            if (weight[cell] > 1e-3f) {
                cut->value[cell] /= weight[cell];
                if (lowest < 0) lowest = z;
            } else {
                cut->value[cell] = z > 0 ? cut->value[cell - cut->width] : 0.0f;
            }
        }
        for (int z = 0; z < lowest; z++)
            cut->value[(size_t)z * cut->width + x] = cut->value[(size_t)lowest * cut->width + x];
    }
}

bool cut_faces_build(CutFaces *cut, const Snapshot *snapshot, const float *scalar, Vec3 min,
                     Vec3 max, Error *error)
{
    TRY(lay_out(cut, snapshot, min, max, error));
    const double dp = snapshot->spacing, band = side_band * dp, reach = kernel_reach * dp;
    const bool plane = snapshot->domain.dimensions == 2;
    const double length[2] = {max.x - min.x, max.y - min.y};
    for (int i = 0; i < snapshot->fluid_count; i++) {
        double x = snapshot->position[i][0] - min.x, z = snapshot->position[i][2] - min.z;
        double y = plane ? 0.5 * length[1] : snapshot->position[i][1] - min.y;
        // Written so that a not-a-number fails every comparison.
        if (!(x >= 0.0 && x <= length[0] && y >= 0.0 && y <= length[1] && fabs(z) < 1e6)) continue;
        const double across = plane ? NAN : y;
        if (y < band || plane) add_particle(cut, 0, length[0], x, z, reach, scalar[i]);
        if (x > length[0] - band) add_particle(cut, 1, length[1], across, z, reach, scalar[i]);
        if (y > length[1] - band || plane) add_particle(cut, 2, length[0], x, z, reach, scalar[i]);
        if (x < band) add_particle(cut, 3, length[1], across, z, reach, scalar[i]);
    }
    finish(cut);
    return true;
}

double cut_faces_u(const CutFaces *cut, int side, double share)
{
    return (cut->first[side] + 0.5 + share * (cut->columns[side] - 1)) / cut->width;
}

void cut_faces_destroy(CutFaces *cut)
{
    scratch_free(&cut->storage);
    *cut = (CutFaces){0};
}
