#include "formulas/sphere_path.fx.h"
#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/henyey_greenstein.fx.h"
#include "formulas/multiple_scattering.fx.h"
#include "shared/blob_instance.glsl"
#include "shared/light_slices.glsl"
#include "shared/scattered_light.glsl"
#include "shared/sky_light.glsl"
#include "shared/smooth_light.glsl"
#if FX_NETWORK
#include "formulas/network_cell.fx.h"
#include "field/field_glow.glsl"
#include "network/network_grid.glsl"
#include "network/network_gather.glsl"
#endif

// Light that each blob scatters to the eye and that changes little within it: of sky and ground, of lights at points, and of
// the sun what is scattered more than once. Of the sun's light that is scattered once it holds the optical depth towards the
// sun; fragments do the rest. FX_NETWORK 1: of blobs in illumination networks it is the light of the networks and of lights at points.
layout(local_size_x = 64) in;

// Three a blob. rgb [exposed]; w 1: it is that of a network
// xyz slope of it across a radius; w crowding: how often more light its place extinguishes than the blob alone does, >= 1. Blobs
// that lie in each other are drawn one after the other; by as much the first is seen too deep into
// xyz slope of the optical depth towards the sun across a radius; w this depth in the center
layout(std430, binding = 6) writeonly buffer BlobLights { vec4 blobLights[]; };
layout(std140, binding = 0) uniform BlobLightBlock
{
    ivec4 blobCount; // x; y [texel] of a block of moments along x; z number of networks
    vec4 viewAxis; // xyz in which the eye looks; w 1 orthographic
};

// Optical depth towards the sun of the blob alone.
float ownDepth(BlobInstance blob, vec3 fromCenter)
{
    float along = dot(fromCenter, lights[0].place.xyz);
    float across = length(fromCenter - along * lights[0].place.xyz);
    float radius = blob.centerRadius.w;
    return fxKernelOpticalDepth(blob.medium.x, radius, across, -along, 0.0, 2.0 * radius);
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
    vec3 mean = vec3(0.0), slope = vec3(0.0), shadeSlope = vec3(0.0), ownSlope = vec3(0.0);
    float shade = 0.0, isInNetwork = 0.0;
#if FX_NETWORK
    int network = networkAt(blob.lit.xyz, blobCount.z);
    isInNetwork = network < 0 ? 0.0 : 1.0;
#endif
    for (int i = 0; i < 4; ++i) {
        vec3 fromCenter = reach * kInvSqrt3 * kCorners[i];
        vec2 towardsSun = sunDepth(blob.lit.xyz + fromCenter);
#if FX_NETWORK
        vec3 source;
        if (network < 0)
            source = smoothLight(blob.lit.xyz + fromCenter, toEye, blob.scatter.rgb, blob.scatter.w, towardsSun);
        else
            source = lightInNetwork(network, blobCount.y, blob.lit.xyz + fromCenter, toEye, blob.scatter.rgb, blob.scatter.w);
#else
        vec3 source = smoothLight(blob.lit.xyz + fromCenter, toEye, blob.scatter.rgb, blob.scatter.w, towardsSun);
#endif
        mean += 0.25 * source;
        slope += kCorners[i] * (source.r + source.g + source.b);
        shade += 0.25 * towardsSun.x;
        shadeSlope += kCorners[i] * towardsSun.x;
        ownSlope += kCorners[i] * ownDepth(blob, fromCenter);
    }
    float total = mean.r + mean.g + mean.b;
    float extinguished = -dot(shadeSlope, lights[0].place.xyz), byBlob = -dot(ownSlope, lights[0].place.xyz);
    float crowding = byBlob > 0.0 ? clamp(extinguished / byBlob, 1.0, 1e4) : 1.0;
    blobLights[3 * index] = vec4(mean, isInNetwork);
    blobLights[3 * index + 1] = vec4(total > 0.0 ? 1.5 * kInvSqrt3 * slope / total : vec3(0.0), crowding);
    blobLights[3 * index + 2] = vec4(1.5 * kInvSqrt3 * shadeSlope, shade);
}
