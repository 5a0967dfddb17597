in vec3 ray;
out vec4 colour;

void main()
{
    float height = normalize(ray).z;
    colour = vec4(mix(backdrop_low.rgb, backdrop_top.rgb, smoothstep(-0.05, 0.55, height)), 1.0);
}
