/// @file blob_source.h
/// Draws blobs of fire, smoke and dust as balls of medium in the media pass.
#pragma once

#include "rendering/passes/media_source.h"

namespace fx::render {

/// Returns the program of the media pass for a combination of options.
/// @param detail true: the program draws procedural detail
/// @param layers true: the program writes layer targets
/// @param isSmall true: the targets are smaller than the picture
const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall);
constexpr size_t kMediaPrograms = 3 * 2 * 2 * 2;
const ProgramDesc& mediaProgramAt(size_t index);

/// Draws the BlobInstances of a buffer, which are sorted by decreasing distance. `form` selects the formula
/// of the optical depth; the default is kernel-optical-depth.
class BlobSource final : public MediaSource
{
public:
    void read(FrameGraph::Builder& builder) const override;
    void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const override;
    const BallList* balls() const override { return &list; }

    ResourceId blobs; ///< buffer of BlobInstance
    /// Buffer written by BlobLightPass.
    ResourceId blobLights;
    BillboardForm form = BillboardForm::Kernel;
    bool detail = false; ///< true: the procedural detail of blobs is drawn
    BallList list;       ///< the blobs, for compositions that sum balls
};

} // namespace fx::render
