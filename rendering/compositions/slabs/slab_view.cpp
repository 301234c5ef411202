#include "rendering/compositions/slabs/slab_view.h"

#include <bit>

namespace fx::render {

namespace {

constexpr int kCoarseSlabs = 6; ///< up to which detail has kCoarseOctaves

} // namespace

base::Status SlabView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    details_.clear();
    const int octaves = in.settings->slabs <= kCoarseSlabs ? kCoarseOctaves : kMaxDetailOctaves;
    for (const GroupDetail& detail : io.details)
        details_.push_back(detailBlock(detail, octaves));
    materials_ = details_.empty() ? std::span<const BlobMaterial>() : io.materials;
    const base::Status status = gatherNetwork(in, io);
    media_.gather(in, io);
    return status && !details_.empty() ? lumpTile_.makeRoom(device_) : status;
}

base::Status SlabView::gatherNetwork(const GatherInputs& in, const GatheredFrame& from)
{
    fields_.clear();
    if (FieldMedia::asksForNetworks(*in.settings))
        fields_.build(in, from);
    if (fields_.networks().empty())
        return network_.makeRoom({}, in.camera->eye);
    if (base::Status status = fields_.makeRoom(); !status)
        return status;
    if (base::Status status =
            makeRoom(device_, lights_, from.blobs.size() * kBlobLightBytes, "network blob lights");
        !status)
        return status;
    return network_.makeRoom(fields_.networks(), in.camera->eye);
}

void SlabView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    slabs_ = frame.settings->slabs;
    media_.begin(*frame.settings);
    lumps_ = materials_.empty() ? ResourceId() : lumpTile_.addTo(graph);
    hasNetwork_ = !network_.isEmpty() && media_.balls() && frame.lights.lights.valid();
    if (hasNetwork_)
        addNetwork(graph, frame);
}

/// At rest the lights of balls are those that the last frame has gathered.
void SlabView::addNetwork(FrameGraph& graph, const PassFrame& frame)
{
    const BallList& balls = *media_.balls();
    const size_t count = balls.instances.size();
    ResourceId lights =
        graph.importBuffer({"network blob lights", std::bit_ceil(count * kBlobLightBytes)}, lights_.name());
    network_.importAll(graph);
    const bool sweeps = !network_.isSettled() && !frame.request->range.isContinued;
    if (!isKept_ || sweeps || frame.mayShadowChange()) {
        fields_.importAll(graph);
        if (!isKept_) {
            fields_.upload(graph);
            fields_.fill(graph, frame.blobs);
        }
        network_.addPasses(graph, fields_.sources(), frame.lights, isKept_);
        lights = BlobLightPass::addTo(graph, {balls.balls, lights, frame.lights, &frame.view, uint32_t(count),
                                              network_.bindings()})
                     .blobLights;
    }
    media_.setLights(lights);
}

MediaPass::Outputs SlabView::compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                     const MediaPass::Outputs& under)
{
    const SlabMedia::Lists lists =
        media_.list(graph, in, {0, {}, false, {materials_, details_, lumps_}, slabs_});
    SlabPass::Inputs slabs = lists.inSlabs(in, slabs_);
    if (hasNetwork_)
        slabs.networks = network_.bindings();
    return SlabPass::addTo(graph, slabs, under);
}

void SlabView::forget()
{
    lumpTile_.forget();
    fields_.forget();
    media_.forget();
}

void SlabView::endFrame(bool)
{
    unused_ = details_.empty() ? unused_ + 1 : 0;
    if (unused_ == kIdleFrames)
        lumpTile_.release();
    networkUnused_ = fields_.networks().empty() ? networkUnused_ + 1 : 0;
    if (networkUnused_ == kIdleFrames) {
        fields_.release();
        network_.release();
        lights_ = {};
    }
}

void SlabView::rest()
{
    media_.forget();
    details_.clear();
    materials_ = {};
    fields_.clear();
    hasNetwork_ = false;
    endFrame(true);
}

} // namespace fx::render
