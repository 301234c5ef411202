/// @file blob_list_renderer.h
/// Draws a list of blobs by OpenGL, as a view draws the snapshot of a scene, over nothing.
///
/// Threads: the thread that made it, which is its GL thread.
#pragma once

#include "fxsdk/cli/render/snapshot_renderer.h"
#include "rendering/reference/render/medium_blobs.h"

#include <memory>
#include <span>

namespace fx::cli {

class BlobListRenderer
{
public:
    /// @param width, height [pixel]
    static base::Result<std::unique_ptr<BlobListRenderer>> create(std::span<const render::MediumBlob> blobs,
                                                                  const render::ViewSettings& settings,
                                                                  int width, int height);
    ~BlobListRenderer();

    /// Draws another list from the next picture on.
    void show(std::span<const render::MediumBlob> blobs);
    /// The renderer, for settings, pictures and statistics.
    SnapshotRenderer& pictures();

    /// @param time [s] of the picture, which only the camera depends on
    base::Status render(const render::ReferenceCamera& camera, double time);

private:
    BlobListRenderer();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fx::cli
