/// @file detail_resources.h
/// What compositions need on the GPU to draw the detail of fields. Threads: [GL thread].
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_texture.h"

#include <cstdint>

namespace fx::render {

constexpr int kCoarseOctaves = 3; ///< of detail, where a picture is coarse

/// What the GPU gets of the detail of a group.
FieldDetailBlock detailBlock(const GroupDetail& detail, int octaves);

/// The periodic cube of lumps, which is filled once. Nothing is created before makeRoom().
class LumpTileTexture
{
public:
    /// @return OutOfMemory, InvalidArgument (the context has no textures of this size)
    base::Status makeRoom(GlDevice& device);
    /// Imports it, and adds the pass that fills it if none has. After makeRoom().
    [[nodiscard]] ResourceId addTo(FrameGraph& graph);
    /// The passes of the last addTo() have not run.
    void forget() { isFilled_ = false; }
    void release() { texture_ = {}; }
    uint64_t bytes() const { return texture_.name() != 0 ? texture_.bytes() : 0; }

private:
    GlTexture texture_;
    bool isFilled_ = false;
};

} // namespace fx::render
