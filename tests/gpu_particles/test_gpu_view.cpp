// Pictures of emitters that the GPU computes, and what they cost a view.
#include "gpu_fixture.h"

#include "tests/rendering/gl/heap_counter.h"

#include <algorithm>

namespace fx::test {

namespace {

/// Mean of the red, green and blue channels.
double meanOf(const Picture& picture)
{
    double sum = 0;
    for (size_t i = 0; i < picture.texels.size(); ++i)
        sum += i % 4 < 3 ? double(picture.texels[i]) : 0.0;
    return sum / double(picture.texels.size() / 4 * 3);
}

double meanDifference(const Picture& a, const Picture& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.texels.size(); ++i)
        sum += double(std::abs(a.texels[i] - b.texels[i]));
    return sum / double(a.texels.size());
}

/// [1] of the texels that differ by more than `limit`.
double shareBeyond(double limit, const Picture& a, const Picture& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.texels.size(); ++i)
        count += double(std::abs(a.texels[i] - b.texels[i])) > limit ? 1 : 0;
    return double(count) / double(a.texels.size());
}

} // namespace

class GpuView : public GpuParticleTest
{
protected:
    void SetUp() override
    {
        GpuParticleTest::SetUp();
        makeTargets(128, 128);
        view_->settings().slices.enabled = false; // particles on the GPU cast no shadow, those of the CPU do
    }
    bool ran(std::string_view pass) const
    {
        const auto passes = view_->executedPasses();
        return std::find(passes.begin(), passes.end(), pass) != passes.end();
    }
};

TEST_F(GpuView, picturesAreThoseOfTheCpuForEveryPresetOfTheLibrary)
{
    size_t pictures = 0;
    for (const std::string& name : libraryNames()) {
        OneEffect cpu(schema_, load(libraryText(name, "cpu")), false);
        OneEffect gpu(schema_, load(libraryText(name, "gpu")), true);
        for (const double seconds : {0.12, 1.2, 2.3}) {
            for (OneEffect* effect : {&cpu, &gpu}) {
                effect->playTo(seconds - 0.5 / 60.0);
                effect->publish();
                effect->playTo(seconds + 0.5 / 60.0);
                effect->publish();
            }
            const base::FrameSnapshot& newer = gpu.publishedLast();
            if (!base::hasGpuParticles(newer))
                continue;
            const Picture a = draw(cpu.publishedLast(), cpu.older());
            const Picture b = draw(newer, gpu.older());
            const bool isInView = view_->statistics().gpuParticles > 0;
            EXPECT_EQ(ran("gpu particles"), isInView);
            // Groups that overlap do not take turns by distance: which is in front differs here and there.
            EXPECT_LE(meanDifference(a, b), 8e-3 * meanOf(a) + 1e-7) << name << " " << seconds;
            const double visible = 4e-2 * double(*std::max_element(a.texels.begin(), a.texels.end()));
            EXPECT_LE(shareBeyond(visible, a, b), 2e-3) << name << " " << seconds;
            pictures += isInView && meanOf(a) > 1e-6 ? 1 : 0;
        }
    }
    EXPECT_GE(pictures, 5u);
    EXPECT_TRUE(view_->canComputeParticles());
}

TEST_F(GpuView, withoutSuchEmittersCompilesNothingAndHoldsNothing)
{
    ASSERT_TRUE(view_->warmUp().ok());
    OneEffect cpu(schema_, load(libraryText("rain.fx.json", "cpu")), true);
    cpu.playTo(0.5);
    const uint32_t compiled = device_->programsCompiled();
    draw(cpu.publish(), nullptr);
    EXPECT_EQ(device_->programsCompiled(), compiled);
    EXPECT_FALSE(ran("gpu particles"));
    EXPECT_EQ(view_->statistics().gpuParticles, 0u);
    const uint64_t bytes = device_->bufferBytes();
    OneEffect gpu(schema_, load(libraryText("rain.fx.json", "gpu")), true);
    gpu.playTo(0.5);
    draw(gpu.publish(), nullptr);
    EXPECT_GT(device_->programsCompiled(), compiled);
    EXPECT_GT(device_->bufferBytes(), bytes);
}

TEST_F(GpuView, aRowIsComputedOnceAStepAndAWarmFrameAllocatesNothing)
{
    const std::string emitter = R"({"compute": "gpu", "shape": "sphere", "size": [1, 0, 0], "lifetime": 1,
        "speed": 2, "emission": {"rate": 2000}, "maxParticles": 2100, "appearance": {"kind": "sprite"}})";
    OneEffect gpu(schema_, load(R"({"version": 1, "emitters": [)" + emitter + ", " + emitter + "]}"), true);
    for (int i = 1; i <= 8; ++i) {
        gpu.playTo(3.0 + i / 60.0);
        gpu.publish();
        draw(gpu.publishedLast(), gpu.older());
    }
    const auto programs = device_->programsCompiled();
    gpu.playTo(3.0 + 9 / 60.0);
    gpu.publish();
    render::HeapCounter counter;
    const base::Status status = drawInto(gpu.publishedLast(), gpu.older());
    EXPECT_EQ(counter.stop(), 0);
    EXPECT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(device_->programsCompiled(), programs);
    const auto computes = [this] {
        const auto passes = view_->executedPasses();
        return std::count(passes.begin(), passes.end(), std::string_view("gpu particles"));
    };
    const auto first = computes();
    EXPECT_GT(first, 0) << "the older rows are there already";
    draw(gpu.publishedLast(), gpu.older()); // the same step again
    EXPECT_EQ(computes(), 0);
    EXPECT_TRUE(ran("gpu particle order")) << "the camera may have moved";
}

/// Steps are taken where a view looks, but what is seen does not depend on when it has looked before.
TEST_F(GpuView, steppedParticlesAreTheSameInEveryViewAndCostNoHeap)
{
    const std::string emitter =
        R"({"compute": "gpu", "shape": "sphere", "size": [1, 0, 0], "position": [0, 2, 0],
        "lifetime": 1, "speed": 2, "emission": {"rate": 1000}, "maxParticles": 1100, "forces": {"drag": 1,
        "curlStrength": 2, "bounce": 0.5}, "appearance": {"kind": "sprite", "luminance": 3000}})";
    OneEffect gpu(schema_, load(R"({"version": 1, "emitters": [)" + emitter + ", " + emitter + "]}"), true);
    const auto makeView = [this] {
        auto view =
            std::make_unique<render::ViewRenderer>(device_.get(), &schema_, std::pmr::get_default_resource());
        view->settings() = view_->settings();
        view->setAssets(&assets_);
        return view;
    };
    auto seldom = makeView();
    for (int i = 1; i <= 24; ++i) {
        gpu.playTo(1.0 + i / 60.0);
        gpu.publish();
        const Picture picture = draw(gpu.publishedLast(), gpu.older());
        EXPECT_TRUE(ran("gpu particles"));
        if (i % 8 != 0)
            continue;
        auto late = makeView();
        for (auto* other : {&seldom, &late}) {
            std::swap(view_, *other);
            EXPECT_EQ(maxDifference(draw(gpu.publishedLast(), gpu.older()), picture), 0.0) << i;
            std::swap(view_, *other);
        }
        EXPECT_GT(meanOf(picture), 0.0);
    }
    gpu.playTo(1.0 + 25 / 60.0);
    gpu.publish();
    render::HeapCounter counter;
    const base::Status status = drawInto(gpu.publishedLast(), gpu.older());
    EXPECT_EQ(counter.stop(), 0);
    EXPECT_TRUE(status.ok()) << status.message();
}

/// A driver that refuses the program: nothing of it is drawn, and nothing else fails.
TEST_F(GpuView, aRefusedProgramIsNoError)
{
    device_->setSourceOverride([](std::string_view name, std::string_view) -> std::optional<std::string> {
        if (name == "gpu_particles/gpu_particles.comp.glsl")
            return "#version 450 core\nthis is no program\n";
        return std::nullopt;
    });
    OneEffect gpu(schema_, load(libraryText("waterfall-mist.fx.json", "gpu")), true);
    gpu.playTo(2.0);
    EXPECT_TRUE(view_->canComputeParticles());
    const Picture picture = draw(gpu.publish(), nullptr);
    EXPECT_FALSE(view_->canComputeParticles());
    EXPECT_GT(meanOf(picture), 0.0) << "its mist is a medium";
    EXPECT_LE(maxDifference(draw(gpu.publishedLast(), nullptr), picture), 1e-6) << "until the scene knows";
    messages_ = std::make_unique<render::GlMessages>(*device_); // some drivers complain of the program
    gpu.world().setGpuParticles(false);                         // as a scene does now
    gpu.playTo(2.1);
    const Picture all = draw(gpu.publish(), nullptr);
    EXPECT_GT(meanDifference(all, picture), 1e-3 * meanOf(picture));
}

} // namespace fx::test
