/// @file block_tile_pass.h
/// The pass that draws tiles of blocks.
#pragma once

#include "rendering/blocks/block_tiles.h"
#include "rendering/frame_graph/frame_graph.h"

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

constexpr int kTileLayers =
    4; ///< textures of the atlas, one above the other; see shaders/blocks/block_chord.glsl

inline constexpr ProgramDesc kBlockTilesProgram{"block tiles", nullptr, nullptr,
                                                "blocks/block_tiles.comp.glsl", nullptr};

/// The jobs of a frame as the GPU reads them. The lists must stay valid until the graph has executed.
class BlockTileJobs
{
public:
    explicit BlockTileJobs(std::pmr::memory_resource* memory) : jobs_(memory), balls_(memory) {}

    void begin();
    /// Appends the jobs of one solver.
    void add(std::span<const TileJob> jobs, const BlockContents& contents);
    bool isEmpty() const { return jobs_.empty(); }
    uint32_t count() const { return uint32_t(jobs_.size()); }
    uint64_t bytes() const { return balls_.size() * sizeof(BlockBall) + jobs_.size() * sizeof(Job); }

    /// Draws the tiles.
    /// @param atlas RGBA16F texture of kTileLayers times `rows` rows of pages
    /// writes  atlas
    [[nodiscard]] ResourceId addTo(FrameGraph& graph, ResourceId atlas, int rows);

private:
    /// Layout of shaders/blocks/block_tiles.comp.glsl.
    struct Job
    {
        glm::ivec4 place; ///< xy [texel] corner; z first ball; w balls
        glm::vec4 right;  ///< xyz; w [m] half the side
        glm::vec4 up;     ///< xyz; w [texel] side
        /// x [m2/cd] one over the brightest light of the content; y 1: its balls differ in color;
        /// z [1] factor of the depth
        glm::vec4 light;
        glm::vec4 eye; ///< x [1/m] one over its distance; y [m] radius of the block
    };

    std::pmr::vector<Job> jobs_; ///< in the order of sizes once addTo() is called
    std::pmr::vector<BlockBall> balls_;
};

} // namespace fx::render
