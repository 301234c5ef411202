#include "stage/stage_block.glsl"

// Mesh vertices as nine floats: position, normal, color.
layout(std430, binding = 0) readonly buffer MeshBuffer
{
    float mesh[];
};

out vec3 worldPosition;
out vec3 worldNormal;
out vec3 albedo;
flat out float isWater;

vec3 load(int i)
{
    return vec3(mesh[i], mesh[i + 1], mesh[i + 2]);
}

void main()
{
    int base = gl_VertexID * 9;
    worldPosition = load(base) + meshOffset.xyz;
    worldNormal = load(base + 3);
    albedo = load(base + 6);
    isWater = float(gl_VertexID) >= water.x ? 1.0 : 0.0;
    gl_Position = clipFromWorld * vec4(worldPosition, 1.0);
}
