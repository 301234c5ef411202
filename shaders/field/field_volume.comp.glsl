#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/voxel_kernel.fx.h"
#include "shared/blob_instance.glsl"
#include "field/field_blocks.glsl"
#include "field/field_seen.glsl"

// Fills the bricks of a field from a volume on voxels: one workgroup a brick, one invocation for all samples along z. Samples at the
// centers of voxels have the values of these voxels; others are interpolated along each axis.
layout(local_size_x = 81) in;
layout(std430, binding = 2) readonly buffer Bricks { FieldBrick bricks[]; };
layout(std430, binding = 3) readonly buffer BrickBalls { uint brickBalls[]; };
layout(std430, binding = 4) readonly buffer VolumeIndex { uint volumeIndex[]; };    // of the brick at each place of the box; kNoBrick
layout(std430, binding = 5) readonly buffer VolumeVoxels { uvec4 volumeVoxels[]; }; // MediumVolume::Packed
layout(rgba32f, binding = 0) uniform writeonly image3D medium;  // rgb emitted light [exposed/m]; a extinction [1/m]
layout(rgba16f, binding = 1) uniform writeonly image3D scatter; // rgb mean albedo; a mean cosine of the phase function
#if FX_LAYERS
layout(rgba16f, binding = 2) uniform writeonly image3D shares; // see field_sample.glsl
#endif
layout(r32f, binding = 6) uniform writeonly image3D change; // extinction less that of casters, over the field's largest
layout(std140, binding = 0) uniform FieldVolumeBlock
{
    vec4 rows[3];  // from a place [m] relative to the eye to voxels: dot(xyz, p) + w
    ivec4 low;     // xyz [brick] lower corner of the box; w first brick of the field
    ivec4 size;    // xyz [brick] of the box
    vec4 factors;  // x of extinction; y of emitted light; z mean cosine
    vec4 share;    // of extinction: as fire, as dust; of balls of fire, of dust
};

const uint kNoBrick = 0xFFFFFFFFu;

struct VolumeSample
{
    vec4 medium; // rgb emitted light over the brightest; a extinction, both without their factors
    vec3 scattered;
};

void addVoxel(ivec3 voxel, float weight, inout VolumeSample io)
{
    ivec3 place = (voxel >> 3) - low.xyz;
    bool isInside = weight > 0.0 && all(greaterThanEqual(place, ivec3(0))) && all(lessThan(place, size.xyz));
    uint brick = isInside ? volumeIndex[place.x + size.x * (place.y + size.y * place.z)] : kNoBrick;
    if (brick != kNoBrick) {
        ivec3 inBrick = voxel & 7;
        uvec4 bits = volumeVoxels[512u * brick + uint(inBrick.x + 8 * inBrick.y + 64 * inBrick.z)];
        float extinction = uintBitsToFloat(bits.x);
        vec3 light = vec3(unpackHalf2x16(bits.y), unpackHalf2x16(bits.z).x);
        vec3 albedo = vec3(bits.w & 1023u, bits.w >> 10 & 1023u, bits.w >> 20 & 1023u) / 1023.0;
        io.medium += weight * vec4(light, extinction);
        io.scattered += weight * extinction * albedo;
    }
}

VolumeSample volumeAt(vec3 p)
{
    const float kOnVoxel = 1e-3; // [voxel] what places are rounded by
    vec3 place = vec3(dot(rows[0].xyz, p) + rows[0].w, dot(rows[1].xyz, p) + rows[1].w, dot(rows[2].xyz, p) + rows[2].w);
    vec3 nearest = floor(place + 0.5);
    place = mix(place, nearest, lessThan(abs(place - nearest), vec3(kOnVoxel)));
    vec3 first = floor(place);
    vec3 part = place - first;
    VolumeSample found = VolumeSample(vec4(0.0), vec3(0.0));
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        vec3 weight = mix(1.0 - part, part, vec3(corner));
        addVoxel(ivec3(first) + corner, weight.x * weight.y * weight.z, found);
    }
    return found;
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
    int number = low.w + int(gl_WorkGroupID.x);
    FieldBrick brick = bricks[number];
    VoxelField field = fieldOf(int(brick.field));
    ivec3 first = sampleOfBrick(int(gl_LocalInvocationIndex));
    ivec3 texel = brickTexel(number) + first;
    clearSeen();
    barrier();
    vec2 largest = vec2(0.0);
    for (int z = 0; z < kBrickSamples; ++z) {
        vec3 p = placeOfSample(field, brick, first + ivec3(0, 0, z));
        VolumeSample found = volumeAt(p);
        float extinction = factors.x * found.medium.a;
        vec3 albedo = found.scattered / max(found.medium.a, 1e-20);
        largest = max(largest, extinction * vec2(z <= kBrickCells / 2, z >= kBrickCells / 2));
        imageStore(medium, texel + ivec3(0, 0, z), vec4(factors.y * found.medium.rgb, extinction));
        imageStore(scatter, texel + ivec3(0, 0, z), vec4(clamp(albedo, vec3(0.0), vec3(1.0)), factors.z));
#if FX_LAYERS
        imageStore(shares, texel + ivec3(0, 0, z), share * (extinction / field.limits.y));
#endif
        imageStore(change, texel + ivec3(0, 0, z), vec4((extinction - castersAt(field, brick, p)) / field.limits.y));
    }
    addSeen(first, largest);
    barrier();
    storeSeen(field, brick, number);
}
