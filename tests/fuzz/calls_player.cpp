#include "tests/fuzz/calls_player.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace fx::fuzz {

namespace {

constexpr size_t kCallBytes = 32;        ///< of a recording for each call
constexpr uint32_t kMaxCalls = 256;      ///< of a recording
constexpr int kMaxDepth = 3;             ///< of calls within callbacks within calls
constexpr uint32_t kMaxNestedCalls = 40; ///< callbacks that a byte of the recording arms

} // namespace

CallsPlayer::CallsPlayer(std::span<const uint8_t> recording) : recording_(recording), input_({})
{
    for (PlayedContext& played : contexts_) {
        played.host.intrude = [this] { intrude(); };
        played.host.releasing = [this](const void* memory, size_t size) { forget(memory, size); };
    }
}

void CallsPlayer::play()
{
    while (!recording_.isEmpty() && calls_ < kMaxCalls)
        playOne();
    intruders_ = 0;
    for (PlayedContext& played : contexts_)
        destroyAll(played);
}

void CallsPlayer::playOne()
{
    constexpr uint32_t kGroups = 3;
    const std::array<std::span<const Call>, kGroups> groups{callsOfContexts(), callsOfScenes(),
                                                            callsOfViews()};
    const InputReader outer = std::exchange(input_, recording_.part(kCallBytes));
    const std::span<const Call> group = groups[input_.below(kGroups)];
    ++calls_;
    (this->*group[input_.below(uint32_t(group.size()))])();
    input_ = outer;
}

/// A callback makes a call of the recording, while some are armed.
void CallsPlayer::intrude()
{
    if (intruders_ == 0 || depth_ >= kMaxDepth || recording_.isEmpty() || calls_ >= kMaxCalls)
        return;
    --intruders_;
    ++depth_;
    playOne();
    --depth_;
}

/// A host must not use an object whose memory it has been given back.
void CallsPlayer::forget(const void* memory, size_t size)
{
    const auto isInside = [&](const void* object) {
        const uintptr_t begin = reinterpret_cast<uintptr_t>(memory), at = reinterpret_cast<uintptr_t>(object);
        return object && at >= begin && at < begin + size;
    };
    for (PlayedContext& played : contexts_) {
        for (PlayedScene& scene : played.scenes)
            if (isInside(scene.scene))
                scene = {};
        for (FxView*& view : played.views)
            if (isInside(view))
                view = nullptr;
    }
}

void CallsPlayer::destroyAll(PlayedContext& played)
{
    played.host.failAfter = UINT32_MAX;
    require(checked(fxDestroyContext(played.context)) == FX_OK,
            "a context can be destroyed with all that it holds", fxGetLastErrorMessage());
    played.context = nullptr;
    require(played.host.blocks() == 0, "a destroyed context holds no memory");
}

FxPresetId CallsPlayer::anyPreset(const PlayedContext& played)
{
    const uint32_t index = input_.below(8);
    return index < played.presets.size() ? played.presets[index] : FxPresetId{index == 7 ? UINT64_MAX : 0};
}

FxInstanceId CallsPlayer::anyInstance(const PlayedScene& played)
{
    const uint32_t index = input_.below(16);
    return index < played.instances.size() ? played.instances[index]
                                           : FxInstanceId{index == 15 ? UINT64_MAX : 0};
}

FxSnapshotId CallsPlayer::anySnapshot(const PlayedScene& played)
{
    const uint32_t index = input_.below(18);
    return index < played.snapshots.size() ? played.snapshots[index] : FxSnapshotId{index};
}

/// Mostly within +-most, 0 for 0, sometimes at a limit of arithmetic.
double CallsPlayer::number(double most)
{
    const uint8_t choice = input_.byte();
    switch (choice) {
    case 250:
        return std::numeric_limits<double>::quiet_NaN();
    case 251:
        return std::numeric_limits<double>::infinity();
    case 252:
        return -std::numeric_limits<double>::infinity();
    case 253:
        return 1e308;
    case 254:
        return -1e-310;
    case 255:
        return input_.value<float>();
    default:
        return most * ((choice + 125) % 250 - 125) / 125.0;
    }
}

uint32_t CallsPlayer::structSize(size_t size)
{
    const uint8_t choice = input_.byte();
    return choice >= 252 ? uint32_t(choice - 252) * 7 : choice == 251 ? UINT32_MAX : uint32_t(size);
}

std::span<const CallsPlayer::Call> CallsPlayer::callsOfContexts()
{
    static constexpr std::array<Call, 6> kCalls{&CallsPlayer::createContext,   &CallsPlayer::destroyContext,
                                                &CallsPlayer::failAllocations, &CallsPlayer::loadPreset,
                                                &CallsPlayer::unloadPreset,    &CallsPlayer::readContext};
    return kCalls;
}

void CallsPlayer::createContext()
{
    PlayedContext& played = anyContext();
    if (played.context)
        return;
    FxContextDef def = played.host.contextDef();
    const bool hasGl = &played == contexts_.data() && glHost().loader.getProcAddress;
    if (hasGl)
        def.gl = glHost().loader;
    def.flags = input_.one(4) ? input_.byte() : uint32_t(FX_CONTEXT_PLACEHOLDERS);
    def.structSize = structSize(sizeof def);
    if (input_.one(8))
        def.headerVersion = input_.value<uint32_t>();
    if (input_.one(8))
        def.allocator.release = nullptr;
    played.host.reversesLoops = input_.one(2);
    FxContext* made = nullptr;
    const FxResult result = checked(fxCreateContext(&def, &made));
    require((result == FX_OK) == (made != nullptr), "only a created context is handed out");
    if (played.context && made) { // a callback has made one
        checked(fxDestroyContext(made));
        return;
    }
    if (made) {
        played.context = made;
        played.hasGl = hasGl;
    }
}

/// A context that a call is inside of belongs to the host no more than its frames do; only the last one is
/// destroyed.
void CallsPlayer::destroyContext()
{
    PlayedContext& played = anyContext();
    if (depth_ > 0)
        return;
    const uint32_t armed = std::exchange(intruders_, 0);
    destroyAll(played);
    intruders_ = armed;
    played.presets.clear();
    played.scenes = {};
    played.views = {};
}

/// Memory runs out after some allocations, or is there again; callbacks are armed.
void CallsPlayer::failAllocations()
{
    PlayedContext& played = anyContext();
    const uint8_t choice = input_.byte();
    played.host.failAfter = choice < 128 ? UINT32_MAX : uint32_t(choice - 128);
    intruders_ = input_.below(kMaxNestedCalls);
}

void CallsPlayer::loadPreset()
{
    PlayedContext& played = anyContext();
    const uint8_t choice = input_.byte();
    FxPresetId preset{};
    FxResult result = FX_OK;
    if (choice < 240) {
        const std::string_view text = smallPresets()[choice % smallPresets().size()];
        const size_t length = choice < 200 ? text.size() : input_.byte();
        result = fxLoadPresetText(played.context, text.data(), length, "recorded", &preset);
    } else if (choice < 248) {
        result =
            fxLoadPresetLibrary(played.context, choice < 244 ? "library:sparks" : "library:nothing", &preset);
    } else {
        result = fxLoadPresetFile(played.context, choice < 252 ? "missing.fx.json" : nullptr, &preset);
    }
    require((checked(result) == FX_OK) == (preset.bits != 0), "only a loaded preset has an id");
    if (result == FX_OK && played.presets.size() < 8)
        played.presets.push_back(preset);
}

void CallsPlayer::unloadPreset()
{
    PlayedContext& played = anyContext();
    checked(fxUnloadPreset(played.context, anyPreset(played)));
}

void CallsPlayer::readContext()
{
    PlayedContext& played = anyContext();
    FxPresetInfo info = sized<FxPresetInfo>();
    checked(fxGetPresetInfo(played.context, anyPreset(played), &info));
    FxPresetPreview preview{};
    preview.structSize = sizeof preview;
    checked(fxGetPresetPreview(played.context, anyPreset(played), &preview));
    FxViewSettings settings = fxDefaultViewSettings();
    checked(fxSetPreviewSettings(played.context, anyPreset(played), &settings));
    FxMemoryStats stats = sized<FxMemoryStats>();
    checked(fxContext_GetMemoryStats(played.context, &stats));
    if (input_.one(4))
        checked(fxContext_AdoptGlThread(played.context));
}

} // namespace fx::fuzz
