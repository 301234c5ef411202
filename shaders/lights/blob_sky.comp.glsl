#include "shared/blob_instance.glsl"
#include "shared/light_block.glsl"

// Light of sky and ground that each blob scatters. Both reach a point through the media along the axes of the sky; what
// does not escape along them is scattered again: with p the mean transmittance, and b the mean of what arrives, the source
// is albedo b / (1 - albedo (1 - p)), which is the luminance of the sky where albedo and all luminances are equal to it.
layout(local_size_x = 64) in;
layout(std430, binding = 6) writeonly buffer BlobSkies { vec4 blobSkies[]; }; // rgb [exposed]; xyz slope across a radius
layout(std140, binding = 0) uniform SkyBlock
{
    ivec4 blobCount;
    FX_LIGHT_MEMBERS
};
#include "shared/light_slices.glsl"

vec3 skySource(vec3 p, vec3 albedo)
{
    float escaping = 0.0;
    vec3 arriving = vec3(0.0);
    for (int i = lightCounts.x; i < lightCounts.x + lightCounts.y; ++i) {
        vec2 depth = parallelDepth(lights[i], p);
        float above = exp(-depth.x);
        float below = exp(-max(depth.y - depth.x, 0.0));
        escaping += above + below;
        arriving += above * lightOfSky.rgb + below * lightOfGround.rgb;
    }
    float weight = 0.5 / float(lightCounts.y);
    float again = lightOfSky.w > 0.5 ? 1.0 - weight * escaping : 0.0;
    return weight * arriving * albedo / max(1.0 - albedo * again, 1e-4);
}

void main()
{
    int index = int(gl_GlobalInvocationID.x);
    if (index >= blobCount.x)
        return;
    BlobInstance blob = blobs[index];
    vec3 albedo = blob.scatter.rgb;
    // the corners of a tetrahedron, half a radius from the center: their mean, and the slope that they follow
    const vec3 kCorners[4] = vec3[4](vec3(1, 1, 1), vec3(1, -1, -1), vec3(-1, 1, -1), vec3(-1, -1, 1));
    const float kInvSqrt3 = 0.57735027;
    float reach = blob.lit.w < 0.0 ? 0.0 : 0.5 * blob.centerRadius.w;
    vec3 mean = vec3(0.0), slope = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 source = skySource(blob.lit.xyz + reach * kInvSqrt3 * kCorners[i], albedo);
        mean += 0.25 * source;
        slope += kCorners[i] * (source.r + source.g + source.b);
    }
    float total = mean.r + mean.g + mean.b;
    blobSkies[2 * index] = vec4(mean, 0.0);
    blobSkies[2 * index + 1] = vec4(total > 0.0 ? 1.5 * kInvSqrt3 * slope / total : vec3(0.0), 0.0);
}
