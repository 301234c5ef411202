#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/voxel_kernel.fx.h"
#include "shared/blob_instance.glsl"
#include "field/field_blocks.glsl"
#include "field/field_ball.glsl"
#include "field/field_seen.glsl"

// Sums the balls of each brick at its samples, in the order of its list: one workgroup a brick. What is added to a field
// besides is one more image and one more sum here. FX_LAYERS 1 also keeps what the light is sorted by. One invocation has all
// samples along z, so that a ball is read once for all of them.
layout(local_size_x = 81) in;
const float kMostCosine = 0.95; // mean cosine of balls of any preset; quotients at rims, where extinctions nearly cancel, may be anything
layout(std430, binding = 2) readonly buffer Bricks { FieldBrick bricks[]; };
layout(std430, binding = 3) readonly buffer BrickBalls { uint brickBalls[]; };
layout(rgba32f, binding = 0) uniform writeonly image3D medium;  // rgb emitted light [exposed/m]; a extinction [1/m]
layout(rgba16f, binding = 1) uniform writeonly image3D scatter; // rgb mean albedo; a mean cosine of the phase function
#if FX_LAYERS
layout(rgba16f, binding = 2) uniform writeonly image3D shares; // see field_sample.glsl
#endif
#if FX_DETAIL
// Coordinates of two generations times extinction over the field's largest; a of the first: see field_detail.glsl
layout(rgba16f, binding = 3) uniform writeonly image3D material0;
layout(rgba16f, binding = 4) uniform writeonly image3D material1; // a thinning, likewise
layout(r32f, binding = 6) uniform writeonly image3D change;      // of the extinction by detail, likewise
#include "field/field_detail.glsl"
struct BlobMaterial
{
    vec4 carried[2]; // xyz [cell]
};
layout(std430, binding = 4) readonly buffer Materials { BlobMaterial materials[]; };
#endif

void main()
{
    FieldBrick brick = bricks[gl_WorkGroupID.x];
    VoxelField field = fieldOf(int(brick.field));
    if (field.limits.x < 0.0)
        return; // field_volume.comp.glsl fills it
    ivec3 first = sampleOfBrick(int(gl_LocalInvocationIndex));
    vec3 places[kBrickSamples];
    vec4 mediumSums[kBrickSamples], scatterSums[kBrickSamples];
#if FX_LAYERS
    vec4 shareSums[kBrickSamples];
#endif
#if FX_DETAIL
    vec3 carriedSums0[kBrickSamples], carriedSums1[kBrickSamples];
    vec3 powerSums[kBrickSamples]; // of light times its power of temperature; of light; of extinction times thinning
#endif
    for (int z = 0; z < kBrickSamples; ++z) {
        places[z] = placeOfSample(field, brick, first + ivec3(0, 0, z));
        mediumSums[z] = scatterSums[z] = vec4(0.0);
#if FX_LAYERS
        shareSums[z] = vec4(0.0);
#endif
#if FX_DETAIL
        carriedSums0[z] = carriedSums1[z] = vec3(0.0);
        powerSums[z] = vec3(0.0);
#endif
    }
#if FX_DETAIL
    bool isDetailed = field.limits.z > 0.5;
    FieldDetail numbers = fieldDetail(int(isDetailed ? field.limits.z : 0.0));
#endif
    clearSeen();
    barrier();
    for (uint k = brick.first; k < brick.first + brick.count; ++k) {
        uint number = brickBalls[k];
        FieldBall ball = fieldBall(field, number);
#if FX_DETAIL
        vec3 carried0 = materials[number].carried[0].xyz, carried1 = materials[number].carried[1].xyz;
        float power = blobs[number].emission.w, bright = ball.emitted.r + ball.emitted.g + ball.emitted.b;
        float thinning = isDetailed ? fxDetailThinning(ball.peak * numbers.erosion.x, numbers.erosion.y, numbers.erosion.z) : 0.0;
#endif
        for (int z = 0; z < kBrickSamples; ++z) {
            float extinction = extinctionAt(ball, places[z]);
            mediumSums[z] += extinction * ball.emitted;
            scatterSums[z] += extinction * ball.scattering;
#if FX_LAYERS
            shareSums[z] += extinction * ball.share;
#endif
#if FX_DETAIL
            carriedSums0[z] += extinction * carried0;
            carriedSums1[z] += extinction * carried1;
            powerSums[z] += vec3(max(extinction, 0.0) * bright * vec2(power, 1.0), extinction * thinning);
#endif
        }
    }
    vec2 largest = vec2(0.0); // below and above the middle, in which samples are in both
    for (int z = 0; z < kBrickSamples; ++z) {
        float seen = abs(mediumSums[z].a);
#if FX_DETAIL
        // what is thinner than detail leaves of anything is not seen
        float place = detailPlace(numbers.erosion, numbers.soft, seen, powerSums[z].z / max(mediumSums[z].a, 1e-20)).s;
        seen = isDetailed && (mediumSums[z].a <= 0.0 || place <= 0.0) ? 0.0 : seen;
#endif
        largest = max(largest, seen * vec2(z <= kBrickCells / 2, z >= kBrickCells / 2));
    }
    addSeen(first, largest);
    ivec3 texel = brickTexel(int(gl_WorkGroupID.x)) + first;
    for (int z = 0; z < kBrickSamples; ++z) {
        float extinction = mediumSums[z].a; // below 0 at rims, see voxel-kernel
        vec4 mean = scatterSums[z] / (extinction < 0.0 ? min(extinction, -1e-20) : max(extinction, 1e-20));
        imageStore(medium, texel + ivec3(0, 0, z), mediumSums[z]);
        imageStore(scatter, texel + ivec3(0, 0, z), clamp(mean, vec4(vec3(0.0), -kMostCosine), vec4(vec3(1.0), kMostCosine)));
#if FX_LAYERS
        imageStore(shares, texel + ivec3(0, 0, z), shareSums[z] / field.limits.y);
#endif
#if FX_DETAIL
        float held = 1.0 / field.limits.y;
        float changed = 0.0; // between samples, for light
        int detailed = isDetailed && extinction > 0.0 ? 1 : 0;
        if (detailed > 0) {
            DetailPlace place = detailPlace(numbers.erosion, numbers.soft, extinction, powerSums[z].z / extinction);
            MediumDetail detail = detailOf(numbers, place, places[z], carriedSums0[z] / extinction, carriedSums1[z] / extinction,
                                           kPixelOfCube * field.corner.w, false);
            changed = (detail.share - 1.0) * extinction * held;
        }
        imageStore(material0, texel + ivec3(0, 0, z), vec4(carriedSums0[z] * held, powerSums[z].x / max(powerSums[z].y, 1e-30)));
        imageStore(material1, texel + ivec3(0, 0, z), vec4(carriedSums1[z] * held, powerSums[z].z * held));
        imageStore(change, texel + ivec3(0, 0, z), vec4(changed));
#endif
    }
    barrier();
    storeSeen(field, brick, int(gl_WorkGroupID.x));
}
