/// Rotation of a rigid body: Euler's angles and their axes, the exponential map, small solves.
///
/// Angles phi = (roll, pitch, yaw) are intrinsic z-y'-x''. The angular velocity is
/// omega = sum_i axis_i phi_i', axes in the frame the angles refer to:
///     roll  Rz(yaw) Ry(pitch) x,   pitch  Rz(yaw) y,   yaw  z,
/// and phi_i' = dual_i . omega with dual_i . axis_j = delta_ij. Source: Fossen (2011), Handbook of
/// Marine Craft Hydrodynamics and Motion Control, eq. 2.24 to 2.28.
#ifndef FAIRLEAD_PHYSICS_RIGID_H
#define FAIRLEAD_PHYSICS_RIGID_H

#include "base/portable.h"

typedef struct Mat3 {
    double at[3][3];
} Mat3;

FN Vec3 mat3_apply(Mat3 m, Vec3 v)
{
    return vec3(m.at[0][0] * v.x + m.at[0][1] * v.y + m.at[0][2] * v.z,
                m.at[1][0] * v.x + m.at[1][1] * v.y + m.at[1][2] * v.z,
                m.at[2][0] * v.x + m.at[2][1] * v.y + m.at[2][2] * v.z);
}

/// m + s v v^T
FN Mat3 mat3_add_square(Mat3 m, Vec3 v, double s)
{
    double c[3];
    c[0] = v.x;
    c[1] = v.y;
    c[2] = v.z;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m.at[i][j] += s * c[i] * c[j];
    return m;
}

/// Inertia given in body axes, in the axes that `q` rotates to: R I R^T.
FN Mat3 rigid_inertia(Quat q, Mat3 inertia)
{
    Vec3 column[3];
    column[0] = quat_rotate(q, vec3(1, 0, 0));
    column[1] = quat_rotate(q, vec3(0, 1, 0));
    column[2] = quat_rotate(q, vec3(0, 0, 1));
    Mat3 r, half, m;
    for (int j = 0; j < 3; j++) {
        r.at[0][j] = column[j].x;
        r.at[1][j] = column[j].y;
        r.at[2][j] = column[j].z;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half.at[i][j] = r.at[i][0] * inertia.at[0][j] + r.at[i][1] * inertia.at[1][j] +
                            r.at[i][2] * inertia.at[2][j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m.at[i][j] = half.at[i][0] * r.at[j][0] + half.at[i][1] * r.at[j][1] +
                         half.at[i][2] * r.at[j][2];
    return m;
}

/// Rotation by the vector `turn` [rad].
FN Quat quat_from_turn(Vec3 turn)
{
    double angle = vec3_norm(turn);
    // sin(x/2)/x by its series where the quotient would lose digits
    double s = angle > 1e-4 ? sin(angle / 2) / angle : 0.5 - angle * angle / 48;
    return quat(cos(angle / 2), s * turn.x, s * turn.y, s * turn.z);
}

/// Axes about which roll, pitch and yaw turn at the angles `angle`.
FN void rigid_axes(Vec3 angle, Vec3 *axes)
{
    double cp = cos(angle.y), sp = sin(angle.y), cy = cos(angle.z), sy = sin(angle.z);
    axes[0] = vec3(cp * cy, cp * sy, -sp);
    axes[1] = vec3(-sy, cy, 0);
    axes[2] = vec3(0, 0, 1);
}

/// Vectors that pick roll, pitch and yaw rates out of an angular velocity. Within 6 deg of a pitch
/// of 90 deg, where roll and yaw coincide, they stay bounded instead of exact.
FN void rigid_duals(Vec3 angle, Vec3 *duals)
{
    double cp = cos(angle.y), sp = sin(angle.y), cy = cos(angle.z), sy = sin(angle.z);
    double safe = cp >= 0 ? (cp > 0.1 ? cp : 0.1) : (cp < -0.1 ? cp : -0.1);
    duals[0] = vec3(cy / safe, sy / safe, 0);
    duals[1] = vec3(-sy, cy, 0);
    duals[2] = vec3(cy * sp / safe, sy * sp / safe, 1);
}

/// Solve m x = b for the leading `count` unknowns by Gauss with pivoting; a singular row gives 0.
FN void rigid_solve(int count, double m[3][3], double *b, double *x)
{
    int order[3];
    for (int i = 0; i < 3; i++)
        order[i] = i;
    for (int k = 0; k < count; k++) {
        int best = k;
        for (int i = k + 1; i < count; i++)
            if (fabs(m[order[i]][k]) > fabs(m[order[best]][k])) best = i;
        int swap = order[k];
        order[k] = order[best];
        order[best] = swap;
        for (int i = k + 1; i < count; i++) {
            double pivot = m[order[k]][k];
            double factor = pivot != 0 ? m[order[i]][k] / pivot : 0.0;
            for (int j = k; j < count; j++)
                m[order[i]][j] -= factor * m[order[k]][j];
            b[order[i]] -= factor * b[order[k]];
        }
    }
    for (int k = count - 1; k >= 0; k--) {
        double sum = b[order[k]], pivot = m[order[k]][k];
        for (int j = k + 1; j < count; j++)
            sum -= m[order[k]][j] * x[j];
        x[k] = pivot != 0 ? sum / pivot : 0.0;
    }
}

/// Angular velocity omega = sum_free axis_j y_j + `given` for which m omega - momentum has no part
/// along any of the `test` axes: constraint torques do no work on the free axes.
/// @param rates  y, filled [count]
FN Vec3 rigid_project(Mat3 m, Vec3 momentum, Vec3 given, int count, const Vec3 *axes,
                      const Vec3 *test, double *rates)
{
    double a[3][3], b[3];
    Vec3 rest = vec3_sub(momentum, mat3_apply(m, given)), omega = given;
    for (int i = 0; i < count; i++) {
        b[i] = vec3_dot(test[i], rest);
        for (int j = 0; j < count; j++)
            a[i][j] = vec3_dot(test[i], mat3_apply(m, axes[j]));
    }
    rigid_solve(count, a, b, rates);
    for (int i = 0; i < count; i++)
        omega = vec3_mad(omega, axes[i], rates[i]);
    return omega;
}

#endif
