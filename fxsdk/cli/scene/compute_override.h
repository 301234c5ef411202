/// @file compute_override.h
/// Loads the presets of a scene with a replaced member "compute".
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/fxsdk.h"
#include "fxsdk/scene_file/scene_file.h"

#include <string>

namespace fx::cli {

/// Reason why the GPU cannot compute all particles of a scene; empty when the GPU can compute all particles.
std::string gpuObstacleOf(const scene_file::SceneFile& scene);

/// An asset hook of a context that replaces the members "compute" of presets. The object must outlive the
/// context. Threads: all threads that call loading functions of the context.
class ComputeOverride
{
public:
    /// Creates an override.
    /// @param compute "cpu", "gpu" or "auto"; empty: presets are not changed
    explicit ComputeOverride(std::string compute) : compute_(std::move(compute)) {}

    /// Asset hook for the context; its functions are null when presets are not changed.
    FxAssetHook hook();
    base::Result<FxPresetId> load(FxContext* context, const scene_file::ScenePreset& preset);

private:
    static const void* open(void* user, const char* name, size_t* outSize);
    static void close(void* user, const void* data, size_t size);

    std::string compute_;
    std::string text_;   ///< text of the preset that is being loaded
    std::string folder_; ///< folder of the preset's files, ending with '/'
};

} // namespace fx::cli
