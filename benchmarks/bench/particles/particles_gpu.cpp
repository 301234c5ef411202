// fx bench particles --gpu: one step of an emitter that the GPU computes. The CPU counts births and publishes
// what they are computed from; the GPU makes every row anew.
#include "benchmarks/bench/particles/bench_depth.h"
#include "benchmarks/bench/particles/bench_emitters.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "foundation/math/hash.h"
#include "foundation/snapshot/gpu_particles.h"
#include "fxsdk/cli/support/interrupt.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gpu_particles/gpu_emitters.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/gpu_particles/gpu_states.h"
#include "rendering/platform/gl_context.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A GL context with what computes rows.
class GpuStage
{
public:
    static base::Result<std::unique_ptr<GpuStage>> create()
    {
        auto context = render::createEglContext({});
        if (!context)
            return context.status();
        auto device = render::GlDevice::create((*context)->loader(), std::pmr::get_default_resource());
        if (!device)
            return device.status();
        auto depth = BenchDepth::create(**device);
        if (!depth)
            return depth.status();
        return std::unique_ptr<GpuStage>(
            new GpuStage(std::move(*context), std::move(*device), std::move(*depth)));
    }

    /// Times of one dispatch and of waiting for it. Of a group that is published for the GPU.
    base::Status compute(const base::SnapshotGroup& group, double& outDispatch, double& outFinish)
    {
        const Clock::time_point begin = Clock::now();
        const auto emitter = emitters_.find(group.program());
        if (!emitter)
            return emitter.status();
        if (rows_.bytes() == 0)
            if (base::Status status = makeBuffers(*group.program()); !status)
                return status;
        const auto words = group.column64(0);
        device_->gl.NamedBufferSubData(words_.name(), 0, GLsizeiptr(words.size_bytes()), words.data());
        render::ParticleBatch batch{};
        batch.newer = {rows_.name(), {}, 0, rows_.bytes()};
        render::GpuRowsJob job{(*emitter)->program,
                               0,
                               true,
                               {(*emitter)->numbers.name(), {}, 0, (*emitter)->numbers.bytes()},
                               {words_.name(), {}, 0, words_.bytes()},
                               columns_,
                               group.program()->rows};
        job.meetsDepth = render::meetsDepth(group.program()->features);
        states_.nextFrame();
        if (base::Status status = states_.prepare(group, job); !status)
            return status;
        graph_.begin();
        batch.newer.id = graph_.importBuffer({"rows", rows_.bytes()}, rows_.name());
        render::GpuRowsPass::addTo(graph_, {&job, 1}, {&batch, 1},
                                   job.meetsDepth ? depth_.in(graph_) : render::GpuDepth{});
        graph_.compile();
        if (base::Status status = backend_.beginFrame(graph_); !status)
            return status;
        graph_.execute(backend_);
        base::Status status = backend_.endFrame();
        outDispatch = since(begin);
        device_->gl.Finish();
        outFinish = since(begin) - outDispatch;
        return status;
    }
    const std::string& renderer() const { return device_->limits().renderer; }
    size_t rowBytes() const { return rowBytes_; }

private:
    GpuStage(std::unique_ptr<render::GlContext> context, std::unique_ptr<render::GlDevice> device,
             BenchDepth depth)
        : context_(std::move(context)), device_(std::move(device)), depth_(std::move(depth)),
          graph_(std::pmr::get_default_resource()), backend_(*device_, std::pmr::get_default_resource()),
          emitters_(*device_, std::pmr::get_default_resource()),
          states_(*device_, std::pmr::get_default_resource())
    {}

    base::Status makeBuffers(const base::GpuParticleProgram& program)
    {
        uint64_t words = 0;
        columns_.fill(-1);
        for (size_t c = 0; c < base::particle_column::Index; ++c)
            if ((program.features.columns >> c & 1) != 0) {
                columns_[c] = int32_t(words);
                words += program.rows * base::columnElementSize(base::kParticleColumns[c].type) / 4;
            }
        rowBytes_ = size_t(words * 4 / program.rows);
        auto rows = render::GlBuffer::create(*device_, words * 4, "rows");
        auto in = render::GlBuffer::create(*device_, base::kMaxSteppedGpuWords * 8, "words");
        if (!rows || !in)
            return rows ? in.status() : rows.status();
        rows_ = std::move(*rows);
        words_ = std::move(*in);
        return {};
    }

    std::unique_ptr<render::GlContext> context_;
    std::unique_ptr<render::GlDevice> device_;
    BenchDepth depth_;
    render::FrameGraph graph_;
    render::GlBackend backend_;
    render::GpuEmitters emitters_;
    render::GpuStates states_;
    render::GlBuffer rows_, words_;
    std::array<int32_t, 16> columns_{};
    size_t rowBytes_ = 0;
};

struct Times
{
    std::vector<double> step, dispatch, finish, whole; ///< [s]
};

base::Status playTimed(BenchStage& stage, GpuStage& gpu, uint32_t steps, Times& times, uint64_t& ioHash)
{
    for (uint32_t i = 0; i < steps; ++i) {
        if (interruptRequested())
            return interruptedStatus();
        stage.playTimed();
        double dispatch = 0, finish = 0;
        const auto held = stage.last();
        const base::SnapshotGroup& group = held.newer->group(0);
        const auto words = std::as_bytes(group.column64(0));
        ioHash = base::hashBytes(ioHash, words.data(), words.size());
        base::Status status = gpu.compute(group, dispatch, finish);
        stage.release(held);
        if (!status)
            return status;
        times.step.push_back(stage.times().back());
        times.dispatch.push_back(dispatch);
        times.finish.push_back(finish);
        times.whole.push_back(times.step.back() + dispatch + finish);
    }
    return {};
}

/// The same emitter again, but colliding with what a depth texture shows; both by turns, step by step.
base::Status measureDepth(const BenchSettings& settings, std::string_view variant, uint32_t steps,
                          GpuStage& gpu, BenchRow& io)
{
    std::array<std::unique_ptr<BenchStage>, 2> stages;
    std::array<Times, 2> times;
    for (size_t i = 0; i < 2; ++i) {
        stages[i] = std::make_unique<BenchStage>(settings.threads);
        stages[i]->computeOnGpu();
        stages[i]->add(benchEffect(variant, uint32_t(settings.count), true, i == 1), 1);
        stages[i]->play(uint32_t(kSteadyAfter * 60.0));
    }
    uint64_t hash = 0;
    for (uint32_t step = 0; step < steps + 3; ++step)
        for (size_t i = 0; i < 2; ++i) {
            if (step == 3)
                times[i] = {};
            if (base::Status status = playTimed(*stages[i], gpu, 1, times[i], hash); !status)
                return status;
        }
    const double with = quantile(times[1].whole, 0.0), without = quantile(times[0].whole, 0.0);
    io.more["ns_per_particle_min_with_depth"] = 1e9 * with / double(settings.count);
    io.more["with_depth_over_without"] = with / without;
    return {};
}

} // namespace

base::Result<BenchRow> measureOnGpu(const BenchSettings& settings, std::string_view variant)
{
    const auto effect = benchEffect(variant, uint32_t(settings.count), true);
    BenchStage stage(settings.threads);
    stage.computeOnGpu();
    stage.add(effect, 1);
    stage.play(uint32_t(kSteadyAfter * 60.0));
    BenchRow row;
    const auto held = stage.last();
    const bool onGpu = held.newer->group(0).program() != nullptr;
    const bool hasSteps = onGpu && held.newer->group(0).program()->features.steps;
    stage.release(held);
    const uint32_t steps = settings.steps > 0 ? settings.steps : 60;
    if (!onGpu) {
        base::Status status = timeStage(stage, steps, *effect, row);
        return status.ok() ? base::Result<BenchRow>(std::move(row)) : base::Result<BenchRow>(status);
    }
    auto gpu = GpuStage::create();
    if (!gpu)
        return gpu.status();
    Times times;
    uint64_t hash = 0;
    for (const uint32_t count : {3u, steps}) { // the first compile and take memory
        times = {};
        hash = 0;
        if (base::Status status = playTimed(stage, **gpu, count, times, hash); !status)
            return status;
    }
    const auto milliseconds = [](const std::vector<double>& t) { return 1e3 * quantile(t, 0.5); };
    const double count = double(settings.count);
    row.medianNanoseconds = 1e9 * quantile(times.whole, 0.5) / count;
    row.p95Nanoseconds = 1e9 * quantile(times.whole, 0.95) / count;
    row.bytesPerParticle = double((*gpu)->rowBytes());
    row.hash = hash;
    row.more = {{"steps", steps},
                {"path", "gpu"},
                {"ms_step", milliseconds(times.step)},
                {"ms_dispatch", milliseconds(times.dispatch)},
                {"ms_finish", milliseconds(times.finish)},
                {"renderer", (*gpu)->renderer()}};
    if (hasSteps)
        if (base::Status status = measureDepth(settings, variant, steps, **gpu, row); !status)
            return status;
    return row;
}

} // namespace fx::cli
