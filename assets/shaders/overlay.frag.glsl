// Signed-distance text with a soft halo; a negative atlas coordinate means a plain area.
in vec2 glyph;
in vec4 paint;
out vec4 colour;

uniform sampler2D atlas;
uniform vec4 halo;

void main()
{
    if (glyph.x < 0.0) {
        colour = paint;
        return;
    }
    float distance = texture(atlas, glyph).r - 0.5;
    float soft = max(fwidth(distance), 1e-4) * 0.7;
    float ink = smoothstep(-soft, soft, distance);
    float glow = smoothstep(-0.38, 0.0, distance) * halo.a;
    float alpha = max(ink, glow);
    colour = vec4(mix(halo.rgb, paint.rgb, ink), alpha * paint.a);
}
