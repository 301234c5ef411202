/// @file scene_object.h
/// What is behind FxScene.
#pragma once

#include "fxsdk/api/check.h"
#include "fxsdk/api/context.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/held_snapshots.h"
#include "fxsdk/fx_scene.h"
#include "fxsdk/scene/scene.h"

#include <atomic>

struct FxScene
{
    FxScene(FxContext* owner, const fx::scene::SceneOptions& options)
        : context(owner), scene(options, &owner->schema, owner->tasks.get(), &owner->memory)
    {}

    FxContext* context;
    fx::api::SingleCaller caller; ///< scene thread
    fx::scene::IdCodec ids{this};
    fx::scene::Scene scene;
    uint64_t updateAllocations = 0; ///< during the last update
    fx::api::HeldSnapshots held;
    std::atomic<uint32_t> views{0}; ///< that show this scene
};

namespace fx::api {

constexpr const char* kSceneThreadRule =
    "call it from the thread that created the scene, or adopt this one with "
    "fxScene_AdoptThread";

inline const FxLog* logOf(const FxScene* scene)
{
    return scene ? &scene->context->def.log : nullptr;
}

/// Takes the scene out of its context and frees it. Nobody may be inside it.
void destroyScene(FxScene* scene);

/// Runs `body` as a call inside the scene, if the thread rules allow it.
template <class F>
FxResult insideScene(const char* function, FxScene* scene, F&& body) noexcept
{
    return guarded(function, logOf(scene), [&]() -> base::Status {
        if (!scene)
            return invalid("scene is null");
        const SingleCaller::Scope scope(scene->caller, kSceneThreadRule);
        return scope.status() ? body() : scope.status();
    });
}

} // namespace fx::api
