#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/voxel_kernel.fx.h"
#include "shared/blob_instance.glsl"
#include "field/field_blocks.glsl"
#include "field/field_ball.glsl"

// Takes shares of balls near the eye out of the samples of the bricks that they touch: one workgroup a brick, one invocation
// all samples along z, as in field_fill.comp.glsl. FX_DETAIL 1: of fields with detail, after they were lit; 0: of those without,
// before.
layout(local_size_x = 81) in;
layout(std430, binding = 2) readonly buffer Bricks { FieldBrick bricks[]; };
struct NearBrick
{
    uint brick; // number
    uint first, count; // of its balls in `nearParts`
    uint unused;
};
struct NearPart
{
    uint number; // of the ball
    float share;
};
layout(std430, binding = 3) readonly buffer NearBricks { NearBrick nearBricks[]; };
layout(std430, binding = 4) readonly buffer NearParts { NearPart nearParts[]; };
layout(rgba32f, binding = 0) uniform image3D medium;
#if !FX_DETAIL
layout(rgba16f, binding = 1) uniform image3D scatter;
#endif
#if FX_LAYERS
layout(rgba16f, binding = 2) uniform image3D shares;
#endif

const float kRounding = 1e-5; // of an extinction: less is nothing that is left

void main()
{
    NearBrick near = nearBricks[gl_WorkGroupID.x];
    FieldBrick brick = bricks[near.brick];
    VoxelField field = fieldOf(int(brick.field));
    if ((field.limits.z > 0.5) != (FX_DETAIL > 0))
        return;
    ivec3 first = sampleOfBrick(int(gl_LocalInvocationIndex));
    vec3 places[kBrickSamples];
    vec4 mediumSums[kBrickSamples], scatterSums[kBrickSamples];
    float sizes[kBrickSamples]; // [1/m] sum of what is added, regardless of its sign
#if FX_LAYERS
    vec4 shareSums[kBrickSamples];
#endif
    for (int z = 0; z < kBrickSamples; ++z) {
        places[z] = placeOfSample(field, brick, first + ivec3(0, 0, z));
        mediumSums[z] = scatterSums[z] = vec4(0.0);
        sizes[z] = 0.0;
#if FX_LAYERS
        shareSums[z] = vec4(0.0);
#endif
    }
    for (uint k = near.first; k < near.first + near.count; ++k) {
        FieldBall ball = fieldBall(field, nearParts[k].number);
        float share = nearParts[k].share;
        for (int z = 0; z < kBrickSamples; ++z) {
            float extinction = share * extinctionAt(ball, places[z]);
            mediumSums[z] += extinction * ball.emitted;
            scatterSums[z] += extinction * ball.scattering;
            sizes[z] += abs(extinction);
#if FX_LAYERS
            shareSums[z] += extinction * ball.share;
#endif
        }
    }
    ivec3 texel = brickTexel(int(near.brick)) + first;
    for (int z = 0; z < kBrickSamples; ++z) {
        ivec3 at = texel + ivec3(0, 0, z);
        vec4 all = imageLoad(medium, at);
        vec4 rest = all - mediumSums[z];
        bool isLeft = abs(rest.a) > kRounding * sizes[z];
        imageStore(medium, at, isLeft ? rest : vec4(0.0));
#if !FX_DETAIL
        vec4 mean = (imageLoad(scatter, at) * all.a - scatterSums[z]) / (rest.a < 0.0 ? min(rest.a, -1e-20) : max(rest.a, 1e-20));
        imageStore(scatter, at, clamp(mean, vec4(vec3(0.0), -1.0), vec4(1.0)));
#endif
#if FX_LAYERS
        vec4 kept = imageLoad(shares, at) - shareSums[z] / field.limits.y;
        imageStore(shares, at, isLeft ? kept : vec4(0.0));
#endif
    }
}
