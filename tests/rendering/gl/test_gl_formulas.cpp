// The formula texts give the same numbers in GLSL as in C++.
#include "gl_test.h"

#include "shaders/formulas/formula.h"
#include "shaders/shader_library.h"

#include <array>

namespace fx::render {

namespace {

constexpr std::array<float, 4> kAlbedos = {0.3f, 0.9f, 0.99f, 1.0f};
constexpr std::array<float, 4> kMeanCosines = {0.0f, 0.4f, 0.7f, 0.9f};
constexpr std::array<float, 4> kCosines = {-1.0f, 0.0f, 0.5f, 1.0f};
constexpr std::array<float, 8> kColumns = {0.0f, 0.01f, 0.3f, 1.0f, 2.5f, 7.0f, 40.0f, 10000.0f};
constexpr int kShares = 8;
constexpr int kSize = 32; ///< [pixel] albedos by columns across, mean cosines by shares down

constexpr ProgramDesc kScattering = {"scattering", "fullscreen.vert", "scattering.frag", nullptr, nullptr};

/// The text of a formula without version and defines, which the first text brings.
std::string bare(std::string_view name)
{
    std::string text = shaders::assemble(name, "").value();
    while (text.starts_with('#'))
        text.erase(0, text.find('\n') + 1);
    return text;
}

std::string scatteringShader()
{
    return shaders::assemble("formulas/henyey_greenstein.fx.h", "").value() +
           bare("formulas/multiple_scattering.fx.h") + R"(
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 sky;
const float albedos[4] = float[](0.3, 0.9, 0.99, 1.0);
const float meanCosines[4] = float[](0.0, 0.4, 0.7, 0.9);
const float cosines[4] = float[](-1.0, 0.0, 0.5, 1.0);
const float columns[8] = float[](0.0, 0.01, 0.3, 1.0, 2.5, 7.0, 40.0, 10000.0);
void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    float albedo = albedos[at.x / 8];
    float column = columns[at.x % 8];
    float g = meanCosines[at.y / 8];
    float tau = float(at.y % 8) * 0.125 * column;
    for (int i = 0; i < 4; ++i) {
        light[i] = fxScatteredLight(albedo, g, cosines[i], tau, column);
        sky[i] = fxDiffuseSky(albedo, g, cosines[i], tau, column - tau);
    }
})";
}

} // namespace

class GlFormulas : public GlTest
{};

TEST_F(GlFormulas, scatteredLightIsThatOfCpp)
{
    device->setSourceOverride([](std::string_view name, std::string_view) -> std::optional<std::string> {
        return name == kScattering.fragment ? scatteringShader() : testShader(name);
    });
    std::array<ResourceId, 2> targets;
    graph.addPass("scattering", [&](FrameGraph::Builder& builder) {
        for (ResourceId& target : targets)
            target = builder.write(builder.create(TextureDesc{"light", kSize, kSize, Format::RGBA32F}));
        return [targets](Backend& to) { to.draw({.program = &kScattering, .targets = targets}); };
    });
    for (const ResourceId target : targets)
        graph.keep(target);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    const std::vector<float> light = read(targets[0], 4);
    const std::vector<float> sky = read(targets[1], 4);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            for (size_t i = 0; i < 4; ++i) {
                const float albedo = kAlbedos[size_t(x / 8)];
                const float g = kMeanCosines[size_t(y / 8)];
                const float column = kColumns[size_t(x % 8)];
                const float tau = float(y % kShares) * 0.125f * column;
                const size_t at = size_t(y * kSize + x) * 4 + i;
                const double lit = formula64::fxScatteredLight(albedo, g, kCosines[i], tau, column);
                ASSERT_NEAR(light[at], lit, 2e-4 + 1e-3 * lit)
                    << albedo << ' ' << g << ' ' << kCosines[i] << ' ' << tau << ' ' << column;
                ASSERT_NEAR(sky[at], formula64::fxDiffuseSky(albedo, g, kCosines[i], tau, column - tau), 1e-4)
                    << albedo << ' ' << g << ' ' << kCosines[i] << ' ' << tau << ' ' << column;
            }
}

} // namespace fx::render
