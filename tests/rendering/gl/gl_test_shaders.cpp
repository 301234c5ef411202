#include "gl_test.h"

#include <map>

namespace fx::render {

std::optional<std::string> GlTest::testShader(std::string_view name)
{
    static const std::map<std::string_view, std::string> kBodies = {
        {"fullscreen.vert", R"(
void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})"},
        {"depth.vert", R"(
layout(std140, binding = 0) uniform Block { vec4 color; vec4 depth; };
void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, depth.x, 1.0);
})"},
        {"fill.frag", R"(
layout(std140, binding = 0) uniform Block { vec4 color; vec4 depth; };
layout(location = 0) out vec4 outColor;
void main() { outColor = color; })"},
        {"eight.frag", R"(
layout(std140, binding = 0) uniform Block { vec4 color; vec4 depth; };
layout(location = 0) out vec4 outs[7];
layout(location = 7) out float last;
void main()
{
    for (int i = 0; i < 7; ++i)
        outs[i] = color + float(i);
    last = color.x + 7.0;
})"},
        {"sample.frag", R"(
layout(binding = 0) uniform sampler2D nearest;
layout(binding = 1) uniform sampler2D linear;
layout(binding = 2) uniform sampler2D repeated;
layout(location = 0) out vec4 outColor;
void main()
{
    outColor = vec4(texture(nearest, vec2(0.51, 0.5)).x, texture(linear, vec2(0.5, 0.5)).x,
                    texture(linear, vec2(1.0, 0.5)).x, texture(repeated, vec2(1.0, 0.5)).x);
})"},
        {"count.frag", R"(
layout(std430, binding = 1) buffer Counter { uint count; };
layout(location = 0) out vec4 outColor;
void main() { atomicAdd(count, 1u); outColor = vec4(1.0); })"},
        {"sums.comp", R"(
layout(local_size_x = 4, local_size_y = 4) in;
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1, rgba32f) uniform image2D result;
layout(std430, binding = 3) buffer Values { uint values[]; };
layout(std140, binding = 0) uniform Block { vec4 color; vec4 depth; };
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(result))))
        return;
    imageStore(result, at, texelFetch(picture, at, 0) + color);
    atomicAdd(values[values.length() - 1], 1u);
})"},
        {"broken.frag", "\nvoid main() { thisIsNoFunction(); }"},
    };
    const auto found = kBodies.find(name);
    if (found == kBodies.end())
        return {};
    return "#version 450 core\n" + found->second + "\n";
}

} // namespace fx::render
