// The functions of fx_view.h.
#include "fxsdk/api/overlay.h"
#include "fxsdk/api/text.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/api/view_object.h"
#include "rendering/gl/gl_state_guard.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace {

using fx::base::Code;
using fx::base::Status;

Status checkCreate(const FxContext* context, const FxScene* scene, FxView** outView)
{
    fx::api::Checks check;
    check.notNull(context, "context");
    check.notNull(scene, "scene");
    check.notNull(outView, "outView");
    if (!check.status())
        return check.status();
    if (!context->device)
        return {Code::NoGl, fx::api::kWithoutGl};
    return scene->context == context ? Status() : fx::api::invalid("scene belongs to another context");
}

/// Leaves both outputs as they are on failure.
Status readSettings(const FxContext& context, const FxViewSettings* given,
                    fx::render::ViewSettings& outSettings, fx::quality::BudgetOptions& outBudget)
{
    FxViewSettings known;
    if (Status status = fx::api::readStruct(given, "settings", fxDefaultViewSettings(), known); !status)
        return status;
    fx::quality::BudgetOptions budget;
    if (Status status = fx::api::convertBudget(known, budget); !status)
        return status;
    if (Status status = fx::api::convertSettings(context.world, known, outSettings); !status)
        return status;
    outBudget = budget;
    return {};
}

/// Lets go of what a frame shows when it has been drawn, or has failed.
class FrameEnd
{
public:
    explicit FrameEnd(FxView& view) : view_(view) {}
    ~FrameEnd()
    {
        if (awaitsRanges)
            return;
        view_.prepared.reset();
        view_.rangeEnd.reset();
    }
    FrameEnd(const FrameEnd&) = delete;
    FrameEnd& operator=(const FrameEnd&) = delete;

    bool awaitsRanges = false; ///< true: the next call draws another range of the frame

private:
    FxView& view_;
};

FxViewStatistics gatherStatistics(const FxView& view)
{
    const fx::render::FrameStatistics frame = fx::api::withLowerLayers(view);
    FxViewStatistics statistics{};
    statistics.blobs = frame.blobs;
    statistics.blobsCulled = frame.blobsCulled;
    statistics.blobsNonFinite = frame.blobsNonFinite;
    statistics.passes = frame.passes;
    statistics.drawCalls = frame.drawCalls;
    statistics.programsCompiled = frame.programsCompiled;
    statistics.glCalls = frame.glCalls;
    statistics.textureBytes = frame.textureBytes;
    statistics.coveredPixels = frame.coveredPixels;
    statistics.shadedFragments = frame.shadedFragments;
    std::copy_n(frame.overflow, 3, statistics.overflow);
    statistics.allocations = view.allocations;
    statistics.estimatedFragments = frame.estimatedFragments;
    statistics.layerScale = 1.0f / float(frame.layerDivisor);
    statistics.keptLists = frame.keptLists ? 1 : 0;
    statistics.uploadedBytes = frame.uploadedBytes;
    statistics.sortedParticles = frame.sortedElements;
    statistics.unsharedBytes = frame.unsharedBytes;
    statistics.sharedBytes = frame.sharedBytes;
    statistics.blobsThinned = frame.blobsThinned;
    std::copy_n(frame.lodGroups, 4, statistics.lodGroups);
    statistics.impostors = frame.impostors;
    statistics.impostorsTaken = frame.impostorsTaken;
    statistics.gpuParticles = uint32_t(frame.gpuParticles);
    statistics.particlesThinned = frame.particlesThinned;
    statistics.keptRowBytes = frame.keptRowBytes;
    statistics.sharedRowBytes = frame.sharedRowBytes;
    statistics.sprites = frame.sprites;
    statistics.meshes = frame.meshes;
    statistics.ribbonPieces = frame.ribbonPieces;
    statistics.listedBlobs = frame.listedBalls;
    statistics.spilledBlobs = frame.spilledBalls;
    statistics.spilledFragments = frame.spilledCards;
    statistics.composition = uint32_t(frame.composition);
    statistics.compositionSize = frame.compositionSize;
    statistics.blocks = frame.blocks;
    statistics.blockInstances = frame.blockInstances;
    statistics.blockParticles = frame.blockParticles;
    statistics.blockParticlesRefused = frame.blockParticlesRefused;
    statistics.blockImpostors = frame.blockImpostors;
    statistics.blockTilesDrawn = frame.blockTilesDrawn;
    return statistics;
}

/// Whether a frame draws nothing and needs no look at its camera. Every frame of a scene at rest comes here.
bool sleepsThrough(const FxView& view, const FxFrameDef* frame)
{
    return view.sleeps && !view.prepared && frame && view.sleptFrame.rangePart == FX_RANGE_ONLY &&
           view.scene->scene.showsNothing() && frame->structSize == sizeof view.sleptFrame &&
           std::memcmp(frame, &view.sleptFrame, sizeof view.sleptFrame) == 0;
}

/// Whether checkGl() has something to find out. Every frame of a scene at rest comes here.
inline bool mayBeLost(const FxView& view)
{
    const fx::render::GlDevice& device = *view.context->device;
    return device.isLost() || (device.limits().reportsReset && !view.prepared);
}

/// GlLost if the context is lost. GL is asked once in a frame, also in one that draws nothing.
Status checkGl(const FxView& view)
{
    return mayBeLost(view) ? view.context->device->pollLoss() : Status();
}

void showMoment(const FxView& view, const fx::scene::Presentation& shown, fx::render::FrameRequest& io)
{
    io.interpolation = shown.interpolation;
    io.time = shown.time;
    io.instances = fx::api::instanceNames(view);
}

Status readFrame(const FxView& view, const FxFrameDef* frame, FxFrameDef& outKnown,
                 fx::render::FrameRequest& outRequest)
{
    if (Status status = fx::api::readStruct(frame, "frame", fxDefaultFrameDef(), outKnown); !status)
        return status;
    return fx::api::convertFrame(view.context->world, outKnown, outRequest);
}

/// Whether the frame follows the range that was drawn last, if it says so.
Status checkSequence(const FxView& view, const FxFrameDef& known)
{
    if (known.rangePart != FX_RANGE_NEXT && known.rangePart != FX_RANGE_LAST)
        return {};
    if (!view.prepared || !view.rangeEnd)
        return fx::api::invalid("frame.rangePart is FX_RANGE_NEXT or FX_RANGE_LAST, but no frame was begun, "
                                "or another call of the "
                                "view has ended it: begin with FX_RANGE_FIRST");
    if (!view.prepared->isSameAs(known))
        return fx::api::invalid(
            "frame.rangePart is FX_RANGE_NEXT or FX_RANGE_LAST, but the camera, the "
            "size, resetHistory or visibilityMask differ from the range before: give the same ones");
    if (known.rangeFar > *view.rangeEnd)
        return fx::api::invalid("frame.rangeFar is " + std::to_string(known.rangeFar) +
                                ", but the range before ends at " + std::to_string(*view.rangeEnd) +
                                ": draw ranges that do not overlap, the farthest first");
    return {};
}

Status readEye(const FxView& view, const char* eye, const FxFrameDef* frame, FxFrameDef& outKnown,
               fx::render::FrameRequest& outRequest)
{
    Status status = readFrame(view, frame, outKnown, outRequest);
    if (status && outKnown.rangePart != FX_RANGE_ONLY)
        status = fx::api::invalid("frame.rangePart is not FX_RANGE_ONLY: draw each eye by a view of its own");
    return status ? status : Status(status.code(), std::string(eye) + ": " + std::string(status.message()));
}

/// The overlays of both eyes follow each other in view.overlay.
void overlayEyes(FxView& view, fx::render::FrameRequest& ioFirst, fx::render::FrameRequest& ioSecond)
{
    view.scene->scene.copyMarks(view.marks);
    std::pmr::vector<fx::render::OverlayBox> second(view.overlay.get_allocator());
    fx::api::makeOverlay(view.marks, ioFirst.camera.origin, view.overlay);
    fx::api::makeOverlay(view.marks, ioSecond.camera.origin, second);
    const size_t count = view.overlay.size();
    view.overlay.insert(view.overlay.end(), second.begin(), second.end());
    ioFirst.overlay = std::span(view.overlay).first(count);
    ioSecond.overlay = std::span(view.overlay).subspan(count);
}

Status renderEyes(FxView& view, const FxFrameDef* first, const FxFrameDef* second)
{
    FxFrameDef known, knownSecond;
    fx::render::FrameRequest request, requestSecond;
    if (Status status = readEye(view, "first", first, known, request); !status)
        return status;
    if (Status status = readEye(view, "second", second, knownSecond, requestSecond); !status)
        return status;
    const uint64_t before = view.context->memory.allocationCount();
    view.sleeps = false;
    const FrameEnd end(view);
    const fx::scene::Presentation& shown = fx::api::showFrame(view, known).shown();
    showMoment(view, shown, request);
    showMoment(view, shown, requestSecond);
    for (const FxFrameDef* eye : {&known, &knownSecond})
        if (Status status = fx::api::checkLayers(view, *eye); !status)
            return status;
    const fx::render::FrameRequest lower = request, lowerSecond = requestSecond; // without an overlay
    if (view.renderer.settings().overlay)
        overlayEyes(view, request, requestSecond);
    Status status;
    for (const fx::api::LayerDraw& layer : fx::api::layersToDraw(view)) {
        status = layer.isUppermost ? layer.renderer->renderStereo(layer.snapshots, request, requestSecond)
                                   : layer.renderer->renderStereo(layer.snapshots, lower, lowerSecond);
        if (!status)
            break;
        fx::api::noteDrawn(layer, view);
    }
    view.allocations = view.context->memory.allocationCount() - before;
    return status;
}

void noteComputing(FxView& view)
{
    const bool canCompute =
        view.renderer.canComputeParticles() &&
        std::all_of(view.lowerLayers.begin(), view.lowerLayers.end(),
                    [](const fx::api::LayerRenderer& lower) { return lower.renderer.canComputeParticles(); });
    view.gpuSeen = canCompute ? FxScene::kRemembered : 0u;
    view.scene->gpuSeen.store(view.gpuSeen, std::memory_order_relaxed);
}

Status renderFrame(FxView& view, const FxFrameDef* frame)
{
    FxFrameDef known;
    fx::render::FrameRequest request;
    if (Status status = readFrame(view, frame, known, request); !status)
        return status;
    if (Status status = checkSequence(view, known); !status)
        return status;
    if (view.rangeEnd && !request.range.isContinued) { // the frame before was not completed
        view.prepared.reset();
        view.rangeEnd.reset();
    }
    if (known.rangePart == FX_RANGE_ONLY && !view.prepared && view.sleeps &&
        !request.targets.useFramebuffer && view.scene->scene.showsNothing())
    {
        // only the camera is another; into a framebuffer the picture has to be carried over
        view.sleptFrame = known;
        Status status = fx::render::ViewRenderer::check(request);
        view.sleeps = status.ok();
        return status;
    }
    const uint64_t before = view.context->memory.allocationCount();
    FrameEnd end(view);
    if (!view.prepared || !view.prepared->isSameAs(known))
        fx::api::showFrame(view, known);
    const fx::scene::Presentation& shown = view.prepared->shown();
    showMoment(view, shown, request);
    if (Status status = fx::api::checkLayers(view, known); !status)
        return status;
    const fx::render::FrameRequest lower = request; // without an overlay
    const bool marks = view.renderer.settings().overlay;
    if (marks && request.range.isLast) {
        view.scene->scene.copyMarks(view.marks);
        fx::api::makeOverlay(view.marks, request.camera.origin, view.overlay);
        request.overlay = view.overlay;
    }
    Status status;
    for (const fx::api::LayerDraw& layer : fx::api::layersToDraw(view)) {
        status = layer.renderer->render(layer.snapshots, layer.isUppermost ? request : lower);
        if (!status)
            break;
        fx::api::noteDrawn(layer, view);
    }
    view.allocations = view.context->memory.allocationCount() - before + view.prepared->allocations;
    view.sleeps = status.ok() && !marks && view.sortLayers.layers().empty() && view.renderer.isAsleep() &&
                  !view.quality.isControlled();
    view.sleptFrame = known;
    end.awaitsRanges = status.ok() && !request.range.isLast;
    if (end.awaitsRanges)
        view.rangeEnd = known.rangeNear;
    return status;
}

} // namespace

void fx::api::destroyView(FxView* view)
{
    FxContext* context = view->context;
    std::erase(context->views, view);
    std::pmr::polymorphic_allocator<>(&context->memory).delete_object(view);
}

FxResult fxCreateView(FxContext* context, FxScene* scene, const FxViewSettings* settings, FxView** outView)
{
    return fx::api::guarded("fxCreateView", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkCreate(context, scene, outView); !status)
            return status;
        const FxViewSettings defaults = fxDefaultViewSettings();
        fx::render::ViewSettings known;
        fx::quality::BudgetOptions budget;
        if (Status status = readSettings(*context, settings ? settings : &defaults, known, budget); !status)
            return status;
        const fx::api::SingleCaller::Scope gl(context->gl, fx::api::kGlThreadRule);
        if (!gl.status())
            return gl.status();
        const fx::api::SharedCaller::Scope tables(context->tables);
        if (!tables.status())
            return tables.status();
        const size_t count = context->views.size() + 1;
        if (context->views.capacity() < count)
            context->views.reserve(std::max(count, 2 * context->views.capacity()));
        fx::quality::ViewQuality quality;
        if (Status status = quality.setOptions(budget); !status)
            return status;
        FxView* view = std::pmr::polymorphic_allocator<>(&context->memory).new_object<FxView>(scene, known);
        view->quality = std::move(quality);
        context->views.push_back(view);
        *outView = view;
        return {};
    });
}

FxResult fxDestroyView(FxView* view)
{
    return fx::api::guarded("fxDestroyView", fx::api::logOf(view), [&]() -> Status {
        if (!view)
            return {};
        const fx::api::SingleCaller::Scope gl(view->context->gl, fx::api::kGlThreadRule);
        if (!gl.status())
            return gl.status();
        const fx::api::SharedCaller::Scope tables(view->context->tables);
        if (!tables.status())
            return tables.status();
        fx::api::destroyView(view);
        return {};
    });
}

FxResult fxView_SetSettings(FxView* view, const FxViewSettings* settings)
{
    return fx::api::insideView("fxView_SetSettings", view, [&]() -> Status {
        fx::render::ViewSettings known;
        fx::quality::BudgetOptions budget;
        if (Status status = readSettings(*view->context, settings, known, budget); !status)
            return status;
        if (Status status = view->quality.setOptions(budget); !status)
            return status;
        view->setSettings(known);
        return {};
    });
}

FxResult fxView_Render(FxView* view, const FxFrameDef* frame)
{
    return fx::api::insideView("fxView_Render", view, [&]() -> Status {
        if (mayBeLost(*view))
            if (Status status = checkGl(*view); !status)
                return status;
        if (sleepsThrough(*view, frame)) {
            view->scene->gpuSeen.store(view->gpuSeen, std::memory_order_relaxed);
            return {};
        }
        Status status = renderFrame(*view, frame);
        noteComputing(*view);
        return view->context->device->orLost(std::move(status));
    });
}

FxResult fxView_RenderStereo(FxView* view, const FxFrameDef* first, const FxFrameDef* second)
{
    return fx::api::insideView("fxView_RenderStereo", view, [&]() -> Status {
        if (Status status = checkGl(*view); !status)
            return status;
        Status status = renderEyes(*view, first, second);
        noteComputing(*view);
        return view->context->device->orLost(std::move(status));
    });
}

FxResult fxView_SetScene(FxView* view, FxScene* scene)
{
    return fx::api::insideView("fxView_SetScene", view, [&]() -> Status {
        if (!scene)
            return fx::api::invalid("scene is null");
        if (scene->context != view->context)
            return fx::api::invalid("scene belongs to another context");
        if (scene != view->scene)
            view->setScene(scene);
        return {};
    });
}

FxResult fxView_GetStatistics(FxView* view, FxViewStatistics* ioStatistics)
{
    return fx::api::insideView("fxView_GetStatistics", view, [&]() -> Status {
        return fx::api::writeStruct(gatherStatistics(*view), ioStatistics, "ioStatistics");
    });
}

FxResult fxView_GetLayerTextures(FxView* view, FxLayerTextures* ioTextures)
{
    return fx::api::insideView("fxView_GetLayerTextures", view, [&]() -> Status {
        const fx::render::LayerTextures layers = view->renderer.layers();
        FxLayerTextures textures{};
        textures.fire = layers.fire;
        textures.smoke = layers.smoke;
        textures.dust = layers.dust;
        textures.depth = layers.depth;
        textures.opticalDepth = layers.opticalDepth;
        textures.media = layers.media;
        return fx::api::writeStruct(textures, ioTextures, "ioTextures");
    });
}

FxResult fxView_GetOutputTextures(FxView* view, FxOutputTextures* ioTextures)
{
    return fx::api::insideView("fxView_GetOutputTextures", view, [&]() -> Status {
        FxOutputTextures textures{};
        uint32_t* const names[] = {&textures.instanceId, &textures.motion, &textures.firstDepth,
                                   &textures.meanDepth, &textures.opticalDepth};
        static_assert(std::size(names) == fx::render::view_output::kCount);
        for (size_t i = 0; i < std::size(names); ++i)
            *names[i] = view->renderer.output(i);
        return fx::api::writeStruct(textures, ioTextures, "ioTextures");
    });
}

FxResult fxView_GetPassCount(FxView* view, uint32_t* outCount)
{
    return fx::api::insideView("fxView_GetPassCount", view, [&]() -> Status {
        if (!outCount)
            return fx::api::invalid("outCount is null");
        *outCount = uint32_t(view->renderer.executedPasses().size());
        return {};
    });
}

FxResult fxView_GetPassName(FxView* view, uint32_t index, char* buffer, size_t capacity)
{
    return fx::api::insideView("fxView_GetPassName", view, [&]() -> Status {
        if (!buffer || capacity == 0)
            return fx::api::invalid("buffer is null or has no room");
        const auto passes = view->renderer.executedPasses();
        if (index >= passes.size())
            return fx::api::invalid("the last frame executed fewer passes than index");
        fx::api::copyText(passes[index], buffer, capacity);
        return {};
    });
}

const char* fxGetTouchedGlState(uint32_t index)
{
    const std::span<const char* const> names = fx::render::touchedState();
    return index < names.size() ? names[index] : nullptr;
}
