#include "rendering/techniques/blocks/block_view.h"

#include "foundation/snapshot/block_groups.h"
#include "rendering/frame/exposure.h"
#include "rendering/frame/snapshot_match.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

namespace constant = base::block_constant;
using base::SnapshotGroup;

constexpr float kMostCounted = 4e9f; ///< below 2^32

/// The blocks of the effect in another snapshot; null if there are none.
const SnapshotGroup* sameBlocks(const base::FrameSnapshot* snapshot, const base::GroupName& name)
{
    for (size_t place = 0; snapshot && place < snapshot->addedCount(); ++place) {
        const SnapshotGroup& group = snapshot->added(place);
        if (base::nameOf(group.info()) == name && group.constants()[constant::Owner] == base::kNoOwner)
            return &group;
    }
    return nullptr;
}

/// What all balls of a group have in common.
GatheredBlob commonOf(const SnapshotGroup& late)
{
    GatheredBlob like{};
    like.detailAmount = late.constants()[base::blob_constant::DetailAmount];
    like.detailScale = late.constants()[base::blob_constant::DetailScale];
    like.anisotropy = late.constants()[base::blob_constant::Anisotropy];
    like.layer = uint32_t(late.constants()[base::blob_constant::Layer]);
    return like;
}

/// The detail of the field of blocks, from the coordinates of the blocks of the effect.
BlobDetail detailOf(const base::BlockGroups& groups, const base::FrameSnapshot* older, float t)
{
    const SnapshotGroup* const newer = groups.material();
    if (!newer)
        return {};
    const base::GroupName name = base::nameOf(newer->info());
    for (size_t place = 0; older && place < older->addedCount(); ++place)
        if (base::nameOf(older->added(place).info()) == name)
            return {*newer, &older->added(place), t};
    return {*newer, nullptr, t};
}

} // namespace

BlockView::BlockView(const TechniqueSetup& setup)
    : device_(*setup.device), blocks_(setup.schema->find(base::kBlockKind.name)),
      balls_(setup.schema->find(base::kBlockBallKind.name)), blobs_(setup.schema->find(base::kBlobKind.name)),
      contents_(setup.memory), errors_(setup.memory), tiles_(setup.memory), jobs_(setup.memory),
      gathered_(setup.memory), casters_(setup.memory), records_(setup.memory), ends_(setup.memory),
      details_(setup.memory), late_(setup.memory)
{}

base::Status BlockView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    counts_ = {};
    gathered_.clear();
    casters_.clear();
    records_.clear();
    ends_.clear();
    details_.clear();
    late_.clear();
    jobs_.begin();
    if (isPending_) // the last frame has failed
        tiles_.forget();
    isPending_ = false;
    tiles_.begin({in.settings->blocks.parallax, in.settings->blocks.resolution, !in.request->resetHistory});
    errors_.begin(!in.request->resetHistory);
    const base::FrameSnapshot* const shown = in.snapshots->newer;
    for (size_t place = 0; shown && place < shown->addedCount(); ++place)
        addCounts(shown->added(place));
    const bool drawsTiles = in.drawsTiles && in.settings->blocks.parallax > 0.0f && in.settings->outputs == 0;
    if (!drawsTiles || counts_.blockInstances == 0)
        return {};
    isPending_ = true;
    walk(in);
    // Without a history nothing depends on the frames before.
    const bool isWalkedAgain = tiles_.chooseFinest() && in.request->resetHistory;
    if (isWalkedAgain || tiles_.pageRows() > rows_) {
        // A larger atlas is empty: all tiles are drawn anew.
        rows_ = std::max(rows_, tiles_.pageRows());
        tiles_.forget();
        gathered_.clear();
        casters_.clear();
        records_.clear();
        ends_.clear();
        details_.clear();
        jobs_.begin();
        tiles_.begin({in.settings->blocks.parallax, in.settings->blocks.resolution, false});
        atlas_ = {};
        walk(in);
        rows_ = std::max(rows_, tiles_.pageRows());
    }
    size_t ball = 0, caster = 0;
    for (const Ends& ends : ends_) {
        late_.push_back({ends.name, std::span(gathered_).subspan(ball, ends.balls - ball),
                         std::span(casters_).subspan(caster, ends.casters - caster),
                         ends.detail < 0 ? nullptr : &details_[size_t(ends.detail)]});
        ball = ends.balls;
        caster = ends.casters;
    }
    io.late = late_;
    return makeRoom();
}

void BlockView::walk(const GatherInputs& in)
{
    const base::FrameSnapshot& newer = *in.snapshots->newer;
    BlockWalk walk(*in.camera, in.request->targets.height, tiles_, gathered_, casters_, records_);
    for (size_t place = 1; place < newer.addedCount(); ++place) {
        const base::GroupInfo& info = newer.added(place).info();
        if (info.isLate && info.kind == blobs_ && newer.added(place - 1).info().solver == info.solver)
            this->walk(in, walk, place);
    }
    counts_.blockImpostors = walk.counts().impostors;
    counts_.blobsCulled = walk.counts().culled;
    counts_.blobsNonFinite = walk.counts().nonFinite;
}

void BlockView::walk(const GatherInputs& in, BlockWalk& walk, size_t place)
{
    const base::FrameSnapshot& newer = *in.snapshots->newer;
    const base::FrameSnapshot* const older = in.snapshots->older;
    const SnapshotGroup& late = newer.added(place);
    const base::BlockGroups groups(newer, place);
    contents_.build(groups);
    const SnapshotGroup* const before = sameBlocks(older, base::nameOf(groups.root().info()));
    const float t = float(in.request->interpolation);
    const double step = older ? base::toSeconds(newer.tick() - older->tick()) : 0.0;
    BlockWalkSettings settings;
    settings.maxPixels = std::min(in.settings->blocks.maxPixels, BlockSettings::kMaxPixels);
    settings.exposure = exposureFromEv100(in.settings->exposureEv100);
    settings.error = in.settings->blocks.error;
    settings.errors = &errors_;
    settings.maxBalls = late.count();
    const size_t jobs = tiles_.jobs().size();
    const BlobDetail detail = detailOf(groups, before ? older : nullptr, t);
    const base::Placement at = placementAt(*in.snapshots, groups.root(), before, t, in.camera->eye);
    walk.run(groups, contents_, before, t, float(step), double(groups.root().constants()[constant::Seconds]),
             at, commonOf(late), detail, settings);
    if (detail.isGiven())
        details_.push_back(detail.groupDetail(at));
    jobs_.add(tiles_.jobs().subspan(jobs), contents_);
    ends_.push_back({base::nameOf(late.info()), gathered_.size(), casters_.size(),
                     detail.isGiven() ? int(details_.size()) - 1 : -1});
}

base::Status BlockView::makeRoom()
{
    if (records_.empty()) {
        if (!jobs_.isEmpty())
            tiles_.forget();
        return {};
    }
    if (base::Status status =
            render::makeRoom(device_, recordBuffer_, records_.size() * sizeof(BlockRecord), "block records");
        !status)
        return status;
    if (atlas_.name() != 0)
        return {};
    auto created = GlTexture::create(device_, kTilePageColumns * kMaxTile, rows_ * kMaxTile * kTileLayers,
                                     glInternalFormat(Format::RGBA16F), "block tiles");
    if (!created)
        return created.status();
    atlas_ = std::move(*created);
    return {};
}

void BlockView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload || records_.empty() || atlas_.name() == 0)
        return;
    ResourceId atlas =
        graph.importTexture({"block tiles", atlas_.width(), atlas_.height(), Format::RGBA16F}, atlas_.name());
    ResourceId records = graph.importBuffer(
        {"block records", std::bit_ceil(records_.size() * sizeof(BlockRecord))}, recordBuffer_.name());
    if (!isKept_) {
        graph.addPass("block upload", [&](FrameGraph::Builder& builder) {
            records = builder.write(records);
            return [records, this](Backend& backend) {
                backend.upload(records, std::as_bytes(std::span(records_)));
            };
        });
        if (!jobs_.isEmpty()) {
            atlas = jobs_.addTo(graph, atlas, rows_);
            graph.keep(atlas); // later frames show it
        }
    }
    frame.tiles = {atlas, records};
}

void BlockView::addCounts(const SnapshotGroup& group)
{
    const base::GroupInfo& info = group.info();
    if (info.kind == balls_)
        ++counts_.blocks;
    else if (info.kind == blocks_ && group.constants()[constant::Owner] != base::kNoOwner)
        ++counts_.blocks;
    else if (info.kind == blocks_) {
        counts_.blockInstances += uint32_t(std::min(group.constants()[constant::Blocks], kMostCounted));
        counts_.blockParticlesRefused += uint64_t(group.constants()[constant::Refused]);
        expands_ = {info.instance, info.solver, blobs_};
    } else if (base::nameOf(info) == expands_) {
        counts_.blockParticles += info.count;
    }
}

void BlockView::count(FrameStatistics& statistics) const
{
    statistics.blocks += counts_.blocks;
    statistics.blockInstances += counts_.blockInstances;
    statistics.blockParticles += counts_.blockParticles;
    statistics.blockParticlesRefused += counts_.blockParticlesRefused;
    statistics.blockImpostors += counts_.blockImpostors;
    statistics.blobsCulled += counts_.blobsCulled;
    statistics.blobsNonFinite += counts_.blobsNonFinite;
    if (isKept_)
        return;
    statistics.blockTilesDrawn += jobs_.count();
    statistics.blockTilesDeferred += tiles_.deferred() + errors_.deferred();
    statistics.uploadedBytes += jobs_.bytes() + records_.size() * sizeof(BlockRecord);
}

/// Tiles of a frame that was not drawn do not exist.
void BlockView::forget()
{
    tiles_.forget();
}

void BlockView::endFrame(bool succeeded)
{
    isPending_ = isPending_ && !succeeded;
    unused_ = records_.empty() ? unused_ + 1 : 0;
    if (unused_ == kIdleFrames)
        release();
}

void BlockView::rest()
{
    counts_ = {};
    records_.clear();
    endFrame(true);
}

void BlockView::release()
{
    tiles_.forget();
    errors_.forget();
    atlas_ = {};
    recordBuffer_ = {};
    rows_ = 0;
}

} // namespace fx::render
