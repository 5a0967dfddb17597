// A disc shaded as a sphere; its depth stays that of the disc, because writing depths costs more
// than all the rest on a processor.
in vec3 shade;
out vec4 colour;

void main()
{
    vec2 at = gl_PointCoord * 2.0 - 1.0;
    float square = dot(at, at);
    if (square > 1.0) discard;
    float bulge = sqrt(1.0 - square);
    vec3 n = vec3(at.x, -at.y, bulge);
    float diffuse = max(dot(n, vec3(-0.42, 0.60, 0.68)), 0.0);
    colour = vec4(shade * (0.50 + 0.55 * diffuse) + 0.12 * pow(diffuse, 24.0), 1.0);
}
