#include "field/field_blocks.glsl"
#include "lights/slice_stack.glsl"

// Adds to the optical depths of light slices what detail makes of the fields, and what volumes have beside the balls that stand for
// them: planes hold those of smooth balls. One invocation
// a column of texels.
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 1) readonly buffer Stacks { SliceStack stacks[]; };
layout(binding = 12) uniform sampler2D brickTable;
layout(binding = 1) uniform sampler3D fieldChange; // r change of extinction over the field's largest
layout(rg32f, binding = 0) uniform image2D slices;    // r optical depth up to a plane; g from it to the next
layout(std140, binding = 0) uniform FieldSliceBlock { ivec4 fieldCount; };

const int kMaxParts = 4; // of the way between two planes

// [1/m] change of extinction by detail and volumes, of all fields
float changeAt(vec3 p)
{
    float sum = 0.0;
    for (int f = 0; f < fieldCount.x; ++f) {
        VoxelField field = fieldOf(f);
        vec3 local = (p - field.corner.xyz) / field.corner.w;
        vec3 size = vec3(kBrickCells * field.bricks.xyz);
        bool changes = field.limits.z > 0.5 || field.limits.x < 0.0;
        bool isInside = changes && all(greaterThanEqual(local, vec3(0.0))) && all(lessThan(local, size));
        ivec3 brick = clamp(ivec3(floor(local / float(kBrickCells))), ivec3(0), field.bricks.xyz - 1);
        float number = isInside ? abs(texelFetch(brickTable, tableTexel(tableEntry(field, brick)), 0).r) : 0.0;
        int turns = number > 0.0 ? 1 : 0;
        if (turns > 0) {
            vec3 texel = vec3(brickTexel(int(number) - 1)) + 0.5 + local - vec3(kBrickCells * brick);
            sum += field.limits.y * textureLod(fieldChange, texel / vec3(textureSize(fieldChange, 0)), 0.0).r;
        }
    }
    return sum;
}

void main()
{
    SliceStack stack = stacks[gl_WorkGroupID.z];
    if (float(gl_GlobalInvocationID.x) >= stack.tiles.z || float(gl_GlobalInvocationID.y) >= stack.tiles.z)
        return;
    vec3 start, direction;
    rayOf(stack, vec2(gl_GlobalInvocationID.xy) + 0.5, start, direction);
    ivec2 tile = ivec2(stack.tiles.xy) + ivec2(gl_GlobalInvocationID.xy);
    int side = int(stack.tiles.z), planes = int(stack.tiles.w);
    float spacing = stack.origin.w;
    float finest = spacing;
    for (int f = 0; f < fieldCount.x; ++f)
        finest = min(finest, fieldTexel(3 * f).w);
    int parts = clamp(int(ceil(spacing / finest)), 1, kMaxParts);
    float partLength = spacing / float(parts);                 // [m] of a part
    float begin = stack.right.w < 0.5 ? -1e30 : stack.along.w; // [m] up to which media do not count, detail included
    float depth = 0.0;
    for (int k = 0; k < planes; ++k) {
        float between = 0.0; // from this plane to the next
        float from = stack.up.w + float(k) * spacing;
        for (int part = 0; k + 1 < planes && part < parts; ++part) {
            float middle = from + spacing * (float(part) + 0.5) / float(parts);
            float counted = clamp((middle - begin) / partLength + 0.5, 0.0, 1.0);
            between += counted * changeAt(start + middle * direction);
        }
        between *= partLength;
        ivec2 texel = tile + side * ivec2(k % kTileColumns, k / kTileColumns);
        vec2 smoothDepth = imageLoad(slices, texel).rg;
        imageStore(slices, texel, vec4(max(smoothDepth.r + depth, 0.0), max(smoothDepth.g + between, 0.0), 0.0, 0.0));
        depth += between;
    }
}
