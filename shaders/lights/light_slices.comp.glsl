#include "formulas/sphere_path.fx.h"
#include "formulas/kernel_optical_depth.fx.h"
#include "lights/slice_stack.glsl"

// Optical depth of all balls of medium between a light and each texel of its planes. One invocation a column of texels;
// a workgroup has 8 x 8 neighboring columns and first finds the balls that any of them can meet.
layout(local_size_x = 8, local_size_y = 8) in;

struct MediumCaster
{
    vec4 centerRadius; // xyz [m] relative to the eye; w radius [m]
    vec4 medium;       // x cross section [m2]
};
layout(std430, binding = 0) readonly buffer Casters { MediumCaster casters[]; };
layout(std430, binding = 1) readonly buffer Stacks { SliceStack stacks[]; };
layout(rg32f, binding = 0) uniform image2D slices; // r optical depth up to a plane; g from it to the next
layout(std140, binding = 0) uniform SliceBlock { ivec4 casterRange; }; // x first; y end; 0 as x: what is there is replaced

const int kMaxPlanes = 128;
shared uint met[2]; // one bit a ball of the batch of 64

// Whether a column of the workgroup can meet a ball. `middle` is the ray in the middle of all columns; `reach` the largest
// distance of another one from it: in metres, or for shells in metres a metre of distance.
bool canMeet(vec4 ball, vec3 start, vec3 direction, float reach, bool isParallel)
{
    vec3 d = ball.xyz - start;
    float along = dot(d, direction);
    float across = length(d - along * direction);
    if (isParallel)
        return across < ball.w + reach;
    return length(d) < ball.w || across < ball.w + reach * length(d);
}

void main()
{
    SliceStack stack = stacks[gl_WorkGroupID.z];
    if (float(gl_WorkGroupID.x * 8u) >= stack.tiles.z || float(gl_WorkGroupID.y * 8u) >= stack.tiles.z)
        return; // the whole workgroup
    bool isParallel = stack.right.w < 0.5;
    int planes = int(stack.tiles.w);
    vec3 start, direction, middleStart, middle, cornerStart, corner;
    rayOf(stack, vec2(gl_GlobalInvocationID.xy) + 0.5, start, direction);
    vec2 group = vec2(gl_WorkGroupID.xy * 8u);
    rayOf(stack, group + 4.0, middleStart, middle);
    float reach = 0.0;
    for (int i = 0; i < 4; ++i) {
        rayOf(stack, group + vec2((i & 1) == 0 ? 0.0 : 8.0, i < 2 ? 0.0 : 8.0), cornerStart, corner);
        reach = max(reach, isParallel ? length(cornerStart - middleStart) : 1.1 * length(corner - middle));
    }

    float between[kMaxPlanes];
    for (int k = 0; k < planes; ++k)
        between[k] = 0.0;
    for (int batch = casterRange.x; batch < casterRange.y; batch += 64) {
        uint lane = gl_LocalInvocationIndex;
        if (lane < 2u)
            met[lane] = 0u;
        barrier();
        int mine = batch + int(lane);
        if (mine < casterRange.y && canMeet(casters[mine].centerRadius, middleStart, middle, reach, isParallel))
            atomicOr(met[lane >> 5], 1u << (lane & 31u));
        barrier();
        for (int word = 0; word < 2; ++word) {
            uint bits = met[word];
            while (bits != 0u) {
                int bit = findLSB(bits);
                bits &= bits - 1u;
                MediumCaster ball = casters[batch + 32 * word + bit];
                float radius = ball.centerRadius.w;
                vec3 toCenter = ball.centerRadius.xyz - start;
                float tc = dot(toCenter, direction);
                float h = length(toCenter - tc * direction);
                if (h < radius) {
                    float spacing = stack.origin.w, before = stack.up.w;
                    float halfChord = sqrt((radius - h) * (radius + h));
                    int first = clamp(int(floor((tc - halfChord - before) / spacing)) + 1, 0, planes - 1);
                    int last = clamp(int(floor((tc + halfChord - before) / spacing)) + 1, 0, planes - 1);
                    for (int k = first; k <= last; ++k) {
                        float begin = k > 0 ? max(before + float(k - 1) * spacing, stack.along.w) : isParallel ? -1e30 : stack.along.w;
                        between[k] += fxKernelOpticalDepth(ball.medium.x, radius, h, tc, begin, before + float(k) * spacing);
                    }
                }
            }
        }
        barrier();
    }

    float depth = 0.0;
    ivec2 tile = ivec2(stack.tiles.xy) + ivec2(gl_GlobalInvocationID.xy);
    int side = int(stack.tiles.z);
    for (int k = 0; k < planes; ++k) {
        depth += between[k];
        float next = k + 1 < planes ? between[k + 1] : 0.0;
        ivec2 texel = tile + side * ivec2(k % kTileColumns, k / kTileColumns);
        vec2 others = vec2(0.0); // of the casters of earlier passes
        for (int i = 0; i < (casterRange.x > 0 ? 1 : 0); ++i)
            others = imageLoad(slices, texel).rg;
        imageStore(slices, texel, vec4(others + vec2(depth, next), 0.0, 0.0));
    }
}
