// Voxel fields as planned by rendering/field/field_plan.cpp; layouts asserted in rendering/field/field_blocks.h.
struct VoxelField
{
    vec4 corner;  // xyz [m] of the first sample relative to the eye; w side of a voxel [m]
    ivec4 bricks; // xyz bricks along each axis; w first entry in the table of bricks
    vec4 limits;  // x least radius of a ball [m]; y no extinction is larger [1/m]; z number of its detail + 1, or 0; w of its glow + 1, or 0
};

struct FieldBrick
{
    uint field;
    uint place; // in bricks of its field: x + 1024 y + 1024^2 z
    uint first; // of its balls
    uint count; // of its balls
};

const int kBrickCells = 8;    // along a side
const int kBrickSamples = 9;  // along a side; those on its faces are in its neighbors as well
const int kBrickColumns = 16; // of the textures along x and y

// The first texel of a brick in the textures.
ivec3 brickTexel(int brick)
{
    return kBrickSamples * ivec3(brick % kBrickColumns, brick / kBrickColumns % kBrickColumns,
                                 brick / (kBrickColumns * kBrickColumns));
}

// The sample number i of a brick, x fastest.
ivec3 sampleOfBrick(int i)
{
    return ivec3(i % kBrickSamples, i / kBrickSamples % kBrickSamples, i / (kBrickSamples * kBrickSamples));
}

// [m] relative to the eye. The same bits for a sample that several bricks have.
vec3 placeOfSample(VoxelField field, FieldBrick brick, ivec3 s)
{
    ivec3 place = ivec3(brick.place & 1023u, brick.place >> 10 & 1023u, brick.place >> 20);
    return field.corner.xyz + field.corner.w * vec3(kBrickCells * place + s);
}
