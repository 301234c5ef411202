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

/// A request to compute the rows (particles) of a group on the GPU.
struct GpuRowsJob
{
    const ProgramDesc* program;
    uint32_t batch;     ///< index of the batch that draws the rows
    bool isNewer;       ///< true: the job writes the newer rows of the batch; false: the older rows
    BufferPart numbers; ///< constants of the emitter: a base::GpuParticleNumbers
    BufferPart words;   ///< a base::GpuParticleMoment and the data that follow it
    std::array<int32_t, 16> columns; ///< offsets of the columns, see ParticleBlock
    uint32_t rows;
    // The following members are used only for emitters whose motion is computed in steps, see GpuStates.
    BufferPart reached = {}; ///< buffer of the state of the particles
    BufferPart steps = {};   ///< data of the steps that the job computes
    uint32_t stepCount = 0;
    bool meetsDepth = false;
    base::Placement place = {}; ///< placement of the emitter, for collisions with depth
};

/// Computes particles from the published data of their emitters. Program: gpu_particles, one permutation for
/// each combination of features.
///
/// reads   distance  [m] along each pixel's ray to opaque geometry, for collisions
/// writes  the rows of batches, in the layout of rows that the CPU uploads
/// The pass is not added if there are no jobs.
class GpuRowsPass
{
public:
    /// @param batches batches, which must be imported; their written resources get new versions
    /// @param depth depth texture with which particles collide in all steps of the jobs; the camera must
    ///     outlive the call
    static void addTo(FrameGraph& graph, std::span<const GpuRowsJob> jobs, std::span<ParticleBatch> batches,
                      const GpuDepth& depth = {});
};

} // namespace fx::render
