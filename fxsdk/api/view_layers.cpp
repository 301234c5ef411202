// Frames of several layers, see fxScene_SetLayer().
#include "fxsdk/api/check.h"
#include "fxsdk/api/view_object.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace fx::api {

namespace {

constexpr uint32_t kIdleFrames = 120; ///< frames without a layer after which its renderer is destroyed

/// Adds what a layer has drawn and cost.
void addStatistics(const render::FrameStatistics& more, render::FrameStatistics& io)
{
    io.blobs += more.blobs;
    io.blobsCulled += more.blobsCulled;
    io.blobsNonFinite += more.blobsNonFinite;
    io.blobsThinned += more.blobsThinned;
    io.particlesThinned += more.particlesThinned;
    io.impostors += more.impostors;
    io.impostorsTaken += more.impostorsTaken;
    for (size_t i = 0; i < std::size(io.lodGroups); ++i)
        io.lodGroups[i] += more.lodGroups[i];
    io.sprites += more.sprites;
    io.meshes += more.meshes;
    io.ribbonPieces += more.ribbonPieces;
    io.gpuParticles += more.gpuParticles;
    io.passes += more.passes;
    io.drawCalls += more.drawCalls;
    io.glCalls += more.glCalls;
    io.programsCompiled += more.programsCompiled;
    io.textureBytes += more.textureBytes;
    io.uploadedBytes += more.uploadedBytes;
    io.sortedElements += more.sortedElements;
    io.estimatedFragments += more.estimatedFragments;
    io.keptRowBytes += more.keptRowBytes;
    io.sharedRowBytes += more.sharedRowBytes;
    io.unsharedBytes += more.unsharedBytes;
    io.sharedBytes += more.sharedBytes;
    io.coveredPixels += more.coveredPixels;
    io.shadedFragments += more.shadedFragments;
    io.listedBalls += more.listedBalls;
    io.spilledBalls += more.spilledBalls;
    io.spilledCards += more.spilledCards;
    io.blocks += more.blocks;
    io.blockInstances += more.blockInstances;
    io.blockParticles += more.blockParticles;
    io.blockParticlesRefused += more.blockParticlesRefused;
    io.blockImpostors += more.blockImpostors;
    io.blockTilesDrawn += more.blockTilesDrawn;
}

LayerRenderer& lowerLayer(FxView& view, int32_t number)
{
    for (LayerRenderer& lower : view.lowerLayers)
        if (lower.layer == number)
            return lower;
    view.lowerLayers.push_back({number, FxView::makeRenderer(*view.context)});
    view.lowerLayers.back().renderer.setCompletes(false);
    return view.lowerLayers.back();
}

/// Destroys the renderers of layers that have not been seen for long.
void forgetIdleLayers(FxView& view, std::span<const SortLayer> drawn)
{
    for (LayerRenderer& lower : view.lowerLayers) {
        const bool isDrawn = std::any_of(drawn.begin(), drawn.end(),
                                         [&](const SortLayer& layer) { return layer.number == lower.layer; });
        lower.idleFrames = isDrawn ? 0 : lower.idleFrames + 1;
    }
    std::erase_if(view.lowerLayers,
                  [](const LayerRenderer& lower) { return lower.idleFrames >= kIdleFrames; });
}

} // namespace

base::Status checkLayers(const FxView& view, const FxFrameDef& frame)
{
    if (view.sortLayers.layers().size() < 2)
        return {};
    if (frame.target == FX_TARGET_FRAMEBUFFER && frame.colorTexture != 0)
        return invalid("frame.target is FX_TARGET_FRAMEBUFFER and frame.colorTexture is only read, so that a "
                       "layer would not see the layers below it: set frame.target to FX_TARGET_TEXTURE, or "
                       "give all instances of the frame one layer");
    const render::ViewSettings& settings = view.renderer.settings();
    if (settings.layerOutputs || settings.outputs != 0)
        return invalid("settings.layerOutputs and settings.outputs are textures of one layer, and the frame "
                       "has several: set them to 0, or give all instances of the frame one layer");
    return {};
}

render::FrameStatistics withLowerLayers(const FxView& view)
{
    render::FrameStatistics all = view.renderer.statistics();
    addStatistics(view.lowerStatistics, all);
    return all;
}

std::span<const LayerDraw> layersToDraw(FxView& view)
{
    const std::span<const SortLayer> layers = view.sortLayers.layers();
    const std::span<const SortLayer> lower = layers.empty() ? layers : layers.first(layers.size() - 1);
    view.lowerStatistics = {};
    view.layerDraws.clear();
    if (!view.lowerLayers.empty())
        forgetIdleLayers(view, lower);
    for (const SortLayer& layer : lower)
        (void)lowerLayer(view, layer.number); // makes all before any is pointed to
    for (const SortLayer& layer : lower) {
        render::ViewRenderer& renderer = lowerLayer(view, layer.number).renderer;
        renderer.settings() = view.renderer.settings();
        view.layerDraws.push_back({&renderer, layer.snapshots, false});
    }
    const base::SnapshotPair& top =
        layers.empty() ? view.prepared->shown().snapshots : layers.back().snapshots;
    view.layerDraws.push_back({&view.renderer, top, true});
    return view.layerDraws;
}

void noteDrawn(const LayerDraw& layer, FxView& view)
{
    if (!layer.isUppermost)
        addStatistics(layer.renderer->statistics(), view.lowerStatistics);
}

} // namespace fx::api
