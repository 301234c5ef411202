#include "rendering/compositions/slabs/slab_view.h"

namespace fx::render {

base::Status SlabView::gather(const GatherInputs& in, GatheredFrame& io)
{
    media_.gather(in, io);
    return {};
}

void SlabView::addPasses(PassStage stage, FrameGraph&, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    slabs_ = frame.settings->slabs;
    media_.begin(*frame.settings);
}

MediaPass::Outputs SlabView::compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                     const MediaPass::Outputs& under)
{
    return SlabPass::addTo(graph, media_.list(graph, in).inSlabs(in, slabs_), under);
}

} // namespace fx::render
