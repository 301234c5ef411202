#include "rendering/gpu_particles/gpu_rows_pass.h"

namespace fx::render {

namespace {

constexpr uint32_t kGroupRows = 256; ///< as in passes/gpu_particles.comp.glsl

ResourceId import(FrameGraph& graph, const BufferPart& part)
{
    return graph.importBuffer({"gpu particle emitters", size_t(part.offset + part.bytes)}, part.name);
}

} // namespace

void GpuRowsPass::addTo(FrameGraph& graph, std::span<const GpuRowsJob> jobs, std::span<ParticleBatch> batches)
{
    for (const GpuRowsJob& job : jobs) {
        ParticleBatch& batch = batches[job.batch];
        BufferPart& rows = job.isNewer ? batch.newer : batch.older;
        const ResourceId numbers = import(graph, job.numbers);
        const ResourceId words = import(graph, job.words);
        graph.addPass("gpu particles", [&](FrameGraph::Builder& builder) {
            builder.read(numbers);
            builder.read(words);
            builder.sideEffect(); // rows are kept for the next frame
            rows.id = builder.write(rows.id);
            return [job, numbers, words, rows](Backend& backend) {
                const BufferBinding buffers[] = {{0, numbers, job.numbers.offset, job.numbers.bytes},
                                                 {1, words, job.words.offset, job.words.bytes},
                                                 {2, rows.id, rows.offset, rows.bytes}};
                DispatchCall call;
                call.program = job.program;
                call.buffers = buffers;
                call.uniforms = asUniforms(job.columns);
                call.groups[0] = (job.rows + kGroupRows - 1) / kGroupRows;
                backend.dispatch(call);
            };
        });
    }
}

} // namespace fx::render
