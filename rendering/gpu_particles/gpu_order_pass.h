/// @file gpu_order_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/particle_batch.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

/// By what the rows of a computed batch are ordered; numbers as in rowDistances().
struct GpuOrderJob
{
    uint32_t batch;
    bool byAge;       ///< otherwise by distance
    bool leastFirst;  ///< otherwise the farthest or oldest
    bool isParallel;  ///< `eye` is a direction
    glm::vec3 eye;    ///< [m] in the group's axes
    float scale = 1;  ///< [1]
    float offset = 0; ///< [m]
};

/// Orders the rows of computed batches, and writes how many live into the arguments of their draws. The order
/// is that of DepthSort: by key, equal keys by row.
///
/// reads   the newer rows of batches
/// writes  their order and their arguments, which live for the frame
/// Absent when no computed batch has an order.
class GpuOrderPass
{
public:
    /// @param batches imported already
    static void addTo(FrameGraph& graph, std::span<const GpuOrderJob> jobs, std::span<ParticleBatch> batches);
};

constexpr size_t kGpuOrderPrograms = 4;
const ProgramDesc& gpuOrderProgram(size_t stage);

} // namespace fx::render
