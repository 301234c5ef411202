// Voxel fields as planned by rendering/field/field_plan.cpp; layouts asserted in rendering/field/field_blocks.h.
struct VoxelField
{
    vec4 corner;  // xyz [m] of the first sample relative to the eye; w side of a voxel [m]
    ivec4 bricks; // xyz bricks along each axis; w first entry in the table of bricks
    vec4 limits;  // x least radius of a ball [m], or below 0 minus the radius of casters of a volume; y no extinction is larger [1/m]; z first texel of its detail, or 0;
                  // in buffers number of its detail + 1, or 0; w number of its glow + 1, or 0
};

// Fields, their details and lists of fields are texels, kFieldColumns in a row: software renderers read those many times
// faster than buffers. Layout of rendering/field/field_texels.h.
layout(binding = 11) uniform sampler2D fieldTexels;
const int kFieldColumns = 1024;
vec4 fieldTexel(int i) { return texelFetch(fieldTexels, ivec2(i % kFieldColumns, i / kFieldColumns), 0); }

VoxelField fieldOf(int number)
{
    return VoxelField(fieldTexel(3 * number), ivec4(fieldTexel(3 * number + 1)), fieldTexel(3 * number + 2));
}

// So is the table of bricks: one texel a brick of each field's box, with the number of the brick + 1 and a fraction of 256 that has one
// bit for each eighth of it in which rays see medium; below 0 where they see none; or 0 where there is none.
const int kTableColumns = 1024;
ivec2 tableTexel(int entry) { return ivec2(entry % kTableColumns, entry / kTableColumns); }
int tableEntry(VoxelField field, ivec3 place)
{
    return field.bricks.w + place.x + field.bricks.x * (place.y + field.bricks.y * place.z);
}

struct FieldBrick
{
    uint field;
    uint place; // in bricks of its field: x + 1024 y + 1024^2 z
    uint first; // of its balls
    uint count; // of its balls
};

// The fields that are seen in a part of the window, of kFieldTiles.
struct FieldTile
{
    uint first; // texel of its list of numbers of fields, one a texel
    uint count;
};
const ivec2 kFieldTiles = ivec2(32, 18); // from clip position -1, -1, x fastest

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

ivec3 placeOfBrick(FieldBrick brick)
{
    return ivec3(brick.place & 1023u, brick.place >> 10 & 1023u, brick.place >> 20);
}

// [m] relative to the eye. The same bits for a sample that several bricks have.
vec3 placeOfSample(VoxelField field, FieldBrick brick, ivec3 s)
{
    return field.corner.xyz + field.corner.w * vec3(kBrickCells * placeOfBrick(brick) + s);
}
