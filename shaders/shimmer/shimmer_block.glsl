// Filled from rendering/passes/heat_shimmer_pass.cpp, which has the same layout.
layout(std140, binding = 0) uniform ShimmerBlock
{
    vec4 shimmer; // x: strength [1]; y: largest offset [pixel]; zw: width and height of the picture [pixel]
    vec4 window;  // x: flip of window y against clip y, 1 or -1
};
