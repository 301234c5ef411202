// A frame that is gathered before the host draws its surfaces, so that these can be darkened by media.
#include "rendering/gl/gl_state_guard.h"
#include "rendering/view/view_parts.h"

namespace fx::render {

base::Status ViewRenderer::Impl::begin(const base::SnapshotPair& snapshots, const FrameRequest& request,
                                       const ViewSettings& settings)
{
    idleFrames = 0;
    hasLights = false;
    compose(settings);
    for (const auto& part : parts)
        if (base::Status status = request.range.isContinued ? base::Status() : part->begin(settings); !status)
            return status;
    base::Status status = gather(snapshots, request, settings);
    hasLights = status.ok();
    return status;
}

void ViewRenderer::Impl::dropPrepared()
{
    if (!prepared)
        return;
    prepared.reset();
    if (keptLists)
        return; // they are as the last frame has left them
    for (const auto& part : parts)
        part->forget();
}

bool ViewRenderer::Impl::takePrepared(const base::SnapshotPair& snapshots, const FrameRequest& request,
                                      const ViewSettings& settings)
{
    if (!prepared)
        return false;
    const FrameKey wanted =
        frameKey(revisions.revisionsOf(snapshots), shownHash(snapshots), request, settings, assets);
    if (prepared->key != wanted || prepared->resetHistory != request.resetHistory) {
        dropPrepared();
        return false;
    }
    if (prepared->isSettled)
        key = wanted;
    return true;
}

/// In a graph of its own: layers of the last frame stay valid.
base::Status ViewRenderer::Impl::fillLights(const ViewSettings& settings)
{
    lightGraph.begin();
    LightBindings bindings = lights.addPasses(lightGraph);
    if (composition)
        bindings = composition->addLightPasses(lightGraph, bindings);
    if (bindings.lights.valid())
        lightGraph.keep(bindings.lights);
    lightGraph.compile();
    if (lightGraph.executedPasses().empty())
        return {};
    GlStateGuard guard(*device, settings.saveState);
    lightTimer.beginFrame(clock, 0);
    lightBackend.setTimer(clock == TimingClock::Off ? nullptr : &lightTimer);
    lightTimer.beginPasses();
    if (lightBackend.beginFrame(lightGraph))
        lightGraph.execute(lightBackend);
    base::Status status = lightBackend.endFrame();
    lightTimer.endFrame(status.ok());
    if (!status)
        forget();
    lights.keep(); // the frame's own passes need not do it again
    return status;
}

base::Status ViewRenderer::prepareLights(const base::SnapshotPair& snapshots, const FrameRequest& asked)
{
    Impl& s = *impl_;
    if (base::Status status = checkAll(asked); !status)
        return status;
    s.dropPrepared();
    s.isOpen = false;
    if (s.leavesPictureAlone(snapshots, asked, settings_)) {
        s.hasLights = false;
        return {};
    }
    const uint64_t callsBefore = s.device->callCount();
    const uint32_t compiledBefore = s.device->programsCompiled();
    FrameRequest contextOnly;
    contextOnly.camera = asked.camera;
    HostTargetFacts unused;
    if (base::Status status = s.targetCheck.check(contextOnly, unused); !status)
        return status;
    if (base::Status status = s.begin(snapshots, asked, settings_); !status)
        return status;
    s.prepared = {
        frameKey(s.revisions.revisionsOf(snapshots), shownHash(snapshots), asked, settings_, s.assets),
        asked.resetHistory, s.key.has_value(), 0, 0};
    if (!s.keptLists)
        s.key.reset(); // nothing of it has been uploaded yet
    base::Status status = s.fillLights(settings_);
    if (!status) {
        s.dropPrepared();
        s.key.reset();
        s.hasLights = false;
        return status;
    }
    s.prepared->glCalls = s.device->callCount() - callsBefore;
    s.prepared->programsCompiled = s.device->programsCompiled() - compiledBefore;
    return {};
}

MediaShadowBlock ViewRenderer::mediaShadow(LightKind kind, uint32_t index, const glm::dvec3& origin) const
{
    return impl_->hasLights ? impl_->lights.shadow(kind, index, origin) : MediaShadowBlock();
}

uint32_t ViewRenderer::mediaShadowTexture() const
{
    return impl_->hasLights && impl_->lights.isFilled() ? impl_->lights.atlasTexture() : 0;
}

const LightList& ViewRenderer::lights() const
{
    return impl_->lights.list();
}

std::span<const EffectLight> ViewRenderer::effectLights() const
{
    return std::span(impl_->glows).first(impl_->hasLights ? impl_->glowCount : 0);
}

} // namespace fx::render
