/// The dialect common to C17, C++17 and CUDA in which everything in physics/ is written: plain
/// functions on values; no VLAs, compound literals or designated initialisers; ternaries instead of
/// fmaxf/fminf (gcc stops vectorising at a call).
#ifndef FAIRLEAD_BASE_PORTABLE_H
#define FAIRLEAD_BASE_PORTABLE_H

#include <math.h>

#if defined(__CUDACC__)
#define FN static __host__ __device__ __forceinline__
#elif defined(__GNUC__)
#define FN static inline __attribute__((always_inline, unused))
#else
#define FN static inline
#endif

#if defined(__cplusplus) || defined(__CUDACC__)
#define RESTRICT __restrict__
#else
#define RESTRICT restrict
#endif

#define PI 3.14159265358979323846

FN float minf(float a, float b) { return a < b ? a : b; }
FN float maxf(float a, float b) { return a > b ? a : b; }
FN double mind(double a, double b) { return a < b ? a : b; }
FN double maxd(double a, double b) { return a > b ? a : b; }

/// Three numbers in double precision: bodies, lines, waves.
typedef struct Vec3 {
    double x, y, z;
} Vec3;

FN Vec3 vec3(double x, double y, double z)
{
    Vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
FN Vec3 vec3_add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
FN Vec3 vec3_sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
FN Vec3 vec3_scale(Vec3 a, double s) { return vec3(a.x * s, a.y * s, a.z * s); }
FN Vec3 vec3_mad(Vec3 a, Vec3 b, double s)
{
    return vec3(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}
FN double vec3_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN double vec3_norm(Vec3 a) { return sqrt(vec3_dot(a, a)); }
FN Vec3 vec3_cross(Vec3 a, Vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// Unit quaternion, scalar first; rotates body-frame vectors into the world.
typedef struct Quat {
    double w, x, y, z;
} Quat;

FN Quat quat(double w, double x, double y, double z)
{
    Quat q;
    q.w = w;
    q.x = x;
    q.y = y;
    q.z = z;
    return q;
}
FN Quat quat_mul(Quat a, Quat b)
{
    return quat(a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w);
}
FN Quat quat_conjugate(Quat q) { return quat(q.w, -q.x, -q.y, -q.z); }
FN Quat quat_normalise(Quat q)
{
    double s = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return quat(q.w * s, q.x * s, q.y * s, q.z * s);
}
/// v' = q v q*
FN Vec3 quat_rotate(Quat q, Vec3 v)
{
    Vec3 u = vec3(q.x, q.y, q.z);
    Vec3 t = vec3_scale(vec3_cross(u, v), 2.0);
    return vec3_add(vec3_mad(v, t, q.w), vec3_cross(u, t));
}
/// Intrinsic z-y'-x'' (yaw, pitch, roll) angles [rad].
FN Quat quat_from_euler(double roll, double pitch, double yaw)
{
    double cr = cos(roll / 2), sr = sin(roll / 2), cp = cos(pitch / 2), sp = sin(pitch / 2);
    double cy = cos(yaw / 2), sy = sin(yaw / 2);
    return quat(cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy,
                cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy);
}
/// Roll, pitch, yaw [rad] of a rotation; the inverse of quat_from_euler for |pitch| < pi/2.
FN Vec3 quat_to_euler(Quat q)
{
    double s = 2 * (q.w * q.y - q.z * q.x);
    s = s > 1 ? 1 : (s < -1 ? -1 : s);
    return vec3(atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)), asin(s),
                atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)));
}

#endif
