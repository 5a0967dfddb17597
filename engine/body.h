/// Rigid bodies with six degrees of freedom: state, constraints, integration. Double precision.
#ifndef FAIRLEAD_BODY_H
#define FAIRLEAD_BODY_H

#include "base/portable.h"
#include "hull.h"
#include "scene.h"

/// Plain data; a checkpoint copies it.
typedef struct Body {
    Vec3 position;             ///< of the centre of gravity, world [m]
    Quat attitude;             ///< geometry axes to world
    Vec3 angle;                ///< roll, pitch, yaw as followed: no jump beyond 90 deg of pitch
    Vec3 velocity;             ///< of the centre of gravity [m/s]
    Vec3 angular_velocity;     ///< world axes [rad/s]
    Vec3 acceleration;         ///< of the last step [m/s^2], used by the dummy extrapolation
    Vec3 angular_acceleration; ///< world axes [rad/s^2]
    Vec3 fluid_force;          ///< of the last step [N]
    Vec3 fluid_moment;         ///< about the centre of gravity, world axes [N m]
    Vec3 line_force;           ///< [N]
    Vec3 line_moment;          ///< [N m]
    Vec3 contact_force;        ///< of bed, walls and other bodies [N]
    Vec3 contact_moment;       ///< [N m]
    // constant after creation
    Vec3 reference_position; ///< of the centre of gravity [m]
    Quat reference_attitude;
    Vec3 centre_of_gravity; ///< geometry axes [m]
    double mass;
    double inertia[3][3];      ///< geometry axes, about the centre of gravity [kg m^2]
    bool moving;               ///< any degree of freedom that is not fixed
    bool constrained;          ///< any rotation that is fixed or prescribed
    const MotionTable *motion; ///< added to prescribed freedoms; NULL = none. Borrowed
} Body;

/// Motions as a naval engineer reads them: surge, sway, heave [m] along the axes of the initial
/// heading, roll, pitch, yaw [rad] relative to it.
typedef struct BodyMotion {
    double value[6];
    double rate[6];
} BodyMotion;

Body body_create(const BodyScene *scene, const BodyGeometry *geometry);

/// World position and velocity of a point given in geometry axes.
Vec3 body_point(const Body *body, Vec3 point);
Vec3 body_point_velocity(const Body *body, Vec3 point);
/// Acceleration of a point moving with the body (alpha x r and omega x (omega x r) included).
Vec3 body_point_acceleration(const Body *body, Vec3 point);

/// Advance over dt under body->fluid_force/moment, line_force/moment, weight and the constraints:
/// semi-implicit (velocity first, then pose), momentum-conserving for the rotation; prescribed
/// freedoms are evaluated at time + dt; springs act on BodyMotion coordinates; held while
/// time < scene->hold_time.
void body_advance(Body *body, const BodyScene *scene, double gravity, double time, double dt);

BodyMotion body_motion(const Body *body);

/// Largest stable step of the springs of this body [s]; INFINITY without springs.
double body_step_limit(const Body *body, const BodyScene *scene);

#endif
