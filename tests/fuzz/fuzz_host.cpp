#include "tests/fuzz/fuzz_host.h"

#include <algorithm>
#include <new>

#if FXSDK_WITH_SPH
#define FX_FUZZ_GAS R"("gas": [{"particles": 40, "dissipation": 0}], )"
#else
#define FX_FUZZ_GAS ""
#endif

namespace fx::fuzz {

namespace {

constexpr std::string_view kMesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

constexpr std::array<std::string_view, 7> kPresets{
    R"({"version": 1, "name": "fountain", "emitters": [{"emission": {"rate": 60}, "lifetime": 1, "speed": 2, "radius": 0.1}]})",
    R"({"version": 1, "name": "flames", "ground": false, "offscreen": "replay", "emitters": [
        {"layer": "fire", "shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1, "radius": 0.5,
         "temperature": 1700, "heat": 1, "fireShare": 0.5, "detailAmount": 0.5, "forces": {"gravity": 0}}]})",
    R"({"version": 1, "name": "blast", )" FX_FUZZ_GAS R"("emitters": [
        {"maxParticles": 64, "shape": "sphere", "size": 0.5, "emission": {"rate": 20}, "lifetime": 1, "speed": 2,
         "radius": 0.25, "forces": {"curlStrength": 1, "curlRate": 0.3, "bounce": 0.5}},
        {"maxParticles": 32, "emission": {"bursts": [{"time": 0.3, "count": 20}]}, "lifetime": 100}]})",
    R"({"version": 1, "name": "chain", "emitters": [
        {"name": "shells", "space": "world", "maxParticles": 20, "emission": {"rate": 5}, "lifetime": 0.4, "speed": 3,
         "radius": 0.05, "events": [{"on": "death", "emit": "stars", "count": 4, "cue": "bang"}, {"on": "birth", "cue": "start"}, {"on": "host", "name": "burst", "cue": "burst", "emit": "stars", "count": 8}],
         "appearance": {"kind": "sprite", "luminance": 100}, "trail": {"lifetime": 0.3}},
        {"name": "stars", "space": "world", "maxParticles": 100, "emission": {"rate": 0}, "lifetime": {"min": 0.2, "max": 0.5},
         "speed": 1, "radius": 0.02, "forces": {"drag": 1}, "appearance": {"kind": "sprite", "luminance": 100}}]})",
    R"({"version": 1, "name": "debris", "emitters": [
        {"maxParticles": 30, "emission": {"rate": 20}, "lifetime": 2, "speed": 3, "radius": 0.1,
         "collisions": [{"shape": "ground"}, {"shape": "scene"}, {"shape": "hook"}],
         "appearance": {"kind": "mesh", "mesh": "library:debris-chunk.obj", "luminance": 10}}]})",
    R"({"version": 1, "name": "gpu", "emitters": [
        {"compute": "gpu", "maxParticles": 64, "emission": {"rate": 40}, "lifetime": 1, "speed": 1, "radius": 0.1,
         "appearance": {"kind": "sprite", "order": "depth", "luminance": 100}}]})",
    R"({"version": 1, "name": "fragments", "fragments": [{"count": 12}]})",
};

} // namespace

std::span<const std::string_view> smallPresets()
{
    return kPresets;
}

FxResult checked(FxResult result)
{
    const std::string_view name = fxResultName(result);
    require(name != "unknown", "a call returns a documented code");
    require(result != FX_ERROR_INTERNAL, "no call finds a defect of the library", fxGetLastErrorMessage());
    require(result == FX_OK || *fxGetLastErrorMessage() != '\0', "a call that fails leaves a message", name);
    return result;
}

FxContextDef FuzzHost::contextDef()
{
    FxContextDef def = fxDefaultContextDef();
    def.allocator = {this, &allocate, &release};
    def.parallelFor = {this, &loop};
    def.log = {this, &log};
    def.assets = {this, &open, &close};
    return def;
}

void FuzzHost::callBack() const
{
    if (intrude)
        intrude();
}

void* FuzzHost::allocate(void* user, size_t size, size_t alignment)
{
    FuzzHost& host = *static_cast<FuzzHost*>(user);
    host.callBack();
    require(size > 0 && alignment > 0 && alignment <= 4096 && (alignment & (alignment - 1)) == 0,
            "the library asks for memory as it promises");
    if (host.failAfter == 0)
        return nullptr;
    --host.failAfter;
    void* const memory = ::operator new(size, std::align_val_t(alignment), std::nothrow);
    if (memory)
        host.blocks_[memory] = {size, alignment};
    return memory;
}

void FuzzHost::release(void* user, void* memory, size_t size, size_t alignment)
{
    FuzzHost& host = *static_cast<FuzzHost*>(user);
    if (host.releasing)
        host.releasing(memory, size);
    host.callBack();
    const auto block = host.blocks_.find(memory);
    require(block != host.blocks_.end() && block->second == std::array{size, alignment},
            "memory is released as it was allocated");
    host.blocks_.erase(block);
    ::operator delete(memory, std::align_val_t(alignment));
}

void FuzzHost::loop(void* user, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument)
{
    FuzzHost& host = *static_cast<FuzzHost*>(user);
    host.callBack();
    const uint32_t batch = std::max(minBatch, 1u), parts = std::max(count / batch, 1u);
    for (uint32_t i = 0; i < parts; ++i) {
        const uint32_t part = host.reversesLoops ? parts - 1 - i : i;
        body(argument, part * batch, part + 1 == parts ? count : (part + 1) * batch);
    }
}

void FuzzHost::log(void* user, FxLogLevel, FxResult, const char* message)
{
    require(message && *message, "log messages say something");
    static_cast<FuzzHost*>(user)->callBack();
}

/// Every mesh is a triangle; there are no other assets.
const void* FuzzHost::open(void* user, const char* name, size_t* outSize)
{
    FuzzHost& host = *static_cast<FuzzHost*>(user);
    host.callBack();
    if (!std::string_view(name).ends_with(".obj"))
        return nullptr;
    ++host.openAssets_;
    *outSize = kMesh.size();
    return kMesh.data();
}

void FuzzHost::close(void* user, const void* data, size_t)
{
    FuzzHost& host = *static_cast<FuzzHost*>(user);
    require(data == kMesh.data() && host.openAssets_ > 0,
            "an asset is closed once for every time it was opened");
    --host.openAssets_;
    host.callBack();
}

} // namespace fx::fuzz
