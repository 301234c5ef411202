#include "shared/view_block.glsl"
#include "shared/blob_instance.glsl"
#include "shared/blob_quad.glsl"

// One covering rectangle a blob; the fragment gets the blob unchanged.
flat out vec4 blobCenterRadius;
flat out vec4 blobMedium;
flat out vec4 blobScatter;
flat out vec4 blobLight; // rgb light that changes little within the blob; w layer * 2 + share of fire
flat out vec4 blobSlope; // xyz relative change of it across a radius; w see crowding in lights/blob_light.comp.glsl
flat out vec4 blobShade; // optical depth towards the sun: xyz its change across a radius, w in the center
flat out vec4 blobLit;
flat out vec4 blobEmission;
flat out mat3 blobDetailAxes; // noise periods along each axis, turned by the seed so that no two blobs share a lattice

layout(std430, binding = 6) readonly buffer BlobLights { vec4 blobLights[]; }; // three a blob, see lights/blob_light.comp.glsl

mat3 detailAxes(float seed, float periods)
{
    float a = 6.2831853 * fract(seed * 7.31);
    float b = 6.2831853 * fract(seed * 23.17);
    mat3 aroundY = mat3(cos(a), 0.0, -sin(a), 0.0, 1.0, 0.0, sin(a), 0.0, cos(a));
    mat3 aroundX = mat3(1.0, 0.0, 0.0, 0.0, cos(b), sin(b), 0.0, -sin(b), cos(b));
    return periods * (aroundX * aroundY);
}

void main()
{
    int index = gl_InstanceID + gl_VertexID / 6 + int(pass.y); // a draw may begin in the middle of the order
    BlobInstance blob = blobs[index];
#if FX_SMALL
    float depthOfTexel = rayOrigin.w > 0.5 ? 1.0 : length(blob.centerRadius.xyz);
    blob.centerRadius.w = max(blob.centerRadius.w, pass.x * depthOfTexel); // a large texel must not lose small blobs
#endif
    blobCenterRadius = blob.centerRadius;
    blobMedium = blob.medium;
    if (rayOrigin.w < 0.5) // one sample of the detail stands for a whole path: from inside it would darken all at once
        blobMedium.z *= smoothstep(0.3, 1.3, length(blob.centerRadius.xyz) / blob.centerRadius.w);
    blobScatter = blob.scatter;
    blobLight = vec4(0.0, 0.0, 0.0, blob.layer.x);
    blobSlope = vec4(0.0, 0.0, 0.0, 1.0);
    blobShade = vec4(0.0);
#ifdef FX_LAYERS // what is only counted needs no light
    blobLight.rgb = blobLights[3 * index].rgb;
    blobSlope = blobLights[3 * index + 1];
    blobShade = blobLights[3 * index + 2];
#endif
    blobLit = blob.lit;
    blobEmission = blob.emission;
    blobDetailAxes = detailAxes(blob.medium.w, blob.lit.w < 0.0 ? -1.0 - blob.lit.w : blob.lit.w);
    gl_Position = blobQuadCorner(blob.centerRadius.xyz, blob.centerRadius.w, gl_VertexID % 6);
}
