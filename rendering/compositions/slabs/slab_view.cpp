#include "rendering/compositions/slabs/slab_view.h"

namespace fx::render {

namespace {

constexpr int kCoarseSlabs = 6; ///< up to which detail has kCoarseOctaves

} // namespace

base::Status SlabView::gather(const GatherInputs& in, GatheredFrame& io)
{
    details_.clear();
    const int octaves = in.settings->slabs <= kCoarseSlabs ? kCoarseOctaves : kMaxDetailOctaves;
    for (const GroupDetail& detail : io.details)
        details_.push_back(detailBlock(detail, octaves));
    materials_ = details_.empty() ? std::span<const BlobMaterial>() : io.materials;
    media_.gather(in, io);
    return details_.empty() ? base::Status() : lumpTile_.makeRoom(device_);
}

void SlabView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    slabs_ = frame.settings->slabs;
    media_.begin(*frame.settings);
    lumps_ = materials_.empty() ? ResourceId() : lumpTile_.addTo(graph);
}

MediaPass::Outputs SlabView::compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                     const MediaPass::Outputs& under)
{
    const SlabMedia::Lists lists =
        media_.list(graph, in, {0, {}, false, {materials_, details_, lumps_}, slabs_});
    return SlabPass::addTo(graph, lists.inSlabs(in, slabs_), under);
}

void SlabView::forget()
{
    lumpTile_.forget();
    media_.forget();
}

void SlabView::endFrame(bool)
{
    unused_ = details_.empty() ? unused_ + 1 : 0;
    if (unused_ == kIdleFrames)
        lumpTile_.release();
}

void SlabView::rest()
{
    media_.forget();
    details_.clear();
    materials_ = {};
    endFrame(true);
}

} // namespace fx::render
