// Shared by every shader. Positions in metres, world axes, z up; colours as shown (display-referred),
// which keeps every pass a plain mix.
layout(std140) uniform Frame {
    mat4 clip_from_world;
    vec4 eye;           // xyz [m]; w: simulated time [s]
    vec4 forward;       // unit; w: tan(field of view / 2)
    vec4 right;         // unit * tan * aspect
    vec4 up;            // unit * tan
    vec4 light;         // unit, towards the lamp
    vec4 sun;           // unit, towards the sun whose glint lies on the water
    vec4 box_min;       // water's room [m]; w: particle spacing [m]
    vec4 box_max;       // z: still level [m]; w: width of the relaxation zone [m], 0 = none
    vec4 target;        // width, height, 1/width, 1/height [pixel]
    vec4 range;         // near, far [m]; radius of the scene [m]; amplitude of the surface [m]
    vec4 sky_zenith;    // reflected sky
    vec4 sky_horizon;
    vec4 backdrop_top;  // what stands behind the scene
    vec4 backdrop_low;
    vec4 bed_colour;    // w: distance of grid lines [m]
    vec4 grid_colour;   // w: strength
    vec4 water_deep;    // w: extinction [1/m]
    vec4 water_shallow; // w: strength of the reflected sky
    vec4 field;         // least, largest value; row of its colour map; 0 none, 1 elevation, 2 scalar
    vec4 tension;       // least, largest [N]; row of its colour map
};

vec3 sky(vec3 direction)
{
    float height = max(direction.z, 0.0);
    return mix(sky_horizon.rgb, sky_zenith.rgb, sqrt(height));
}

// Distance from the eye of the point a depth value stands for, along `ray` (unit).
float depth_distance(float depth, vec3 ray)
{
    float along = range.x * range.y / (range.y - depth * (range.y - range.x));
    return along / max(dot(ray, forward.xyz), 1e-3);
}

#ifdef FRAGMENT
// 1 on the line, 0 beside it; `at` is the distance to the line in units of its own.
float line_mask(float at, float pixels)
{
    float width = max(fwidth(at), 1e-6);
    return 1.0 - smoothstep(pixels - 0.7, pixels + 0.7, abs(at) / width);
}
#endif
