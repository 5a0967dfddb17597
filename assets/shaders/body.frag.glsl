in vec3 world;
in vec3 normal;
in float keel_height;
out vec4 colour;

uniform vec4 flip;
uniform vec4 paint;    // rgb above water; w: height of the still waterline in geometry axes [m]
uniform vec4 anti;     // rgb of the bottom paint; w: width of the boot top [m], 0 = one paint

void main()
{
    if (flip.x < 0.0 && world.z < flip.y - 0.01 * range.z) discard;
    vec3 n = normalize(normal);
    vec3 ray = normalize(world - eye.xyz);
    if (dot(n, ray) > 0.0) n = -n;
    vec3 base = paint.rgb;
    if (anti.w > 0.0) {
        float at = keel_height - paint.w;
        float soft = max(fwidth(at), 1e-5);
        float deck = smoothstep(0.75, 0.9, n.z) * step(anti.w, at);
        base = mix(base, mix(base, vec3(0.62, 0.60, 0.56), 0.75), deck);
        base = mix(vec3(0.93, 0.93, 0.91), base, smoothstep(-soft, soft, at - anti.w));
        base = mix(anti.rgb, base, smoothstep(-soft, soft, at - 0.45 * anti.w));
    }
    float diffuse = max(dot(n, light.xyz), 0.0);
    float hemisphere = 0.5 + 0.5 * n.z;
    float head = clamp(-dot(n, ray), 0.0, 1.0);
    vec3 lit = base * (0.30 + 0.22 * hemisphere + 0.48 * diffuse + 0.10 * head);
    float shine = pow(max(dot(reflect(ray, n), light.xyz), 0.0), 28.0);
    float rim = pow(1.0 - head, 3.0) * (0.4 + 0.6 * max(n.z, 0.0));
    colour = vec4(lit + 0.16 * shine + 0.14 * rim * sky_horizon.rgb, 1.0);
}
