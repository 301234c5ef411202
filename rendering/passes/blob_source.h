/// @file blob_source.h
/// Draws blobs of fire, smoke and dust as balls of medium in the media pass.
#pragma once

#include "rendering/passes/media_source.h"

namespace fx::render {

/// The program of one permutation.
/// @param detail true: the program draws procedural detail
/// @param layers true: the program writes layer targets
/// @param isSmall true: the targets are smaller than the picture
const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall);
constexpr size_t kMediaPrograms = 3 * 2 * 2 * 2;
const ProgramDesc& mediaProgramAt(size_t index);

/// Draws BlobInstances of a buffer, sorted by decreasing distance. Formula: kernel-optical-depth, or the
/// formula of the chosen billboard form.
class BlobSource final : public MediaSource
{
public:
    void read(FrameGraph::Builder& builder) const override;
    void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const override;
    const BallList* balls() const override { return &list; }

    ResourceId blobs; ///< buffer of BlobInstance
    /// Buffer written by BlobLightPass; invalid if the sky has no planes of light slices.
    ResourceId blobLights;
    BillboardForm form = BillboardForm::Kernel;
    bool detail = false; ///< true: some blobs have procedural detail, and it is drawn
    BallList list;       ///< the same blobs, for compositions that sum them
};

} // namespace fx::render
