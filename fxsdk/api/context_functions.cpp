// The functions of fx_context.h.
#include "foundation/assets/volume_sequence.h"
#include "fxsdk/api/check.h"
#include "fxsdk/api/context.h"
#include "fxsdk/api/gl_loader.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/preset_load_object.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/api/view_object.h"
#include "rendering/view/view_renderer.h"
#include "simulation/particles/particle_program.h"

#include <memory>
#include <string>
#include <vector>

namespace {

using fx::base::Code;
using fx::base::Result;
using fx::base::Status;
using fx::render::GlDevice;

constexpr uint32_t kMaxWorkers = 256;

Status checkDef(const FxContextDef& def)
{
    if (def.headerVersion / 65536 != FX_VERSION_MAJOR)
        return {Code::Version, "def.headerVersion is of another major version than the library"};
    fx::api::Checks check;
    check.that(!def.allocator.allocate == !def.allocator.release,
               "def.allocator has one function of two; set both or none");
    check.that(!def.assets.open == !def.assets.close, "def.assets has one function of two; set both or none");
    check.range(def.workers, 0u, kMaxWorkers, "def.workers");
    check.range(def.flags, 0u, uint32_t(FX_CONTEXT_PLACEHOLDERS), "def.flags");
    return check.status() ? fx::api::HostWorld::check(def) : check.status();
}

/// @param name of the argument that has the loader, in messages
Result<std::unique_ptr<GlDevice>> makeDevice(FxContext& context, const FxGlLoader& gl, const char* name)
{
    const fx::render::GlLoader loader{gl.user, gl.getProcAddress};
    if (loader.getProcAddress == &fxGetGlProcAddress && !fx::api::isGlContextCurrent())
        return Status(Code::GlUnsupported,
                      "no OpenGL context is current on this thread: make one current before (eglMakeCurrent, "
                      "glXMakeCurrent, SDL_GL_MakeCurrent, glfwMakeContextCurrent), or set " +
                          std::string(name) + " to the function of your window library");
    return GlDevice::create(loader, &context.memory);
}

void logRenderer(const FxContext& context)
{
    fx::api::logMessage(context, FX_LOG_INFO,
                        ("OpenGL renderer: " + context.device->limits().renderer).c_str());
}

Status connectGl(FxContext& context)
{
    Result<std::unique_ptr<GlDevice>> device = makeDevice(context, context.def.gl, "def.gl.getProcAddress");
    if (!device)
        return device.status();
    context.device = std::move(*device);
    logRenderer(context);
    return {};
}

/// Calls `body`, which returns a Status, on the GL thread of a context that has OpenGL.
template <class Body>
FxResult onGlThread(const char* function, FxContext* context, Body&& body)
{
    return fx::api::guarded(function, fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        if (!context->device)
            return {Code::NoGl, fx::api::kWithoutGl};
        const fx::api::SingleCaller::Scope scope(context->gl, fx::api::kGlThreadRule);
        return scope ? body() : scope.status();
    });
}

/// Replaces the device and the renderers of all views. Strong guarantee.
Status restoreGl(FxContext& context, const FxGlLoader& gl)
{
    Result<std::unique_ptr<GlDevice>> device = makeDevice(context, gl, "gl.getProcAddress");
    if (!device)
        return device.status();
    std::pmr::vector<fx::render::ViewRenderer> renderers(&context.memory);
    renderers.reserve(context.views.size());
    for (size_t i = 0; i < context.views.size(); ++i)
        renderers.push_back(FxView::makeRenderer(context, **device));
    context.device->reportLoss(); // its objects are forgotten, also those of frames that end below
    for (size_t i = 0; i < renderers.size(); ++i)
        context.views[i]->setRenderer(std::move(renderers[i]));
    renderers.clear();
    context.device = std::move(*device);
    logRenderer(context);
    return {};
}

/// Of all emitters of the presets that are loaded.
std::vector<std::shared_ptr<const fx::base::GpuParticleProgram>> gpuPrograms(FxContext& context)
{
    std::vector<std::shared_ptr<const fx::base::GpuParticleProgram>> programs;
    const fx::api::SharedCaller::Scope tables(context.tables);
    if (!tables.status())
        return programs;
    context.presets.forEach([&](uint32_t, const fx::api::HeldPreset& preset) {
        for (const auto& solver : preset.effect->solvers)
            if (auto program = solver->gpuProgram())
                programs.push_back(std::move(program));
    });
    return programs;
}

void destroy(FxContext* context)
{
    while (!context->views.empty())
        fx::api::destroyView(context->views.back());
    while (!context->scenes.empty())
        fx::api::destroyScene(context->scenes.back());
    for (FxPresetLoad* load : context->loads)
        fx::api::freePresetLoad(load);
    context->loads.clear();
    fx::base::HostMemory memory(fx::api::toHooks(context->def.allocator));
    context->~FxContext();
    memory.deallocate(context, sizeof(FxContext), alignof(FxContext));
}

/// Whether no load of the context runs, or waits for another one.
Status checkLoads(FxContext& context)
{
    const fx::api::SharedCaller::Scope tables(context.tables);
    if (!tables.status())
        return tables.status();
    for (FxPresetLoad* load : context.loads) {
        const std::scoped_lock lock(load->mutex);
        if (load->state == FX_PRESET_LOAD_RUNNING)
            return {Code::ReEntrant,
                    "fxPresetLoad_Run is in progress: call fxPresetLoad_Cancel, and wait until the "
                    "thread of the load has returned from it"};
    }
    return {};
}

/// Shuts a context for good, with all that is in it, so that no callback of its destruction gets into it.
/// After a failure it is as open as before.
Status close(FxContext& context)
{
    if (context.device && !context.gl.thread.isCaller())
        return {Code::WrongThread, fx::api::kGlThreadRule};
    if (Status status = checkLoads(context); !status) // it would go on in a context that is freed
        return status;
    fx::api::SharedCaller::Scope loading(context.loading);
    if (!loading.status())
        return loading.status();
    fx::api::SharedCaller::Scope tables(context.tables);
    if (!tables.status())
        return tables.status();
    bool isInside = context.gl.busy();
    for (const FxScene* scene : context.scenes)
        isInside = isInside || scene->caller.busy();
    if (isInside)
        return {Code::ReEntrant, "a callback must not destroy the context that is calling it"};
    loading.close();
    tables.close();
    context.gl.close();
    for (FxScene* scene : context.scenes)
        scene->caller.close();
    return {};
}

/// The counters of all volume sequences of the presets.
void gatherSequences(const fx::base::AssetTable& assets, FxMemoryStats& io)
{
    for (fx::base::AssetId id = 1; id <= assets.size(); ++id)
        if (const auto sequence = assets.sequence(id)) {
            const fx::base::VolumeSequence::Counts counts = sequence->counts();
            io.sequenceBytes += counts.bytes;
            io.sequenceFramesRead += counts.reads;
            io.sequenceFramesLate += counts.late;
            io.sequenceFramesFailed += counts.failures;
        }
}

} // namespace

namespace fx::api {

Status createContext(const FxContextDef& def, const TechniqueLists& techniques, FxContext** outContext)
{
    base::HostMemory memory(toHooks(def.allocator));
    void* place = memory.allocate(sizeof(FxContext), alignof(FxContext));
    FxContext* context = nullptr;
    try {
        context = new (place) FxContext(def, techniques);
        if (def.gl.getProcAddress)
            if (Status status = connectGl(*context); !status) {
                destroy(context);
                return status;
            }
    } catch (...) {
        if (context)
            destroy(context);
        else
            memory.deallocate(place, sizeof(FxContext), alignof(FxContext));
        throw;
    }
    *outContext = context;
    return {};
}

} // namespace fx::api

FxResult fxCreateContext(const FxContextDef* def, FxContext** outContext)
{
    FxContextDef known;
    return fx::api::guarded("fxCreateContext", nullptr, [&]() -> Status {
        if (!outContext)
            return fx::api::invalid("outContext is null");
        if (Status status = fx::api::readStruct(def, "def", fxDefaultContextDef(), known); !status)
            return status;
        if (Status status = checkDef(known); !status)
            return status;
        return fx::api::createContext(known, {}, outContext);
    });
}

FxResult fxDestroyContext(FxContext* context)
{
    return fx::api::guarded("fxDestroyContext", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return {};
        if (Status status = close(*context); !status)
            return status;
        destroy(context);
        return {};
    });
}

FxResult fxContext_WarmUp(FxContext* context)
{
    return onGlThread("fxContext_WarmUp", context, [&]() -> Status {
        if (context->device->isLost())
            return context->device->orLost({});
        fx::render::ViewRenderer renderer(context->device.get(), &context->schema, &context->memory,
                                          context->techniques.draws);
        for (const FxView* view : context->views)
            renderer.settings().outputs |= view->renderer.settings().outputs;
        if (Status status = renderer.warmUp(); !status) // programs belong to the device and stay
            return context->device->orLost(std::move(status));
        for (const auto& program : gpuPrograms(*context))
            renderer.warmUp(*program);
        return context->device->orLost({});
    });
}

FxResult fxContext_ReportGlLoss(FxContext* context)
{
    return onGlThread("fxContext_ReportGlLoss", context, [&]() -> Status {
        context->device->reportLoss();
        return {};
    });
}

FxResult fxContext_RestoreGl(FxContext* context, const FxGlLoader* gl)
{
    return onGlThread("fxContext_RestoreGl", context, [&]() -> Status {
        if (gl && !gl->getProcAddress)
            return fx::api::invalid("gl.getProcAddress is null: set it, or give null for gl");
        return restoreGl(*context, gl ? *gl : context->def.gl);
    });
}

FxResult fxContext_AdoptGlThread(FxContext* context)
{
    return fx::api::guarded("fxContext_AdoptGlThread", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        if (!context->device)
            return {Code::NoGl, fx::api::kWithoutGl};
        if (context->gl.busy())
            return {Code::ReEntrant, "a call is inside a view; adopt the thread when that has returned"};
        context->gl.thread.adopt();
        return {};
    });
}

FxResult fxContext_GetMemoryStats(FxContext* context, FxMemoryStats* ioStats)
{
    return fx::api::guarded("fxContext_GetMemoryStats", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        const fx::api::SharedCaller::Scope scope(context->tables);
        if (!scope.status())
            return scope.status();
        FxMemoryStats stats{};
        stats.presets = context->presets.count();
        stats.scenes = uint32_t(context->scenes.size());
        stats.views = uint32_t(context->views.size());
        stats.bytesInUse = context->memory.bytesInUse();
        stats.allocationCount = context->memory.allocationCount();
        for (const FxScene* const scene : context->scenes)
            stats.bytesReserved += scene->scene.reservedBytes();
        gatherSequences(context->assets, stats);
        return fx::api::writeStruct(stats, ioStats, "ioStats");
    });
}
