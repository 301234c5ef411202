/// @file detail_resources.h
/// GPU resources that compositions need to draw the detail of fields. Threads: [GL thread].
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_texture.h"

#include <cstdint>

namespace fx::render {

constexpr int kCoarseOctaves = 3; ///< number of octaves of detail in views with few slabs or few voxels

/// Converts the detail of a group to the layout of the GPU. @param octaves 1 .. kMaxDetailOctaves
FieldDetailBlock detailBlock(const GroupDetail& detail, int octaves);

/// Owns the texture of the periodic cube of noise (formula lump-noise). makeRoom() creates the texture. The
/// pass that addTo() adds fills the texture once.
class LumpTileTexture
{
public:
    /// Creates the texture if it does not exist.
    /// @return OutOfMemory, InvalidArgument (the context has no textures of this size)
    base::Status makeRoom(GlDevice& device);
    /// Imports the texture into the graph. If the texture is not filled yet, also adds the pass that fills
    /// the texture. makeRoom() must have been called.
    [[nodiscard]] ResourceId addTo(FrameGraph& graph);
    /// Must be called if the pass of the last addTo() has not run. The next addTo() then adds the pass
    /// again.
    void forget() { isFilled_ = false; }
    void release() { texture_ = {}; }
    uint64_t bytes() const { return texture_.bytes(); }

private:
    GlTexture texture_;
    bool isFilled_ = false;
};

} // namespace fx::render
