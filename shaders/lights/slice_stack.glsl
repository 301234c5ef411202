// Where the planes of a light lie. Layout of SliceStackBlock in rendering/lights/slices/light_list.h.
struct SliceStack
{
    vec4 origin; // xyz [m] corner of the first plane, or the light's place; w distance of two planes [m]
    vec4 right;  // xyz [m] one texel to the right; w 0 flat planes, 1 shells around `origin`
    vec4 up;     // xyz [m] one texel up; w distance of the first shell from `origin` [m]
    vec4 along;  // xyz direction in which parallel light goes; w distance from a point up to which media do not count [m]
    vec4 tiles;  // xy texel of the first plane in the atlas; z texels along a side; w planes
};

const int kTileColumns = 8; // of planes in the atlas

// Inverse of the octahedral map; places a little outside of [-1, 1]^2 fold back to where the map goes on.
vec3 octahedralDirection(vec2 p)
{
    if (abs(p.x) > 1.0)
        p = vec2((p.x > 0.0 ? 2.0 : -2.0) - p.x, -p.y);
    if (abs(p.y) > 1.0)
        p = vec2(-p.x, (p.y > 0.0 ? 2.0 : -2.0) - p.y);
    vec3 d = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (d.z < 0.0)
        d.xy = vec2((1.0 - abs(p.y)) * (p.x >= 0.0 ? 1.0 : -1.0), (1.0 - abs(p.x)) * (p.y >= 0.0 ? 1.0 : -1.0));
    return normalize(d);
}

void rayOf(SliceStack stack, vec2 texel, out vec3 start, out vec3 direction)
{
    start = stack.origin.xyz;
    if (stack.right.w < 0.5) {
        start += texel.x * stack.right.xyz + texel.y * stack.up.xyz;
        direction = stack.along.xyz;
    } else {
        direction = octahedralDirection(2.0 * (texel - 1.0) / (stack.tiles.z - 2.0) - 1.0);
    }
}
