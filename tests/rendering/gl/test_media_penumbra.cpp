// The GLSL with which surfaces look up the shadow of media in the light of a glowing ball: half of all
// directions are opaque, and the edge between the halves is as soft as the ball is wide.
#include "gl_test.h"

#include "shaders/shader_library.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr int kTexels = 256; ///< along a side of a plane
constexpr int kRows = 64;    ///< [pixel] of directions all around
constexpr int kPlaces = 81;  ///< [pixel] from -40 to 40 degrees beside the edge
constexpr float kNearest =
    1.2f; ///< [radius] of what casts the shadow, as in shaders/shared/media_shadow.glsl

constexpr ProgramDesc kPlanes = {"planes", "fullscreen.vert", "planes.frag", nullptr, nullptr};
constexpr ProgramDesc kSmoothPlanes = {"smooth planes", "fullscreen.vert", "smooth.frag", nullptr, nullptr};
constexpr ProgramDesc kAround = {"around", "fullscreen.vert", "around.frag", nullptr, nullptr};
constexpr ProgramDesc kLookup = {"lookup", "fullscreen.vert", "lookup.frag", nullptr, nullptr};

/// Optical depth 30 towards positive x, none elsewhere; both planes alike.
std::string planesShader()
{
    return shaders::assemble("lights/slice_stack.glsl", "").value() + R"(
layout(location = 0) out vec2 depth;
void main()
{
    vec2 texel = mod(gl_FragCoord.xy, 256.0);
    depth = vec2(octahedralDirection(2.0 * (texel - 1.0) / 254.0 - 1.0).x > 0.0 ? 30.0 : 0.0, 0.0);
})";
}

std::string lookupShader()
{
    return shaders::assemble("shared/media_shadow.glsl", "").value() + R"(
layout(binding = 0) uniform sampler2D planes;
layout(std140, binding = 0) uniform Block { vec4 ball; }; // x its radius, y distance of the places, z of the nearest caster
layout(location = 0) out vec4 passed;
void main()
{
    FxMediaShadow shadow;
    for (int i = 0; i < 3; ++i)
        shadow.right[i] = shadow.up[i] = shadow.along[i] = shadow.tiles[i] = vec4(0.0);
    for (int i = 0; i < 3; ++i)
        shadow.right[i][i] = 1.0;
    shadow.along[0] = vec4(ball.z, ball.x, 0.0, 1.0);
    shadow.tiles[0] = vec4(0.0, 0.0, 256.0, 2.0);
    shadow.place = vec4(0.0, 0.0, 0.0, 1.0);
    float angle = radians(floor(gl_FragCoord.x) - 40.0);
    passed = vec4(fxMediaTransmittance(planes, shadow, ball.y * vec3(sin(angle), 0.3 * cos(angle), 0.954 * cos(angle))), 1.0);
})";
}

/// Optical depth 1 + d.x / 2 - d.y / 4 + d.z / 8 towards d.
std::string smoothShader()
{
    return shaders::assemble("lights/slice_stack.glsl", "").value() + R"(
layout(location = 0) out vec2 depth;
void main()
{
    vec2 texel = mod(gl_FragCoord.xy, 256.0);
    depth = vec2(1.0 + dot(octahedralDirection(2.0 * (texel - 1.0) / 254.0 - 1.0), vec3(0.5, -0.25, 0.125)), 0.0);
})";
}

/// Direction of a pixel: longitude across, latitude down.
glm::dvec3 around(double x, double y)
{
    const double longitude = x / kPlaces * 2.0 * std::numbers::pi,
                 latitude = (y / kRows - 0.5) * std::numbers::pi;
    return {std::cos(latitude) * std::cos(longitude), std::sin(latitude),
            std::cos(latitude) * std::sin(longitude)};
}

std::string aroundShader()
{
    return shaders::assemble("shared/media_shadow.glsl", "").value() + R"(
layout(binding = 0) uniform sampler2D planes;
layout(location = 0) out vec4 passed;
void main()
{
    FxMediaShadow shadow;
    for (int i = 0; i < 3; ++i)
        shadow.right[i] = shadow.up[i] = shadow.along[i] = shadow.tiles[i] = vec4(0.0);
    for (int i = 0; i < 3; ++i)
        shadow.right[i][i] = 1.0;
    shadow.along[0] = vec4(0.0, 0.0, 0.0, 1.0);
    shadow.tiles[0] = vec4(0.0, 0.0, 256.0, 2.0);
    shadow.place = vec4(0.0, 0.0, 0.0, 1.0);
    float longitude = gl_FragCoord.x / 81.0 * 6.28318531, latitude = (gl_FragCoord.y / 64.0 - 0.5) * 3.14159265;
    vec3 d = vec3(cos(latitude) * cos(longitude), sin(latitude), cos(latitude) * sin(longitude));
    passed = vec4(fxMediaTransmittance(planes, shadow, 2.0 * d), 1.0);
})";
}

class MediaPenumbra : public GlTest
{
protected:
    std::vector<float> passed(float radius, float distance, float caster = 0.0f)
    {
        device->setSourceOverride([](std::string_view name, std::string_view) -> std::optional<std::string> {
            return name == kPlanes.fragment   ? planesShader()
                   : name == kLookup.fragment ? lookupShader()
                                              : testShader(name);
        });
        ResourceId planes, target;
        graph.addPass("planes", [&](FrameGraph::Builder& builder) {
            planes =
                builder.write(builder.create(TextureDesc{"planes", 2 * kTexels, kTexels, Format::RG32F}));
            return [planes](Backend& to) { to.draw({.program = &kPlanes, .targets = {&planes, 1}}); };
        });
        graph.addPass("lookup", [&](FrameGraph::Builder& builder) {
            builder.read(planes);
            target = builder.write(builder.create(TextureDesc{"passed", kPlaces, 1, Format::RGBA32F}));
            return [planes, target, radius, distance, caster](Backend& to) {
                const glm::vec4 ball(radius, distance, caster, 0.0f);
                const TextureBinding textures[] = {{0, planes, Sampling::Linear}};
                DrawCall call;
                call.program = &kLookup;
                call.targets = {&target, 1};
                call.textures = textures;
                call.uniforms = asUniforms(ball);
                to.draw(call);
            };
        });
        graph.keep(target);
        EXPECT_TRUE(runGraph().ok()) << backend->status().message();
        return read(target, 4);
    }
};

/// Share of a disc on the one side of a line. @param t distance of the line from its middle over its radius
double segment(double t)
{
    const double u = std::clamp(t, -1.0, 1.0);
    return (std::acos(u) - u * std::sqrt(1.0 - u * u)) / std::numbers::pi;
}

} // namespace

TEST_F(MediaPenumbra, theEdgeOfAShadowIsAsSoftAsTheGlowingBallIsWide)
{
    const float distance = 3.0f;
    for (const float caster : {0.0f, 2.0f}) { // of a ball of 1 m
        const double reach = 1.0 / double(std::max(caster, kNearest)) - 1.0 / double(distance);
        const std::vector<float> light = passed(1.0f, distance, caster);
        for (int i = 0; i < kPlaces; ++i) {
            const double angle = (i - 40) * std::numbers::pi / 180.0;
            EXPECT_NEAR(light[size_t(4 * i)], segment(std::tan(angle) / reach), 0.14) << i - 40;
        }
        EXPECT_GT(light[4 * 10], 0.99f);
        EXPECT_LT(light[4 * 70], 0.01f);
    }
}

TEST_F(MediaPenumbra, noSeamOfTheMapOfDirectionsIsSeen)
{
    device->setSourceOverride([](std::string_view name, std::string_view) -> std::optional<std::string> {
        return name == kSmoothPlanes.fragment ? smoothShader()
               : name == kAround.fragment     ? aroundShader()
                                              : testShader(name);
    });
    ResourceId planes, target;
    graph.addPass("planes", [&](FrameGraph::Builder& builder) {
        planes = builder.write(builder.create(TextureDesc{"planes", 2 * kTexels, kTexels, Format::RG32F}));
        return [planes](Backend& to) { to.draw({.program = &kSmoothPlanes, .targets = {&planes, 1}}); };
    });
    graph.addPass("around", [&](FrameGraph::Builder& builder) {
        builder.read(planes);
        target = builder.write(builder.create(TextureDesc{"passed", kPlaces, kRows, Format::RGBA32F}));
        return [planes, target](Backend& to) {
            const TextureBinding textures[] = {{0, planes, Sampling::Linear}};
            to.draw({.program = &kAround, .targets = {&target, 1}, .textures = textures});
        };
    });
    graph.keep(target);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    const std::vector<float> light = read(target, 4);
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kPlaces; ++x) {
            const glm::dvec3 d = around(x + 0.5, y + 0.5);
            EXPECT_NEAR(light[size_t(4 * (y * kPlaces + x))],
                        std::exp(-(1.0 + 0.5 * d.x - 0.25 * d.y + 0.125 * d.z)), 2e-3)
                << d.x << ' ' << d.y << ' ' << d.z;
        }
}

TEST_F(MediaPenumbra, aPointHasSharpShadows)
{
    const std::vector<float> light = passed(0.0f, 3.0f);
    for (int i = 0; i < kPlaces; ++i)
        if (std::abs(i - 40) > 2) {
            EXPECT_NEAR(light[size_t(4 * i)], i < 40 ? 1.0 : 0.0, 1e-4) << i - 40;
        }
}

} // namespace fx::render
