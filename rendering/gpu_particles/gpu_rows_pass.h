/// @file gpu_rows_pass.h
#pragma once

#include "foundation/math/geometry.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gpu_particles/gpu_depth.h"
#include "rendering/passes/particle_batch.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

/// Rows of a group that have not been computed yet.
struct GpuRowsJob
{
    const ProgramDesc* program;
    uint32_t batch;                  ///< that draws them
    bool isNewer;                    ///< as its newer rows, or as its older ones
    BufferPart numbers;              ///< base::GpuParticleNumbers
    BufferPart words;                ///< base::GpuParticleMoment and the data after it
    std::array<int32_t, 16> columns; ///< places of the columns, as in ParticleBlock
    uint32_t rows;
    // Only of emitters that are stepped, see GpuStates:
    BufferPart reached = {}; ///< state of their particles
    BufferPart steps = {};   ///< that they take now
    uint32_t stepCount = 0;
    bool meetsDepth = false;
    base::Placement place = {}; ///< placement, for collisions with depth
};

/// Computes particles from the published data of their emitters. Program: gpu_particles, one permutation for
/// each combination of features.
///
/// reads   distance  [m] along each pixel's ray to what the frame shows, where an emitter collides with it
/// writes  the rows of batches, in the layout in which the CPU's are uploaded Absent when there is no job.
class GpuRowsPass
{
public:
    /// @param batches imported already; the written parts get new versions
    /// @param depth depth texture that all steps of the jobs collide with; its camera must outlive the call
    static void addTo(FrameGraph& graph, std::span<const GpuRowsJob> jobs, std::span<ParticleBatch> batches,
                      const GpuDepth& depth = {});
};

} // namespace fx::render
