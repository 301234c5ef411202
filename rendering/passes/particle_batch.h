/// @file particle_batch.h
/// A group of particles or ribbons in the form in which passes draw it.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/media_source.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

/// Layout of the uniform block of programs that define FX_VIEW_EXTRA. shaders/shared/particle_block.glsl
/// explains each member.
struct ParticleBlock
{
    ViewBlock view;
    glm::vec4 placePosition;
    glm::vec4 placeRotation;
    glm::vec4 alignAxis;
    glm::vec4 appearance;
    glm::vec4 shine;
    glm::vec4 moment;
    glm::vec4 atlas;
    glm::vec4 strip;
    std::array<int32_t, 16> newerAt;
    std::array<int32_t, 16> olderAt;
    std::array<int32_t, 4> rows;
};
static_assert(sizeof(ParticleBlock) == sizeof(ViewBlock) + 8 * 16 + 9 * 16);

/// ParticleBlock with additional members, for programs that write marks, see output_marks.h.
struct MarkedParticleBlock
{
    ParticleBlock particles;
    std::array<glm::vec4, 3> drift;
    glm::uvec4 instance;
};
static_assert(sizeof(MarkedParticleBlock) == sizeof(ParticleBlock) + 4 * 16);

/// Geometry drawn for each row.
enum class BatchShape : uint8_t
{
    Sprite,
    Ribbon,
    Mesh,
    Count
};

/// A range of a buffer.
struct BufferPart
{
    uint32_t name = 0; ///< name of the GL buffer
    ResourceId id;     ///< id of the buffer in this frame's graph
    uint64_t offset = 0;
    uint64_t bytes = 0; ///< [byte] size of the range; 0: there is no data
};

struct ParticleBatch
{
    ParticleBlock block;
    BatchShape shape = BatchShape::Sprite;
    bool isSolid = false;   ///< true: particles are opaque, write depth, and are drawn before all media
    bool repeats = false;   ///< true: the texture repeats
    uint32_t vertices = 6;  ///< number of vertices per instance
    uint32_t instances = 0; ///< number of drawn rows, or of drawn pieces of ribbons
    BufferPart newer, older, order, mesh;
    uint32_t texture = 0; ///< name of the GL texture array
    uint32_t motion = 0;
    ResourceId textureId, motionId;
    bool isComputed = false; ///< true: the GPU computes the rows
    /// Buffer with draw arguments that the GPU writes. Invalid: `instances` is the number of drawn elements.
    ResourceId arguments;
    /// `drift` and `instance` are members of MarkedParticleBlock, and are used only with outputs.
    std::array<glm::vec4, 3> drift{};
    glm::uvec4 instance{};
};

/// Returns the program for a combination of options.
/// @param isSolid true: the program writes depth and distance
/// @param layers true: the program writes layer targets
const ProgramDesc& particleProgram(BatchShape shape, bool isSolid, bool layers);
constexpr size_t kParticlePrograms = 3 * 2 * 2;
const ProgramDesc& particleProgramAt(size_t index);

/// Returns the program that writes the fragments of cards to CardLists.
const ProgramDesc& cardProgram(BatchShape shape);

/// markedCardProgram() writes the fragments of cards and their marks to CardLists. markedSolidProgram()
/// writes the marks of opaque particles. See output_marks.h.
const ProgramDesc& markedCardProgram(BatchShape shape);
const ProgramDesc& markedSolidProgram(BatchShape shape);

/// Draws groups of particles and ribbons. DrawBatch::batch is an index in `batches`.
class BatchSource final : public MediaSource
{
public:
    void read(FrameGraph::Builder& builder) const override;
    void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const override;
    bool hasSolids() const override;
    void drawSolids(Backend& backend, const MediaTarget& target, ResourceId depth) const override;

    std::span<const ParticleBatch> batches;
};

} // namespace fx::render
