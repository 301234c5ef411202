#include "rendering/view/view_renderer.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "rendering/frame/view_block.h"
#include "rendering/gl/gl_state_guard.h"
#include "rendering/passes/dazzle_pass.h"
#include "rendering/passes/programs.h"
#include "rendering/view/view_parts.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <bit>
#include <string>

namespace fx::render {

namespace {

/// Names what a moment between two snapshots shows.
uint64_t contentOf(const StampPair& stamps, double interpolation)
{
    const uint64_t moment = stamps.isSteady() ? 0 : std::bit_cast<uint64_t>(interpolation);
    return base::hashWord(base::hashWord(stamps.newer, stamps.isSteady() ? 0 : stamps.older), moment);
}

base::Status invalid(std::string message)
{
    return {base::Code::InvalidArgument, std::move(message)};
}

/// Nothing is to be seen, and nothing else would change the host's picture.
bool leavesPictureAlone(const base::SnapshotPair& snapshots, const FrameRequest& request,
                        const ViewSettings& settings)
{
    const auto isEmpty = [](const base::FrameSnapshot* snapshot) {
        return !snapshot || snapshot->groupCount() == 0;
    };
    return isEmpty(snapshots.newer) && isEmpty(snapshots.older) && !settings.dazzle.enabled &&
           !settings.toneMap && !request.targets.useFramebuffer && request.overlay.empty();
}

} // namespace

base::Status ViewRenderer::Impl::checkTargets(const FrameRequest& request)
{
    const HostTargets& targets = request.targets;
    const char* const own = backend.owns(targets.color)   ? "frame.colorTexture"
                            : backend.owns(targets.depth) ? "frame.depthTexture"
                                                          : nullptr;
    if (own)
        return invalid(std::string(own) + " is a texture of this view, which draws to it: give a copy");
    return targetCheck.check(request);
}

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
    const StampPair now = stamps.stampsOf(snapshots);
    const FrameKey wanted = frameKey(now, request, settings, assets);
    keptLists = key == wanted && !request.resetHistory;
    if (keptLists) {
        single.buffers.keep(single.frame);
        joined.buffers.keep(joined.frame);
        return {};
    }
    key.reset();
    base::SnapshotPair shown = snapshots;
    if (now.isSteady())
        shown.older = nullptr; // nothing moves between them
    if (base::Status status = gatherAnew(shown, now, request, settings); !status) {
        single.buffers.forgetComputed();
        builder.forgetPictures();
        return status;
    }
    if (builder.isSettled())
        key = wanted;
    return {};
}

SnapshotRowStamps ViewRenderer::Impl::rowsOf(const base::FrameSnapshot* snapshot) const
{
    return snapshot ? stamps.rowsOf(*snapshot) : SnapshotRowStamps{};
}

base::Status ViewRenderer::Impl::gatherAnew(const base::SnapshotPair& snapshots, const StampPair& now,
                                            const FrameRequest& request, const ViewSettings& settings)
{
    const CameraGeometry camera = cameraGeometry(request.camera);
    builder.build(snapshots, request, settings, camera, contentOf(now, request.interpolation));
    if (builder.anyHeat() && settings.shimmer.strength > 0.0f)
        hotAreas.find(builder.blobs(), request.camera, request.targets.width, request.targets.height);
    else
        hotAreas.clear();
    streams.clear();
    batches.clear();
    if (builder.stream().count > 0)
        streams.push_back(builder.stream());
    if (builder.impostorStream().count > 0)
        streams.push_back(builder.impostorStream());
    fragments = estimateFragments(builder.blobs(), camera, request.targets.width, request.targets.height);
    const UploadStamps own{now, rowsOf(snapshots.newer), rowsOf(snapshots.older)};
    merger.build(snapshots, now, own.newerRows, own.olderRows);
    const base::SnapshotPair merged = merger.merged();
    ParticleFrameInputs inputs{&snapshots, &request, &settings, &camera, builder.lights()};
    inputs.lod = &builder.lod();
    inputs.left = merger.taken();
    if (base::Status status = add(single, inputs, own); !status)
        return status;
    inputs.snapshots = &merged;
    inputs.left = {};
    inputs.merger = &merger;
    if (base::Status status = add(joined, inputs, {merger.stamps(), merger.newerRows(), merger.olderRows()});
        !status)
        return status;
    if (base::Status status = makeRoom(blobBuffer, builder.blobs().size_bytes(), "blobs"); !status)
        return status;
    if (base::Status status = makeRoomForImpostors(); !status)
        return status;
    mediaRuns = runs.build(streams);
    return {};
}

base::Status ViewRenderer::Impl::add(Particles& particles, const ParticleFrameInputs& inputs,
                                     const UploadStamps& of)
{
    particles.frame.build(inputs);
    const bool refused = particles.buffers.refusesGpu();
    if (refused)
        particles.frame.dropComputed();
    base::Status status = particles.buffers.prepare(*inputs.snapshots, of, particles.frame, assets);
    if (!status && particles.buffers.refusesGpu() && !refused) { // the scene will send rows from now on
        particles.frame.dropComputed();
        status = particles.buffers.prepare(*inputs.snapshots, of, particles.frame, assets);
    }
    if (!status)
        return status;
    for (DrawStream stream : particles.frame.streams()) {
        stream.batch += uint32_t(batches.size());
        streams.push_back(stream);
    }
    batches.insert(batches.end(), particles.frame.batches().begin(), particles.frame.batches().end());
    for (size_t i = 0; i < fragments.size(); ++i)
        fragments[i] += particles.frame.fragments()[i];
    return {};
}

ViewRenderer::ViewRenderer(GlDevice* device, const base::SnapshotSchema* schema,
                           std::pmr::memory_resource* memory)
    : impl_(std::make_unique<Impl>(device, schema, memory))
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
    return !impl_->single.buffers.refusesGpu();
}

void ViewRenderer::warmUp(const base::GpuParticleProgram& emitter)
{
    impl_->single.buffers.warmUp(emitter);
}

base::Status ViewRenderer::check(const FrameRequest& request)
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

base::Status ViewRenderer::render(const base::SnapshotPair& snapshots, const FrameRequest& asked)
{
    Impl& s = *impl_;
    if (base::Status status = check(asked); !status)
        return status;
    if (base::Status status = checkSensorLaw(settings_.dazzle); !status)
        return status;
    asleep_ = false;
    if (leavesPictureAlone(snapshots, asked, settings_)) {
        statistics_ = s.rest();
        asleep_ = statistics_.glCalls == 0 && s.holdsNothing();
        return {};
    }
    const uint64_t callsBefore = s.device->callCount();
    if (base::Status status = s.checkTargets(asked); !status)
        return status;
    s.idleFrames = 0;
    const uint32_t compiledBefore = s.device->programsCompiled();
    if (base::Status status = settings_.dazzle.enabled ? s.ensureHistory() : base::Status(); !status)
        return status;
    FrameRequest request = asked;
    request.resetHistory = asked.resetHistory || s.historyFresh;

    if (base::Status status = s.gather(snapshots, asked, settings_); !status)
        return status;
    s.timer.beginFrame(s.clock, s.tag);
    s.backend.setTimer(s.clock == TimingClock::Off ? nullptr : &s.timer);
    const int divisor = s.layerScale.choose(s.fragments, settings_.layerDivisor, settings_.fragmentBudget,
                                            asked.resetHistory);
    s.graph.begin();
    s.outputs = buildViewGraph(
        s.graph,
        {&request, &settings_, s.builder.blobs(), s.batches, s.mediaRuns, s.hotAreas.areas(),
         s.builder.anyDetail(), s.dazzleHistory.name(), divisor, s.blobBuffer.name(), s.keptLists,
         s.builder.impostors(), s.keptLists ? std::span<const BlobInstance>() : s.builder.takenBlobs(),
         s.keptLists ? std::span<const uint32_t>() : s.builder.takenTiles(),
         s.keptLists ? std::span<const MediaRun>() : s.builder.takenRuns(), s.impostorBuffer.name(),
         s.impostorAtlas.name(), s.single.buffers.jobs(), s.single.frame.gpuOrders()});
    base::Status status;
    if (s.outputs.anyPass) {
        s.graph.compile();
        GlStateGuard guard(*s.device, settings_.saveState);
        s.timer.beginPasses();
        // tone mapping writes the codes of sRGB itself
        const bool isDisplayReferred = settings_.toneMap && asked.targets.color != 0;
        if (s.backend.beginFrame(s.graph, isDisplayReferred ? SrgbTargets::Codes : SrgbTargets::Light))
            s.graph.execute(s.backend);
        s.single.buffers.fence();
        s.joined.buffers.fence();
        status = s.backend.endFrame();
    }
    if (!status)
        s.single.buffers.forgetComputed();
    s.releaseUnused();
    s.timer.endFrame(status.ok() && s.outputs.anyPass);
    if (s.clock != TimingClock::Off)
        covered_ = screenShare(s.builder.blobs(), cameraGeometry(request.camera));
    if (!status) {
        s.outputs = {}; // nothing of this frame can be handed out
        s.key.reset();
        s.builder.forgetPictures();
    }
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
