/// @file blob_list_renderer.h
/// Draws a list of blobs by OpenGL over an empty background, in the same way as a view draws a snapshot.
///
/// Threads: only the thread that created the object, which is its GL thread.
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

    /// Replaces the list of blobs, from the next picture on.
    void show(std::span<const render::MediumBlob> blobs);
    /// The underlying renderer with its settings, pictures and statistics.
    SnapshotRenderer& pictures();

    /// Draws a picture of the blobs.
    /// @param time [s] time of the picture; the blobs do not depend on the time
    base::Status render(const render::ReferenceCamera& camera, double time);

private:
    BlobListRenderer();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fx::cli
