#include "rendering/outputs/output_view.h"

#include <bit>

namespace fx::render {

base::Status OutputView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    listed_ = io.marks;
    media_.see(in, io);
    return makeRoom(device_, marks_, listed_.size_bytes(), "blob marks");
}

void OutputView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    media_.begin(*frame.settings);
    markBuffer_ = {};
    if (listed_.empty())
        return;
    markBuffer_ = graph.importBuffer({"blob marks", std::bit_ceil(listed_.size_bytes())}, marks_.name());
    if (!isKept_)
        graph.addPass("blob mark upload", [&](FrameGraph::Builder& builder) {
            markBuffer_ = builder.write(markBuffer_);
            return [buffer = markBuffer_, marks = listed_](Backend& backend) {
                backend.upload(buffer, std::as_bytes(marks));
            };
        });
}

OutputTextures OutputView::addTo(FrameGraph& graph, const PassFrame& frame, ResourceId hostDistance,
                                 std::span<const MediaSource* const> solids, const PastFrame& past)
{
    const MediaPass::Inputs media{{}, frame.distance, frame.width, frame.height, frame.view, false};
    const SolidMarks marks =
        SolidMarkPass::addTo(graph, {solids, hostDistance, frame.width, frame.height, frame.view});
    return OutputPass::addTo(graph, {frame.settings->outputs,
                                     media_.list(graph, media, {OutputPass::kMaxOfTile, {}, true}),
                                     markBuffer_, marks, frame.distance, frame.width, frame.height,
                                     frame.view, &frame.request->camera, past});
}

void OutputView::rest()
{
    media_.forget();
    marks_ = {};
}

/// What has no room is left out of the outputs as well; what is listed, the composition counts.
void OutputView::readBack(const GlBackend& backend, FrameStatistics& statistics)
{
    FrameStatistics own;
    media_.readBack(backend, own);
    statistics.spilledBalls += own.spilledBalls;
    statistics.spilledCards += own.spilledCards;
}

} // namespace fx::render
