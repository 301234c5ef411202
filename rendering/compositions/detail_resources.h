/// @file detail_resources.h
/// Resources on the GPU with which compositions draw the detail of fields. Threads: [GL thread].
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_texture.h"

#include <cstdint>

namespace fx::render {

constexpr int kCoarseOctaves = 3; ///< octaves of detail in coarse pictures

/// Converts the detail of a group to the layout of the GPU. @param octaves 1 .. kMaxDetailOctaves
FieldDetailBlock detailBlock(const GroupDetail& detail, int octaves);

/// The texture of the periodic cube of noise (formula lump-noise). It is created by makeRoom() and filled
/// once.
class LumpTileTexture
{
public:
    /// @return OutOfMemory, InvalidArgument (the context has no textures of this size)
    base::Status makeRoom(GlDevice& device);
    /// Imports the texture, and adds the pass that fills it if it is not filled. Requires makeRoom().
    [[nodiscard]] ResourceId addTo(FrameGraph& graph);
    /// Call this if the passes of the last addTo() have not run: the next addTo() fills the texture.
    void forget() { isFilled_ = false; }
    void release() { texture_ = {}; }
    uint64_t bytes() const { return texture_.name() != 0 ? texture_.bytes() : 0; }

private:
    GlTexture texture_;
    bool isFilled_ = false;
};

} // namespace fx::render
