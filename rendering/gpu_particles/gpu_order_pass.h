/// @file gpu_order_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/particle_batch.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

/// A request to sort those particles of one batch that the GPU has computed: by age, or by the distances of
/// rowDistances().
struct GpuOrderJob
{
    uint32_t batch;
    bool byAge;       ///< true: sort by age; false: sort by distance
    bool leastFirst;  ///< true: nearest or youngest first; false: farthest or oldest first
    bool isParallel;  ///< true: `eye` is a direction
    glm::vec3 eye;    ///< [m] position of the eye in the space of the group
    float scale = 1;  ///< [1] as in rowDistances()
    float offset = 0; ///< [m] as in rowDistances()
};

/// Least number of rows for which a radix sort is used instead of a bitonic sort. With a software renderer
/// both cost the same at 8,000 rows. The limit is higher because the radix sort has more dispatches, which
/// are expensive on GPUs.
constexpr uint32_t kRadixOrderRows = 16'384;

/// Sorts the rows of computed batches, and writes the number of living particles to the arguments of their
/// draws. The order is that of DepthSort: by key, and for equal keys by row.
///
/// reads   the newer rows of batches
/// writes  the order and the draw arguments of batches; both are transient
/// The pass is not added if no computed batch is sorted.
class GpuOrderPass
{
public:
    /// @param batches batches, which must be imported
    /// @param radixFrom least number of rows for which a radix sort is used; both sorts give the same order
    static void addTo(FrameGraph& graph, std::span<const GpuOrderJob> jobs, std::span<ParticleBatch> batches,
                      uint32_t radixFrom = kRadixOrderRows);
};

constexpr size_t kGpuOrderPrograms = 8;
/// Index of the first program that only radix sorts use.
constexpr size_t kFirstRadixProgram = 4;
const ProgramDesc& gpuOrderProgram(size_t index);

} // namespace fx::render
