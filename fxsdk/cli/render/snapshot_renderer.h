/// @file snapshot_renderer.h
/// Draws snapshots by OpenGL over an empty background, in the same way as a view draws the snapshots of a
/// scene.
///
/// Threads: only the thread that created the object, which is its GL thread.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"
#include "rendering/reference/render/reference_camera.h"

#include <memory>

namespace fx::cli {

class SnapshotRenderer
{
public:
    /// Creates a renderer.
    /// @param schema schema of the snapshots; must outlive the renderer
    /// @param width, height [pixel] size of pictures
    static base::Result<std::unique_ptr<SnapshotRenderer>>
    create(const base::SnapshotSchema& schema, const render::ViewSettings& settings, int width, int height);
    ~SnapshotRenderer();

    /// Compiles the programs of all techniques, so that no picture takes time for it. Otherwise a picture
    /// compiles the programs that it needs and that no picture before it needed.
    base::Status warmUp();

    /// Settings of the next picture.
    render::ViewSettings& settings();

    /// Table of the images and volumes that snapshots name; must outlive the renderer. Without it, balls are
    /// drawn in place of volumes.
    void setAssets(const base::AssetTable* assets);

    /// Draws a moment of the scene.
    /// @param time [s] time of the picture, for passes with a history
    base::Status render(const SceneMoment& moment, const render::ReferenceCamera& camera, double time);
    /// Copies the pictures from the GPU. All but `color` require settings.layerOutputs. The picture of
    /// instances contains the ids of the snapshots if the ids are below 2^24.
    FrameLayers read();

    const render::FrameStatistics& statistics() const;
    bool fillsPlanes() const;          ///< whether light slices of the last frame were filled
    double millisecondsRender() const; ///< [ms] time of the last frame, until the GPU has finished
    const std::string& rendererName() const;
    render::GlDevice& device(); ///< the device of the pictures, for measurements that change its programs

private:
    SnapshotRenderer();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Converts the camera to that of a view, relative to its eye. The near plane is at a distance of 1 mm.
render::CameraView viewOf(const render::ReferenceCamera& camera, double aspect);

} // namespace fx::cli
