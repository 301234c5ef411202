/// @file scene_object.h
/// Implementation of FxScene.
#pragma once

#include "fxsdk/api/check.h"
#include "fxsdk/api/context.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/held_snapshots.h"
#include "fxsdk/fx_scene.h"
#include "fxsdk/scene/scene.h"

#include <atomic>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::api {

/// The contact callback of a host whose world is not that of the library.
struct HostContact
{
    const HostWorld* world;
    void* user;
    FxContactFunction meet;
};

} // namespace fx::api

struct FxScene
{
    FxScene(FxContext* owner, const fx::scene::SceneOptions& options)
        : context(owner), scene(options, &owner->schema, owner->tasks.get(), &owner->memory),
          longestFrame(fx::base::toSeconds(options.maxFrameTicks))
    {}

    FxContext* context;
    fx::api::SingleCaller caller; ///< scene thread
    fx::scene::IdCodec ids{this};
    fx::scene::Scene scene;
    /// quality of instances that are created with FX_QUALITY_DEFAULT
    fx::sim::QualityLevel quality = fx::sim::QualityLevel::Medium;
    uint64_t updateAllocations = 0; ///< number of allocations during the last update
    /// temporary memory of fxScene_SetFocus()
    std::pmr::vector<fx::activation::Frustum> foci{&context->memory};
    fx::api::HeldSnapshots held;
    std::shared_ptr<const fx::api::HostContact> contact; ///< null if the callback needs no conversion
    std::atomic<uint32_t> views{0};                      ///< number of views that show this scene
    double longestFrame;                                 ///< [s] longest time that one update simulates
    /// Bits for the next update: kCatchingUp, kPresetsChanged.
    std::atomic<uint32_t> notices{0};
    static constexpr uint32_t kCatchingUp = 1;     ///< the time of the last update exceeded longestFrame
    static constexpr uint32_t kPresetsChanged = 2; ///< a preset was unloaded or redirected
    bool isCatchingUp() const { return (notices.load() & kCatchingUp) != 0; }

    /// The preset of a reservation.
    struct ReservedPreset
    {
        FxPresetId preset;
        std::shared_ptr<const fx::sim::EffectDef> effect;
        fx::sim::QualityLevel level;
        uint32_t count;
    };
    std::pmr::vector<ReservedPreset> reserved{&context->memory};
    /// Implements fxScene_ReservePreset() for checked arguments.
    fx::base::Status reserve(FxPresetId preset, const std::shared_ptr<const fx::sim::EffectDef>& effect,
                             fx::sim::QualityLevel level, uint32_t count);
    /// Number of instances that all presets with this content have reserved, plus `more`; at most
    /// maxInstances.
    uint32_t reservedInstances(const fx::sim::EffectDef& effect, fx::sim::QualityLevel level,
                               uint64_t more = 0) const;
    /// Ends the reservations of unloaded presets, and lets those of redirected presets go on with their new
    /// content. After an exception the next update calls the function again.
    void followPresets();
    bool followPreset(ReservedPreset& one);
    uint32_t maxInstances = 0; ///< FxSceneDef::maxInstances

    bool isBehind = false;       ///< whether the last update left steps for the next one
    bool isLongReported = false; ///< whether the log says that an update was shortened

    // Number of updates during which gpuSeen and rowsWanted remain above 0 after they were set.
    static constexpr uint32_t kRemembered = 240;
    std::atomic<uint32_t> gpuSeen{0};
    std::atomic<uint32_t> rowsWanted{0};
    /// Whether emitters that prefer the GPU are computed on the GPU in this update.
    bool computesOnGpu()
    {
        const auto count = [](std::atomic<uint32_t>& left) {
            uint32_t value = left.load();
            while (value > 0 && !left.compare_exchange_weak(value, value - 1)) {
            }
            return value > 0;
        };
        if (gpuSeen == 0 && rowsWanted == 0)
            return false;
        const bool isSeen = count(gpuSeen), isWanted = count(rowsWanted);
        return isSeen && !isWanted;
    }
};

namespace fx::api {

constexpr const char* kSceneThreadRule =
    "call it from the thread that created the scene, or adopt this one with "
    "fxScene_AdoptThread";

inline const FxLog* logOf(const FxScene* scene)
{
    return scene ? &scene->context->def.log : nullptr;
}

inline void checkQuality(Checks& check, uint32_t quality, const char* name)
{
    check.range(quality, uint32_t(FX_QUALITY_DEFAULT), uint32_t(FX_QUALITY_REFERENCE), name);
}

/// Converts a quality of the C API.
/// @param preferred level to which FX_QUALITY_DEFAULT is converted
inline sim::QualityLevel toQuality(uint32_t quality, sim::QualityLevel preferred)
{
    return quality == FX_QUALITY_DEFAULT ? preferred : sim::QualityLevel(quality - FX_QUALITY_LOW);
}

/// Removes the scene from its context and frees it. No call on the scene may be in progress.
void destroyScene(FxScene* scene);

/// Runs `body` as a call inside the scene, if the thread rules allow it.
template <class F>
FxResult insideScene(const char* function, FxScene* scene, F&& body) noexcept
{
    return guarded(function, logOf(scene), [&]() -> base::Status {
        if (!scene)
            return invalid("scene is null");
        const SingleCaller::Scope scope(scene->caller, kSceneThreadRule);
        return scope ? body() : scope.status();
    });
}

/// Finds the local identity of `id` and runs body(identity) inside the scene.
template <class F>
FxResult withInstance(const char* function, FxScene* scene, FxInstanceId id, F&& body)
{
    return insideScene(function, scene, [&]() -> base::Status {
        const scene::LocalId local = scene->ids.decode(id.bits, kInstanceIdType);
        if (!scene->scene.contains(local))
            return {base::Code::StaleId, "instance names no instance of this scene"};
        return body(local);
    });
}

} // namespace fx::api
