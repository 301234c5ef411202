/// @file media_source.h
/// Interface of the sources that the passes of opaque particles and of media draw.
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

/// Lists of fragments, one for each texel. Cards write their fragments to these lists instead of blending
/// them. Layout of shaders/shared/card_lists.glsl.
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

/// Balls of medium, for compositions that sum balls instead of blending them.
struct BallList
{
    ResourceId balls = {};  ///< buffer of BlobInstance
    ResourceId lights = {}; ///< buffer written by BlobLightPass, one entry for each ball
    /// The same balls; must stay valid until the graph has executed.
    std::span<const BlobInstance> instances{};
    bool detail = false; ///< true: some balls have procedural detail, and it is drawn
};

/// Targets and options of a draw.
struct MediaTarget
{
    const ViewBlock* view;
    ResourceId distance;                 ///< [m] distance along the ray to opaque geometry
    std::span<const ResourceId> targets; ///< targets of MediaPass, or of SolidPass
    bool layers;                         ///< as in MediaPass
    bool isSmall;                        ///< true: texels are larger than pixels
    LightBindings lights{};              ///< lights of the view
    CardLists cards{};     ///< if valid, cards write their fragments to these lists instead of `targets`
    bool isMarked = false; ///< true: opaque elements write marks instead of light, see output_marks.h
};

/// A source of drawable elements, divided into batches. After a pass that draws it has been added, it must
/// not change until the graph has executed.
class MediaSource
{
public:
    /// Declares all resources that the draws read.
    virtual void read(FrameGraph::Builder& builder) const = 0;
    /// Blends the elements of a batch over the target, with premultiplied colors. If target.cards is valid,
    /// fragments of cards are written to these lists instead.
    virtual void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const = 0;

    /// The balls of medium of this source; null if it draws cards.
    virtual const BallList* balls() const { return nullptr; }

    /// True if the source has opaque elements. They are not part of batches.
    virtual bool hasSolids() const { return false; }
    /// Draws the opaque elements to the targets of SolidPass, with depth test.
    virtual void drawSolids(Backend&, const MediaTarget&, ResourceId /*depth*/) const {}

protected:
    ~MediaSource() = default;
};

/// Inputs of drawQuads(), besides the ViewBlock and the target's distance.
struct QuadInputs
{
    ResourceId instances;     ///< buffer at binding 0
    TextureBinding picture{}; ///< texture that is bound if it is valid
    const LightBindings* lights = nullptr;
    ResourceId blobLights{}; ///< buffer that is bound at kBlobLightBinding, if valid
};

constexpr uint32_t kBlobLightBinding = 6;

/// Draws the instances of a batch as quads of 6 vertices. They are blended over the target, with
/// premultiplied colors. The program gets the ViewBlock, with batch.first in pass.y, and the target's
/// distance at texture unit 0.
void drawQuads(Backend& backend, const ProgramDesc& program, const QuadInputs& inputs, const DrawBatch& batch,
               const MediaTarget& target);

} // namespace fx::render
