/// @file slab_media.h
/// Lists the balls and cards (flat particles) of each screen tile, for passes that sum media along rays.
#pragma once

#include "rendering/compositions/slabs/slab_passes.h"
#include "rendering/techniques/draw_technique.h"

namespace fx::render {

/// Takes the streams of a gathered frame, and adds passes that list the elements of the streams per tile.
/// The memory is kept from frame to frame.
class SlabMedia
{
public:
    explicit SlabMedia(const TechniqueSetup& setup);

    /// Moves all streams from `io` to this object.
    void gather(const GatherInputs& in, GatheredFrame& io);
    /// Stores references to all streams; the streams also stay in `from`.
    void see(const GatherInputs& in, const GatheredFrame& from);
    /// Replaces the source of balls. `balls` must stay valid, and its buffers must exist when list() is
    /// called. With null, no balls are drawn.
    void replaceBalls(const MediaSource* balls) { ballSource_ = balls; }
    bool isEmpty() const { return !ballSource_ && cards_.empty(); }
    /// Balls of this frame; null without balls.
    const BallList* balls() const { return ballSource_ ? ballSource_->balls() : nullptr; }

    /// Begins the passes of a frame.
    void begin(const ViewSettings& settings);
    /// Sets the lights of the balls of this frame, instead of BallList::lights.
    void setLights(ResourceId lights) { lights_ = lights; }

    /// Results of list().
    struct Lists
    {
        SlabTilePass::Outputs tiles;
        ResourceId balls; ///< texture written by SlabBallPass; invalid: no balls
        SlabDetail detail;
        SlabDetailPass::Outputs fieldDetail;
        CardLists cards;

        BlockTileBindings blocks; ///< tiles of the balls, if the pass that reads the lists is a SlabPass

        SlabPass::Inputs inSlabs(const MediaPass::Inputs& media, int slabs) const
        {
            return {&media, balls, detail, fieldDetail, tiles, cards, blocks, slabs};
        }
    };
    /// Options of list().
    struct ListUse
    {
        uint32_t maxOfTile;         ///< see SlabTilePass::Inputs; ignored with `slabs`
        ResourceId fieldTiles = {}; ///< see SlabTilePass::Inputs
        bool marks = false;         ///< true: cards also store the data for ViewSettings::outputs
        BallDetails details = {};
        int slabs = 0; ///< number of slabs of the SlabPass that reads the lists; 0: another pass reads them
    };
    /// Adds the passes that list balls and cards. Called once or twice per frame.
    [[nodiscard]] Lists list(FrameGraph& graph, const MediaPass::Inputs& in, const ListUse& use);

    void forget() { tiles_ = heads_ = {}; }
    void readBack(const GlBackend& backend, FrameStatistics& statistics);

private:
    uint64_t cardCapacity(const MediaPass::Inputs& in) const;

    GlDevice& device_;
    const MediaSource* ballSource_ = nullptr; ///< source of all balls; null without balls
    std::pmr::vector<DrawBatch> cards_;       ///< batches of all sources without balls
    std::pmr::vector<TileRect> rects_;
    uint64_t cardFragments_ = 0; ///< estimated number of fragments of all cards
    int width_ = 0;              ///< [pixel] width of the picture
    bool counts_ = false;        ///< true: listed and dropped entries are counted
    ResourceId lights_;          ///< see setLights(); invalid: those of the balls
    ResourceId tiles_, heads_;   ///< counters of the last frame, for reading back to the CPU; may be invalid
    uint64_t capacity_ = 0;      ///< largest number of card fragments in the last frame's lists
};

} // namespace fx::render
