#include "shimmer/shimmer_block.glsl"

// The picture seen through hot gas: each pixel is fetched where the gas bends its ray to.
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D sceneDistance; // [m] along the ray, +inf for none
layout(binding = 2) uniform sampler2D heat;          // as heat_shimmer_offset.frag.glsl writes it
layout(location = 0) out vec4 color;

bool isFinite(vec4 v)
{
    uvec4 exponent = floatBitsToUint(v) & 0x7F800000u;
    return all(notEqual(exponent, uvec4(0x7F800000u)));
}

// Displacement [pixel]: only what lies behind the gas moves, at most shimmer.y, less towards the border.
vec2 offsetAt(ivec2 at, ivec2 last, vec4 sum, float gas)
{
    float scene = texelFetch(sceneDistance, at, 0).r;
    float lever = clamp(1.0 - gas / scene, 0.0, 1.0);
    vec2 offset = sum.xy * (shimmer.x * lever * inversesqrt(max(sum.z, 1.0))); // n overlapping blobs bend as one
    ivec2 inside = min(at, last - at);
    float fade = min(float(min(inside.x, inside.y)) / shimmer.y, 1.0);
    return offset * (fade * min(1.0, shimmer.y / max(length(offset), 1e-20)));
}

bool isBehind(ivec2 at, float gas)
{
    return texelFetch(sceneDistance, at, 0).r >= gas;
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(picture, 0) - 1;
    color = texelFetch(picture, at, 0);
    vec4 sum = texelFetch(heat, at, 0);
    if (!(sum.z > 0.0) || !isFinite(sum))
        return;
    float gas = sum.w / sum.z;
    vec2 offset = offsetAt(at, last, sum, gas);
    if (offset == vec2(0.0))
        return;

    vec2 source = clamp(vec2(at) + offset, vec2(0.0), vec2(last));
    vec2 corner = floor(source);
    vec2 f = source - corner;
    ivec2 low = ivec2(corner);
    ivec2 high = low + ivec2(greaterThan(f, vec2(0.0))); // texels without weight are not read
    ivec2 right = ivec2(high.x, low.y);
    ivec2 above = ivec2(low.x, high.y);
    if (!isBehind(low, gas) || !isBehind(right, gas) || !isBehind(above, gas) || !isBehind(high, gas))
        return; // what stands before the gas must not bleed

    vec4 v00 = texelFetch(picture, low, 0);
    vec4 v01 = texelFetch(picture, above, 0);
    precise vec4 v0 = v00 + f.x * (texelFetch(picture, right, 0) - v00); // equal neighbors give their value exactly
    precise vec4 v1 = v01 + f.x * (texelFetch(picture, high, 0) - v01);
    precise vec4 v = v0 + f.y * (v1 - v0);
    if (isFinite(v)) // a broken texel does not spread
        color = v;
}
