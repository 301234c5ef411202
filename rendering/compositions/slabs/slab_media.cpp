#include "rendering/compositions/slabs/slab_media.h"

#include "rendering/gl/gl_backend.h"
#include "rendering/media/blob_estimate.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::render {

namespace {

constexpr uint64_t kMinCards = 4096;

template <class T>
T readBuffer(GlDevice& device, uint32_t name)
{
    T value{};
    device.gl.GetNamedBufferSubData(name, 0, sizeof value, &value);
    return value;
}

} // namespace

SlabMedia::SlabMedia(const TechniqueSetup& setup)
    : device_(*setup.device), cards_(setup.memory), rects_(setup.memory)
{}

void SlabMedia::gather(const GatherInputs& in, GatheredFrame& io)
{
    see(in, io);
    io.streams->clear();
}

void SlabMedia::see(const GatherInputs& in, const GatheredFrame& from)
{
    ballSource_ = nullptr;
    cards_.clear();
    for (const DrawStream& stream : *from.streams) {
        if (stream.source->balls())
            ballSource_ = stream.source;
        else
            cards_.push_back({stream.batch, 0, stream.count, stream.source});
    }
    const HostTargets& targets = in.request->targets;
    const FragmentCounts ofBalls = estimateFragments(from.blobs, *in.camera, targets.width, targets.height);
    cardFragments_ = from.fragments[0] - std::min(from.fragments[0], ofBalls[0]);
    width_ = targets.width;
}

void SlabMedia::begin(const ViewSettings& settings)
{
    counts_ = settings.countOverdraw;
    lights_ = {};
    forget();
}

/// Twice what is estimated, since rows may overlap more; for each texel at least one.
uint64_t SlabMedia::cardCapacity(const MediaPass::Inputs& in) const
{
    const double scale = double(in.width) / double(std::max(width_, 1));
    const uint64_t wanted = std::max({uint64_t(2.0 * scale * scale * double(cardFragments_)),
                                      uint64_t(in.width) * uint64_t(in.height), kMinCards});
    return std::min(std::bit_ceil(wanted), kMaxCards);
}

SlabMedia::Lists SlabMedia::list(FrameGraph& graph, const MediaPass::Inputs& in, const ListUse& use)
{
    BallList balls = ballSource_ ? *ballSource_->balls() : BallList();
    if (lights_.valid())
        balls.lights = lights_;
    const uint64_t entries = findTiles(balls.instances, in.view, rects_);
    capacity_ = cardCapacity(in);
    Lists out{};
    out.fieldDetail = SlabDetailPass::addTo(graph, balls.instances.empty() ? BallDetails() : use.details);
    out.detail = out.fieldDetail.texels.valid() ? SlabDetail::OfFields
                 : balls.detail                 ? SlabDetail::OfBalls
                                                : SlabDetail::None;
    out.blocks = use.slabs > 0 ? balls.tiles : BlockTileBindings();
    const bool isAlone = in.view.rayDirection.w > 0.5f; // see ViewBlock
    const bool isCut = !isAlone && (in.view.clipOffset.z > 0.0f || std::isfinite(in.view.clipOffset.w));
    const uint32_t most = use.slabs > 0
                              ? SlabPass::maxOfTile(use.slabs, out.detail, in.layers,
                                                    use.details.details.size(), out.blocks.valid(), isCut)
                              : use.maxOfTile;
    out.cards = SlabCardPass::addTo(graph, {cards_, &in, capacity_, use.marks});
    out.tiles = SlabTilePass::addTo(
        graph, {rects_, entries, in.width, in.height, most, in.view.rayOriginY.w, out.cards, use.fieldTiles});
    out.balls = SlabBallPass::addTo(graph, balls, out.fieldDetail, in.view, out.blocks.valid());
    if (counts_) {
        tiles_ = out.tiles.tiles;
        heads_ = out.cards.heads;
        graph.keep(tiles_);
        if (heads_.valid())
            graph.keep(heads_);
    }
    return out;
}

void SlabMedia::readBack(const GlBackend& backend, FrameStatistics& statistics)
{
    if (tiles_.valid()) {
        const auto counts = readBuffer<SlabTileCounts>(device_, backend.bufferName(tiles_));
        statistics.listedBalls += counts.listed;
        statistics.spilledBalls += counts.spilled;
    }
    if (heads_.valid()) {
        const uint64_t cards = readBuffer<uint32_t>(device_, backend.bufferName(heads_));
        statistics.spilledCards += cards - std::min(cards, capacity_);
    }
}

} // namespace fx::render
