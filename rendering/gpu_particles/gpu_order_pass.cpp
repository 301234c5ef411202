#include "rendering/gpu_particles/gpu_order_pass.h"

#include "foundation/snapshot/particle_kind.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr uint32_t kBlock = 1024;  ///< as in gpu_particles/gpu_particle_order.comp.glsl
constexpr uint32_t kThreads = 512; ///< likewise

constexpr ProgramDesc stage(const char* defines)
{
    return {"gpu particle order", nullptr, nullptr, "gpu_particles/gpu_particle_order.comp.glsl", defines};
}
constexpr ProgramDesc radixStage(const char* defines)
{
    return {"gpu particle radix", nullptr, nullptr, "gpu_particles/gpu_particle_radix.comp.glsl", defines};
}
constexpr ProgramDesc kStages[kGpuOrderPrograms] = {
    stage("FX_STAGE=0"), stage("FX_STAGE=1"),      stage("FX_STAGE=2"),      stage("FX_STAGE=3"),
    stage("FX_STAGE=4"), radixStage("FX_STAGE=0"), radixStage("FX_STAGE=1"), radixStage("FX_STAGE=2")};
enum : size_t
{
    SortedBlocks,
    MergeFar,
    MergeNear,
    Arguments,
    Keys,
    CountDigits,
    SumCounts,
    Scatter
};

constexpr uint32_t kDigitBits = 4; ///< as in gpu_particles/gpu_particle_radix.comp.glsl
constexpr uint32_t kDigits = 1u << kDigitBits;

/// Layout of the uniform block.
struct OrderBlock
{
    glm::vec4 eye;
    glm::vec4 scale;
    std::array<int32_t, 4> columnAt;
    std::array<int32_t, 4> sizes;
    std::array<uint32_t, 4> span;
};

struct Sorting
{
    OrderBlock block;
    BufferPart rows;
    ResourceId pairs, order, arguments;
    ResourceId otherPairs, counts; ///< of a radix sort
    uint32_t count;                ///< pairs, whole blocks; a power of two for a bitonic sort

    void run(Backend& backend, size_t which, uint32_t length, uint32_t apart) const
    {
        OrderBlock now = block;
        now.span = {length, apart, 0, 0};
        const BufferBinding buffers[] = {
            {0, rows.id, rows.offset, rows.bytes}, {1, pairs}, {2, order}, {3, arguments}};
        DispatchCall call;
        call.program = &kStages[which];
        call.buffers = buffers;
        call.uniforms = asUniforms(now);
        call.groups[0] = which == MergeFar ? count / 2 / kThreads : count / kBlock;
        backend.dispatch(call);
    }
    void runBitonic(Backend& backend) const
    {
        run(backend, SortedBlocks, 0, 0);
        for (uint32_t length = 2 * kBlock; length <= count; length *= 2) {
            for (uint32_t apart = length / 2; apart >= kBlock; apart /= 2)
                run(backend, MergeFar, length, apart);
            run(backend, MergeNear, length, 0);
        }
        run(backend, Arguments, 0, 0);
    }
    void runDigit(Backend& backend, uint32_t bit) const
    {
        const bool isEven = bit / kDigitBits % 2 == 0;
        const BufferBinding buffers[] = {
            {0, isEven ? pairs : otherPairs}, {1, isEven ? otherPairs : pairs}, {2, counts}};
        const std::array<uint32_t, 4> sizes{count / kBlock, bit, 0, 0};
        for (const size_t which : {CountDigits, SumCounts, Scatter}) {
            DispatchCall call;
            call.program = &kStages[which];
            call.buffers = buffers;
            call.uniforms = asUniforms(sizes);
            call.groups[0] = which == SumCounts ? 1 : count / kBlock;
            backend.dispatch(call);
        }
    }
    void runRadix(Backend& backend) const
    {
        run(backend, Keys, 0, 0);
        for (uint32_t bit = 0; bit < 32; bit += kDigitBits) // an even number of times: `pairs` has the result
            runDigit(backend, bit);
        run(backend, Arguments, 0, 0);
    }
};

OrderBlock blockOf(const GpuOrderJob& job, const ParticleBatch& batch, uint32_t count)
{
    namespace column = base::particle_column;
    const auto& at = batch.block.newerAt;
    return {{job.eye, job.isParallel ? 1.0f : 0.0f},
            {job.scale, job.offset, job.byAge ? 1.0f : 0.0f, job.leastFirst ? 1.0f : 0.0f},
            {at[column::PositionX], at[column::PositionY], at[column::PositionZ], at[column::Radius]},
            {at[column::Age], batch.block.rows[0], int32_t(count), int32_t(batch.vertices)},
            {}};
}

} // namespace

const ProgramDesc& gpuOrderProgram(size_t index)
{
    return kStages[index];
}

void GpuOrderPass::addTo(FrameGraph& graph, std::span<const GpuOrderJob> jobs,
                         std::span<ParticleBatch> batches, uint32_t radixFrom)
{
    for (const GpuOrderJob& job : jobs) {
        ParticleBatch& batch = batches[job.batch];
        const auto rows = uint32_t(batch.block.rows[0]);
        const bool isRadix = rows >= radixFrom;
        const uint32_t count =
            isRadix ? (rows + kBlock - 1) / kBlock * kBlock : std::max(std::bit_ceil(rows), kBlock);
        graph.addPass("gpu particle order", [&](FrameGraph::Builder& builder) {
            builder.read(batch.newer.id);
            Sorting sorting{blockOf(job, batch, count), batch.newer, {}, {}, {}, {}, {}, count};
            sorting.pairs = builder.write(builder.create(BufferDesc{"gpu order keys", 8 * size_t(count)}));
            sorting.order = builder.write(builder.create(BufferDesc{"gpu order", 4 * size_t(count)}));
            sorting.arguments = builder.write(builder.create(BufferDesc{"gpu draw arguments", 64}));
            batch.order = {0, sorting.order, 0, 4 * uint64_t(count)};
            batch.arguments = sorting.arguments;
            if (isRadix) {
                sorting.otherPairs =
                    builder.write(builder.create(BufferDesc{"gpu order keys, sorted", 8 * size_t(count)}));
                sorting.counts = builder.write(
                    builder.create(BufferDesc{"gpu order digits", 4 * kDigits * size_t(count / kBlock)}));
            }
            return [sorting, isRadix](Backend& backend) {
                isRadix ? sorting.runRadix(backend) : sorting.runBitonic(backend);
            };
        });
    }
}

} // namespace fx::render
