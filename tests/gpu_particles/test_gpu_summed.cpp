// Cards that the GPU computes, in the compositions that sum media up: as thick as their opacity says, and as
// those of the CPU.
#include "gpu_fixture.h"

#include <algorithm>
#include <cmath>

namespace fx::test {

namespace {

using render::Composition;

class GpuSummed : public GpuParticleTest, public testing::WithParamInterface<Composition>
{
protected:
    void SetUp() override
    {
        GpuParticleTest::SetUp();
        makeTargets(64, 64);
        view_->settings().slices.enabled = false; // particles on the GPU cast no shadow, those of the CPU do
        view_->settings().voxels = 64;
    }
    Picture drawn(const OneEffect& effect, Composition composition)
    {
        view_->settings().composition = composition;
        return draw(effect.publishedLast(), effect.older());
    }
    static void play(OneEffect& effect, double seconds)
    {
        effect.playTo(seconds - 0.5 / 60.0);
        effect.publish();
        effect.playTo(seconds + 0.5 / 60.0);
        effect.publish();
    }
    /// `count` sprites in one place that stay there.
    std::shared_ptr<const sim::EffectDef> sprites(const char* compute, int count, double opacity,
                                                  const std::string& blend = "alpha")
    {
        const std::string births = std::to_string(count);
        return load(std::string(R"({"version": 1, "ground": false, "emitters": [{"compute": ")") + compute +
                    R"(", "position": [0, 2, 0], "lifetime": 10, "speed": 0, "radius": 1,
                    "forces": {"gravity": 0}, "emission": {"bursts": [{"time": 0, "count": )" +
                    births + R"(}]}, "maxParticles": )" + births +
                    R"(, "appearance": {"kind": "sprite", "luminance": 2000, "lit": 0, "opacity": )" +
                    std::to_string(opacity) + R"(, "blend": ")" + blend + R"("}}]})");
    }
};

/// Mean of red, green and blue.
double meanOf(const Picture& picture)
{
    double sum = 0;
    for (size_t i = 0; i < picture.texels.size(); ++i)
        sum += i % 4 < 3 ? double(picture.texels[i]) : 0.0;
    return sum / double(picture.texels.size() / 4 * 3);
}

} // namespace

TEST_P(GpuSummed, cardsThatCoverAreAsThickAsTheirOpacitySays)
{
    for (const int count : {1, 7})
        for (const double opacity : {0.05, 0.5, 0.97}) {
            OneEffect gpu(schema_, sprites("gpu", count, opacity), true);
            play(gpu, 0.5);
            ASSERT_TRUE(base::hasGpuParticles(gpu.publishedLast()));
            const Picture summed = drawn(gpu, GetParam());
            const Picture sorted = drawn(gpu, Composition::Sorted);
            EXPECT_GT(view_->statistics().gpuParticles, 0u);
            const double brightest = double(*std::max_element(sorted.texels.begin(), sorted.texels.end()));
            EXPECT_GT(meanOf(sorted), 0.0);
            // light of one luminance and place: the sum of depths is the product of what passes
            EXPECT_LT(maxDifference(summed, sorted), 2e-3 * brightest) << count << " of " << opacity;
        }
}

TEST_P(GpuSummed, cardsThatAddEmitOnly)
{
    OneEffect gpu(schema_, sprites("gpu", 5, 0.5, "additive"), true);
    play(gpu, 0.5);
    const Picture sorted = drawn(gpu, Composition::Sorted);
    EXPECT_GT(meanOf(sorted), 0.0);
    const double brightest = double(*std::max_element(sorted.texels.begin(), sorted.texels.end()));
    EXPECT_LT(maxDifference(drawn(gpu, GetParam()), sorted), 1e-4 * brightest);
}

TEST_P(GpuSummed, picturesAreThoseOfTheCpu)
{
    size_t pictures = 0;
    for (const char* name : {"magic-trail.fx.json", "rain.fx.json", "waterfall-mist.fx.json"}) {
        OneEffect cpu(schema_, load(libraryText(name, "cpu")), false);
        OneEffect gpu(schema_, load(libraryText(name, "gpu")), true);
        play(cpu, 0.4);
        play(gpu, 0.4);
        if (!base::hasGpuParticles(gpu.publishedLast()))
            continue; // not yet
        const Picture a = drawn(cpu, GetParam()), b = drawn(gpu, GetParam());
        double sum = 0.0;
        for (size_t i = 0; i < a.texels.size(); ++i)
            sum += double(std::abs(a.texels[i] - b.texels[i]));
        EXPECT_LE(sum / double(a.texels.size()), 2e-3 * meanOf(a) + 1e-7) << name << ": a sum has no order";
        EXPECT_EQ(view_->statistics().spilledCards, 0u);
        pictures += view_->statistics().gpuParticles > 0 && meanOf(a) > 1e-6 ? 1 : 0;
    }
    EXPECT_GE(pictures, 1u);
}

TEST_P(GpuSummed, cardsBehindAMediumAreHiddenByIt)
{
    const auto light = [&](double z) {
        const std::string text =
            R"({"version": 1, "ground": false, "emitters": [
            {"layer": "smoke", "position": [0, 2, 0], "emission": {"bursts": [{"time": 0, "count": 20}]},
             "lifetime": 10, "speed": 0, "radius": 1.5, "opticalDepth": 0.15, "forces": {"gravity": 0},
             "shape": "sphere", "size": 0.3, "temperature": 300, "albedoOverLife": [0, 0, 0]},
            {"compute": "gpu", "lifetime": 10, "speed": 0, "radius": 0.5,
             "emission": {"bursts": [{"time": 0, "count": 1}]}, "maxParticles": 1, "forces": {"gravity": 0},
             "appearance": {"kind": "sprite", "opacity": 0.9, "luminance": 20000, "lit": 0},
             "position": [0, 2, )" +
            std::to_string(z) + "]}]}";
        OneEffect effect(schema_, load(text), true);
        play(effect, 0.5);
        return meanOf(drawn(effect, GetParam()));
    };
    const double before = light(3.0), within = light(0.0), behind = light(-3.0);
    EXPECT_LT(within, 0.9 * before);
    EXPECT_LT(behind, 0.9 * within);
    EXPECT_GT(behind, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Compositions, GpuSummed, testing::Values(Composition::Slabs, Composition::Volume),
                         [](const auto& one) {
                             return one.param == Composition::Slabs ? "Slabs" : "Volume";
                         });

} // namespace fx::test
