#include "field/field_blocks.glsl"

// One rectangle a part of the window in which fields are seen. Layout of FieldTileBlock in rendering/field/field_blocks.h.
struct FieldTile
{
    uint place; // column + 256 row
    uint first; // of its fields, in their list
    uint count; // of its fields
    uint unused;
};
layout(std430, binding = 3) readonly buffer FieldTiles { FieldTile tiles[]; };

flat out uvec2 tileRange;

void main()
{
    const vec2 kTiles = vec2(32.0, 18.0);
    FieldTile tile = tiles[gl_InstanceID];
    tileRange = uvec2(tile.first, tile.count);
    vec2 corner = vec2(gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : 0.0,
                       gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : 0.0);
    gl_Position = vec4((vec2(tile.place & 255u, tile.place >> 8) + corner) / kTiles * 2.0 - 1.0, 0.5, 1.0);
}
