#include "rendering/view/view_renderer.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "rendering/frame/view_block.h"
#include "rendering/gl/gl_state_guard.h"
#include "rendering/passes/programs.h"
#include "rendering/view/view_parts.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace fx::render {

namespace {

/// Names what a moment between two snapshots shows.
uint64_t contentOf(const base::SnapshotPair& snapshots, const RevisionPair& revisions, double interpolation)
{
    const uint64_t moment = revisions.isSteady() ? 0 : std::bit_cast<uint64_t>(interpolation);
    const uint64_t content =
        base::hashWord(base::hashWord(revisions.newer, revisions.isSteady() ? 0 : revisions.older), moment);
    return snapshots.shown.empty() ? content : base::hashWord(content, shownHash(snapshots));
}

/// Differs where the casters of a frame differ in the world: level of detail depends on the eye.
uint64_t casterRevision(const GatherInputs& in, const glm::dvec3& eye)
{
    const LodSettings& lod = in.settings->lod;
    uint64_t revision = base::hashWord(in.content, std::bit_cast<uint32_t>(in.settings->particleShare));
    if (lod.bias > 0.0f || lod.impostorPixels > 0.0f)
        for (int i = 0; i < 3; ++i)
            revision = base::hashWord(revision, std::bit_cast<uint64_t>(eye[i]));
    const bool hasTiles = in.drawsTiles && in.settings->blocks.parallax > 0.0f && in.settings->outputs == 0;
    return base::hashWord(revision, uint64_t(hasTiles)); // blocks of very many balls cast as single balls
}

/// Whether any light has planes that casters are needed for.
bool castsShadows(const ViewSettings& settings, size_t glows)
{
    const SliceSettings& slices = settings.slices;
    const Lighting& lighting = settings.lighting;
    return slices.enabled &&
           (lighting.sunIlluminance != glm::vec3(0.0f) || lighting.skyLuminance != glm::vec3(0.0f) ||
            (slices.castingPoints > 0 && glows + settings.hostLights.count > 0));
}

base::Status invalid(std::string message)
{
    return {base::Code::InvalidArgument, std::move(message)};
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
    return targetCheck.check(request, targetFacts);
}

/// Nothing is to be seen, and nothing else would change the host's picture.
bool ViewRenderer::Impl::leavesPictureAlone(const base::SnapshotPair& snapshots, const FrameRequest& request,
                                            const ViewSettings& settings) const
{
    const auto isEmpty = [](const base::FrameSnapshot* snapshot) {
        return !snapshot || snapshot->groupCount() == 0;
    };
    return isEmpty(snapshots.newer) && isEmpty(snapshots.older) && !settings.toneMap &&
           !request.targets.useFramebuffer && request.overlay.empty() &&
           std::ranges::none_of(techniques, [&](const DrawTechnique* technique) {
               return technique->actsAlone && technique->actsAlone(settings);
           });
}

void ViewRenderer::Impl::forget()
{
    lights.forget();
    for (const auto& part : parts)
        part->forget();
}

void ViewRenderer::Impl::askWhetherParticlesAreComputed()
{
    computesParticles =
        std::ranges::all_of(parts, [](const auto& part) { return part->canComputeParticles(); });
}

base::Status ViewRenderer::Impl::gather(const base::SnapshotPair& snapshots, const FrameRequest& request,
                                        const ViewSettings& settings)
{
    const RevisionPair now = revisions.revisionsOf(snapshots);
    const FrameKey wanted = frameKey(now, shownHash(snapshots), request, settings, assets);
    keptLists = request.range.isContinued || (key == wanted && !request.resetHistory && !stereo.otherCamera);
    if (keptLists) {
        lights.keep();
        for (const auto& part : parts)
            part->keep();
        return {};
    }
    key.reset();
    base::SnapshotPair shown = snapshots;
    if (now.isSteady())
        shown.older = nullptr; // nothing moves between them
    if (base::Status status = gatherAnew(shown, now, request, settings); !status) {
        forget();
        askWhetherParticlesAreComputed();
        return status;
    }
    if (lights.isCurrent() && std::ranges::all_of(parts, [](const auto& part) { return part->isSettled(); }))
        key = wanted;
    return {};
}

SnapshotRowRevisions ViewRenderer::Impl::rowsOf(const base::FrameSnapshot* snapshot) const
{
    return snapshot ? revisions.rowsOf(*snapshot) : SnapshotRowRevisions{};
}

base::Status ViewRenderer::Impl::gatherAnew(const base::SnapshotPair& snapshots, const RevisionPair& now,
                                            const FrameRequest& request, const ViewSettings& settings)
{
    const CameraGeometry camera = cameraGeometry(request.camera);
    const bool isOtherEye = stereo.isSecond && stereo.hasLists;
    const bool sharesLists = !composing->fitsToVisible && !settings.slices.network;
    stereo.hasLists = false;
    if (!isOtherEye) {
        lod.begin(settings.lod, camera, request.targets.height, request.resetHistory);
        stereo.firstEye = camera.eye;
    }
    glowCount = snapshots.newer ? render::effectLights(*snapshots.newer, glows, techniques) : 0;
    const GatherInputs inputs{&snapshots,
                              now,
                              rowsOf(snapshots.newer),
                              rowsOf(snapshots.older),
                              &request,
                              &settings,
                              &camera,
                              assets,
                              std::span(glows).first(glowCount),
                              &lod,
                              contentOf(snapshots, now, request.interpolation),
                              castsShadows(settings, glowCount),
                              composing->needsOrder,
                              composing->drawsTiles,
                              sharesLists ? stereo.otherCamera : nullptr};
    streams.clear();
    solids.clear();
    mediaBatches = {};
    casters.clear();
    GatheredFrame gathered{&streams, &casters};
    for (const auto& part : parts)
        if (base::Status status = isOtherEye && sharesLists ? part->gatherOtherEye(inputs, gathered)
                                                            : part->gather(inputs, gathered);
            !status)
            return status;
    for (const auto& part : parts)
        if (const MediaSource* source = part->solids())
            solids.push_back(source);
    const LightListInputs lit{&settings, camera.eye,           inputs.lights,
                              casters,   request.resetHistory, isOtherEye};
    const bool isUsed =
        (composition && composition->hasMedia()) || !streams.empty() || !solids.empty() || !casters.empty();
    if (base::Status status = lights.gather(lit, casterRevision(inputs, stereo.firstEye), isUsed); !status)
        return status;
    fragments = gathered.fragments;
    mediaBatches = batcher.build(streams);
    stereo.hasLists = stereo.otherCamera != nullptr;
    return {};
}

ViewRenderer::ViewRenderer(GlDevice* device, const base::SnapshotSchema* schema,
                           std::pmr::memory_resource* memory, DrawTechniques techniques)
    : impl_(std::make_unique<Impl>(device, schema, memory, techniques))
{}

ViewRenderer::~ViewRenderer() = default;
ViewRenderer::ViewRenderer(ViewRenderer&&) noexcept = default;
ViewRenderer& ViewRenderer::operator=(ViewRenderer&&) noexcept = default;

void ViewRenderer::setAssets(const base::AssetTable* assets)
{
    impl_->assets = assets;
}

base::Status ViewRenderer::warmUp()
{
    std::vector<const ProgramDesc*> called;
    const auto add = [&](std::span<const ProgramDesc* const> programs) {
        called.insert(called.end(), programs.begin(), programs.end());
    };
    add(framePrograms());
    for (const DrawTechnique* technique : impl_->techniques)
        if (technique->programs)
            add(technique->programs());
    for (const MediaComposition* composition : mediaCompositions())
        if (composition->programs)
            add(composition->programs());
    if (settings_.outputs != 0)
        add(outputPrograms());
    if (base::Status status = impl_->device->compile(called); !status)
        return status;
    for (const auto& part : impl_->parts)
        if (base::Status status = part->prepare(); !status)
            return status;
    return {};
}

void ViewRenderer::setCompletes(bool completes)
{
    impl_->completes = completes;
}

bool ViewRenderer::canComputeParticles() const
{
    return impl_->computesParticles;
}

void ViewRenderer::warmUp(const base::GpuParticleProgram& emitter)
{
    for (const auto& part : impl_->parts)
        part->warmUp(emitter);
    impl_->askWhetherParticlesAreComputed();
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

/// The request with the texture from which depth can be read.
base::Status ViewRenderer::Impl::findDepth(FrameRequest& io)
{
    io.targets.depth = targetFacts.depth != 0 ? targetFacts.depth : copies.depth();
    return copies.status();
}

base::Status ViewRenderer::Impl::draw(const FrameRequest& request, const ViewSettings& settings, int divisor)
{
    graph.begin();
    outputs = buildViewGraph(graph, {&request, &settings, parts, mediaBatches, solids, &lights, composition,
                                     divisor, outputView, &history.past(), &targetFacts, &copies, completes});
    if (!copies.status()) {
        forget();
        return copies.status();
    }
    if (!outputs.anyPass)
        return {};
    graph.compile();
    passNames.reserve(lightGraph.executedPasses().size() + graph.executedPasses().size()); // see namePasses()
    GlStateGuard guard(*device, settings.saveState);
    if (base::Status status = copies.copy(); !status) {
        forget();
        return status;
    }
    timer.beginPasses();
    // tone mapping and display encodings write codes themselves; only the last part of a picture is
    // tone-mapped
    const bool isToneMapped = settings.toneMap && completes && request.range.isLast;
    const bool isDisplayReferred =
        request.targets.isDisplay() || (isToneMapped && request.targets.color != 0);
    if (backend.beginFrame(graph, isDisplayReferred ? SrgbTargets::Codes : SrgbTargets::Light,
                           request.targets.keepScissor))
        graph.execute(backend);
    for (const auto& part : parts)
        part->fence();
    base::Status status = backend.endFrame();
    if (!status)
        forget();
    return status;
}

base::Status ViewRenderer::checkAll(const FrameRequest& request) const
{
    if (base::Status status = check(request); !status)
        return status;
    if (!findComposition(settings_.composition))
        return invalid("settings: this library has no composition " +
                       std::to_string(int(settings_.composition)));
    const bool isPart = request.range.isContinued || !request.range.isLast;
    if (isPart && (settings_.layerOutputs || settings_.outputs != 0))
        return invalid(
            "frame.rangePart is not FX_RANGE_ONLY, but settings.layerOutputs and settings.outputs are "
            "textures of a whole frame: set them to 0, or draw a frame for them");
    if (settings_.toneMap && request.targets.isDisplay())
        return invalid("frame.targetEncoding is a display encoding and settings.toneMap is 1, which would "
                       "tone-map twice: set one of them to 0");
    if (settings_.slabs != 6 && settings_.slabs != 16)
        return invalid("settings: slabs are 6 or 16");
    if (settings_.outputs > view_output::kAll)
        return invalid("settings: this library has no such outputs");
    if (settings_.voxels < 16 || settings_.voxels > 256)
        return invalid("settings: voxels are 16 to 256");
    for (const DrawTechnique* technique : impl_->techniques)
        if (base::Status status = technique->check ? technique->check(settings_) : base::Status(); !status)
            return status;
    return {};
}

void ViewRenderer::tellComposition()
{
    const bool isSlabs = settings_.composition == Composition::Slabs;
    const bool isVolume = settings_.composition == Composition::Volume;
    statistics_.composition = settings_.composition;
    statistics_.compositionSize = uint32_t(isSlabs ? settings_.slabs : isVolume ? settings_.voxels : 0);
}

base::Status ViewRenderer::render(const base::SnapshotPair& snapshots, const FrameRequest& asked)
{
    Impl& s = *impl_;
    if (base::Status status = checkAll(asked); !status)
        return status;
    asleep_ = false;
    if (settings_.outputs != 0)
        s.history.advance(asked);
    else
        s.history.forget();
    if (s.leavesPictureAlone(snapshots, asked, settings_)) {
        statistics_ = s.rest();
        tellComposition();
        asleep_ = statistics_.glCalls == 0 && s.holdsNothing() && settings_.outputs == 0; // which tell motion
        return {};
    }
    const uint64_t callsBefore = s.device->callCount();
    if (base::Status status = s.checkTargets(asked); !status)
        return status;
    s.copies.begin(asked.targets, s.targetFacts);
    FrameRequest seen = asked;
    if (base::Status status = s.findDepth(seen); !status)
        return status;
    const uint32_t compiledBefore = s.device->programsCompiled();
    const bool wasPrepared = s.takePrepared(snapshots, asked, settings_);
    const uint64_t callsThen = wasPrepared ? s.prepared->glCalls : 0;
    const uint32_t compiledThen = wasPrepared ? s.prepared->programsCompiled : 0;
    s.prepared.reset();
    seen.range.isContinued = asked.range.isContinued && s.isOpen;
    s.isOpen = false;
    if (!wasPrepared)
        if (base::Status status = s.begin(snapshots, seen, settings_); !status)
            return status;
    s.lights.setSunShadow(asked.sunShadow, asked.camera.origin);
    s.timer.beginFrame(s.clock, s.tag);
    s.backend.setTimer(s.clock == TimingClock::Off ? nullptr : &s.timer);
    if (!s.stereo.isSecond && !seen.range.isContinued)
        s.stereo.divisor = s.layerScale.choose(s.fragments, settings_.layerDivisor, settings_.fragmentBudget,
                                               asked.resetHistory);
    const int divisor = s.stereo.divisor;
    base::Status status;
    try {
        status = s.draw(seen, settings_, divisor);
    } catch (...) { // out of memory: the next frame uploads and fills everything again
        s.forget();
        s.key.reset();
        throw;
    }
    s.isOpen = status.ok() && !asked.range.isLast;
    for (const auto& part : s.parts)
        if (!s.isOpen)
            part->endFrame(status.ok());
    s.askWhetherParticlesAreComputed();
    s.timer.endFrame(status.ok() && s.outputs.anyPass);
    if (s.clock != TimingClock::Off) {
        covered_ = {};
        for (const auto& part : s.parts)
            part->cover(cameraGeometry(asked.camera), covered_);
    }
    if (!status) {
        s.outputs = {}; // nothing of this frame can be handed out
        s.key.reset();
        s.hasLights = false;
    }
    s.namePasses(wasPrepared);
    statistics_ = s.count(divisor);
    tellComposition();
    statistics_.glCalls = s.device->callCount() - callsBefore + callsThen;
    statistics_.programsCompiled = s.device->programsCompiled() - compiledBefore + compiledThen;
    if (wasPrepared && !s.lightGraph.executedPasses().empty())
        statistics_.drawCalls += s.lightBackend.drawCalls();
    if (status && settings_.countOverdraw)
        for (const auto& part : s.parts)
            part->readBack(s.backend, statistics_);
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
    impl_->timer.hostClock = impl_->lightTimer.hostClock = clock;
}

bool ViewRenderer::takeTimes(GroupTimes& out)
{
    for (GroupTimes prepared; impl_->lightTimer.take(prepared);)
        impl_->noteFilling(prepared);
    if (!impl_->timer.take(out))
        return false;
    impl_->noteFilling(out);
    return true;
}

void ViewRenderer::Impl::noteFilling(const GroupTimes& times)
{
    const size_t group = timer.groups().find(kLightSliceGroup);
    if (group != 0 && times.milliseconds[group] > 0.0)
        fillMilliseconds = times.milliseconds[group];
}

double ViewRenderer::fillMilliseconds() const
{
    return impl_->fillMilliseconds;
}

DrawTechniques ViewRenderer::techniques() const
{
    return impl_->techniques;
}

const PassGroups& ViewRenderer::passGroups() const
{
    return impl_->timer.groups();
}

LayerTextures ViewRenderer::layers() const
{
    const Impl& s = *impl_;
    const auto name = [&](ResourceId id) { return id.valid() ? s.backend.textureName(id) : 0; };
    const ViewGraphOutputs& o = s.outputs;
    return {name(o.fire), name(o.smoke), name(o.dust), name(o.depth), name(o.opticalDepth), name(o.media)};
}

uint32_t ViewRenderer::output(size_t number) const
{
    const ResourceId id = impl_->outputs.outputs[number];
    return id.valid() ? impl_->backend.textureName(id) : 0;
}

std::span<const std::string_view> ViewRenderer::executedPasses() const
{
    return impl_->passNames;
}

} // namespace fx::render
