#include "formulas/henyey_greenstein.fx.h"
#include "formulas/multiple_scattering.fx.h"
#include "shared/blob_instance.glsl"
#include "shared/light_slices.glsl"
#include "shared/scattered_light.glsl"
#include "shared/sky_light.glsl"

// Light that each blob scatters to the eye and that changes little within it: of sky and ground, of lights at points, and of
// the sun what is scattered more than once. Fragments add the sun's light that is scattered once; without points of a ray
// (lightCounts.z) it is here as well.
layout(local_size_x = 64) in;
layout(std430, binding = 6) writeonly buffer BlobLights { vec4 blobLights[]; }; // rgb [exposed]; xyz slope across a radius
layout(std140, binding = 0) uniform BlobLightBlock
{
    ivec4 blobCount;
    vec4 viewAxis; // xyz in which the eye looks; w 1 orthographic
};

vec3 smoothLight(vec3 p, vec3 toEye, vec3 albedo, float g)
{
    vec3 sum = skySource(p, albedo) + scatteredOfPoints(p, toEye, albedo, g);
    if (lightOfSky.w > 0.5)
        sum += sunScatteredAgain(p, toEye, albedo, g);
    if (lightCounts.z == 0)
        sum += sunScatteredOnce(p, toEye, albedo, g);
    return sum;
}

void main()
{
    int index = int(gl_GlobalInvocationID.x);
    if (index >= blobCount.x)
        return;
    BlobInstance blob = blobs[index];
    vec3 toEye = viewAxis.w > 0.5 ? -viewAxis.xyz : -blob.lit.xyz / max(length(blob.lit.xyz), 1e-20);
    // the corners of a tetrahedron, half a radius from the center: their mean, and the slope that they follow
    const vec3 kCorners[4] = vec3[4](vec3(1, 1, 1), vec3(1, -1, -1), vec3(-1, 1, -1), vec3(-1, -1, 1));
    const float kInvSqrt3 = 0.57735027;
    float reach = blob.lit.w < 0.0 ? 0.0 : 0.5 * blob.centerRadius.w;
    vec3 mean = vec3(0.0), slope = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 source = smoothLight(blob.lit.xyz + reach * kInvSqrt3 * kCorners[i], toEye, blob.scatter.rgb, blob.scatter.w);
        mean += 0.25 * source;
        slope += kCorners[i] * (source.r + source.g + source.b);
    }
    float total = mean.r + mean.g + mean.b;
    blobLights[2 * index] = vec4(mean, 0.0);
    blobLights[2 * index + 1] = vec4(total > 0.0 ? 1.5 * kInvSqrt3 * slope / total : vec3(0.0), 0.0);
}
