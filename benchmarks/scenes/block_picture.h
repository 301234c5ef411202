/// @file block_picture.h
/// Pictures by OpenGL of blocks that emit light and scatter none, for measurements of impostors: how media
/// are lit has no part in them.
///
/// Threads: only the thread that created the object, which is its GL thread.
#pragma once

#include "benchmarks/scenes/block_heaps.h"
#include "benchmarks/scenes/lit_media.h"
#include "fxsdk/cli/render/snapshot_renderer.h"

#include <cstdint>
#include <memory>

namespace fx::cli {

/// Luminance that a picture shows as 1. @param exposureEv100 [EV100]
float whiteOf(float exposureEv100);

/// Draws blocks by OpenGL in the composition `slabs`.
class BlockPainter
{
public:
    static base::Result<std::unique_ptr<BlockPainter>> create(int width, int height);

    /// Draws frames until no tile is due. LitPicture::seconds is the time of the last one; its opacity stays
    /// empty.
    /// @param blocks with complete types
    base::Result<LitPicture> paint(const sim::BlocksDef& blocks, const LitView& view);
    /// Settings of blocks in the next picture.
    render::BlockSettings& settings() { return renderer_->settings().blocks; }
    const render::FrameStatistics& statistics() const { return renderer_->statistics(); }

private:
    BlockPainter() = default;

    base::SnapshotSchema schema_;
    std::unique_ptr<SnapshotRenderer> renderer_;
    uint64_t sequence_ = 0; ///< of the snapshot
};

} // namespace fx::cli
