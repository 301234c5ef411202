#include "shared/blob_instance.glsl"
#include "shared/light_slices.glsl"
#include "shared/sky_light.glsl"

// Light of sky and ground that each blob scatters.
layout(local_size_x = 64) in;
layout(std430, binding = 6) writeonly buffer BlobSkies { vec4 blobSkies[]; }; // rgb [exposed]; xyz slope across a radius
layout(std140, binding = 0) uniform SkyBlock { ivec4 blobCount; };

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
