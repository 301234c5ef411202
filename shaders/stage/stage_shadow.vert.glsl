#include "stage/stage_block.glsl"

// The mesh as the sun sees it.
layout(std430, binding = 0) readonly buffer MeshBuffer
{
    float mesh[];
};

void main()
{
    int base = gl_VertexID * 9;
    vec3 position = vec3(mesh[base], mesh[base + 1], mesh[base + 2]);
    gl_Position = shadowFromMesh * vec4(position, 1.0);
}
