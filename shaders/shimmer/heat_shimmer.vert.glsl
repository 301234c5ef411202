#include "shimmer/shimmer_block.glsl"

// One rectangle of whole pixels an area that hot gas may reach.
layout(std430, binding = 0) readonly buffer HotAreas { uvec4 hotAreas[]; }; // [pixel] left, low, right, high

void main()
{
    uvec4 area = hotAreas[gl_InstanceID];
    bool isRight = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
    bool isHigh = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
    vec2 corner = vec2(isRight ? area.z : area.x, isHigh ? area.w : area.y);
    gl_Position = vec4((corner / shimmer.zw * 2.0 - 1.0) * vec2(1.0, window.x), 0.5, 1.0);
}
