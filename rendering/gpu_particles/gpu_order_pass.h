/// @file gpu_order_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/particle_batch.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

/// The draw order of particles of one batch that the GPU has computed: by age, or by the distances of
/// rowDistances().
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

/// Number of rows from which a radix sort is used instead of a bitonic sort. With a software renderer they
/// cost the same at 8,000 rows; the radix sort has more dispatches, which count elsewhere.
constexpr uint32_t kRadixOrderRows = 16'384;

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
    /// @param radixFrom number of rows from which a radix sort is used; the order is the same
    static void addTo(FrameGraph& graph, std::span<const GpuOrderJob> jobs, std::span<ParticleBatch> batches,
                      uint32_t radixFrom = kRadixOrderRows);
};

constexpr size_t kGpuOrderPrograms = 8;
/// First program that only radix sorts use.
constexpr size_t kFirstRadixProgram = 4;
const ProgramDesc& gpuOrderProgram(size_t index);

} // namespace fx::render
