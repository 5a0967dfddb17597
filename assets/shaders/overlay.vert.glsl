layout(location = 0) in vec4 place;  // xy from the top left [pixel]; zw in the font atlas
layout(location = 1) in vec4 tint;
out vec2 glyph;
out vec4 paint;

void main()
{
    glyph = place.zw;
    paint = tint;
    gl_Position = vec4(place.x * target.z * 2.0 - 1.0, 1.0 - place.y * target.w * 2.0, 0.0, 1.0);
}
