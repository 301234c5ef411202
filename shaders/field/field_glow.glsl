// Grids in which the light that media emit is spread: rendering/field/field_glow_plan.cpp. Layout of FieldGlowBlock in
// rendering/field/field_blocks.h. All grids lie above each other along z.
struct FieldGlow
{
    vec4 corner; // xyz [m] of the grid relative to the eye; w side of a cell [m]
    vec4 before; // the same of the grid whose light it goes on from; w 0: none
    ivec4 cells; // xyz along each axis; w along z of all grids before this one
    ivec4 cellsBefore; // the same of the grid of `before`
};
layout(std430, binding = 3) readonly buffer FieldGlows { FieldGlow glows[]; };

// Number of the grid whose cells lie in layer z of a texture of `count` grids.
int glowOfLayer(int z, int count)
{
    int number = 0;
    while (number + 1 < count && z >= glows[number + 1].cells.w)
        ++number;
    return number;
}

const int kGlowCells = 32; // along a side of a grid
const int kGlowColumns = 8; // of the rays of all directions, along x; along y there are 4

// The direction from a cell to its neighbor number i of 27; 13 is itself.
ivec3 glowDirection(int i)
{
    return ivec3(i % 3, i / 3 % 3, i / 9) - 1;
}

// Where the rays of a direction lie in their texture.
ivec3 glowRayCorner(int i)
{
    return kGlowCells * ivec3(i % kGlowColumns, i / kGlowColumns, 0);
}
