#include "shared/view_block.glsl"
#include "shared/blob_instance.glsl"
#include "slabs/slab_balls.glsl"
#if FX_FIELD_DETAIL
#include "formulas/kernel_optical_depth.fx.h"
#include "field/field_blocks.glsl"
#include "field/field_detail.glsl"
struct BlobMaterial
{
    vec4 carried[2]; // as BlobMaterial of rendering/passes/blob_instance.h
};
layout(std430, binding = 4) readonly buffer Materials { BlobMaterial materials[]; };
#endif

// Balls to texels, with what of them is the same along all rays.
layout(local_size_x = 64) in;
layout(std430, binding = 6) readonly buffer BlobLights { vec4 blobLights[]; }; // pass.z a blob, see lights/blob_light.comp.glsl
layout(rgba32f, binding = 0) uniform writeonly image2D balls;
#if FX_BLOCKS
struct BlockRecord
{
    vec4 right, up, tile, detail; // as BlockRecord of rendering/blocks/block_walk.h
};
layout(std430, binding = 7) readonly buffer BlockRecords { BlockRecord blockRecords[]; };
#endif

void main()
{
    uint ball = gl_GlobalInvocationID.x;
    if (ball >= uint(pass.y))
        return;
    BlobInstance blob = blobs[ball];
    uint first = uint(pass.z) * ball;
    float away = length(blob.centerRadius.xyz);
    bool isThere = blob.centerRadius.w > 0.0 && away < 1e15;
    float radius = !isThere ? 1.0 : max(blob.centerRadius.w, pass.x * (rayOrigin.w > 0.5 ? 1.0 : away)); // a large texel must not lose small balls
    float detail = blob.medium.z * forward.w;
    if (rayOrigin.w < 0.5) // one sample of the detail stands for a whole path: from inside it would darken all at once
        detail *= smoothstep(0.3, 1.3, away / blob.centerRadius.w);
    float depth = 1.11408460164327 * (isThere ? max(blob.medium.x, 0.0) : 0.0) / (radius * radius); // kernel-optical-depth (3)
#if FX_FIELD_DETAIL
    vec4 carried0 = materials[ball].carried[0];
    float texel = carried0.w > 0.5 ? float(kDetailTexels) * (carried0.w - 1.0) : -1.0;
    vec3 erosion = fieldTexel(int(max(texel, 0.0)) + kErosionTexel).xyz;
    float lumpDepth = fxKernelPeak(isThere ? max(blob.medium.x, 0.0) : 0.0, radius) * erosion.x;
#if FX_BLOCKS
    lumpDepth *= blob.layer.z > 0.5 ? blockRecords[max(int(blob.layer.z) - 1, 0)].detail.x : 1.0; // of the balls in it
#endif
    float thinning = texel < 0.0 ? 0.0 : fxDetailThinning(lumpDepth, erosion.y, erosion.z);
    detail = texel < 0.0 ? detail : 0.0; // of the field instead
    imageStore(balls, ballTexel(ball, kCarried0), vec4(carried0.xyz, texel + 1.0));
    imageStore(balls, ballTexel(ball, kCarried1), vec4(materials[ball].carried[1].xyz, thinning));
#endif
    imageStore(balls, ballTexel(ball, kPlace), vec4(isThere ? blob.centerRadius.xyz : vec3(0.0), radius));
    imageStore(balls, ballTexel(ball, kMedium), vec4(depth, blob.centerRadius.w, blob.layer.x, detail));
    imageStore(balls, ballTexel(ball, kEmitted), blob.emission);
    imageStore(balls, ballTexel(ball, kScatter), blob.scatter);
    imageStore(balls, ballTexel(ball, kLight), blobLights[first]);
    imageStore(balls, ballTexel(ball, kSlope), vec4(blobLights[first + 1u].xyz / max(blob.centerRadius.w, 1e-20), 0.0));
    float periods = blob.lit.w < 0.0 ? -1.0 - blob.lit.w : blob.lit.w;
    imageStore(balls, ballTexel(ball, kDetail), vec4(blob.medium.w, periods, 0.0, 0.0));
#if FX_BLOCKS
    if (blob.layer.z > 0.5) {
        BlockRecord block = blockRecords[int(blob.layer.z) - 1];
        float wider = blob.centerRadius.w / radius;
        imageStore(balls, ballTexel(ball, kMedium), vec4(isThere ? blob.medium.x * block.up.w * wider * wider : 0.0, radius, blob.layer.x, -1.0));
        imageStore(balls, ballTexel(ball, kTile), block.tile);
        imageStore(balls, ballTexel(ball, kTileRight), vec4(block.right.xyz, 0.0));
        imageStore(balls, ballTexel(ball, kTileUp), vec4(block.up.xyz, block.right.w));
    }
#endif
}
