/// @file snapshot_renderer.h
/// Draws snapshots by OpenGL, as a view draws those of a scene, over nothing.
///
/// Threads: the thread that made it, which is its GL thread.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"
#include "rendering/reference/render/reference_camera.h"

#include <memory>

namespace fx::cli {

class SnapshotRenderer
{
public:
    /// @param schema of the snapshots; must outlive the renderer
    /// @param width, height [pixel]
    static base::Result<std::unique_ptr<SnapshotRenderer>>
    create(const base::SnapshotSchema& schema, const render::ViewSettings& settings, int width, int height);
    ~SnapshotRenderer();

    /// Of the next picture.
    render::ViewSettings& settings();

    /// @param time [s] of the picture, for effects with a history
    base::Status render(const SceneMoment& moment, const render::ReferenceCamera& camera, double time);
    /// Copies the pictures from the GPU; those besides `color` only with settings.layerOutputs. Instances are
    /// called as in the snapshots, if that is below 2^24.
    FrameLayers read();

    const render::FrameStatistics& statistics() const;
    bool fillsPlanes() const;          ///< whether the last frame has filled planes of light slices
    double millisecondsRender() const; ///< of the last frame, until the GPU has finished
    const std::string& rendererName() const;

private:
    SnapshotRenderer();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The camera as views take it, relative to its eye. The near plane is at a distance of one millimetre.
render::CameraView viewOf(const render::ReferenceCamera& camera, double aspect);

} // namespace fx::cli
