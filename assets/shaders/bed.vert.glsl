out vec2 place;

void main()
{
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    vec2 centre = 0.5 * (box_min.xy + box_max.xy);
    place = centre + corner * 5.0 * range.z;
    gl_Position = clip_from_world * vec4(place, box_min.z, 1.0);
}
