/// @file media_source.h
/// Interface of drawable data for the passes of opaque particles and of media.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>
#include <span>

namespace fx::render {

class MediaSource;
struct BlobInstance;

/// Elements of a source that are drawn by one call.
struct DrawBatch
/// number of the source's batch
{
    uint32_t batch = 0;
    uint32_t first = 0;
    uint32_t count = 0;
    const MediaSource* source = nullptr;
};

/// Lists of fragments, one for each texel, in which cards are gathered instead of being drawn over each
/// other. Layout of shaders/shared/card_lists.glsl.
struct CardLists
/// buffer; invalid: fragments are drawn
{
    ResourceId heads = {};
    ResourceId nodes = {}; ///< buffer
    ResourceId marks = {}; ///< buffer of CardMark, one beside each node; invalid: they are not wanted

    bool valid() const { return heads.valid(); }
};
constexpr uint32_t kCardHeadBinding = 4;
constexpr uint32_t kCardNodeBinding = 5;
constexpr uint32_t kCardMarkBinding = 7;

/// Balls of medium, for compositions that sum them up instead of drawing them.
struct BallList
{
    ResourceId balls = {};                     ///< buffer of BlobInstance
    ResourceId lights = {};                    ///< buffer written by BlobLightPass, one entry for each
    std::span<const BlobInstance> instances{}; ///< the same balls; stay until the graph has executed
    bool detail = false;                       ///< some have procedural detail, and it is drawn
};

/// Where a pass draws to.
struct MediaTarget
{
    const ViewBlock* view;
    ResourceId distance;                 ///< [m] along the ray to opaque geometry
    std::span<const ResourceId> targets; ///< as in MediaPass, or in SolidPass
    bool layers;                         ///< as in MediaPass
    bool isSmall;                        ///< texels are larger than pixels
    LightBindings lights{};              ///< of the view
    CardLists cards{};                   ///< lists in which cards are gathered, instead of `targets`
    bool isMarked = false;               ///< solids write OutputMarks instead, see output_marks.h
};

/// Draws batches of its elements. It must not change from the addition of its pass until the graph has
/// executed.
class MediaSource
{
public:
    /// Declares everything that the draws read.
    virtual void read(FrameGraph::Builder& builder) const = 0;
    /// Blends premultiplied "over" the target; or, with target.cards, gathers fragments. Balls are never
    /// gathered.
    virtual void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const = 0;

    /// The balls of medium that it draws; null: it draws cards.
    virtual const BallList* balls() const { return nullptr; }

    /// Whether it has opaque elements, which are not part of batches.
    virtual bool hasSolids() const { return false; }
    /// Draws the opaque elements into the targets of SolidPass, with depth test.
    virtual void drawSolids(Backend&, const MediaTarget&, ResourceId /*depth*/) const {}

protected:
    ~MediaSource() = default;
};

/// Inputs of quads besides the ViewBlock and the target's distance.
struct QuadInputs
{
    ResourceId instances;     ///< buffer at binding 0
    TextureBinding picture{}; ///< bound when it is valid
    const LightBindings* lights = nullptr;
    ResourceId blobLights{}; ///< buffer at kBlobLightBinding when it is valid
};

constexpr uint32_t kBlobLightBinding = 6;

/// Draws the instances of a batch as quads of 6 vertices, blended premultiplied "over" the target. The
/// program has the ViewBlock, with batch.first in pass.y, and the target's distance at texture unit 0.
void drawQuads(Backend& backend, const ProgramDesc& program, const QuadInputs& inputs, const DrawBatch& batch,
               const MediaTarget& target);

} // namespace fx::render
