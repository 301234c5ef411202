/// @file media_source.h
/// Interface of sources of drawable elements, for the passes that draw opaque particles and media.
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
{
    uint32_t batch = 0; ///< index of the batch in its source
    uint32_t first = 0;
    uint32_t count = 0;
    const MediaSource* source = nullptr;
};

/// Lists of fragments, one list for each texel. Cards write their fragments to these lists instead of
/// blending. Layout of shaders/shared/card_lists.glsl.
struct CardLists
{
    ResourceId heads = {}; ///< buffer of list heads; invalid: fragments are blended
    ResourceId nodes = {}; ///< buffer of list nodes
    ResourceId marks = {}; ///< buffer of CardMark, one for each node; invalid: no marks are written

    bool valid() const { return heads.valid(); }
};
constexpr uint32_t kCardHeadBinding = 4;
constexpr uint32_t kCardNodeBinding = 5;
constexpr uint32_t kCardMarkBinding = 7;

/// Tiles of blocks, see rendering/blocks.
struct BlockTileBindings
{
    ResourceId atlas = {};   ///< texture of tiles; invalid: no ball has a tile
    ResourceId records = {}; ///< buffer of BlockRecord

    bool valid() const { return atlas.valid(); }
};

/// Balls of medium, for compositions that sum balls.
struct BallList
{
    ResourceId balls = {};  ///< buffer of BlobInstance
    ResourceId lights = {}; ///< buffer written by BlobLightPass, one entry for each ball
    /// The balls of the buffer `balls`, for the CPU; must stay valid until the graph has executed.
    std::span<const BlobInstance> instances{};
    bool detail = false;       ///< true: the procedural detail of balls is drawn
    BlockTileBindings tiles{}; ///< tiles of the balls with BlobInstance::layer.z > 0
};

/// Targets and options of a draw.
struct MediaTarget
{
    const ViewBlock* view;
    ResourceId distance;                 ///< [m] distance along the ray to opaque geometry
    std::span<const ResourceId> targets; ///< targets of MediaPass, or of SolidPass
    bool layers;                         ///< true: `targets` are layer targets
    bool isSmall;                        ///< true: texels are larger than pixels
    LightBindings lights{};              ///< lights of the view
    CardLists cards{};     ///< if valid, cards write their fragments to `cards` instead of `targets`
    bool isMarked = false; ///< true: opaque elements write marks instead of light, see output_marks.h
};

/// A source of drawable elements, divided into batches. After a pass that draws the source has been added,
/// the source must not change until the graph has executed.
class MediaSource
{
public:
    /// Declares all resources that draw() and drawSolids() read.
    virtual void read(FrameGraph::Builder& builder) const = 0;
    /// Blends the elements of a batch over the target, with premultiplied colors. If target.cards is valid,
    /// fragments of cards are written to the lists `target.cards` instead.
    virtual void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const = 0;

    /// Returns the balls of medium of the source, or null if the source draws cards.
    virtual const BallList* balls() const { return nullptr; }

    /// True if the source has opaque elements. Opaque elements are not part of batches.
    virtual bool hasSolids() const { return false; }
    /// Draws the opaque elements to the targets of SolidPass, with depth test.
    virtual void drawSolids(Backend&, const MediaTarget&, ResourceId /*depth*/) const {}

protected:
    ~MediaSource() = default;
};

/// Additional inputs of drawQuads().
struct QuadInputs
{
    ResourceId instances;     ///< buffer at binding 0
    TextureBinding picture{}; ///< texture; bound if valid
    const LightBindings* lights = nullptr;
    ResourceId blobLights{}; ///< buffer; bound at kBlobLightBinding if valid
};

constexpr uint32_t kBlobLightBinding = 6;

/// Draws the instances of a batch as quads of 6 vertices. The quads are blended over the target, with
/// premultiplied colors. The program gets the ViewBlock, and the target's distance at texture unit 0. The
/// member pass.y of the ViewBlock is batch.first.
void drawQuads(Backend& backend, const ProgramDesc& program, const QuadInputs& inputs, const DrawBatch& batch,
               const MediaTarget& target);

} // namespace fx::render
