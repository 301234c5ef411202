/// @file field_texels.h
/// Fields, their details and the lists of fields as texels: software renderers read those many times faster
/// than buffers.
#pragma once

#include "rendering/field/field_plan.h"
#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

constexpr int kFieldColumns = 1024; ///< texels in a row; also in shaders/field/field_blocks.glsl
constexpr int kTableColumns = 1024; ///< of the table of bricks; also in the shader
constexpr size_t kDetailTexels = sizeof(FieldDetailBlock) / sizeof(glm::vec4); ///< also in the shaders
constexpr uint32_t kFieldTexelUnit = 11, kBrickTableUnit = 12; ///< texture units; also in the shader

/// Rows of a texture that holds so many texels, a power of two so that it is seldom made anew.
int rowsOfTexels(size_t count, int columns);

/// Three texels a field, as FieldBlock, but limits.z is the first texel of its detail; nine a detail, as
/// FieldDetailBlock; one with a number of a field for each entry of FieldPlan::tileFields(). Keeps its memory
/// from frame to frame.
class FieldTexels
{
public:
    explicit FieldTexels(std::pmr::memory_resource* memory) : texels_(memory), tiles_(memory) {}

    void build(const FieldPlan& plan, std::span<const FieldDetailBlock> details);

    std::span<const glm::vec4> texels() const { return texels_; }
    /// As FieldPlan::tiles(), but `first` is a texel.
    std::span<const FieldTileBlock> tiles() const { return tiles_; }

private:
    std::pmr::vector<glm::vec4> texels_;
    std::pmr::vector<FieldTileBlock> tiles_;
};

extern const ProgramDesc kFieldTexelProgram;

/// reads   list     buffer of vec4
/// writes  texture  RGBA32F of kFieldColumns; invalid: a new one
class FieldTexelPass
{
public:
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, ResourceId list, size_t count,
                                          ResourceId texture);
};

} // namespace fx::render
