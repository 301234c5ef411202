/// @file blob_view.h
/// The blobs of one view, and the impostors of far effects.
#pragma once

#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/media/frame_builder.h"
#include "rendering/passes/blob_source.h"
#include "rendering/passes/impostor_pass.h"
#include "rendering/techniques/draw_technique.h"

namespace fx::render {

class BlobView final : public TechniqueView
{
public:
    explicit BlobView(const TechniqueSetup& setup);

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    base::Status gatherOtherEye(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override;
    bool isSettled() const override { return builder_.isSettled(); }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    void forget() override;
    void endFrame(bool succeeded) override;
    void rest() override;
    void count(FrameStatistics& statistics) const override;
    void readBack(const GlBackend& backend, FrameStatistics& statistics) override;
    void cover(const CameraGeometry& camera, ScreenShare& share) const override;
    uint64_t bytes() const override;

private:
    base::Status handOut(const GatherInputs& in, GatheredFrame& io);
    base::Status makeRoomForImpostors();
    void releaseBlobs();
    void releaseImpostors();
    void addPictures(FrameGraph& graph, PassFrame& frame);
    void takePictures(FrameGraph& graph, const PassFrame& frame);
    void uploadImpostors(FrameGraph& graph);
    void uploadBlobs(FrameGraph& graph, PassFrame& frame);
    void addLights(FrameGraph& graph, const PassFrame& frame);
    void countOverdraw(FrameGraph& graph, const PassFrame& frame);

    GlDevice& device_;
    FrameBuilder builder_;
    BlobSource blobs_;
    BlobSource takenBlobs_; ///< source of the blobs of the impostors that are rendered in this frame
    DrawBatch takenBatch_;
    ImpostorSource impostors_;
    GlBuffer blobBuffer_;  ///< buffer of blobs; persistent, so that the next frame can reuse its content
    GlBuffer lightBuffer_; ///< buffer of the lights of blobs; persistent, like `blobBuffer_`
    GlBuffer impostorBuffer_;
    GlTexture impostorAtlas_;      ///< created when the first impostor is rendered
    bool isKept_ = false;          ///< true: lists and buffers are unchanged since the last frame
    uint32_t blobsUnused_ = 0;     ///< consecutive frames without blobs
    uint32_t impostorsUnused_ = 0; ///< consecutive frames without impostors
    uint32_t restingFrames_ = 0;   ///< number of consecutive calls of rest()
    ResourceId overdraw_;          ///< output of OverdrawPass; invalid: fragments are not counted
    int layerWidth_ = 0, layerHeight_ = 0;
};

} // namespace fx::render
