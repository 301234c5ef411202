/// @file block_view.h
/// The blocks of medium of one view: impostors of those that are small on the picture.
#pragma once

#include "rendering/blocks/block_tile_pass.h"
#include "rendering/blocks/block_walk.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/techniques/draw_technique.h"

#include <deque>

namespace fx::render {

/// Gives the balls of blocks to the technique that draws balls, where the composition draws tiles. Otherwise
/// that technique reads the balls of all blocks from the snapshot.
class BlockView final : public TechniqueView
{
public:
    explicit BlockView(const TechniqueSetup& setup);

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override { isKept_ = true; }
    bool isSettled() const override { return tiles_.deferred() + errors_.deferred() == 0; }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    void forget() override;
    void endFrame(bool succeeded) override;
    void rest() override;
    void count(FrameStatistics& statistics) const override;
    uint64_t bytes() const override { return atlas_.bytes() + recordBuffer_.bytes(); }

private:
    void addCounts(const base::SnapshotGroup& group);
    void walk(const GatherInputs& in);
    void walk(const GatherInputs& in, BlockWalk& walk, size_t place);
    base::Status makeRoom();
    void release();

    GlDevice& device_;
    base::KindId blocks_, balls_, blobs_;
    base::GroupName expands_; ///< group of the balls of the blocks that were added last
    FrameStatistics counts_;

    BlockContents contents_;
    BlockErrors errors_;
    BlockTiles tiles_;
    BlockTileJobs jobs_;
    std::pmr::vector<GatheredBlob> gathered_;
    std::pmr::vector<MediumCaster> casters_;
    std::pmr::vector<BlockRecord> records_;
    /// Ends of each group's balls and casters in the lists.
    struct Ends
    {
        base::GroupName name;
        size_t balls, casters;
        int detail; ///< index in details_; -1: none
    };
    std::pmr::vector<Ends> ends_;
    std::pmr::vector<GroupDetail> details_;
    std::pmr::vector<LateBalls> late_;
    GlTexture atlas_;
    GlBuffer recordBuffer_;
    int rows_ = 0;           ///< rows of pages of the atlas
    bool isPending_ = false; ///< true: tiles of the cache have not been drawn yet
    bool isKept_ = false;    ///< true: lists and buffers are those of the last frame
    uint32_t unused_ = 0;    ///< consecutive frames without impostors
};

} // namespace fx::render
