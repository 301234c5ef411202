/// @file context.h
/// Implementation of FxContext: the host's hooks and the data that scenes and views share.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/snapshot_schema.h"
#include "foundation/tasks/task_runner.h"
#include "fxsdk/api/call_scope.h"
#include "fxsdk/api/host_world.h"
#include "fxsdk/fx_context.h"
#include "fxsdk/fx_preset.h"
#include "fxsdk/fx_preset_load.h"
#include "fxsdk/scene/id_table.h"
#include "fxsdk/techniques.h"
#include "rendering/gl/gl_device.h"
#include "rendering/techniques/draw_techniques.h"
#include "simulation/solver/effect_def.h"

#include <memory>
#include <memory_resource>
#include <string>
#include <vector>

namespace fx::api {

/// Type of an id, stored in its last byte.
enum IdType : uint8_t
{
    kPresetIdType = 1,
    kInstanceIdType = 2,
    kSnapshotIdType = 3,
};

/// A loaded preset.
struct HeldPreset
{
    std::shared_ptr<const sim::EffectDef> effect;
    std::string source; ///< file, or name under which it was loaded
};

using PresetTable = scene::IdTable<HeldPreset>;

/// The techniques of a context: the parts that read presets and the parts that draw.
struct TechniqueLists
{
    preset::Techniques presets = preset::techniques();
    render::DrawTechniques draws = render::drawTechniques();
};

base::AllocatorHooks toHooks(const FxAllocator& allocator);

inline constexpr const char* kWithoutGl =
    "the context was created without getProcAddress; set gl.getProcAddress of FxContextDef to "
    "fxGetGlProcAddress, or to the loader of the window library, before fxCreateContext";
} // namespace fx::api

struct FxContext
{
    /// Creates a context that is ready for use, without GL, of a checked definition. Throws std::bad_alloc.
    /// @param techniques lists of techniques, which must outlive the context
    explicit FxContext(const FxContextDef& def, const fx::api::TechniqueLists& techniques = {});
    FxContext(const FxContext&) = delete;
    FxContext& operator=(const FxContext&) = delete;

    /// Finds a loaded preset by its id. @return StaleId if the id names no preset of this context
    fx::base::Result<std::shared_ptr<const fx::sim::EffectDef>> findPreset(FxPresetId id);

    /// Finds a loaded preset by its fingerprint. @return null if there is none
    std::shared_ptr<const fx::sim::EffectDef> findPreset(uint64_t fingerprint);

    /// States to all scenes that a preset was unloaded or redirected. `tables` must be locked.
    void noticePresets();

    const FxContextDef def;
    const fx::api::HostWorld world; ///< units of length and axes of `def`
    const fx::api::TechniqueLists techniques;
    fx::base::HostMemory memory;
    fx::base::SnapshotSchema schema;      ///< constant after construction
    fx::base::AssetTable assets{&memory}; ///< images and meshes of all presets
    std::unique_ptr<fx::base::TaskRunner> tasks;

    fx::api::SharedCaller loading; ///< serializes the loading of presets; entered before `tables`
    fx::api::SharedCaller tables;  ///< guards the five members below; locked only for a short time
    fx::scene::IdCodec ids{this};
    fx::api::PresetTable presets;
    std::pmr::vector<FxScene*> scenes;
    std::pmr::vector<FxView*> views;
    std::pmr::vector<FxPresetLoad*> loads;

    fx::api::SingleCaller gl;                     ///< GL thread
    std::unique_ptr<fx::render::GlDevice> device; ///< null without GL
};

namespace fx::api {

constexpr const char* kGlThreadRule = "call it from the context's GL thread, or adopt this one with "
                                      "fxContext_AdoptGlThread";

/// Implements fxCreateContext() for a checked definition, with the techniques of the caller.
base::Status createContext(const FxContextDef& def, const TechniqueLists& techniques, FxContext** outContext);

inline const FxLog* logOf(const FxContext* context)
{
    return context ? &context->def.log : nullptr;
}

void logMessage(const FxContext& context, FxLogLevel level, const char* message);

} // namespace fx::api
