in float across;
in float pull;
in float half_width;
in float sunk;
in float mark;
out vec4 colour;

uniform sampler2D maps;
uniform vec4 size;
uniform vec4 slack; // colour of a slack stretch

void main()
{
    float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
    if (cover < 0.05) discard;
    float at = clamp((pull - tension.x) / (tension.y - tension.x), 0.0, 1.0);
    vec3 base = texture(maps, vec2(at * 0.996 + 0.002, tension.z)).rgb;
    base = mix(base, slack.rgb, step(0.5, mark) * step(mark, 1.5));
    if (pull < -0.5) base = vec3(0.16, 0.17, 0.19); // an anchor
    if (pull < -1.5) { // an edge of the tank
        colour = vec4(mix(grid_colour.rgb, backdrop_top.rgb, 0.3), 0.6 * cover);
        return;
    }
    float veil = size.z * (1.0 - exp(-2.0 * water_deep.w * max(sunk, 0.0)));
    float s = clamp(across / half_width, -1.0, 1.0);
    float shade = 0.72 + 0.38 * sqrt(1.0 - s * s);
    colour = vec4(base * shade, cover * (1.0 - veil));
}
