#include "rendering/view/view_renderer.h"

#include "foundation/math/bits.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_state_guard.h"
#include "rendering/passes/dazzle_pass.h"
#include "rendering/passes/programs.h"
#include "rendering/passes/view_block.h"
#include "rendering/view/fragment_estimate.h"
#include "rendering/view/frame_builder.h"
#include "rendering/view/layer_scale_control.h"
#include "rendering/view/particle_buffers.h"
#include "rendering/view/particle_frame.h"
#include "rendering/view/view_graph.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <string>

namespace fx::render {

struct ViewRenderer::Impl
{
    Impl(GlDevice* d, std::pmr::memory_resource* memory)
        : device(d), graph(memory), backend(*d, memory), builder(memory), particles(memory),
          buffers(*d, memory), runs(memory), streams(memory), timer(*d)
    {}

    base::Status ensureHistory();
    base::Status gather(const base::SnapshotPair& snapshots, const FrameRequest& request,
                        const ViewSettings& settings); ///< everything that is to be drawn
    FrameStatistics rest();
    FrameStatistics count(int divisor);
    void readBack(FrameStatistics& statistics); ///< waits for the GPU

    GlDevice* device;
    FrameGraph graph;
    GlBackend backend;
    FrameBuilder builder;
    ParticleFrame particles;
    ParticleBuffers buffers;
    DrawRuns runs;
    std::pmr::vector<DrawStream> streams;
    const base::AssetTable* assets = nullptr;
    FragmentCounts fragments{}; ///< of this frame
    LayerScaleControl layerScale;
    GlPassTimer timer;
    TimingClock clock = TimingClock::Off;
    uint64_t tag = 0;
    GlBuffer dazzleHistory;
    uint32_t idleFrames = 0;   ///< one after the other in which there was nothing to draw
    bool historyFresh = false; ///< nothing has been adapted to yet
    ViewGraphOutputs outputs;
};

namespace {

constexpr uint32_t kIdleFrames = 300; ///< until textures and buffers are given back

base::Status invalid(std::string message)
{
    return {base::Code::InvalidArgument, std::move(message)};
}

base::Status checkRequest(const FrameRequest& request)
{
    const HostTargets& targets = request.targets;
    if (targets.width <= 0 || targets.height <= 0)
        return invalid("frame: width and height must be positive");
    if (targets.color == 0 && !targets.useFramebuffer)
        return invalid("frame: neither a color texture nor a framebuffer is given");
    const CameraView& camera = request.camera;
    if (!base::allFinite(glm::value_ptr(camera.view), 16) ||
        !base::allFinite(glm::value_ptr(camera.projection), 16) ||
        !base::allFinite(glm::value_ptr(camera.origin), 3))
        return invalid("frame: view, projection or origin is not finite");
    if (camera.projection[0][0] == 0.0f || camera.projection[1][1] == 0.0f)
        return invalid("frame: the projection has no extent (its first or second diagonal element is 0)");
    return {};
}

/// Nothing is to be seen, and nothing else would change the host's picture.
bool leavesPictureAlone(const base::SnapshotPair& snapshots, const FrameRequest& request,
                        const ViewSettings& settings)
{
    const auto isEmpty = [](const base::FrameSnapshot* snapshot) {
        return !snapshot || snapshot->groupCount() == 0;
    };
    return isEmpty(snapshots.newer) && isEmpty(snapshots.older) && !settings.dazzle.enabled &&
           !settings.toneMap && !request.targets.useFramebuffer;
}

} // namespace

base::Status ViewRenderer::Impl::ensureHistory()
{
    if (dazzleHistory.name() != 0)
        return {};
    auto created = GlBuffer::create(*device, sizeof(DazzleHistory), "dazzle history");
    if (!created)
        return created.status();
    dazzleHistory = std::move(*created);
    historyFresh = true;
    return {};
}

base::Status ViewRenderer::Impl::gather(const base::SnapshotPair& snapshots, const FrameRequest& request,
                                        const ViewSettings& settings)
{
    const CameraGeometry camera = cameraGeometry(request.camera);
    builder.build(snapshots, request, settings, camera);
    particles.build({&snapshots, &request, &settings, &camera, builder.lights()});
    const bool refused = buffers.refusesGpu();
    if (refused)
        particles.dropComputed();
    base::Status status = buffers.prepare(snapshots, particles, assets);
    if (!status && buffers.refusesGpu() && !refused) { // the scene will send rows from now on
        particles.dropComputed();
        status = buffers.prepare(snapshots, particles, assets);
    }
    if (!status)
        return status;
    streams.clear();
    if (builder.stream().count > 0)
        streams.push_back(builder.stream());
    streams.insert(streams.end(), particles.streams().begin(), particles.streams().end());
    fragments = estimateFragments(builder.blobs(), camera, request.targets.width, request.targets.height);
    for (size_t i = 0; i < fragments.size(); ++i)
        fragments[i] += particles.fragments()[i];
    return {};
}

/// A frame in which there is nothing to draw.
FrameStatistics ViewRenderer::Impl::rest()
{
    outputs = {};
    historyFresh = true; // glare that has paused begins anew
    FrameStatistics statistics;
    if (++idleFrames >= kIdleFrames && backend.pooledBytes() > 0) {
        const uint64_t before = device->callCount();
        backend.releasePool();
        statistics.glCalls = device->callCount() - before;
    }
    statistics.textureBytes = backend.pooledBytes();
    return statistics;
}

/// What the frame has drawn.
FrameStatistics ViewRenderer::Impl::count(int divisor)
{
    FrameStatistics statistics;
    statistics.blobs = uint32_t(builder.blobs().size());
    statistics.blobsCulled = builder.counts().culled;
    statistics.blobsNonFinite = builder.counts().nonFinite;
    statistics.particles = particles.rows();
    for (const ParticleBatch& batch : particles.batches())
        statistics.gpuParticles += batch.isComputed ? batch.instances : 0;
    statistics.particlesOrdered = particles.orderedRows();
    statistics.uploadedBytes = buffers.uploadedBytes();
    statistics.passes = outputs.anyPass ? uint32_t(graph.executedPasses().size()) : 0;
    statistics.drawCalls = outputs.anyPass ? backend.drawCalls() : 0;
    statistics.textureBytes = backend.pooledBytes() + buffers.bytes();
    statistics.estimatedFragments = fragments[layerDivisorIndex(divisor)];
    statistics.layerDivisor = divisor;
    return statistics;
}

void ViewRenderer::Impl::readBack(FrameStatistics& statistics)
{
    if (outputs.overdraw.valid()) {
        for (const float count : readTexture(*device, backend.textureName(outputs.overdraw),
                                             outputs.layerWidth, outputs.layerHeight, 1))
        {
            statistics.coveredPixels += count > 0.0f ? 1 : 0;
            statistics.shadedFragments += uint64_t(count);
        }
    }
    if (dazzleHistory.name() != 0 && !historyFresh) {
        DazzleHistory history;
        device->gl.GetNamedBufferSubData(dazzleHistory.name(), 0, sizeof history, &history);
        std::copy_n(history.frameMean, 3, statistics.overflow);
    }
}

ViewRenderer::ViewRenderer(GlDevice* device, const base::SnapshotSchema*, std::pmr::memory_resource* memory)
    : impl_(std::make_unique<Impl>(device, memory))
{}

ViewRenderer::~ViewRenderer() = default;

void ViewRenderer::setAssets(const base::AssetTable* assets)
{
    impl_->assets = assets;
}

base::Status ViewRenderer::warmUp()
{
    for (const ProgramDesc* program : allPrograms())
        if (base::Status status = impl_->device->compile(*program); !status)
            return status;
    return impl_->ensureHistory();
}

bool ViewRenderer::canComputeParticles() const
{
    return !impl_->buffers.refusesGpu();
}

void ViewRenderer::warmUp(const base::GpuParticleProgram& emitter)
{
    impl_->buffers.warmUp(emitter);
}

base::Status ViewRenderer::render(const base::SnapshotPair& snapshots, const FrameRequest& asked)
{
    Impl& s = *impl_;
    if (base::Status status = checkRequest(asked); !status)
        return status;
    if (base::Status status = checkSensorLaw(settings_.dazzle); !status)
        return status;
    if (leavesPictureAlone(snapshots, asked, settings_)) {
        statistics_ = s.rest();
        return {};
    }
    s.idleFrames = 0;
    const uint64_t callsBefore = s.device->callCount();
    const uint32_t compiledBefore = s.device->programsCompiled();
    if (base::Status status = settings_.dazzle.enabled ? s.ensureHistory() : base::Status(); !status)
        return status;
    FrameRequest request = asked;
    request.resetHistory = asked.resetHistory || s.historyFresh;

    if (base::Status status = s.gather(snapshots, request, settings_); !status)
        return status;
    s.timer.beginFrame(s.clock, s.tag);
    s.backend.setTimer(s.clock == TimingClock::Off ? nullptr : &s.timer);
    const std::span<const MediaRun> runs = s.runs.build(s.streams);
    const int divisor = s.layerScale.choose(s.fragments, settings_.layerDivisor, settings_.fragmentBudget,
                                            asked.resetHistory);
    s.graph.begin();
    s.outputs = buildViewGraph(s.graph, {&request, &settings_, s.builder.blobs(), s.particles.batches(), runs,
                                         s.builder.anyHeat(), s.builder.anyDetail(), s.dazzleHistory.name(),
                                         divisor, s.buffers.jobs(), s.particles.gpuOrders()});
    base::Status status;
    if (s.outputs.anyPass) {
        s.graph.compile();
        GlStateGuard guard(*s.device, settings_.saveState);
        s.timer.beginPasses();
        if (s.backend.beginFrame(s.graph))
            s.graph.execute(s.backend);
        s.buffers.fence();
        status = s.backend.endFrame();
    }
    if (!status)
        s.buffers.forgetComputed();
    s.timer.endFrame(status.ok() && s.outputs.anyPass);
    if (s.clock != TimingClock::Off)
        covered_ = screenShare(s.builder.blobs(), cameraGeometry(request.camera));
    if (!status)
        s.outputs = {};                              // nothing of this frame can be handed out
    s.historyFresh = !(status && s.outputs.dazzled); // glare that has paused begins anew

    statistics_ = s.count(divisor);
    statistics_.glCalls = s.device->callCount() - callsBefore;
    statistics_.programsCompiled = s.device->programsCompiled() - compiledBefore;
    if (status && settings_.countOverdraw)
        s.readBack(statistics_);
    return status;
}

void ViewRenderer::setTiming(TimingClock clock, uint64_t tag)
{
    impl_->clock = clock;
    impl_->tag = tag;
}

bool ViewRenderer::hasGpuClock()
{
    return impl_->timer.hasGpuClock();
}

void ViewRenderer::setHostClock(HostClock clock)
{
    impl_->timer.hostClock = clock;
}

bool ViewRenderer::takeTimes(GroupTimes& out)
{
    return impl_->timer.take(out);
}

LayerTextures ViewRenderer::layers() const
{
    const Impl& s = *impl_;
    const auto name = [&](ResourceId id) { return id.valid() ? s.backend.textureName(id) : 0; };
    const ViewGraphOutputs& o = s.outputs;
    return {name(o.fire), name(o.smoke), name(o.dust), name(o.depth), name(o.opticalDepth), name(o.media)};
}

std::span<const std::string_view> ViewRenderer::executedPasses() const
{
    return impl_->outputs.anyPass ? impl_->graph.executedPasses() : std::span<const std::string_view>();
}

} // namespace fx::render
