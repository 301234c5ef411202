/// @file reference_scene.h
/// Converts frames of a scene file or a list of blobs to the input of the reference renderer.
#pragma once

#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "rendering/reference/render/reference_renderer.h"

#include <map>
#include <memory>

namespace fx::cli {

/// The scene at one moment.
struct ReferenceFrame
{
    render::ReferenceScene scene;
    uint32_t nonFinite = 0; ///< number of blobs that were omitted because a value was not finite
};

/// Runs the effects of a scene file without GL.
class ReferenceSceneSource
{
public:
    /// Creates a source of frames of a scene file.
    /// @param file must outlive the source and its frames
    static base::Result<std::unique_ptr<ReferenceSceneSource>> create(const scene_file::SceneFile& file,
                                                                      const EffectSceneOptions& options);

    /// The effects at `tick`, seen by the camera of the file. `tick` must not decrease from call to call.
    base::Result<ReferenceFrame> frameAt(base::Ticks tick);

private:
    explicit ReferenceSceneSource(const scene_file::SceneFile& file) : file_(file) {}

    /// The medium of a volume of the effects at its moment; null if its voxels are not known.
    /// @param ioStatus receives the error of a frame of a sequence that cannot be read
    std::shared_ptr<const render::MediumVolume> volumeOf(const render::GroupVolume& volume,
                                                         base::Status& ioStatus);
    /// The voxels of an asset, or of a frame of a sequence.
    std::shared_ptr<const render::MediumVolume> keep(uint32_t asset, uint32_t frame,
                                                     const base::VoxelVolume& voxels);

    const scene_file::SceneFile& file_;
    std::unique_ptr<EffectScene> effects_;
    /// by asset and frame; of a sequence only the frames of the last moment
    std::map<std::pair<uint32_t, uint32_t>, std::shared_ptr<const render::MediumVolume>> volumes_;
};

/// The camera of a path at a time [s], in double precision.
render::ReferenceCamera cameraOf(const scene_file::CameraPath& path, double time);

} // namespace fx::cli
