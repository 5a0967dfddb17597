// A ribbon that faces the eye and is shaded as a tube, never thinner than a set number of pixels.
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 position;
layout(location = 2) in vec3 after;
layout(location = 3) in vec3 edge; // -1 or 1 across; tension [N]; 0 working, 1 slack, 2 near its largest
out float across;
out float pull;
out float half_width;
out float sunk;
out float mark;

uniform vec4 size; // radius [m]; least half width [pixel]; veil of the water, 0..1

vec2 pixel(vec4 clip) { return clip.xy / max(clip.w, 1e-4) * 0.5 * target.xy; }

void main()
{
    vec4 centre = clip_from_world * vec4(position, 1.0);
    vec2 along = pixel(clip_from_world * vec4(after, 1.0)) - pixel(clip_from_world * vec4(before, 1.0));
    along = length(along) > 1e-3 ? normalize(along) : vec2(1.0, 0.0);
    float radius = size.x * 0.5 * target.y / (forward.w * max(centre.w, 1e-4));
    half_width = max(radius, size.y) * (1.0 + 0.8 * clamp(edge.z - 1.0, 0.0, 1.0));
    float grown = half_width + 0.8;
    across = edge.x * grown;
    pull = edge.y;
    mark = edge.z;
    sunk = box_max.z - position.z;
    // Towards the eye by a few widths, so that a line on the bed is not half sunk in it.
    float width = half_width * 2.0 * forward.w * centre.w * target.w;
    vec3 nearer = position + normalize(eye.xyz - position) * 6.0 * width;
    vec4 shifted = clip_from_world * vec4(nearer, 1.0);
    centre.z = shifted.z / shifted.w * centre.w;
    centre.xy += edge.x * vec2(-along.y, along.x) * grown * 2.0 * target.zw * centre.w;
    gl_Position = centre;
}
