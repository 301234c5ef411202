// Rows that the GPU computes against those of the CPU, for every preset of the library.
#include "gpu_compare.h"
#include "gpu_fixture.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace fx::test {

class GpuRows : public GpuParticleTest
{};

TEST_F(GpuRows, areThoseOfTheCpuForEveryPresetOfTheLibrary)
{
    std::set<std::string> presets;
    size_t groups = 0, living = 0, stepped = 0;
    const bool isSoftware = device_->limits().renderer.find("llvmpipe") != std::string::npos;
    for (const std::string& name : libraryNames()) {
        OneEffect cpu(schema_, load(libraryText(name, "cpu")), false);
        OneEffect gpu(schema_, load(libraryText(name, "gpu")), true);
        for (const double seconds : {0.04, 0.1, 0.9, 2.1, 4.4, 7.7}) {
            cpu.playTo(seconds);
            gpu.playTo(seconds);
            const base::FrameSnapshot& a = cpu.publish();
            const base::FrameSnapshot& b = gpu.publish();
            ASSERT_EQ(a.groupCount(), b.groupCount());
            for (size_t g = 0; g < a.groupCount(); ++g) {
                if (!b.group(g).program())
                    continue;
                SCOPED_TRACE(name + " group " + std::to_string(g) + " at " + std::to_string(seconds));
                const Rows cpuRows = rowsOf(a.group(g)), gpuRows = computed(b.group(g));
                living += compare(cpuRows, gpuRows);
                EXPECT_EQ(isSoftware ? countDifferent(cpuRows, gpuRows) : 0, 0u);
                presets.insert(name);
                stepped += b.group(g).program()->features.steps ? 1 : 0;
                expectInside(a.group(g).info().bounds, b.group(g).info().bounds);
                ++groups;
            }
        }
    }
    EXPECT_GT(groups, 60u);
    EXPECT_GT(stepped, 15u);
    const std::set<std::string> known{
        "black-powder.fx.json", "debris.fx.json",         "explosion.fx.json",     "grenade.fx.json",
        "magic-trail.fx.json",  "mushroom-cloud.fx.json", "muzzle-flash.fx.json",  "petrol-fireball.fx.json",
        "rain.fx.json",         "snow.fx.json",           "waterfall-mist.fx.json"};
    EXPECT_EQ(presets, known);
    EXPECT_GT(living, 20'000u);
}

/// One emitter with whatever `members` add or change.
std::string emitterText(const std::string& members, const char* compute)
{
    return std::string(R"({"version": 1, "emitters": [{"compute": ")") + compute +
           R"(", "shape": "cone", "angleDegrees": 30, "size": [0.2, 0, 0], "speed": {"min": 2, "max": 5},
           "lifetime": {"min": 0.4, "max": 1.6}, "radius": {"min": 0.02, "max": 0.05}, "maxParticles": 2000,
           "appearance": {"kind": "sprite", "order": "none"}, "forces": {"gravity": 1, "drag": 0.7})" +
           members + "}]}";
}

TEST_F(GpuRows, followWindAndTurningAndBurstsAsTheCpu)
{
    const std::string members = R"(, "emission": {"rate": 300, "bursts": [
        {"time": 0.2, "count": 100, "cycles": 0, "interval": 0.17}], "duration": 60})";
    OneEffect cpu(schema_, load(emitterText(members, "cpu")), false);
    OneEffect gpu(schema_, load(emitterText(members, "gpu")), true);
    size_t living = 0;
    for (int i = 1; i <= 12; ++i) {
        for (OneEffect* effect : {&cpu, &gpu}) {
            effect->playTo(0.21 * i, 1.0 / 60.0);
            sim::InstanceParameters parameters;
            parameters.wind = {float(i % 3), 0.0f, 2.0f - float(i % 5)};
            parameters.intensity = i % 4 == 0 ? 0.5f : 1.0f;
            effect->world().setParameters(effect->slot(), parameters);
        }
        const base::SnapshotGroup& group = gpu.publish().group(0);
        ASSERT_TRUE(group.program()) << i;
        living += compare(rowsOf(cpu.publish().group(0)), computed(group));
    }
    EXPECT_GT(living, 5000u);
}

TEST_F(GpuRows, doNotDependOnStepsOrJumps)
{
    const std::string members = R"(, "emission": {"rate": 777})";
    OneEffect cpu(schema_, load(emitterText(members, "cpu")), false);
    OneEffect gpu(schema_, load(emitterText(members, "gpu")), true);
    cpu.playTo(3.0);
    gpu.playTo(3.0, 1.0 / 48.0);
    ASSERT_TRUE(gpu.publish().group(0).program());
    EXPECT_GT(compare(rowsOf(cpu.publish().group(0)), computed(gpu.publish().group(0))), 500u);
    OneEffect away(schema_, load(emitterText(members, "gpu")), true);
    away.playTo(3.0 - 2.0 / 60.0);
    away.seekTo(1.0);
    away.seekTo(3.0 - 2.0 / 60.0);
    away.playTo(3.0);
    ASSERT_TRUE(away.publish().group(0).program());
    EXPECT_GT(compare(rowsOf(cpu.publish().group(0)), computed(away.publish().group(0))), 500u);
}

/// Everything of a group of particles but its flags.
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
    EXPECT_EQ(a.info().bounds.min, b.info().bounds.min);
    EXPECT_EQ(a.info().bounds.max, b.info().bounds.max);
    EXPECT_TRUE(std::ranges::equal(a.constants(), b.constants()));
}

TEST_F(GpuRows, areReplayedOnTheCpuBitForBit)
{
    for (const std::string& name : libraryNames()) {
        OneEffect cpu(schema_, load(libraryText(name, "cpu")), false);
        OneEffect gpu(schema_, load(libraryText(name, "gpu")), true);
        for (const double seconds : {0.3, 1.3, 2.9}) {
            SCOPED_TRACE(name + " at " + std::to_string(seconds));
            cpu.playTo(seconds);
            gpu.playTo(seconds);
            const base::FrameSnapshot& a = cpu.publish();
            const auto b = base::replayOnCpu(gpu.publish(), std::pmr::get_default_resource());
            ASSERT_EQ(a.groupCount(), b->groupCount());
            for (size_t g = 0; g < a.groupCount(); ++g)
                if (a.group(g).info().kind == schema_.find("particle"))
                    expectSameRows(a.group(g), b->group(g));
        }
    }
}

TEST_F(GpuRows, comeBackBitForBitWhenTheyAreNotWantedAnyMore)
{
    const std::string members = R"(, "emission": {"rate": 500, "bursts": [{"time": 0.5, "count": 200}]})";
    OneEffect cpu(schema_, load(emitterText(members, "cpu")), false);
    OneEffect gpu(schema_, load(emitterText(members, "gpu")), true);
    for (int i = 1; i <= 6; ++i) {
        for (OneEffect* effect : {&cpu, &gpu}) {
            effect->playTo(0.4 * i);
            sim::InstanceParameters parameters;
            parameters.wind = {float(i), 0.0f, 0.0f};
            effect->world().setParameters(effect->slot(), parameters);
        }
        EXPECT_EQ(cpu.world().hash({{cpu.slot()}}), gpu.world().hash({{gpu.slot()}})) << i;
    }
    EXPECT_TRUE(gpu.publish().group(0).program());
    gpu.world().setGpuParticles(false);
    cpu.playTo(2.5);
    gpu.playTo(2.5);
    const base::FrameSnapshot& b = gpu.publish();
    ASSERT_FALSE(b.group(0).program());
    expectSameRows(cpu.publish().group(0), b.group(0));
    EXPECT_EQ(cpu.world().hash({{cpu.slot()}}), gpu.world().hash({{gpu.slot()}}));
}

TEST_F(GpuRows, stayOnTheCpuWhileBirthsMayBeDropped)
{
    const std::string members = R"(, "emission": {"rate": 200, "bursts": [{"time": 2.5, "count": 3000}]})";
    OneEffect cpu(schema_, load(emitterText(members, "cpu")), false);
    OneEffect gpu(schema_, load(emitterText(members, "gpu")), true);
    gpu.playTo(2.4);
    EXPECT_TRUE(gpu.publish().group(0).program());
    for (const double seconds : {2.55, 3.3}) { // some of the burst find no room
        gpu.playTo(seconds);
        cpu.playTo(seconds);
        const base::FrameSnapshot& b = gpu.publish();
        ASSERT_FALSE(b.group(0).program()) << seconds;
        expectSameRows(cpu.publish().group(0), b.group(0));
    }
    gpu.playTo(6.0);
    EXPECT_TRUE(gpu.publish().group(0).program()) << "they are all gone";
    cpu.playTo(6.0);
    EXPECT_GT(compare(rowsOf(cpu.publish().group(0)), computed(gpu.publish().group(0))), 100u);
}

TEST_F(GpuRows, endTheirInstanceWhenTheCpuWould)
{
    const std::string members = R"(, "emission": {"bursts": [{"time": 0, "count": 300}]})";
    OneEffect cpu(schema_, load(emitterText(members, "cpu")), false);
    OneEffect gpu(schema_, load(emitterText(members, "gpu")), true);
    for (int i = 1; i < 120; ++i) {
        cpu.playTo(i / 60.0);
        gpu.playTo(i / 60.0);
        const base::Ticks now = i * OneEffect::kStep;
        ASSERT_EQ(cpu.world().finished(cpu.slot(), now), gpu.world().finished(gpu.slot(), now)) << i;
    }
    EXPECT_TRUE(gpu.world().finished(gpu.slot(), 119 * OneEffect::kStep));
}

/// The four billionth birth of a run: all 96 bits of its fractions count.
TEST_F(GpuRows, haveExactAgesHoweverManyWereBornBefore)
{
    OneEffect effect(schema_, load(emitterText(R"(, "emission": {"rate": 777})", "gpu")), true);
    effect.playTo(2.0);
    const base::SnapshotGroup& group = effect.publish().group(0);
    ASSERT_TRUE(group.program());
    base::FrameSnapshot late(&schema_, std::pmr::get_default_resource());
    late.begin(0, 1);
    base::SnapshotGroup& changed = late.addGroup(group.info().kind, group.count());
    changed.editInfo() = group.info();
    changed.setProgram(group.program());
    std::ranges::copy(group.column64(0), changed.editColumn64(0).begin());
    auto* const words = reinterpret_cast<std::byte*>(changed.editColumn64(0).data());
    base::GpuParticleMoment moment;
    std::memcpy(&moment, words, sizeof moment);
    ASSERT_EQ(moment.runs, 1u);
    size_t living = 0;
    for (uint32_t k = 0; k < 8; ++k) {
        base::GpuBirthRun run{};
        run.reach = 0xFFFFFF00u - 977u * k;
        run.stride = 352'800;
        for (uint32_t w = 0; w < 3; ++w) {
            run.fraction[w] = 0xFFFFFFFFu - 12'345u * k * (w + 1);
            run.rest[w] = 0xFFFFFFFFu - (k >> w);
        }
        run.age = 1000 - base::gpuBirthAge(run, run.reach - 1);
        std::memcpy(words + sizeof moment, &run, sizeof run);
        const Rows rows = computed(changed);
        for (uint32_t row = 0; row < rows.count(); ++row) {
            if (!rows.isAlive(row))
                continue;
            const uint32_t distance =
                moment.nextRow > row ? moment.nextRow - row : moment.nextRow + moment.rows - row;
            const auto ticks = uint32_t(base::gpuBirthAge(run, run.reach - distance));
            const float seconds = (float(ticks >> 16) * 65536.0f + float(ticks & 0xFFFFu)) *
                                  float(1.0 / double(base::kTicksPerSecond));
            ASSERT_EQ(rows.columns[column::Age][row], seconds) << k << " " << row;
            ++living;
        }
    }
    EXPECT_GT(living, 4000u);
}

} // namespace fx::test
