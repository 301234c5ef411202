/// @file reference_scene.h
/// Frames of a scene file or a list of blobs as the reference renderer takes them.
#pragma once

#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "rendering/reference/render/reference_renderer.h"

#include <memory>

namespace fx::cli {

/// The scene at one moment.
struct ReferenceFrame
{
    render::ReferenceScene scene;
    uint32_t nonFinite = 0; ///< blobs left out because a number was not finite
};

/// A scene file whose effects run without GL.
class ReferenceSceneSource
{
public:
    /// @param file must outlive the source and its frames
    static base::Result<std::unique_ptr<ReferenceSceneSource>> create(const scene_file::SceneFile& file,
                                                                      const EffectSceneOptions& options);

    /// The effects at `tick`, which must not decrease from call to call, seen by the camera of the file.
    base::Result<ReferenceFrame> frameAt(base::Ticks tick);

private:
    explicit ReferenceSceneSource(const scene_file::SceneFile& file) : file_(file) {}

    const scene_file::SceneFile& file_;
    std::unique_ptr<EffectScene> effects_;
};

/// The camera of a path at a time [s], in double.
render::ReferenceCamera cameraOf(const scene_file::CameraPath& path, double time);

} // namespace fx::cli
