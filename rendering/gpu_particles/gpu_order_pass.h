/// @file gpu_order_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/particle_batch.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

/// A request to sort the GPU particles of one batch by age or by distance. rowDistances() defines the
/// distances.
struct GpuOrderJob
{
    uint32_t batch;
    bool byAge;       ///< true: sort by age; false: sort by distance
    bool leastFirst;  ///< true: nearest or youngest first; false: farthest or oldest first
    bool isParallel;  ///< true: `eye` is a direction
    glm::vec3 eye;    ///< [m] position of the eye in the space of the group
    float scale = 1;  ///< [1] argument `scale` of rowDistances()
    float offset = 0; ///< [m] argument `offset` of rowDistances()
};

/// Least number of rows for which a radix sort is used instead of a bitonic sort. With a software renderer,
/// both sorts have the same cost at 8,000 rows. The limit is higher, because a radix sort has more
/// dispatches, and dispatches are expensive on GPUs.
constexpr uint32_t kRadixOrderRows = 16'384;

/// Sorts the rows of batches whose particles the GPU has computed. Writes the number of living particles to
/// the draw arguments of the batches. As in DepthSort, rows are sorted by key, and rows with equal keys by
/// index.
///
/// reads   the newer rows of batches
/// writes  the order and the draw arguments of batches, as transient buffers
/// The pass is not added if `jobs` is empty.
class GpuOrderPass
{
public:
    /// @param batches batches, which must be imported
    /// @param radixFrom least number of rows for which a radix sort is used instead of a bitonic sort; both
    ///     sorts give the same order
    static void addTo(FrameGraph& graph, std::span<const GpuOrderJob> jobs, std::span<ParticleBatch> batches,
                      uint32_t radixFrom = kRadixOrderRows);
};

constexpr size_t kGpuOrderPrograms = 8;
/// Index of the first program that only radix sorts use.
constexpr size_t kFirstRadixProgram = 4;
const ProgramDesc& gpuOrderProgram(size_t index);

} // namespace fx::render
