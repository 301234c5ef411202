/// @file output_view.h
/// State of a view for its outputs (view_output).
#pragma once

#include "rendering/gl/gl_buffer.h"
#include "rendering/outputs/output_pass.h"

namespace fx::render {

/// The object exists while the settings of a view request outputs. Its gather() is called after the gather()
/// of all techniques and before the gather() of the composition. gather() removes no streams from the frame.
class OutputView final : public TechniqueView
{
public:
    explicit OutputView(const TechniqueSetup& setup) : device_(*setup.device), media_(setup) {}

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override { isKept_ = true; }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    void forget() override { media_.forget(); }
    void rest() override;
    uint64_t bytes() const override { return marks_.bytes(); }
    void readBack(const GlBackend& backend, FrameStatistics& statistics) override;

    /// Adds the passes of a frame. PassFrame::distance must include opaque particles.
    /// @param hostDistance [m] distance along the ray to the host's opaque geometry, without particles
    [[nodiscard]] OutputTextures addTo(FrameGraph& graph, const PassFrame& frame, ResourceId hostDistance,
                                       std::span<const MediaSource* const> solids, const PastFrame& past);

private:
    GlDevice& device_;
    SlabMedia media_;
    GlBuffer marks_;
    std::span<const BlobMark> listed_; ///< marks of the balls of this frame
    ResourceId markBuffer_;
    bool isKept_ = false;
};

} // namespace fx::render
