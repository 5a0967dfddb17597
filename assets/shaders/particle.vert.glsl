layout(location = 0) in vec4 place; // xyz [m]; w: field value
out vec3 shade;

uniform sampler2D maps;

void main()
{
    gl_Position = clip_from_world * vec4(place.xyz, 1.0);
    float radius = 0.62 * box_min.w * target.y / (forward.w * max(gl_Position.w, 1e-4));
    gl_PointSize = clamp(radius, 1.0, 200.0);
    float at = clamp((place.w - field.x) / (field.y - field.x), 0.0, 1.0);
    shade = texture(maps, vec2(at * 0.996 + 0.002, field.z)).rgb;
}
