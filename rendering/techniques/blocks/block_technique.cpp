#include "foundation/snapshot/block_kind.h"
#include "rendering/techniques/draw_techniques.h"

#include <algorithm>

namespace fx::render {

namespace {

namespace constant = base::block_constant;

constexpr float kMostCounted = 4e9f; ///< below 2^32

/// Counts the blocks of the visible effects. Their balls are drawn by kBlobTechnique.
class BlockView final : public TechniqueView
{
public:
    explicit BlockView(const base::SnapshotSchema& schema)
        : blocks_(schema.find(base::kBlockKind.name)), balls_(schema.find(base::kBlockBallKind.name)),
          blobs_(schema.find(base::kBlobKind.name))
    {}

    base::Status gather(const GatherInputs& in, GatheredFrame&) override
    {
        counts_ = {};
        const base::FrameSnapshot* const shown = in.snapshots->newer;
        for (size_t place = 0; shown && place < shown->addedCount(); ++place)
            add(shown->added(place));
        return {};
    }
    void rest() override { counts_ = {}; }
    void count(FrameStatistics& statistics) const override
    {
        statistics.blocks += counts_.blocks;
        statistics.blockInstances += counts_.blockInstances;
        statistics.blockParticles += counts_.blockParticles;
        statistics.blockParticlesRefused += counts_.blockParticlesRefused;
    }

private:
    void add(const base::SnapshotGroup& group)
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

    base::KindId blocks_, balls_, blobs_;
    base::GroupName expands_; ///< group of the balls of the blocks that were added last
    FrameStatistics counts_;
};

std::unique_ptr<TechniqueView> create(const TechniqueSetup& setup)
{
    return std::make_unique<BlockView>(*setup.schema);
}

} // namespace

constexpr DrawTechnique kBlockTechnique{
    .name = "particle blocks",
    .kind = &base::kBlockKind,
    .create = create,
};

constexpr DrawTechnique kBlockBallTechnique{
    .name = "balls of particle blocks",
    .kind = &base::kBlockBallKind,
};

} // namespace fx::render
