// One square a picture: the tile where it is kept. Sizes are those of rendering/passes/impostor_pass.h.
layout(std430, binding = 0) readonly buffer KeptTiles { uint keptTiles[]; };
flat out ivec2 fromTexel; // what is added to a texel of the atlas to find it among the pictures

void main()
{
    const int kTile = 32;
    const int kTakingColumns = 12;
    const ivec2 kTiles = ivec2(64, 32);
    int tile = int(keptTiles[gl_InstanceID]);
    ivec2 target = ivec2(tile % kTiles.x, tile / kTiles.x);
    ivec2 source = ivec2(gl_InstanceID % kTakingColumns, gl_InstanceID / kTakingColumns);
    fromTexel = (source - target) * kTile;
    vec2 corner = vec2(gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : 0.0,
                       gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : 0.0);
    gl_Position = vec4((vec2(target) + corner) / vec2(kTiles) * 2.0 - 1.0, 0.5, 1.0);
}
