// What a frame of a view is said to have cost.
#include "rendering/gl/gl_read_texture.h"
#include "rendering/passes/dazzle_pass.h"
#include "rendering/view/view_parts.h"

#include <algorithm>

namespace fx::render {

/// What the frame has drawn.
FrameStatistics ViewRenderer::Impl::count(int divisor)
{
    FrameStatistics statistics;
    statistics.blobs = uint32_t(builder.blobs().size());
    statistics.blobsCulled = builder.counts().culled;
    statistics.blobsNonFinite = builder.counts().nonFinite;
    statistics.blobsThinned = builder.counts().thinned;
    std::copy(builder.lodCounts().begin(), builder.lodCounts().end(), statistics.lodGroups);
    for (const DrawnCounts& drawn : {single.frame.drawn(), joined.frame.drawn()}) {
        statistics.sprites += drawn.sprites;
        statistics.meshes += drawn.meshes;
        statistics.ribbonPieces += drawn.ribbonPieces;
    }
    statistics.particles = statistics.sprites + statistics.meshes + statistics.ribbonPieces;
    for (const ParticleBatch& batch : batches)
        statistics.gpuParticles += batch.isComputed ? batch.instances : 0;
    statistics.particlesOrdered = single.frame.orderedRows() + joined.frame.orderedRows();
    statistics.particlesThinned = single.frame.thinnedRows() + joined.frame.thinnedRows();
    statistics.keptLists = keptLists;
    statistics.impostors = uint32_t(builder.impostors().size());
    statistics.impostorsTaken = keptLists ? 0 : uint32_t(builder.takenTiles().size());
    statistics.uploadedBytes = single.buffers.uploadedBytes() + joined.buffers.uploadedBytes() +
                               (keptLists ? 0
                                          : builder.blobs().size_bytes() + builder.impostors().size_bytes() +
                                                builder.takenBlobs().size_bytes());
    statistics.keptRowBytes = single.buffers.keptBytes() + joined.buffers.keptBytes();
    statistics.sharedRowBytes = single.buffers.sharedBytes() + joined.buffers.sharedBytes();
    statistics.sortedElements = keptLists ? 0 : statistics.particlesOrdered + builder.blobs().size();
    statistics.passes = outputs.anyPass ? uint32_t(graph.executedPasses().size()) : 0;
    statistics.drawCalls = outputs.anyPass ? backend.drawCalls() : 0;
    statistics.textureBytes = backend.pooledBytes() + single.buffers.bytes() + joined.buffers.bytes() +
                              blobBuffer.bytes() + impostorBuffer.bytes() + impostorAtlas.bytes();
    if (outputs.anyPass) {
        statistics.unsharedBytes = graph.memory().unshared;
        statistics.sharedBytes = graph.memory().shared;
    }
    statistics.estimatedFragments = fragments[layerDivisorIndex(divisor)];
    statistics.layerDivisor = divisor;
    return statistics;
}

void ViewRenderer::Impl::readBack(FrameStatistics& statistics)
{
    if (outputs.overdraw.valid()) {
        for (const float count : readTexture(*device, backend.textureName(outputs.overdraw),
                                             outputs.layerWidth, outputs.layerHeight, 1))
        {
            statistics.coveredPixels += count > 0.0f ? 1 : 0;
            statistics.shadedFragments += uint64_t(count);
        }
    }
    if (dazzleHistory.name() != 0 && !historyFresh) {
        DazzleHistory history;
        device->gl.GetNamedBufferSubData(dazzleHistory.name(), 0, sizeof history, &history);
        std::copy_n(history.frameMean, 3, statistics.overflow);
    }
}

} // namespace fx::render
