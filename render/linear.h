/// Single-precision vectors and matrices as OpenGL wants them (columns one after another).
#ifndef FAIRLEAD_LINEAR_H
#define FAIRLEAD_LINEAR_H

#include "base/portable.h"

typedef struct Vec4f {
    float x, y, z, w;
} Vec4f;

typedef struct Mat4 {
    float m[16];
} Mat4;

static inline Vec4f vec4f(double x, double y, double z, double w)
{
    return (Vec4f){(float)x, (float)y, (float)z, (float)w};
}

static inline Vec4f vec4f_from(Vec3 v, double w) { return vec4f(v.x, v.y, v.z, w); }

static inline Vec3 vec3_unit(Vec3 v)
{
    double length = vec3_norm(v);
    return length > 0 ? vec3_scale(v, 1.0 / length) : vec3(0, 0, 1);
}

static inline Mat4 mat4_multiply(Mat4 a, Mat4 b)
{
    Mat4 c;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a.m[k * 4 + row] * b.m[column * 4 + k];
            c.m[column * 4 + row] = sum;
        }
    return c;
}

/// World to eye: x right, y up, z backwards.
static inline Mat4 mat4_view(Vec3 eye, Vec3 right, Vec3 up, Vec3 forward)
{
    Vec3 rows[3] = {right, up, vec3_scale(forward, -1.0)};
    Mat4 view = {{0}};
    for (int row = 0; row < 3; row++) {
        view.m[row] = (float)rows[row].x;
        view.m[4 + row] = (float)rows[row].y;
        view.m[8 + row] = (float)rows[row].z;
        view.m[12 + row] = (float)-vec3_dot(rows[row], eye);
    }
    view.m[15] = 1;
    return view;
}

/// @param tangent  of half the vertical angle
static inline Mat4 mat4_perspective(double tangent, double aspect, double near, double far)
{
    Mat4 p = {{0}};
    p.m[0] = (float)(1.0 / (tangent * aspect));
    p.m[5] = (float)(1.0 / tangent);
    p.m[10] = (float)(-(far + near) / (far - near));
    p.m[11] = -1;
    p.m[14] = (float)(-2.0 * far * near / (far - near));
    return p;
}

/// Rotation and translation of a body's geometry.
static inline Mat4 mat4_pose(Quat attitude, Vec3 origin)
{
    Vec3 axes[3] = {quat_rotate(attitude, vec3(1, 0, 0)), quat_rotate(attitude, vec3(0, 1, 0)),
                    quat_rotate(attitude, vec3(0, 0, 1))};
    Mat4 pose = {{0}};
    for (int column = 0; column < 3; column++) {
        pose.m[column * 4] = (float)axes[column].x;
        pose.m[column * 4 + 1] = (float)axes[column].y;
        pose.m[column * 4 + 2] = (float)axes[column].z;
    }
    pose.m[12] = (float)origin.x;
    pose.m[13] = (float)origin.y;
    pose.m[14] = (float)origin.z;
    pose.m[15] = 1;
    return pose;
}

#endif
