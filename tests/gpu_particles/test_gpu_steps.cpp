// Emitters whose motion has no closed form: modules, steps, histories and ways back to the CPU.
#include "gpu_fixture.h"
#include "module_cases.h"

#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/forces/force_ops.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::test {

namespace column = base::particle_column;

namespace {

constexpr float kBound = 2e-4f; ///< [m] for what is within 5 m, see docs/howto/gpu-particles.md

/// @return living ones; how far apart they are in `outWorst` [m], how many are not equal in `outDifferent`
size_t compare(const Rows& cpu, const Rows& gpu, float& outWorst, size_t& outDifferent)
{
    size_t living = 0;
    for (size_t i = 0; i < gpu.count(); ++i) {
        const bool isAlive = i < cpu.count() && cpu.isAlive(i);
        EXPECT_EQ(gpu.isAlive(i), isAlive) << "row " << i;
        if (!isAlive || !gpu.isAlive(i))
            continue;
        ++living;
        bool same = true;
        for (const size_t c : {column::PositionX, column::PositionY, column::PositionZ}) {
            const float difference = std::abs(cpu.columns[c][i] - gpu.columns[c][i]);
            outWorst = std::max(outWorst, std::isfinite(difference) ? difference : 1e9f);
            same = same && difference == 0.0f;
        }
        for (const size_t c : {column::VelocityX, column::VelocityY, column::VelocityZ})
            same = same && (cpu.columns[c].empty() || cpu.columns[c][i] == gpu.columns[c][i]);
        outDifferent += same ? 0 : 1;
    }
    return living;
}

bool areEqual(const Rows& a, const Rows& b)
{
    return std::ranges::equal(a.columns, b.columns) && std::ranges::equal(a.color, b.color);
}

} // namespace

class GpuSteps : public GpuParticleTest
{
protected:
    void expectEqual(const base::SnapshotGroup& a, const base::SnapshotGroup& b, size_t least)
    {
        ASSERT_TRUE(b.program());
        const Rows cpu = rowsOf(a), gpu = computed(b);
        float worst = 0;
        size_t different = 0;
        EXPECT_GT(compare(cpu, gpu, worst, different), least);
        EXPECT_LE(worst, kBound) << different << " are not equal";
        different_ += different;
        const base::Bounds &seen = a.info().bounds, &possible = b.info().bounds;
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(seen.min[k], possible.min[k]);
            EXPECT_LE(seen.max[k], possible.max[k]);
        }
    }
    size_t different_ = 0;
};

TEST_F(GpuSteps, moveAsOnTheCpuWithEveryModule)
{
    for (const ModuleCase& one : kModuleCases) {
        SCOPED_TRACE(one.name);
        OneEffect cpu(schema_, load(steppedText(one.members, "cpu")), false);
        OneEffect gpu(schema_, load(steppedText(one.members, "gpu")), true);
        states_ = makeStates();
        different_ = 0;
        for (const double seconds : {0.1, 0.9, 0.95, 2.5}) {
            cpu.playTo(seconds);
            gpu.playTo(seconds);
            expectEqual(cpu.publish().group(0), gpu.publish().group(0), 30);
        }
        const bool isSoftware = device_->limits().renderer.find("llvmpipe") != std::string::npos;
        EXPECT_EQ(isSoftware ? different_ : 0u, 0u) << "this renderer computes as the CPU does, bit for bit";
    }
}

TEST_F(GpuSteps, moveInAVectorFieldAsOnTheCpu)
{
    auto grid = std::make_shared<sim::FieldGrid>();
    grid->nodes = {5, 4, 6};
    grid->channels = 3;
    grid->low = glm::vec3(-2.0f, 0.0f, -2.0f);
    grid->cell = glm::vec3(0.8f, 1.1f, 0.7f);
    for (size_t i = 0; i < 3 * grid->count(); ++i)
        grid->values.push_back(std::sin(float(i) * 1.7f) * 3.0f);
    for (const bool isAcceleration : {false, true}) {
        const auto make = [&](const char* compute) {
            auto effect = load(steppedText(R"("forces": {"drag": 1})", compute));
            auto& def =
                const_cast<sim::EmitterDef&>(dynamic_cast<const sim::EmitterDef&>(*effect->solvers[0]));
            def.modules.push_back(
                sim::makeVectorFieldOp({grid, {0.1f, 0.2f, 0.0f}, 1.2f, 0.9f, isAcceleration}));
            return effect;
        };
        OneEffect cpu(schema_, make("cpu"), false), gpu(schema_, make("gpu"), true);
        for (const double seconds : {0.4, 2.0}) {
            cpu.playTo(seconds);
            gpu.playTo(seconds);
            expectEqual(cpu.publish().group(0), gpu.publish().group(0), 100);
        }
    }
}

/// A view that looks at every step, one that looks now and then, one that has just come.
TEST_F(GpuSteps, areTheSameForEveryViewWheneverItLooks)
{
    const char* const members = kModuleCases[std::size(kModuleCases) - 1].members;
    OneEffect gpu(schema_, load(steppedText(members, "gpu")), true);
    auto always = makeStates(), seldom = makeStates();
    size_t resumed = 0;
    for (int i = 1; i <= 60; ++i) {
        gpu.playTo(1.0 + i / 60.0);
        const base::SnapshotGroup& group = gpu.publish().group(0);
        const Rows rows = computed(group, *always);
        resumed += steps_ == 1 ? 1 : 0;
        if (i % 17 != 0)
            continue;
        EXPECT_TRUE(areEqual(rows, computed(group, *seldom))) << i;
        EXPECT_GE(steps_, 17u);
        auto late = makeStates();
        EXPECT_TRUE(areEqual(rows, computed(group, *late))) << i;
        EXPECT_GE(steps_, uint32_t(std::min(60 + i, 96))) << "all steps of the longest life";
        EXPECT_TRUE(areEqual(rows, computed(group, *late))) << "the same moment again";
        EXPECT_EQ(steps_, 0u);
    }
    EXPECT_EQ(resumed, 59u) << "each but the first goes on from the last";
}

/// More steps than one dispatch takes.
TEST_F(GpuSteps, areTakenInPartsWhereThereAreMany)
{
    const char* const births = R"("lifetime": 3, "maxParticles": 2000, "emission": {"rate": 500})";
    OneEffect gpu(schema_, load(steppedText(R"("forces": {"drag": 1, "curlStrength": 1})", "gpu", births)),
                  true);
    auto always = makeStates();
    for (int i = 1; i <= 7; ++i) {
        gpu.playTo(i * 0.5);
        gpu.publish();
        const Rows rows = computed(gpu.publishedLast().group(0), *always);
        if (i < 7)
            continue;
        auto late = makeStates();
        EXPECT_TRUE(areEqual(rows, computed(gpu.publishedLast().group(0), *late)));
        EXPECT_GT(steps_, 150u);
    }
}

TEST_F(GpuSteps, followTheHostBackInTimeAndIntoOtherWeather)
{
    const char* const members = R"("forces": {"drag": 2, "curlStrength": 1, "bounce": 0.5})";
    const auto breezeOf = [](int i) {
        sim::InstanceParameters parameters;
        parameters.wind = {float(i % 3), 0.0f, 1.0f - float(i % 2)};
        parameters.intensity = i % 4 == 0 ? 0.5f : 1.0f;
        return parameters;
    };
    OneEffect cpu(schema_, load(steppedText(members, "cpu")), false);
    OneEffect gpu(schema_, load(steppedText(members, "gpu")), true);
    for (int i = 1; i <= 8; ++i) {
        for (OneEffect* effect : {&cpu, &gpu}) {
            effect->playTo(0.3 * i, i % 2 == 0 ? 1.0 / 60.0 : 1.0 / 48.0);
            effect->world().setParameters(effect->slot(), breezeOf(i));
        }
        expectEqual(cpu.publish().group(0), gpu.publish().group(0), 40);
    }
    for (OneEffect* effect : {&cpu, &gpu}) { // the same moment, but with this wind from the start
        effect->seekTo(1.0);
        effect->seekTo(2.4);
        effect->publish();
    }
    ASSERT_TRUE(gpu.publishedLast().group(0).program());
    expectEqual(cpu.publishedLast().group(0), gpu.publishedLast().group(0), 40);
    EXPECT_GT(steps_, 60u) << "nothing of the other history counts";
}

/// The same emitter at the same time, but in another wind: nothing tells them apart but what has happened.
TEST_F(GpuSteps, neverGoOnFromAnotherHistory)
{
    const char* const members = R"("forces": {"drag": 2, "curlStrength": 1})";
    const auto effect = load(steppedText(members, "gpu"));
    OneEffect calm(schema_, effect, true), windy(schema_, effect, true);
    OneEffect cpu(schema_, load(steppedText(members, "cpu")), false);
    sim::InstanceParameters breeze;
    breeze.wind = {2.0f, 0.0f, 0.0f};
    for (OneEffect* one : {&windy, &cpu})
        one->world().setParameters(one->slot(), breeze);
    for (OneEffect* one : {&calm, &windy, &cpu}) {
        one->playTo(2.0);
        one->publish();
    }
    ASSERT_EQ(calm.publishedLast().group(0).program(), windy.publishedLast().group(0).program());
    computed(calm.publishedLast().group(0));
    expectEqual(cpu.publishedLast().group(0), windy.publishedLast().group(0), 100);
    EXPECT_GT(steps_, 90u);
}

void expectSameRows(const base::SnapshotGroup& a, const base::SnapshotGroup& b)
{
    ASSERT_EQ(a.count(), b.count());
    for (size_t c = 0; c < column::Count; ++c) {
        ASSERT_EQ(a.has(c), b.has(c));
        if (c == column::Color)
            EXPECT_TRUE(std::ranges::equal(a.column64(c), b.column64(c)));
        else
            EXPECT_TRUE(std::ranges::equal(a.column(c), b.column(c))) << "column " << c;
    }
}

TEST_F(GpuSteps, comeBackToTheCpuBitForBit)
{
    for (const ModuleCase& one : kModuleCases) {
        SCOPED_TRACE(one.name);
        OneEffect cpu(schema_, load(steppedText(one.members, "cpu")), false);
        OneEffect gpu(schema_, load(steppedText(one.members, "gpu")), true);
        cpu.playTo(1.9);
        gpu.playTo(1.9);
        ASSERT_TRUE(gpu.publish().group(0).program());
        const auto replayed = base::replayOnCpu(gpu.publishedLast(), std::pmr::get_default_resource());
        expectSameRows(cpu.publish().group(0), replayed->group(0));
        EXPECT_EQ(cpu.world().hash({{cpu.slot()}}), gpu.world().hash({{gpu.slot()}}));
        gpu.world().setGpuParticles(false);
        cpu.playTo(2.2);
        gpu.playTo(2.2);
        ASSERT_FALSE(gpu.publish().group(0).program());
        expectSameRows(cpu.publish().group(0), gpu.publishedLast().group(0));
        EXPECT_EQ(cpu.world().hash({{cpu.slot()}}), gpu.world().hash({{gpu.slot()}}));
    }
}

/// What only the host knows is met on the CPU, for as long as there is anything.
TEST_F(GpuSteps, leaveTheGpuWhereTheHostHasGeometry)
{
    const char* const members = R"("collisions": [{"shape": "hook", "bounce": 0.5}])";
    OneEffect cpu(schema_, load(steppedText(members, "cpu")), false);
    OneEffect gpu(schema_, load(steppedText(members, "gpu")), true);
    const auto meet = [](void*, const double from[3], const double to[3], float* outShare,
                         float outNormal[3]) {
        if (!(from[1] >= 2.0 && to[1] < 2.0))
            return 0;
        *outShare = float((from[1] - 2.0) / (from[1] - to[1]));
        outNormal[0] = outNormal[2] = 0.0f;
        outNormal[1] = 1.0f;
        return 1;
    };
    size_t computed = 0;
    for (int i = 1; i <= 14; ++i) {
        for (OneEffect* effect : {&cpu, &gpu}) {
            effect->world().setContact(i >= 5 && i < 7 ? sim::HostContact{nullptr, meet}
                                                       : sim::HostContact{});
            effect->playTo(0.3 * i);
            effect->publish();
        }
        const base::SnapshotGroup& group = gpu.publishedLast().group(0);
        computed += group.program() ? 1 : 0;
        if (group.program())
            expectEqual(cpu.publishedLast().group(0), group, 40);
        else
            expectSameRows(cpu.publishedLast().group(0), group);
        EXPECT_EQ(group.program() != nullptr, i < 5 || i > 11) << i;
    }
    EXPECT_EQ(computed, 7u);
}

TEST_F(GpuSteps, endTheirInstanceWhenTheCpuWould)
{
    const char* const births = R"("lifetime": {"min": 0.4, "max": 1.6}, "emission": {"bursts": [{"time": 0,
        "count": 300}]})";
    const char* const members = R"("collisions": [{"shape": "plane", "response": "kill"}])";
    OneEffect cpu(schema_, load(steppedText(members, "cpu", births)), false);
    OneEffect gpu(schema_, load(steppedText(members, "gpu", births)), true);
    for (int i = 1; i < 110; ++i) {
        cpu.playTo(i / 60.0);
        gpu.playTo(i / 60.0);
        const base::Ticks now = i * OneEffect::kStep;
        ASSERT_EQ(cpu.world().finished(cpu.slot(), now), gpu.world().finished(gpu.slot(), now)) << i;
    }
    EXPECT_TRUE(cpu.world().finished(cpu.slot(), 109 * OneEffect::kStep));
}

} // namespace fx::test
