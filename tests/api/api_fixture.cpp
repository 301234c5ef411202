#include "tests/api/api_fixture.h"

#include <new>

namespace fx::test {

/// Counts down to 1 and stays there: from then on there is none.
bool HostAllocator::isLeft()
{
    uint64_t remaining = remaining_;
    while (remaining > 1 && !remaining_.compare_exchange_weak(remaining, remaining - 1)) {
    }
    return remaining != 1;
}

void* HostAllocator::allocate(void* user, size_t size, size_t alignment)
{
    auto& self = *static_cast<HostAllocator*>(user);
    if (!self.isLeft()) {
        self.failed_ = true;
        return nullptr;
    }
    ++self.blocks_;
    self.bytes_ += int64_t(size);
    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
}

void HostAllocator::release(void* user, void* memory, size_t size, size_t alignment)
{
    auto& self = *static_cast<HostAllocator*>(user);
    --self.blocks_;
    self.bytes_ -= int64_t(size);
    ::operator delete(memory, std::align_val_t(alignment)); // with a size clang has none
}

std::string fountainPreset()
{
    return R"({"version": 1, "name": "fountain", "emitters": [{
        "maxParticles": 128, "shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1,
        "speed": {"min": 1, "max": 3}, "radius": 0.25}]})";
}

std::string burstPreset(int count, double seconds)
{
    return R"({"version": 1, "name": "burst", "ground": false, "emitters": [{
        "maxParticles": )" +
           std::to_string(count) +
           R"(, "shape": "sphere", "size": 1, "emission": {"bursts": [{"time": 0, "count": )" +
           std::to_string(count) + R"(}]}, "lifetime": )" + std::to_string(seconds) +
           R"(, "radius": 0.5, "forces": {"drag": 0.5, "buoyancy": 0.2, "curlStrength": 1, "curlScale": 2}}]})";
}

std::string smallBlastPreset()
{
    const std::string gas = kHasGas ? R"("gas": [{"particles": 40, "dissipation": 0}],)" : "";
    return R"({"version": 1, "name": "small blast", )" + gas + R"("emitters": [
            {"maxParticles": 64, "shape": "sphere", "size": 0.5, "emission": {"rate": 20}, "lifetime": 1,
             "speed": 2, "radius": 0.25, "forces": {"curlStrength": 1, "curlRate": 0.3, "bounce": 0.5}},
            {"maxParticles": 32, "emission": {"bursts": [{"time": 0.3, "count": 20}]}, "lifetime": 100}]})";
}

FxPresetId loadText(FxContext* context, const std::string& text)
{
    FxPresetId preset{};
    EXPECT_EQ(fxLoadPresetText(context, text.c_str(), text.size(), "test preset", &preset), FX_OK)
        << fxGetLastErrorMessage();
    return preset;
}

ApiTest::ApiTest()
{
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.workers = 1;
    EXPECT_EQ(fxCreateContext(&contextDef, &context_), FX_OK) << fxGetLastErrorMessage();
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK) << fxGetLastErrorMessage();
    fountain_ = loadText(context_, fountainPreset());
}

ApiTest::~ApiTest()
{
    EXPECT_EQ(fxDestroyContext(context_), FX_OK);
}

FxInstanceDef ApiTest::instanceDef() const
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = fountain_;
    def.seed = 7;
    return def;
}

FxInstanceId ApiTest::addFountain()
{
    const FxInstanceDef def = instanceDef();
    FxInstanceId id{};
    EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    return id;
}

FxSceneStatistics ApiTest::statistics() const
{
    FxSceneStatistics statistics{};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_OK) << fxGetLastErrorMessage();
    return statistics;
}

uint64_t ApiTest::hash() const
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(scene_, &hash), FX_OK) << fxGetLastErrorMessage();
    return hash;
}

uint64_t ApiTest::simulationHash() const
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetSimulationHash(scene_, &hash), FX_OK) << fxGetLastErrorMessage();
    return hash;
}

std::vector<std::byte> ApiTest::savedState() const
{
    size_t size = 0;
    EXPECT_EQ(fxScene_SaveState(scene_, nullptr, 0, &size), FX_OK) << fxGetLastErrorMessage();
    std::vector<std::byte> state(size);
    EXPECT_EQ(fxScene_SaveState(scene_, state.data(), state.size(), &size), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(size, state.size());
    return state;
}

FxResult ApiTest::restore(const std::vector<std::byte>& state) const
{
    return fxScene_RestoreState(scene_, state.data(), state.size());
}

void ApiTest::play(int frames) const
{
    for (int frame = 0; frame < frames; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
}

uint64_t ApiTest::bytesInUse() const
{
    FxMemoryStats stats{};
    stats.structSize = sizeof stats;
    EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
    return stats.bytesInUse;
}

} // namespace fx::test
