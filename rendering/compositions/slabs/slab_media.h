/// @file slab_media.h
/// Per-tile lists of the balls and cards (flat particles) of a view, for passes that sum them along rays.
#pragma once

#include "rendering/compositions/slabs/slab_passes.h"
#include "rendering/techniques/draw_technique.h"

namespace fx::render {

/// Removes streams from a gathered frame, and adds passes that list their elements per tile. The memory is
/// kept from frame to frame.
class SlabMedia
{
public:
    explicit SlabMedia(const TechniqueSetup& setup);

    /// Removes all streams from `io` and stores them.
    void gather(const GatherInputs& in, GatheredFrame& io);
    /// Stores references to all streams; the streams also stay in `from`.
    void see(const GatherInputs& in, const GatheredFrame& from);
    /// Replaces the balls of the stored streams by those of `balls`; null: no balls. `balls` must stay valid,
    /// and its buffers must exist when list() is called.
    void replaceBalls(const MediaSource* balls) { ballSource_ = balls; }
    bool isEmpty() const { return !ballSource_ && cards_.empty(); }

    /// Begins the passes of a frame.
    void begin(const ViewSettings& settings);

    /// Results of list().
    struct Lists
    {
        SlabTilePass::Outputs tiles;
        ResourceId balls; ///< texture written by SlabBallPass; invalid: no balls
        SlabDetail detail;
        SlabDetailPass::Outputs fieldDetail;
        CardLists cards;

        SlabPass::Inputs inSlabs(const MediaPass::Inputs& media, int slabs) const
        {
            return {&media, balls, detail, fieldDetail, tiles, cards, slabs};
        }
    };
    /// Options of list().
    struct ListUse
    {
        uint32_t maxOfTile;         ///< see SlabTilePass::Inputs
        ResourceId fieldTiles = {}; ///< see SlabTilePass::Inputs
        bool marks = false;         ///< true: cards also get the data that outputs need
        BallDetails details = {};
    };
    /// Adds the passes that list balls and cards. A frame calls it once or twice.
    [[nodiscard]] Lists list(FrameGraph& graph, const MediaPass::Inputs& in, const ListUse& use);

    void forget() { tiles_ = heads_ = {}; }
    void readBack(const GlBackend& backend, FrameStatistics& statistics);

private:
    uint64_t cardCapacity(const MediaPass::Inputs& in) const;

    GlDevice& device_;
    const MediaSource* ballSource_ = nullptr; ///< source of all balls; null without balls
    std::pmr::vector<DrawBatch> cards_;       ///< batches of other sources
    std::pmr::vector<TileRect> rects_;
    uint64_t cardFragments_ = 0; ///< estimated number of fragments of cards in the whole picture
    int width_ = 0;              ///< [pixel] width of the picture
    bool counts_ = false;        ///< true: listed and spilled entries are counted
    ResourceId tiles_, heads_;   ///< counters of the last frame, for reading back to the CPU; may be invalid
    uint64_t capacity_ = 0;      ///< number of fragments of cards for which the last frame had memory
};

} // namespace fx::render
