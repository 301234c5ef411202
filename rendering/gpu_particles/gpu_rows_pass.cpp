#include "rendering/gpu_particles/gpu_rows_pass.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr uint32_t kGroupRows = 256; ///< as in gpu_particles/gpu_particles.comp.glsl
constexpr uint32_t kMaxSteps = 128;  ///< of one dispatch: drivers end those that take too long

/// Layout of the uniform block.
struct OutputBlock
{
    std::array<int32_t, 16> columns;
    std::array<uint32_t, 4> chain;
    GpuDepthBlock depth;
};

/// A job whose buffers are resources of the graph.
struct RowsDispatch
{
    GpuRowsJob job;
    ResourceId numbers, words, rows, reached, steps;
    BufferPart out;
    ResourceId distance; ///< of what the frame shows; invalid: none, or of no interest
    GpuDepthBlock depth;

    void run(Backend& backend) const
    {
        uint32_t first = 0;
        do { // at least once: it writes the rows
            const uint32_t end = std::min(first + kMaxSteps, job.stepCount);
            runSteps(backend, first, end);
            first = end;
        } while (first < job.stepCount);
    }

private:
    void runSteps(Backend& backend, uint32_t first, uint32_t end) const
    {
        const BufferBinding buffers[] = {{0, numbers, job.numbers.offset, job.numbers.bytes},
                                         {1, words, job.words.offset, job.words.bytes},
                                         {2, rows, out.offset, out.bytes},
                                         {3, reached, job.reached.offset, job.reached.bytes},
                                         {4, steps, job.steps.offset, job.steps.bytes}};
        const OutputBlock block{job.columns, {first, end, end == job.stepCount ? 1u : 0u, 0u}, depth};
        const TextureBinding textures[] = {{0, distance}};
        DispatchCall call;
        call.program = job.program;
        call.buffers = std::span(buffers).first(job.reached.bytes > 0 ? 5 : 3);
        call.textures = std::span(textures).first(distance.valid() ? 1 : 0);
        call.uniforms = asUniforms(block);
        call.groups[0] = (job.rows + kGroupRows - 1) / kGroupRows;
        backend.dispatch(call);
    }
};

ResourceId import(FrameGraph& graph, const BufferPart& part)
{
    return graph.importBuffer({"gpu particle emitters", size_t(part.offset + part.bytes)}, part.name);
}

} // namespace

void GpuRowsPass::addTo(FrameGraph& graph, std::span<const GpuRowsJob> jobs, std::span<ParticleBatch> batches,
                        const GpuDepth& depth)
{
    for (const GpuRowsJob& job : jobs) {
        ParticleBatch& batch = batches[job.batch];
        BufferPart& rows = job.isNewer ? batch.newer : batch.older;
        const ResourceId numbers = import(graph, job.numbers);
        const ResourceId words = import(graph, job.words);
        RowsDispatch dispatch{job, numbers, words, {}, {}, {}, {}, {}, {}};
        if (job.meetsDepth) {
            dispatch.distance = depth.distance;
            dispatch.depth = makeGpuDepthBlock(depth, job.place);
        }
        const bool isStepped = job.reached.bytes > 0;
        if (isStepped) {
            dispatch.reached = import(graph, job.reached);
            dispatch.steps = import(graph, job.steps);
        }
        graph.addPass("gpu particles", [&](FrameGraph::Builder& builder) {
            builder.read(numbers);
            builder.read(words);
            if (dispatch.distance.valid())
                builder.read(dispatch.distance);
            if (isStepped) {
                builder.read(dispatch.steps);
                dispatch.reached = builder.write(dispatch.reached);
            }
            builder.sideEffect(); // rows are kept for the next frame
            rows.id = builder.write(rows.id);
            dispatch.rows = rows.id;
            dispatch.out = rows;
            return [dispatch](Backend& backend) { dispatch.run(backend); };
        });
    }
}

} // namespace fx::render
