layout(location = 0) in vec3 position; // geometry axes [m]
layout(location = 1) in vec3 facing;
out vec3 world;
out vec3 normal;
out float keel_height;

uniform mat4 world_from_body;
uniform vec4 flip; // x: -1 mirrors in the plane z = y; z: scale of geometry y; unused

void main()
{
    vec3 place = position * vec3(1.0, flip.z, 1.0);
    world = (world_from_body * vec4(place, 1.0)).xyz;
    normal = mat3(world_from_body) * (facing * vec3(1.0, 1.0 / flip.z, 1.0));
    keel_height = position.z;
    vec3 drawn = world;
    if (flip.x < 0.0) drawn.z = 2.0 * flip.y - drawn.z;
    gl_Position = clip_from_world * vec4(drawn, 1.0);
}
