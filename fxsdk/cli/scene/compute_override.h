/// @file compute_override.h
/// Loads presets of a scene with a different member "compute".
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/fxsdk.h"
#include "fxsdk/scene_file/scene_file.h"

#include <string>

namespace fx::cli {

/// Why the GPU cannot compute all particles of a scene; empty when it can.
std::string gpuObstacleOf(const scene_file::SceneFile& scene);

/// A context's asset hook that hands out presets whose "compute" members have been replaced. It must outlive
/// the context. Threads: that of the context's loading calls.
class ComputeOverride
{
public:
    /// @param compute "cpu", "gpu" or "auto"; empty: presets are not changed
    explicit ComputeOverride(std::string compute) : compute_(std::move(compute)) {}

    /// Asset hook for the context; its functions are null when presets are not changed.
    FxAssetHook hook();
    base::Result<FxPresetId> load(FxContext* context, const scene_file::ScenePreset& preset);

private:
    static const void* open(void* user, const char* name, size_t* outSize);
    static void close(void* user, const void* data, size_t size);

    std::string compute_;
    std::string text_;   ///< of the preset being loaded
    std::string folder_; ///< of its files, with the slash
};

} // namespace fx::cli
