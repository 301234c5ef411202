#include "shared/view_block.glsl"

// One square for each tile that has something to show.
layout(std430, binding = 2) readonly buffer SlabTiles
{
    uvec4 tileCounts[2];
    uvec4 tiles[]; // as in slabs/slab_tiles.comp.glsl
};
flat out ivec2 tileList;   // first entry and entries
flat out float tileWeight; // as in slabs/slab_window.glsl

void main()
{
    uvec4 tile = tiles[gl_InstanceID];
    ivec2 size = ivec2(rayDirectionX.w, rayDirectionY.w);
    int columns = (size.x + 15) / 16;
    ivec2 corner = ivec2(gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1 : 0,
                         gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1 : 0);
    ivec2 texel = 16 * (ivec2(int(tile.x) % columns, int(tile.x) / columns) + corner);
    vec2 window = vec2(min(texel, size)) / vec2(size) * 2.0 - 1.0;
    tileList = ivec2(tile.yz);
    tileWeight = uintBitsToFloat(tile.w);
    gl_Position = vec4(window.x, rayOriginY.w * window.y, 0.5, 1.0);
}
