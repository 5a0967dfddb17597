layout(location = 0) in vec4 position; // w: 1 where there is water
layout(location = 1) in vec4 facing;   // outward normal; w: field value
layout(location = 2) in float depth;   // below the surface on a side wall [m]; -1 on the surface
out vec3 world;
out vec3 normal;
out float value;
out float below;
out float wet;

void main()
{
    world = position.xyz;
    wet = position.w;
    normal = facing.xyz;
    value = facing.w;
    below = depth;
    gl_Position = clip_from_world * vec4(world, 1.0);
}
