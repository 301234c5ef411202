// The lights of a view. Filled by rendering/lights/slices/light_list.cpp; LightListBlock has this layout. The first light is parallel, the sun; without sun its color is 0. The others are points.
struct SliceLight
{
    vec4 right; // parallel light: texel x = dot(right.xyz, p) + right.w
    vec4 up;    // texel y likewise
    vec4 along; // plane likewise; of a point: w planes per metre of distance, x what is taken from it, y radius of the shadowless ball around it [m]
    vec4 tiles; // xy texel of the first plane in the atlas; z texels along a side; w planes, 0: media cast no shadow
    vec4 color; // rgb exposed illuminance of parallel light, exposed intensity of a point; w 0 parallel, 1 point, 2 point that stands for glowing medium
    vec4 place; // xyz unit vector towards parallel light, or the point [m] relative to the eye; w its radius [m], or that of the ball of finer planes
    vec4 cone;  // share of a spot: smooth step of dot(direction of the light, xyz) + w from 0 to 1
};

layout(std140, binding = 1) uniform Lights
{
    ivec4 lightCounts;  // x lights; y axes of the sky after them; z points of a ray through a ball
    vec4 lightOfSky;    // rgb exposed luminance from above; w 1: light that is scattered again counts
    vec4 lightOfGround; // rgb exposed luminance from below
    vec4 hostShadowRows[3]; // texture coordinates and depth of p in the host's shadow map: dot(row.xyz, p) + row.w
    vec4 hostShadowEdge;    // xy radius of the soft edge in texture coordinates; z 1 nearer is smaller, -1 larger, 0 no map
    SliceLight lights[42]; // the second half: planes of the first half as they were, color.r what they still count
};
