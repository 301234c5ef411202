/// @file volume_glow.h
/// GPU resources of a view for grids, in which the light that media emit is propagated through fields.
#pragma once

#include "rendering/field/field_glow_pass.h"
#include "rendering/field/field_glow_plan.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"

#include <array>
#include <span>

namespace fx::render {

/// Owns the textures and buffers of the grids. They are created when a field emits light for the first time.
/// Threads: [GL thread].
class VolumeGlow
{
public:
    explicit VolumeGlow(GlDevice& device) : device_(device) {}

    /// Allocates textures and buffers for `grids`. @return OutOfMemory
    base::Status makeRoom(std::span<const FieldGlowBlock> grids);
    /// Imports the resources of a frame. Without grids the resource ids are invalid.
    void importAll(FrameGraph& graph, std::span<const FieldGlowBlock> grids);
    /// Uploads the grids and adds the passes. @param in inputs of the passes; this function sets the members
    /// `grids`, `gridCount` and `glow`
    void addPasses(FrameGraph& graph, FieldGlowPass::Inputs in, std::span<const FieldGlowBlock> grids);

    /// Light of this frame; invalid if no field emits light.
    ResourceId light() const { return textures_.light; }
    ResourceId grids() const { return grids_; } ///< buffer of FieldGlowBlock
    void release();
    uint64_t bytes() const;

private:
    GlDevice& device_;
    std::array<GlTexture, 5> volumes_; ///< textures in the order of the members of GlowTextures
    GlBuffer buffer_;
    GlowTextures textures_; ///< resource ids in this frame
    ResourceId grids_;      ///< grids of this frame
};

} // namespace fx::render
