/// @file view_network.h
/// State of a view whose fields have illumination networks: the grids of the networks, and their light on
/// the GPU.
#pragma once

#include "rendering/field/field_glow_pass.h"
#include "rendering/field/field_glow_plan.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/network/network_passes.h"
#include "rendering/passes/blob_light_pass.h"

#include <array>
#include <span>
#include <vector>

namespace fx::render {

/// The iteration of a frame starts from the light of the previous frame. Each frame runs kSweeps iterations
/// ("sweeps") until kSettledSweeps sweeps have run after the last change of media or lights. GPU resources
/// are created when the settings of a view first request networks. Threads: [GL thread].
class ViewNetwork
{
public:
    ViewNetwork(GlDevice& device, std::pmr::memory_resource* memory)
        : device_(device), grids_(memory), known_(memory), now_(memory)
    {}

    /// Sets the grids of a frame whose media differ from the last frame.
    /// @param eye [m] world position to which the grids are relative
    /// @return OutOfMemory
    base::Status makeRoom(std::span<const FieldGlowBlock> grids, const glm::dvec3& eye);
    void importAll(FrameGraph& graph);
    /// Uploads the grids and adds the passes.
    /// @param in inputs of the passes; this function sets the members for grids and their textures
    /// @param isKept true: media and lights have not changed since the last frame
    void addPasses(FrameGraph& graph, FieldGlowPass::Inputs in, const LightBindings& lights, bool isKept);

    bool isEmpty() const { return grids_.empty(); }
    bool isSettled() const { return settled_ >= kSettledSweeps; } ///< true if no more sweeps are needed
    /// The light in this frame; invalid without grids.
    BlobLightPass::Networks bindings() const
    {
        return {textures_.moments, gridsId_, block_.x, int(grids_.size())};
    }
    void release();
    uint64_t bytes() const;

private:
    static constexpr int kSweeps = 2; ///< number of sweeps per frame
    /// Number of sweeps after the last change, and for grids that begin without light.
    static constexpr int kSettledSweeps = 16;

    /// A grid of the last frame.
    struct Known
    {
        glm::dvec3 corner; ///< [m] world
        float side;        ///< [m] side of a cell
        glm::ivec4 cells;  ///< as FieldGlowBlock::cells
    };
    void matchGrids(const glm::dvec3& eye);
    base::Status makeTextures(const glm::ivec3& extent);

    GlDevice& device_;
    glm::ivec3 block_{0}; ///< [texel] size of a block in the textures
    int settled_ = 0;     ///< number of sweeps since the last change
    std::pmr::vector<FieldGlowBlock> grids_;
    std::pmr::vector<Known> known_, now_; ///< grids of the last frame, and of this frame
    std::array<GlTexture, 7> volumes_;    ///< textures in the order of the members of NetworkTextures
    GlTexture outgrown_; ///< moments of the last frame, if the textures of this frame are new
    GlBuffer buffer_;
    NetworkTextures textures_; ///< resource ids in this frame
    ResourceId gridsId_;       ///< grids in this frame
};

} // namespace fx::render
