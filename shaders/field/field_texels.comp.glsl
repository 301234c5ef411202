#include "field/field_blocks.glsl"

// What field/field_blocks.glsl reads as texels, from a buffer.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer FieldList { vec4 listed[]; };
layout(rgba32f, binding = 0) uniform writeonly image2D texels;
layout(std140, binding = 0) uniform ListBlock { ivec4 listCount; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i < listCount.x)
        imageStore(texels, ivec2(i % kFieldColumns, i / kFieldColumns), listed[i]);
}
