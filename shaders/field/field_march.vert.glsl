#include "field/field_blocks.glsl"

// One rectangle a part of the window in which fields are seen.
layout(std430, binding = 3) readonly buffer FieldTiles { FieldTile fieldTiles[]; };
flat out uvec2 tileRange; // first of its fields in their list, and how many

void main()
{
    FieldTile tile = fieldTiles[gl_InstanceID];
    tileRange = uvec2(tile.first, tile.count);
    vec2 corner = vec2(gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : 0.0,
                       gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : 0.0);
    vec2 place = vec2(gl_InstanceID % kFieldTiles.x, gl_InstanceID / kFieldTiles.x);
    corner *= tile.count > 0u ? 1.0 : 0.0; // the others have no area
    gl_Position = vec4((place + corner) / vec2(kFieldTiles) * 2.0 - 1.0, 0.5, 1.0);
}
