/// @file media_source.h
/// What the passes of solid things and of media draw, without knowing what it is.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>
#include <span>

namespace fx::render {

class MediaSource;

/// Some of what a source has, drawn in one go.
struct DrawBatch
{
    uint32_t batch = 0; ///< the source says what it numbers
    uint32_t first = 0;
    uint32_t count = 0;
    const MediaSource* source = nullptr;
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
};

/// Draws batches of its own things. It stays as it is from when its pass is added until the graph has
/// executed.
class MediaSource
{
public:
    /// Declares everything that the draws read.
    virtual void read(FrameGraph::Builder& builder) const = 0;
    /// Draws premultiplied "over" what is there.
    virtual void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const = 0;

    /// Whether something of it hides what is behind it; that is not part of batches.
    virtual bool hasSolids() const { return false; }
    /// Draws what hides into the targets of SolidPass, the nearest wins.
    virtual void drawSolids(Backend&, const MediaTarget&, ResourceId /*depth*/) const {}

protected:
    ~MediaSource() = default;
};

/// What quads read besides the ViewBlock and the target's distance.
struct QuadInputs
{
    ResourceId instances;     ///< buffer at binding 0
    TextureBinding picture{}; ///< bound when it is valid
    const LightBindings* lights = nullptr;
    ResourceId blobLights{}; ///< buffer at kBlobLightBinding when it is valid
};

constexpr uint32_t kBlobLightBinding = 6;

/// Draws the instances of a batch as quads of 6 vertices, premultiplied "over" what is there. The program has
/// the ViewBlock, with batch.first in pass.y, and the target's distance at texture unit 0.
void drawQuads(Backend& backend, const ProgramDesc& program, const QuadInputs& inputs, const DrawBatch& batch,
               const MediaTarget& target);

} // namespace fx::render
