// Conversion between the host's target and light; filled from rendering/passes/display_block.h.
layout(std140, binding = 0) uniform DisplayBlock
{
    vec4 display; // x: exposed radiance shown as 1; y: encoding of the target, 0 linear, 1 sRGB, 2 gamma 2.2; z: that of what is read; w: radiance that the host shows as 1
    ivec4 place;  // xy [pixel] of the frame in the target; z: 1 also unchanged pixels are written; w unused
};
