/// @file slab_media.h
/// Per-tile lists of balls and cards of a view, for passes that sum them along rays.
#pragma once

#include "rendering/compositions/slabs/slab_passes.h"
#include "rendering/techniques/draw_technique.h"

namespace fx::render {

/// Takes streams from a gathered frame, and lists them when the frame is drawn. Keeps its memory from frame
/// to frame.
class SlabMedia
{
public:
    explicit SlabMedia(const TechniqueSetup& setup);

    /// Takes all streams.
    void gather(const GatherInputs& in, GatheredFrame& io);
    /// Remembers all streams, and leaves them where they are.
    void see(const GatherInputs& in, const GatheredFrame& from);
    /// In place of the balls that it has taken; null: none. Must stay, and have its buffers when list() is
    /// called.
    void replaceBalls(const MediaSource* balls) { ballSource_ = balls; }
    bool isEmpty() const { return !ballSource_ && cards_.empty(); }

    /// Begins the passes of a frame.
    void begin(const ViewSettings& settings);

    /// Results of list().
    struct Lists
    {
        SlabTilePass::Outputs tiles;
        ResourceId balls; ///< as texels; invalid: none
        SlabDetail detail;
        SlabDetailPass::Outputs fieldDetail;
        CardLists cards;

        SlabPass::Inputs inSlabs(const MediaPass::Inputs& media, int slabs) const
        {
            return {&media, balls, detail, fieldDetail, tiles, cards, slabs};
        }
    };
    /// What list() makes.
    struct ListUse
    {
        uint32_t maxOfTile;         ///< as SlabTilePass
        ResourceId fieldTiles = {}; ///< likewise
        bool marks = false;         ///< cards are gathered with what outputs need
        BallDetails details = {};
    };
    /// Adds the passes that list balls and cards. A frame calls it once or twice.
    [[nodiscard]] Lists list(FrameGraph& graph, const MediaPass::Inputs& in, const ListUse& use);

    void forget() { tiles_ = heads_ = {}; }
    void readBack(const GlBackend& backend, FrameStatistics& statistics);

private:
    uint64_t cardCapacity(const MediaPass::Inputs& in) const;

    GlDevice& device_;
    const MediaSource* ballSource_ = nullptr; ///< of all balls; null without balls
    std::pmr::vector<DrawBatch> cards_;       ///< batches other than balls
    std::pmr::vector<TileRect> rects_;
    uint64_t cardFragments_ = 0; ///< estimated, of the whole picture
    int width_ = 0;              ///< [pixel] of the picture
    bool counts_ = false;        ///< counts listed and spilled entries
    ResourceId tiles_, heads_;   ///< counters of the last frame, for reading back; may be invalid
    uint64_t capacity_ = 0;      ///< of the last frame's cards
};

} // namespace fx::render
