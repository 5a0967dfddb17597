// Water from what lies behind it: the finished picture of everything opaque is looked up (bent a
// little), dimmed over the path through the water, and the sky is laid over it by Fresnel's law.
// Nothing is blended, so the nearest sheet of water wins whatever the order of drawing.
// Compiled four times, because a software renderer works through both sides of every branch: for the
// surface or a WALL of the water's room, plain or COLOURED by a field.
in vec3 world;
in vec3 normal;
in float value;
in float below;
in float wet;
out vec4 colour;

uniform sampler2D opaque_colour;
uniform sampler2D opaque_depth;
uniform sampler2D maps;
uniform sampler2D mirror;
uniform sampler2D cut;
uniform vec3 faces; // of the cut faces' grid: z of the first row, step [m], rows

// Length of the ray inside the water's room.
float way_out(vec3 from, vec3 ray)
{
    vec3 inverse = 1.0 / (ray + vec3(1e-7));
    vec3 side = mix(box_min.xyz, box_max.xyz, step(0.0, ray));
    vec3 reach = (side - from) * inverse;
    if (ray.z > 0.0) reach.z = 1e6;
    return max(min(reach.x, min(reach.y, reach.z)), 0.0);
}

// A dashed frame round the part of the basin that is not driven.
float zone_frame(vec2 place)
{
    vec2 centre = 0.5 * (box_min.xy + box_max.xy);
    vec2 reach = 0.5 * (box_max.xy - box_min.xy) - box_max.w;
    vec2 beyond = abs(place - centre) - reach;
    float edge = max(beyond.x, beyond.y);
    float along = beyond.x > beyond.y ? place.y : place.x;
    float dash = step(0.45, fract(along / (0.022 * range.z)));
    return line_mask(edge, 0.8) * dash;
}

// x to the power of 128.
float sharp(float x)
{
    for (int i = 0; i < 7; i++)
        x *= x;
    return x;
}

void main()
{
#ifndef WALL
    if (wet < 0.5) discard;
#endif
    vec3 n = normalize(normal);
    vec3 ray = world - eye.xyz;
    float here = length(ray);
    ray /= here;
    float facing = -dot(n, ray);
    bool inside = facing < 0.0; // seen from under water
    if (inside) {
        n = -n;
        facing = -facing;
    }

    vec2 screen = gl_FragCoord.xy * target.zw, bent = screen;
    float behind = depth_distance(texture(opaque_depth, screen).r, ray);
#ifndef WALL
    bent += vec2(dot(n.xy, right.xy), dot(n.xy, up.xy)) * (-0.035 / forward.w);
    vec4 ship = texture(mirror, bent);
    float aside = depth_distance(texture(opaque_depth, bent).r, ray);
    if (aside < here)
        bent = screen;
    else
        behind = aside;
#endif
    float path = inside ? here : max(min(behind - here, way_out(world, ray)), 0.0);
    vec3 passed = exp(-water_deep.w * path * vec3(1.55, 0.85, 0.7));

    float lit = dot(n, light.xyz);
    vec3 bounce = reflect(ray, n);
    vec3 reflected = sky(vec3(bounce.xy, abs(bounce.z)));
    float grazing = clamp(1.0 - facing, 0.0, 1.0), square = grazing * grazing;
    float fresnel = 0.02 + 0.98 * square * square * grazing;
#ifdef WALL
    vec3 body = mix(water_deep.rgb, water_shallow.rgb, 0.22) * 0.92;
    float share = min(fresnel, 0.25) * 0.6, glint = 0.0;
#else
    float crest = clamp(0.5 + 0.5 * (world.z - box_max.z) / range.w, 0.0, 1.0);
    vec3 body = mix(water_deep.rgb, water_shallow.rgb, 0.12 + 0.5 * crest * crest);
    body *= 0.84 + 0.22 * lit;
    reflected = mix(reflected, ship.rgb, ship.a * 0.85);
    float share = fresnel * water_shallow.w;
    float glint = sharp(max(dot(vec3(bounce.xy, abs(bounce.z)), sun.xyz), 0.0)) * 0.30;
#endif
    vec3 through = mix(body, texture(opaque_colour, bent).rgb, passed);

#ifdef COLOURED
#ifdef WALL
    float shown = texture(cut, vec2(value, ((world.z - faces.x) / faces.y + 0.5) / faces.z)).r;
    float shade = 0.80 + 0.12 * lit, cover = 0.78;
#else
    float shown = field.w < 1.5 ? world.z - box_max.z : value;
    float shade = 0.80 + 0.26 * lit, cover = 0.86;
#endif
    float at = clamp((shown - field.x) / (field.y - field.x), 0.0, 1.0);
    vec3 mapped = texture(maps, vec2(at * 0.996 + 0.002, field.z)).rgb * shade;
    colour = vec4(mix(through, mapped, cover) + 0.25 * glint, 1.0);
    colour.rgb = mix(colour.rgb, reflected, share * 0.25);
#else
    colour = vec4(mix(through, reflected, share) + glint * vec3(1.0, 0.97, 0.9), 1.0);
#endif
#ifdef WALL
    colour.rgb = mix(colour.rgb, vec3(0.93, 0.98, 1.0), 0.55 * line_mask(below, 1.1));
#else
    if (box_max.w > 0.0) colour.rgb = mix(colour.rgb, vec3(1.0), 0.22 * zone_frame(world.xy));
#endif
}
