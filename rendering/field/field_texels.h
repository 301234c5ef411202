/// @file field_texels.h
/// Stores fields, their details and the lists of fields as texels of a texture. Software renderers read
/// textures many times faster than buffers.
#pragma once

#include "rendering/field/field_plan.h"
#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

/// Number of texels in a row; equal to the constant in shaders/field/field_blocks.glsl.
constexpr int kFieldColumns = 1024;
/// Number of texels in a row of the table of bricks; equal to the constant in
/// shaders/field/field_blocks.glsl.
constexpr int kTableColumns = 1024;
/// number of texels of a FieldDetailBlock; equal to the constant in the shaders
constexpr size_t kDetailTexels = sizeof(FieldDetailBlock) / sizeof(glm::vec4);
/// number of texels of a ball near the eye; equal to the constant in shaders/field/field_near.glsl
constexpr size_t kNearTexels = 4;
/// Texture units; equal to the bindings in shaders/field/field_blocks.glsl.
constexpr uint32_t kFieldTexelUnit = 11, kBrickTableUnit = 12;

/// Number of rows of a texture for `count` texels. The number is a power of two, so that the texture is
/// seldom reallocated.
int rowsOfTexels(size_t count, int columns);

/// The balls of a frame and their noise coordinates; `materials` is empty if no field has detail.
struct FieldBalls
{
    std::span<const BlobInstance> blobs;
    std::span<const BlobMaterial> materials;
};

/// Builds the texels of a frame: all FieldBlocks, then all FieldDetailBlocks, then kNearTexels for each ball
/// near the eye whose field has detail, then one texel with a field's
/// index for each entry of FieldPlan::tileFields(). The member limits.z of a FieldBlock is replaced by the
/// index of the first texel of the field's detail. The memory is kept from frame to frame.
class FieldTexels
{
public:
    explicit FieldTexels(std::pmr::memory_resource* memory) : texels_(memory), tiles_(memory) {}

    void build(const FieldPlan& plan, std::span<const FieldDetailBlock> details, const FieldBalls& balls);

    std::span<const glm::vec4> texels() const { return texels_; }
    /// Like FieldPlan::tiles(), except that `first` is the index of a texel.
    std::span<const FieldTileBlock> tiles() const { return tiles_; }

private:
    void addNear(const FieldPlan& plan, std::span<const FieldDetailBlock> details, const FieldBalls& balls);

    std::pmr::vector<glm::vec4> texels_;
    std::pmr::vector<FieldTileBlock> tiles_;
};

extern const ProgramDesc kFieldTexelProgram;

/// Copies a buffer to a texture.
///
/// reads   list     buffer of vec4
/// writes  texture  RGBA32F with kFieldColumns columns; if invalid, a new texture is created
class FieldTexelPass
{
public:
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, ResourceId list, size_t count,
                                          ResourceId texture);
};

} // namespace fx::render
