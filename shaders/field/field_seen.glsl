// Which eighths of a brick rays see. Needs field/field_blocks.glsl; a workgroup has 81 invocations, each with all samples along z of
// one column, and calls these functions in this order with barriers between them.
layout(r32f, binding = 5) uniform writeonly image2D brickTable; // see field_blocks.glsl

shared uint most[8]; // bits of the largest extinction of a sample that is seen, in each eighth of the brick [1/m], regardless of its sign

void clearSeen()
{
    if (gl_LocalInvocationIndex < 8u)
        most[gl_LocalInvocationIndex] = 0u;
}

// first: x and y of the samples; largest: x below, y above the middle, in which samples are in both
void addSeen(ivec3 first, vec2 largest)
{
    for (int k = 0; k < 8; ++k) {
        bvec2 isHigh = bvec2(k & 1, k & 2);
        bvec2 isOf = bvec2(isHigh.x ? first.x >= kBrickCells / 2 : first.x <= kBrickCells / 2,
                           isHigh.y ? first.y >= kBrickCells / 2 : first.y <= kBrickCells / 2);
        if (all(isOf))
            atomicMax(most[k], floatBitsToUint(k < 4 ? largest.x : largest.y));
    }
}

// number: of the brick
void storeSeen(VoxelField field, FieldBrick brick, int number)
{
    if (gl_LocalInvocationIndex > 0u)
        return;
    float seen = 0.0;
    for (int k = 0; k < 8; ++k)
        seen += most[k] > 0u ? exp2(float(k - 8)) : 0.0;
    float entry = float(number) + 1.0;
    imageStore(brickTable, tableTexel(tableEntry(field, placeOfBrick(brick))), vec4(seen > 0.0 ? entry + seen : -entry));
}
