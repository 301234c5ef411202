#if FX_DETAIL
#include "formulas/field_detail.fx.h"
#endif
#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/volume_advection.fx.h"
#include "formulas/voxel_kernel.fx.h"
#include "shared/blob_instance.glsl"
#include "field/field_blocks.glsl"
#include "field/field_seen.glsl"

// Fills the bricks of a field from a volume on voxels: one workgroup a brick, one invocation for all samples along z. Samples at the
// centers of voxels have the values of these voxels; others are interpolated along each axis.
layout(local_size_x = 81) in;
layout(std430, binding = 2) readonly buffer Bricks { FieldBrick bricks[]; };
layout(std430, binding = 3) readonly buffer BrickBalls { uint brickBalls[]; };
layout(std430, binding = 4) readonly buffer VolumeIndex { uint volumeIndex[]; }; // brick at each place of the box, or kNoBrick
layout(binding = 0) uniform usampler3D volumeVoxels; // MediumVolume::packedWithVelocities(), see wordsOf()
#if FX_BETWEEN
layout(std430, binding = 5) readonly buffer SecondIndex { uint secondIndex[]; };
layout(binding = 1) uniform usampler3D secondVoxels;
#endif
layout(rgba32f, binding = 0) uniform writeonly image3D medium;  // rgb emitted light [exposed/m]; a extinction [1/m]
layout(rgba16f, binding = 1) uniform writeonly image3D scatter; // rgb mean albedo; a mean cosine of the phase function
#if FX_LAYERS
layout(rgba16f, binding = 2) uniform writeonly image3D shares; // see field_sample.glsl
#endif
#if FX_DETAIL
// As in field_fill.comp.glsl. Coordinates are fixed in the volume: nothing is added to them.
layout(rgba16f, binding = 3) uniform writeonly image3D material0;
layout(rgba16f, binding = 4) uniform writeonly image3D material1; // a thinning times extinction over the field's largest
const int kErosionTexel = 6; // as in field_detail.glsl
#endif
layout(r32f, binding = 6) uniform writeonly image3D change; // extinction less that of casters, over the field's largest
struct VolumeFrame
{
    ivec4 low;  // xyz [brick] lower corner of the box; w number of bricks
    ivec4 size; // xyz [brick] of the box
    vec4 light; // x of light that is stored as 1
    vec4 place; // from voxels of the field's lattice to those of the frame: w times the place, plus xyz
};
layout(std140, binding = 0) uniform FieldVolumeBlock
{
    vec4 rows[3];          // from a place [m] relative to the eye to voxels: dot(xyz, p) + w
    VolumeFrame frames[2];
    vec4 factors;          // x of extinction; y of emitted light; z mean cosine
    vec4 tint;             // rgb of albedo and emitted light
    vec4 share;            // of extinction: as fire, as dust; of balls of fire, of dust
    vec4 moment;           // x share of the second frame; y, z [s] since the first and until the second
    ivec4 firstBrick;      // x of the field
};

const uint kNoBrick = 0xFFFFFFFFu;

struct VolumeSample
{
    vec4 medium; // rgb emitted light; a extinction, both without their factors
    vec3 scattered;
    float rate; // [1/s] of emitted light
};

// Element of the list of voxels, or kNoBrick where no brick is.
uint voxelOf(int frame, ivec3 voxel)
{
    ivec3 size = frames[frame].size.xyz;
    ivec3 place = (voxel >> 3) - frames[frame].low.xyz;
    if (any(lessThan(place, ivec3(0))) || any(greaterThanEqual(place, size)))
        return kNoBrick;
    uint at = uint(place.x + size.x * (place.y + size.y * place.z));
#if FX_BETWEEN
    uint brick = frame == 0 ? volumeIndex[at] : secondIndex[at];
#else
    uint brick = volumeIndex[at];
#endif
    ivec3 inBrick = voxel & 7;
    return brick == kNoBrick ? kNoBrick : 512u * brick + uint(inBrick.x + 8 * inBrick.y + 64 * inBrick.z);
}

// An element of the list; kColumns and kRows in rendering/compositions/voxel_texture.cpp are equal.
uvec4 wordsOf(int frame, uint at)
{
    ivec3 texel = ivec3(at & 511u, at >> 9 & 511u, at >> 18);
#if FX_BETWEEN
    if (frame == 1)
        return texelFetch(secondVoxels, texel, 0);
#endif
    return texelFetch(volumeVoxels, texel, 0);
}

// Adds the rate times its light.
void addVoxel(int frame, uint at, float weight, inout VolumeSample io)
{
    uvec4 bits = wordsOf(frame, at);
    float extinction = uintBitsToFloat(bits.x);
    vec2 blueRate = unpackHalf2x16(bits.z);
    vec3 light = vec3(unpackHalf2x16(bits.y), blueRate.x) * (weight * frames[frame].light.x);
    vec3 albedo = vec3(bits.w & 1023u, bits.w >> 10 & 1023u, bits.w >> 20 & 1023u) / 1023.0;
    io.medium += vec4(light, weight * extinction);
    io.rate += (light.r + light.g + light.b) * blueRate.y;
    io.scattered += weight * extinction * albedo;
}

// Places and velocities are in voxels of the field's lattice.
vec3 placeIn(int frame, vec3 place)
{
    place = frames[frame].place.w * place + frames[frame].place.xyz;
    const float kOnVoxel = 1e-3; // [voxel] what places are rounded by
    vec3 nearest = floor(place + 0.5);
    return mix(place, nearest, lessThan(abs(place - nearest), vec3(kOnVoxel)));
}

// Place in voxels of the frame.
VolumeSample mediumAt(int frame, vec3 place)
{
    vec3 first = floor(place);
    vec3 part = place - first;
    VolumeSample found = VolumeSample(vec4(0.0), vec3(0.0), 0.0);
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        vec3 weights = mix(1.0 - part, part, vec3(corner));
        float weight = weights.x * weights.y * weights.z;
        uint at = weight > 0.0 ? voxelOf(frame, ivec3(first) + corner) : kNoBrick;
        if (at != kNoBrick)
            addVoxel(frame, at, weight, found);
    }
    float light = found.medium.r + found.medium.g + found.medium.b;
    found.rate = light > 0.0 ? found.rate / light : 0.0;
    return found;
}

#if FX_BETWEEN
vec4 shifted(vec4 v[4], float t)
{
    vec4 found;
    for (int c = 0; c < 4; ++c)
        found[c] = fxFlowShift(v[0][c], v[1][c], v[2][c], v[3][c], t);
    return found;
}

// Extinction and light are shifted by formula volume-advection (9).
VolumeSample shiftedAt(int frame, vec3 place)
{
    VolumeSample sampled = mediumAt(frame, place);
    if (!(sampled.medium.a > 0.0))
        return sampled;
    vec3 low = floor(place), part = place - low;
    vec3 dimmest = sampled.medium.rgb / sampled.medium.a, brightest = dimmest; // light over extinction
    bvec3 isBetween = greaterThan(part, vec3(0.0));
    vec4 planes[4], rows[4], taps[4];
    for (int k = 0; k < 4; ++k)
        planes[k] = rows[k] = taps[k] = vec4(0.0);
    for (int z = 0; z < 4; ++z) {
        if (z != 1 && !isBetween.z)
            continue;
        for (int y = 0; y < 4; ++y) {
            if (y != 1 && !isBetween.y)
                continue;
            for (int x = 0; x < 4; ++x) {
                VolumeSample own = VolumeSample(vec4(0.0), vec3(0.0), 0.0);
                uint at = x == 1 || isBetween.x ? voxelOf(frame, ivec3(low) + ivec3(x, y, z) - 1) : kNoBrick;
                if (at != kNoBrick)
                    addVoxel(frame, at, 1.0, own);
                taps[x] = own.medium;
                if (own.medium.a > 0.0 && x % 3 != 0 && y % 3 != 0 && z % 3 != 0) {
                    dimmest = min(dimmest, own.medium.rgb / own.medium.a);
                    brightest = max(brightest, own.medium.rgb / own.medium.a);
                }
            }
            rows[y] = shifted(taps, part.x);
        }
        planes[z] = shifted(rows, part.y);
    }
    vec4 found = shifted(planes, part.z);
    sampled.scattered *= found.a / sampled.medium.a;
    sampled.medium = vec4(clamp(found.rgb, found.a * dimmest, found.a * brightest), found.a);
    return sampled;
}

struct Flow
{
    vec4 momentum; // xyz weight times velocity [voxel/s]; w weight
    float growth;  // weight times divergence [1/s]
};

Flow flowAt(int frame, vec3 place)
{
    place = frames[frame].place.w * place + frames[frame].place.xyz;
    vec3 first = floor(place);
    vec3 part = place - first;
    uint velocities = 512u * uint(frames[frame].low.w); // behind the voxels
    Flow flow = Flow(vec4(0.0), 0.0);
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        vec3 weights = mix(1.0 - part, part, vec3(corner));
        float weight = weights.x * weights.y * weights.z;
        uint at = weight > 0.0 ? voxelOf(frame, ivec3(first) + corner) : kNoBrick;
        if (at != kNoBrick) {
            uvec4 pair = wordsOf(frame, velocities + at / 2u);
            uvec2 own = (at & 1u) == 0u ? pair.xy : pair.zw;
            weight *= fxFlowWeight(uintBitsToFloat(wordsOf(frame, at).x));
            vec2 z = unpackHalf2x16(own.y);
            flow.momentum += weight * vec4(unpackHalf2x16(own.x), z.x, 1.0);
            flow.growth += weight * z.y;
        }
    }
    flow.momentum.xyz /= frames[frame].place.w;
    return flow;
}

vec3 velocityOr(vec4 momentum, vec3 other)
{
    return vec3(fxFlowVelocity(momentum.x, momentum.w, other.x), fxFlowVelocity(momentum.y, momentum.w, other.y),
                fxFlowVelocity(momentum.z, momentum.w, other.z));
}

float densityOf(float seconds, Flow flow)
{
    return fxFlowDensity(seconds, fxFlowVelocity(flow.growth, flow.momentum.w, 0.0));
}

// The moment between two frames, by formula volume-advection.
VolumeSample volumeAt(vec3 place)
{
    vec3 before = place, after = place;
    vec2 share = vec2(1.0 - moment.x, moment.x);
    if (moment.y + moment.z > 0.0) {
        vec3 mixed = velocityOr(mix(flowAt(0, place).momentum, flowAt(1, place).momentum, moment.x), vec3(0.0)); // (1)
        Flow from = flowAt(0, place - moment.y * mixed);
        Flow to = flowAt(1, place + moment.z * mixed);
        before -= moment.y * velocityOr(from.momentum, mixed); // (2)
        after += moment.z * velocityOr(to.momentum, mixed);    // (3)
        share *= vec2(densityOf(moment.y, from), densityOf(-moment.z, to));
    }
    VolumeSample a = shiftedAt(0, placeIn(0, before)), b = shiftedAt(1, placeIn(1, after));
    vec2 own = vec2(a.medium.a, b.medium.a), extinction = share * own; // (5)
    vec2 rates = (moment.y + moment.z) / 16.0 * vec2(a.rate, b.rate);
    vec3 light;
    for (int c = 0; c < 3; ++c)
        light[c] = fxFlowLight(extinction.x, a.medium[c], extinction.y, b.medium[c], own.x, own.y, rates.x, rates.y); // (7)
    return VolumeSample(vec4(light, extinction.x + extinction.y), share.x * a.scattered + share.y * b.scattered, 0.0);
}
#else
VolumeSample volumeAt(vec3 place)
{
    return mediumAt(0, placeIn(0, place));
}
#endif

vec3 voxelAt(vec3 p)
{
    return vec3(dot(rows[0].xyz, p) + rows[0].w, dot(rows[1].xyz, p) + rows[1].w, dot(rows[2].xyz, p) + rows[2].w);
}

// [1/m] extinction of the balls that stand for the volume in the light slices
float castersAt(VoxelField field, FieldBrick brick, vec3 p)
{
    float radius = -field.limits.x, perRadius2 = 1.0 / (radius * radius), sum = 0.0;
    float fineness = field.corner.w * field.corner.w * perRadius2;
    for (uint k = brick.first; k < brick.first + brick.count; ++k) {
        vec3 d = p - blobs[brickBalls[k]].centerRadius.xyz;
        float peak = fxKernelPeak(blobs[brickBalls[k]].medium.x, radius);
        sum += peak * fxVoxelKernel(dot(d, d) * perRadius2, fineness);
    }
    return sum;
}

void main()
{
    int number = firstBrick.x + int(gl_WorkGroupID.x);
    FieldBrick brick = bricks[number];
    VoxelField field = fieldOf(int(brick.field));
    ivec3 first = sampleOfBrick(int(gl_LocalInvocationIndex));
    ivec3 texel = brickTexel(number) + first;
    clearSeen();
    barrier();
    vec2 largest = vec2(0.0);
#if FX_DETAIL
    bool isDetailed = field.limits.z > 0.5;
    vec4 erosion = isDetailed ? fieldTexel(int(field.limits.z) + kErosionTexel) : vec4(0.0);
#endif
    for (int z = 0; z < kBrickSamples; ++z) {
        vec3 p = placeOfSample(field, brick, first + ivec3(0, 0, z));
        VolumeSample found = volumeAt(voxelAt(p));
        float extinction = factors.x * found.medium.a;
        vec3 albedo = tint.rgb * found.scattered / max(found.medium.a, 1e-20);
        largest = max(largest, extinction * vec2(z <= kBrickCells / 2, z >= kBrickCells / 2));
        imageStore(medium, texel + ivec3(0, 0, z), vec4(factors.y * tint.rgb * found.medium.rgb, extinction));
        imageStore(scatter, texel + ivec3(0, 0, z), vec4(clamp(albedo, vec3(0.0), vec3(1.0)), factors.z));
#if FX_LAYERS
        imageStore(shares, texel + ivec3(0, 0, z), share * (extinction / field.limits.y));
#endif
#if FX_DETAIL
        float thinning = isDetailed && extinction > 0.0 ? fxDetailThinning(extinction * erosion.x, erosion.y, erosion.z) : 0.0;
        imageStore(material0, texel + ivec3(0, 0, z), vec4(0.0));
        imageStore(material1, texel + ivec3(0, 0, z), vec4(vec3(0.0), thinning * extinction / field.limits.y));
#endif
        imageStore(change, texel + ivec3(0, 0, z), vec4((extinction - castersAt(field, brick, p)) / field.limits.y));
    }
    addSeen(first, largest);
    barrier();
    storeSeen(field, brick, number);
}
