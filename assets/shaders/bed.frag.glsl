in vec2 place;
out vec4 colour;

void main()
{
    vec2 cells = place / bed_colour.w;
    vec2 width = max(fwidth(cells), vec2(1e-6));
    vec2 near = abs(fract(cells - 0.5) - 0.5) / width;
    vec2 lines = (1.0 - smoothstep(0.2, 1.3, near)) * (1.0 - smoothstep(0.15, 0.5, width));
    vec2 centre = 0.5 * (box_min.xy + box_max.xy), reach = 0.5 * (box_max.xy - box_min.xy);
    float outside = length(max(abs(place - centre) - reach, 0.0));
    vec3 base = mix(bed_colour.rgb, grid_colour.rgb, max(lines.x, lines.y) * grid_colour.w);
    base *= 1.0 - 0.16 * exp(-outside / (0.06 * range.z));
    float fog = smoothstep(0.0, 2.2, outside / range.z);
    colour = vec4(mix(base, backdrop_low.rgb, fog), 1.0);
}
