// What a frame of a view is said to have cost.
#include "rendering/view/view_parts.h"

#include <algorithm>

namespace fx::render {

/// What the frame has drawn.
FrameStatistics ViewRenderer::Impl::count(int divisor)
{
    FrameStatistics statistics;
    for (const auto& part : parts)
        part->count(statistics);
    std::copy(lod.counts().begin(), lod.counts().end(), statistics.lodGroups);
    statistics.keptLists = keptLists;
    statistics.passes = outputs.anyPass ? uint32_t(graph.executedPasses().size()) : 0;
    statistics.drawCalls = outputs.anyPass ? backend.drawCalls() : 0;
    statistics.textureBytes = bytes();
    if (outputs.anyPass) {
        statistics.unsharedBytes = graph.memory().unshared;
        statistics.sharedBytes = graph.memory().shared;
    }
    statistics.estimatedFragments = fragments[layerDivisorIndex(divisor)];
    statistics.layerDivisor = divisor;
    return statistics;
}

} // namespace fx::render
