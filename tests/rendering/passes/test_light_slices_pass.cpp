// Planes of optical depth as the GPU fills them, against those of the processor, and the quantile of the
// kernel.
#include "foundation/random/philox.h"
#include "rendering/lights/slices/light_list.h"
#include "rendering/lights/slices/light_slices_pass.h"
#include "rendering/lights/slices/slice_depths.h"
#include "shaders/formulas/formula.h"
#include "shaders/shader_library.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace fx;
using namespace fx::render;

namespace {

struct CasterBlock
{
    glm::vec4 centerRadius;
    glm::vec4 medium;
};

std::vector<MediumCaster> cloud(uint32_t count)
{
    std::vector<MediumCaster> casters;
    for (uint32_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(3, 0, i, base::RandomPurpose::Position);
        const auto v = base::randomUnit4(3, 0, i, base::RandomPurpose::Attributes);
        const float radius = 0.1f + 0.8f * v[0] * v[0];
        casters.push_back({{4.0f * u[0] - 2.0f, 3.0f * u[1] - 1.5f, 8.0f * u[2] - 4.0f},
                           radius,
                           0.1f * v[1] * radius * radius});
    }
    return casters;
}

class LightSlicesPassTest : public test::PostPass
{
protected:
    /// A view with the sun, one light before the media, one within them, and the sky.
    void light(const SliceResolution& resolution, std::span<const MediumCaster> casters)
    {
        settings_.lighting.sunDirection = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
        settings_.lighting.sunIlluminance = glm::vec3(1e5f);
        settings_.lighting.skyLuminance = glm::vec3(1e3f);
        settings_.slices.resolution = resolution;
        settings_.slices.castingPoints = 2;
        settings_.hostLights.count = 2;
        for (int i = 0; i < 2; ++i) {
            settings_.hostLights.lights[i].position =
                i == 0 ? glm::dvec3(6, 4, 2) : glm::dvec3(0.2, 0.1, 0.3);
            settings_.hostLights.lights[i].intensity = glm::vec3(100.0f);
            settings_.hostLights.lights[i].radius = i == 0 ? 0.0f : 0.2f;
        }
        list_.build({&settings_, glm::dvec3(0.0), {}, casters});
    }

    std::vector<float> drawn(std::span<const MediumCaster> casters)
    {
        std::vector<CasterBlock> blocks;
        for (const MediumCaster& caster : casters)
            blocks.push_back(
                {glm::vec4(caster.center, caster.radius), glm::vec4(caster.crossSection, 0, 0, 0)});
        graph_->begin();
        const std::vector<float> before(2 * size_t(list_.atlasWidth()) * size_t(list_.atlasHeight()), -1.0f);
        const ResourceId atlas = importTexels(list_.atlasWidth(), list_.atlasHeight(), Format::RG32F, before);
        const LightSlicesPass::Inputs in{importBytes(std::as_bytes(std::span(blocks))),
                                         importBytes(std::as_bytes(list_.stackBlocks())),
                                         atlas,
                                         uint32_t(blocks.size()),
                                         uint32_t(list_.stackBlocks().size()),
                                         list_.mostTexels(),
                                         list_.mostPlanes()};
        const ResourceId filled = LightSlicesPass::addTo(*graph_, in).atlas;
        execute(filled);
        return read(filled, 2);
    }

    /// Compares all planes; how many texels of the atlas belong to one.
    size_t compare(const std::vector<float>& atlas, std::span<const MediumCaster> casters)
    {
        size_t texels = 0;
        for (size_t i = 0; i < list_.stacks().size(); ++i) {
            SliceDepths depths(memory_);
            depths.build(list_.stacks()[i], casters);
            const glm::vec4& tiles = list_.stackBlocks()[i].tiles;
            const int side = int(tiles.z);
            double worst = 0.0, most = 0.0;
            for (int k = 0; k < int(tiles.w); ++k)
                for (int y = 0; y < side; ++y)
                    for (int x = 0; x < side; ++x) {
                        const int ax = int(tiles.x) + side * (k % kSliceTileColumns) + x;
                        const int ay = int(tiles.y) + side * (k / kSliceTileColumns) + y;
                        const size_t at = size_t(ay) * size_t(list_.atlasWidth()) + size_t(ax);
                        const float wanted = depths.at(k, x, y);
                        const float next = k + 1 < int(tiles.w) ? depths.at(k + 1, x, y) : wanted;
                        worst = std::max(worst, double(std::abs(atlas[2 * at] - wanted)));
                        worst = std::max(worst, double(std::abs(atlas[2 * at] + atlas[2 * at + 1] - next)));
                        most = std::max(most, double(wanted));
                        ++texels;
                    }
            EXPECT_GT(most, 0.05) << i;
            EXPECT_LE(worst, 1e-5 * most)
                << "stack " << i << ", " << side << " texels, " << tiles.w << " planes";
        }
        return texels;
    }

    ViewSettings settings_;
    LightList list_{memory_};
};

} // namespace

TEST_F(LightSlicesPassTest, planesAreThoseOfTheProcessor)
{
    const auto casters = cloud(1000);
    for (const SliceResolution& resolution : {SliceResolution{8, 3}, {24, 7}, {64, 32}, {128, 9}}) {
        light(resolution, casters);
        const std::vector<float> atlas = drawn(casters);
        const size_t texels = compare(atlas, casters);
        const auto untouched = size_t(std::count(atlas.begin(), atlas.end(), -1.0f));
        EXPECT_EQ(untouched + 2 * texels, atlas.size()) << "nothing beside the planes is written";
    }
}

TEST_F(LightSlicesPassTest, farBallsAndCoincidentOnesAreIntegratedAsWell)
{
    std::vector<MediumCaster> casters(130, {{900.0f, 20.0f, -300.0f}, 400.0f, 1000.0f});
    casters.push_back({{1000.0f, 20.0f, -300.0f}, 0.01f, 0.0f});
    light({32, 16}, casters);
    (void)compare(drawn(casters), casters);
}

TEST_F(LightSlicesPassTest, manyBallsInOneColumnAllCount)
{
    std::vector<MediumCaster> casters; // more turns of a loop than software renderers take
    for (uint32_t i = 0; i < 10000; ++i) {
        const auto u = base::randomUnit4(5, 0, i, base::RandomPurpose::Position);
        casters.push_back({{u[0], u[1], u[2]}, 0.6f, 5e-4f * u[3]});
    }
    light({64, 64}, casters);
    (void)compare(drawn(casters), casters);
}

TEST_F(LightSlicesPassTest, equalInputsGiveEqualBits)
{
    const auto casters = cloud(1000);
    light({64, 16}, casters);
    const std::vector<float> first = drawn(casters);
    EXPECT_EQ(test::differentBits(first, drawn(casters)), 0u);
}

TEST_F(LightSlicesPassTest, theQuantileOfTheKernelIsThatOfTheProcessor)
{
    constexpr int kCount = 512;
    static constexpr ProgramDesc kProgram{"quantile", nullptr, nullptr, "test_quantile.comp", nullptr};
    device_->setSourceOverride([](std::string_view name, std::string_view) -> std::optional<std::string> {
        if (name != "test_quantile.comp")
            return std::nullopt;
        return *shaders::assemble("formulas/kernel_quantile.fx.h", "") + R"(
layout(local_size_x = 64) in;
layout(r32f, binding = 0) uniform writeonly image2D result;
void main()
{
    int i = int(gl_GlobalInvocationID.x);
    imageStore(result, ivec2(i, 0), vec4(fxKernelQuantile((float(i) - 6.0) / 500.0)));
})";
    });
    graph_->begin();
    ResourceId result = importScalar(kCount, 1, std::vector<float>(kCount, 9.0f));
    graph_->addPass("quantile", [&](FrameGraph::Builder& builder) {
        result = builder.write(result);
        return [result](Backend& backend) {
            const ImageBinding images[] = {{0, result}};
            DispatchCall call;
            call.program = &kProgram;
            call.images = images;
            call.groups[0] = kCount / 64;
            backend.dispatch(call);
        };
    });
    execute(result);
    const std::vector<float> got = read(result, 1);
    for (int i = 0; i < kCount; ++i) // from below 0 to above 1
        ASSERT_NEAR(got[size_t(i)], formula::fxKernelQuantile((float(i) - 6.0f) / 500.0f), 2e-4f) << i;
    device_->setSourceOverride({});
}
