// The lights of a view, and the optical depth of all media between them and a point. Filled by
// rendering/lights/slices/light_list.cpp.
struct SliceLight
{
    vec4 right; // parallel light: texel x = dot(right.xyz, p) + right.w
    vec4 up;    // texel y likewise
    vec4 along; // plane likewise; of a point: w planes per metre of distance, x what is taken from it
    vec4 tiles; // xy texel of the first plane in the atlas; z texels along a side; w planes, 0: media cast no shadow
    vec4 color; // rgb exposed illuminance of parallel light, exposed intensity of a point; w 0 parallel, 1 point
    vec4 place; // xyz unit vector towards parallel light, or the point [m] relative to the eye; w its radius [m]
    vec4 cone;  // share of a spot: clamp(dot(direction of the light, xyz) + w, 0, 1)
};
layout(std430, binding = 5) readonly buffer Lights
{
    ivec4 lightCounts; // x lights; y axes of the sky after them; z points of a ray through a ball
    vec4 lightOfSky;   // rgb exposed luminance from above; w 1: light that is scattered again counts
    vec4 lightOfGround;
    SliceLight lights[];
};
layout(binding = 7) uniform sampler2D lightSlices; // optical depth

const int kSliceTileColumns = 8;

vec2 octahedralPlace(vec3 d)
{
    vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
    if (d.z < 0.0)
        p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return p;
}

float slicePlane(vec4 tiles, int plane, vec2 texel)
{
    vec2 tile = tiles.xy + tiles.z * vec2(plane % kSliceTileColumns, plane / kSliceTileColumns);
    return textureLod(lightSlices, (tile + texel) / vec2(textureSize(lightSlices, 0)), 0.0).r;
}

// x: optical depth between the light and p [m, relative to the eye]; y: of all media on the line through both.
vec2 sliceDepth(SliceLight light, vec3 p)
{
    if (light.tiles.w < 0.5)
        return vec2(0.0);
    vec2 texel;
    float plane;
    if (light.color.w < 0.5) {
        texel = vec2(dot(light.right.xyz, p) + light.right.w, dot(light.up.xyz, p) + light.up.w);
        plane = dot(light.along.xyz, p) + light.along.w;
    } else {
        vec3 d = p - light.place.xyz;
        float l = length(d);
        texel = 1.0 + (0.5 + 0.5 * octahedralPlace(l > 0.0 ? d / l : vec3(0.0, 0.0, 1.0))) * (light.tiles.z - 2.0);
        plane = l * light.along.w - light.along.x;
    }
    texel = clamp(texel, vec2(0.5), vec2(light.tiles.z - 0.5));
    int last = int(light.tiles.w) - 1;
    plane = clamp(plane, 0.0, float(last));
    int lower = min(int(plane), last - 1);
    float before = slicePlane(light.tiles, lower, texel);
    float behind = slicePlane(light.tiles, lower + 1, texel);
    float total = lower + 1 == last ? behind : slicePlane(light.tiles, last, texel);
    return vec2(mix(before, behind, plane - float(lower)), total);
}

// Exposed illuminance of a light at p before media, and the unit vector towards it.
vec3 unshadowedLight(SliceLight light, vec3 p, out vec3 towards)
{
    towards = light.place.xyz;
    if (light.color.w < 0.5)
        return light.color.rgb;
    vec3 d = light.place.xyz - p;
    float l2 = dot(d, d);
    towards = l2 > 0.0 ? d * inversesqrt(l2) : vec3(0.0, 1.0, 0.0);
    float share = clamp(light.cone.w - dot(towards, light.cone.xyz), 0.0, 1.0);
    return light.color.rgb * (share / max(l2 + light.place.w * light.place.w, 1e-12));
}
