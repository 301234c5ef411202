/// @file volume_network.h
/// State of a view whose fields have illumination networks: grids and their light on the GPU.
#pragma once

#include "rendering/field/field_glow_pass.h"
#include "rendering/field/field_glow_plan.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/network/network_passes.h"

#include <array>
#include <span>
#include <vector>

namespace fx::render {

/// The light goes on from frame to frame: some sweeps a frame while media or lights change, some more after
/// that, then none. Nothing before a view asks for networks. Threads: [GL thread].
class VolumeNetwork
{
public:
    explicit VolumeNetwork(GlDevice& device) : device_(device) {}

    /// Takes over the grids of a frame that is not kept. @param eye [m] world position that they are relative
    /// to @param cells along a side of a grid, a multiple of 8 @return OutOfMemory
    base::Status makeRoom(std::span<const FieldGlowBlock> grids, int cells, const glm::dvec3& eye);
    void importAll(FrameGraph& graph);
    /// @param in inputs; grids and textures are added @param isKept media and lights are those of the last
    /// frame
    void addPasses(FrameGraph& graph, FieldGlowPass::Inputs in, const LightBindings& lights, bool isKept);

    bool isEmpty() const { return grids_.empty(); }
    bool isSettled() const { return settled_ >= kSettledSweeps; } ///< no sweeps are left to do
    int cells() const { return cells_; }
    ResourceId moments() const { return textures_.moments; } ///< of the frame; invalid: there are no grids
    ResourceId buffer() const { return gridsId_; }           ///< of FieldGlowBlock
    void release();
    uint64_t bytes() const;

private:
    static constexpr int kSweeps = 2;         ///< of a frame
    static constexpr int kSettledSweeps = 16; ///< after the last change, and of light that begins in darkness

    /// A grid of the last frame.
    struct Known
    {
        glm::dvec3 corner; ///< [m] world
        float side;        ///< [m] of a cell
    };
    void matchGrids(const glm::dvec3& eye);
    base::Status makeTextures();

    GlDevice& device_;
    int cells_ = 0;
    int settled_ = 0; ///< sweeps since the last change
    std::vector<FieldGlowBlock> grids_;
    std::vector<Known> known_, now_;   ///< of the last frame, of this one
    std::array<GlTexture, 7> volumes_; ///< in the order of NetworkTextures
    GlBuffer buffer_;
    NetworkTextures textures_; ///< of the frame
    ResourceId gridsId_;       ///< of the frame
};

} // namespace fx::render
