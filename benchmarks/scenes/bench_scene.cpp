#include "benchmarks/scenes/bench_scene.h"

#include "fxsdk/api/view_object.h"
#include "fxsdk/cli/scene/api_status.h"
#include "rendering/gl/gl_read_texture.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>

namespace fx::cli {

base::Result<std::unique_ptr<BenchScene>> BenchScene::create(const Options& options)
{
    std::unique_ptr<BenchScene> scene(new BenchScene);
    if (base::Status status = scene->start(options); !status)
        return status;
    return scene;
}

BenchScene::~BenchScene()
{
    fxDestroyView(view_);
    fxDestroyScene(scene_);
    fxDestroyContext(context_);
}

base::Status BenchScene::start(const Options& options)
{
    options_ = options;
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.workers = 1;
    if (options.gl) {
        auto context = render::createEglContext({});
        if (!context.ok())
            return context.status();
        gl_ = std::move(*context);
        const render::GlLoader loader = gl_->loader();
        contextDef.gl = {loader.user, loader.getProcAddress};
    }
    if (base::Status status = toStatus(fxCreateContext(&contextDef, &context_)); !status)
        return status;
    FxSceneDef sceneDef = fxDefaultSceneDef();
    sceneDef.maxInstances = 1 << 20;
    sceneDef.disableCulling = options.culling ? 0 : 1;
    if (base::Status status = toStatus(fxCreateScene(context_, &sceneDef, &scene_)); !status)
        return status;
    frame_ = fxDefaultFrameDef();
    return options.gl ? startGl() : base::Status();
}

base::Status BenchScene::startGl()
{
    auto device = render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource());
    if (!device.ok())
        return device.status();
    device_ = std::move(*device);
    auto color = render::GlTexture::create(*device_, options_.pixels, options_.pixels, GL_RGBA32F, "picture");
    if (!color.ok())
        return color.status();
    color_ = std::move(*color);
    if (options_.warmsUp)
        if (base::Status status = toStatus(fxContext_WarmUp(context_)); !status)
            return status;
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0; // glare of the host's picture is not a cost of effects
    frame_.colorTexture = color_.name();
    frame_.width = frame_.height = options_.pixels;
    return toStatus(fxCreateView(context_, scene_, &settings, &view_));
}

base::Result<FxPresetId> BenchScene::load(const std::string& preset)
{
    FxPresetId id = {};
    if (base::Status status =
            toStatus(fxLoadPresetText(context_, preset.data(), preset.size(), "benchmark", &id));
        !status)
        return status;
    return id;
}

base::Result<FxPresetId> BenchScene::loadLibrary(const char* name)
{
    FxPresetId id = {};
    if (base::Status status = toStatus(fxLoadPresetLibrary(context_, name, &id)); !status)
        return status;
    return id;
}

base::Status BenchScene::add(FxPresetId preset, double x, double z, uint64_t seed, int64_t startTick)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = preset;
    def.position[0] = x;
    def.position[2] = z;
    def.seed = seed;
    def.startTick = startTick;
    FxInstanceId id = {};
    base::Status status = toStatus(fxScene_CreateInstance(scene_, &def, &id));
    if (status.ok())
        instances_.push_back(id);
    return status;
}

base::Status BenchScene::look(double radians)
{
    FxFocus focus = fxDefaultFocus();
    focus.origin[1] = frame_.origin[1] = 2.0;
    const float c = float(std::cos(radians)), s = float(std::sin(radians));
    focus.view[0] = focus.view[10] = c; // turned about +Y
    focus.view[8] = s;
    focus.view[2] = -s;
    const float nearPlane = 0.1f, farPlane = 2000.0f, cotangent = 2.7475f;
    focus.projection[0] = focus.projection[5] = cotangent;
    focus.projection[10] = (farPlane + nearPlane) / (nearPlane - farPlane);
    focus.projection[11] = -1.0f;
    focus.projection[14] = 2.0f * farPlane * nearPlane / (nearPlane - farPlane);
    std::copy_n(focus.view, 16, frame_.view);
    std::copy_n(focus.projection, 16, frame_.projection);
    return toStatus(fxScene_SetFocus(scene_, &focus, 1));
}

void BenchScene::moveTo(double x, double y, double z)
{
    frame_.origin[0] = x;
    frame_.origin[1] = y;
    frame_.origin[2] = z;
}

base::Status BenchScene::setView(const FxViewSettings& settings)
{
    return toStatus(fxView_SetSettings(view_, &settings));
}

void BenchScene::holdDetail(bool isHeld)
{
    if (view_)
        view_->renderer.settings().lod.hold = isHeld;
}

void BenchScene::clear()
{
    const float black[4] = {0, 0, 0, 0};
    device_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, black);
}

base::Status BenchScene::update()
{
    return toStatus(fxScene_Update(scene_, 1.0 / 60.0));
}

base::Status BenchScene::draw()
{
    if (!view_)
        return {};
    return toStatus(fxView_Render(view_, &frame_));
}

void BenchScene::clearPicture()
{
    constexpr float kGray[4] = {0.5f, 0.5f, 0.5f, 1.0f};
    if (device_)
        device_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, kGray);
}

std::vector<float> BenchScene::picture()
{
    if (!device_)
        return {};
    return render::readTexture(*device_, color_.name(), options_.pixels, options_.pixels, 4);
}

uint64_t BenchScene::bytesInUse() const
{
    FxMemoryStats stats = {};
    stats.structSize = sizeof stats;
    fxContext_GetMemoryStats(context_, &stats);
    return stats.bytesInUse;
}

FxFrameStats BenchScene::frameStats() const
{
    FxFrameStats stats = {};
    stats.structSize = sizeof stats;
    fxScene_GetFrameStats(scene_, &stats);
    return stats;
}

void BenchScene::remove(size_t index)
{
    fxScene_DestroyInstance(scene_, instances_[index]);
    instances_.erase(instances_.begin() + std::ptrdiff_t(index));
}

void BenchScene::finish()
{
    if (device_)
        device_->gl.Finish();
}

FxSceneStatistics BenchScene::statistics() const
{
    FxSceneStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    fxScene_GetStatistics(scene_, &statistics);
    return statistics;
}

FxViewStatistics BenchScene::viewStatistics() const
{
    FxViewStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    if (view_)
        fxView_GetStatistics(view_, &statistics);
    return statistics;
}

} // namespace fx::cli
