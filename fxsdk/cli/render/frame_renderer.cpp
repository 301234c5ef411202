#include "fxsdk/cli/render/frame_renderer.h"

#include "fxsdk/cli/render/depth_contacts.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/scene/view_settings.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/techniques/draw_techniques.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory_resource>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

render::CameraView cameraAt(const scene_file::CameraPath& path, double time, float aspect)
{
    render::CameraView camera;
    camera.origin = path.at(time).position;
    camera.view = path.viewRotation(time);
    camera.projection = path.projection(aspect);
    return camera;
}

} // namespace

base::Result<std::unique_ptr<FrameRenderer>> FrameRenderer::create(const scene_file::SceneFile& file,
                                                                   const FrameRendererOptions& options)
{
    std::unique_ptr<FrameRenderer> renderer(new FrameRenderer(file));
    if (base::Status status = renderer->start(options); !status)
        return status;
    return renderer;
}

FrameRenderer::~FrameRenderer()
{
    fxDestroyView(view_);
    effects_.reset();
    stage_.reset();
}

base::Status FrameRenderer::start(const FrameRendererOptions& options)
{
    options_ = options;
    auto glContext = render::createEglContext({});
    if (!glContext.ok())
        return glContext.status();
    glContext_ = std::move(*glContext);
    const render::GlLoader loader = glContext_->loader();
    auto device = render::GlDevice::create(loader, std::pmr::get_default_resource());
    if (!device.ok())
        return device.status();
    device_ = std::move(*device);

    options_.scene.gl = {loader.user, loader.getProcAddress};
    auto effects = EffectScene::create(file_, options_.scene);
    if (!effects.ok())
        return effects.status();
    effects_ = std::move(*effects);
    if (options_.warmsUp)
        if (base::Status status = toStatus(fxContext_WarmUp(effects_->context())); !status)
            return status;

    const bool isAsked = options_.scene.compute == "gpu" || options_.scene.compute == "auto";
    staysOnGpu_ = (isAsked && gpuObstacleOf(file_).empty()) ||
                  (options_.scene.compute != "cpu" && showsDepthContacts(file_));
    stage_ = std::make_unique<render::StageRenderer>(device_.get());
    if (base::Status status = stage_->setMesh(file_.mesh); !status)
        return status;
    if (base::Status status = stage_->setBackground(file_.background); !status)
        return status;
    const FxViewSettings settings = toApi(options_.settings);
    if (base::Status status =
            toStatus(fxCreateView(effects_->context(), effects_->scene(), &settings, &view_));
        !status)
        return status;
    std::vector<FxLight> lights;
    for (const render::SceneLight& light : shownLights())
        lights.push_back(toApi(light));
    return toStatus(fxView_SetLights(view_, lights.data(), uint32_t(lights.size())));
}

/// As many as a view takes.
std::span<const render::SceneLight> FrameRenderer::shownLights() const
{
    return std::span(file_.lights).first(std::min(file_.lights.size(), size_t(FX_MOST_LIGHTS)));
}

/// Particles go to the GPU with the first picture, and come back when there was none for 240 steps: where
/// pictures are further apart, others are drawn between them.
base::Status FrameRenderer::keepOnGpu(base::Ticks tick)
{
    if (!staysOnGpu_)
        return {};
    const base::Ticks apart = 100 * (base::kTicksPerSecond / options_.scene.stepsPerSecond);
    const float aspect = float(options_.width) / float(options_.height);
    for (base::Ticks between = lastTick_ < 0 ? 0 : lastTick_ + apart; between < tick; between += apart) {
        const render::CameraView camera = cameraAt(file_.camera, base::toSeconds(between), aspect);
        base::Status status = effects_->showMoment(between);
        if (status.ok())
            status = drawStage(camera);
        if (status.ok())
            status = drawEffects(camera, 0.0);
        if (!status)
            return status;
    }
    return {};
}

/// With the overlay, what the camera does not see is hidden.
base::Status FrameRenderer::lookThrough(const render::CameraView& camera)
{
    if (!options_.settings.overlay)
        return {};
    FxFocus focus = fxDefaultFocus();
    focus.height = float(options_.height);
    std::copy_n(glm::value_ptr(camera.origin), 3, focus.origin);
    std::copy_n(glm::value_ptr(camera.view), 16, focus.view);
    std::copy_n(glm::value_ptr(camera.projection), 16, focus.projection);
    return toStatus(fxScene_SetFocus(effects_->scene(), &focus, 1));
}

base::Status FrameRenderer::render(base::Ticks tick)
{
    Clock::time_point start = Clock::now();
    const float aspect = float(options_.width) / float(options_.height);
    const render::CameraView camera = cameraAt(file_.camera, base::toSeconds(tick), aspect);
    if (base::Status status = lookThrough(camera); !status)
        return status;
    if (base::Status status = keepOnGpu(tick); !status)
        return status;
    if (base::Status status = effects_->showMoment(tick); !status)
        return status;
    if (base::Status status = effects_->waitForFrames(); !status)
        return status;
    counters_.millisecondsSimulate = millisecondsSince(start);

    start = Clock::now();
    if (base::Status status = drawStage(camera); !status)
        return status;
    if (options_.settings.layerOutputs)
        background_ = readPicture(stage_->colorTexture(), 4);
    const double first = options_.settings.outputs != 0 ? options_.frameSeconds : 0.0;
    const double passed =
        lastTick_ < 0 || options_.everyFrameIsCut ? first : base::toSeconds(tick - lastTick_);
    if (base::Status status = drawEffects(camera, passed); !status)
        return status;
    device_->gl.Finish();
    counters_.millisecondsRender = millisecondsSince(start);
    lastTick_ = tick;
    return count();
}

/// Surfaces are lit by the lights of the effects, and media darken them.
base::Status FrameRenderer::drawStage(const render::CameraView& camera)
{
    FxFrameDef frame = frameOf(camera, 0.0);
    frame.colorTexture = frame.depthTexture = 0; // the stage has none before its first picture
    if (base::Status status = toStatus(fxView_PrepareLights(view_, &frame)); !status)
        return status;
    std::array<render::EffectLight, kMaxStageEffects> lights;
    size_t count = 0;
    if (!staysOnGpu_) { // what the GPU computes sheds no light, and a snapshot would end that
        const auto snapshot = effects_->snapshot();
        if (!snapshot.ok())
            return snapshot.status();
        count = render::effectLights(**snapshot, lights);
    }
    if (base::Status status =
            lit_.read(view_, std::span(lights).first(count), shownLights(), options_.settings.lighting);
        !status)
        return status;
    return stage_->render(camera, lit_.lighting(), options_.settings.exposureEv100, options_.width,
                          options_.height);
}

FxFrameDef FrameRenderer::frameOf(const render::CameraView& camera, double passed) const
{
    FxFrameDef frame = fxDefaultFrameDef();
    frame.resetHistory = lastTick_ < 0 || options_.everyFrameIsCut ? 1 : 0;
    for (int i = 0; i < 3; ++i)
        frame.origin[i] = camera.origin[i];
    std::copy_n(glm::value_ptr(camera.view), 16, frame.view);
    std::copy_n(glm::value_ptr(camera.projection), 16, frame.projection);
    frame.colorTexture = stage_->colorTexture();
    frame.depthTexture = stage_->depthTexture();
    frame.width = options_.width;
    frame.height = options_.height;
    frame.deltaTime = passed;
    const render::HostShadowMap map = stage_->sunShadow(camera.origin);
    frame.sunShadowTexture = map.texture;
    std::copy_n(glm::value_ptr(map.fromWorld), 16, frame.sunShadowMatrix);
    frame.sunShadowEdge = map.edge;
    return frame;
}

base::Status FrameRenderer::drawEffects(const render::CameraView& camera, double passed)
{
    const FxFrameDef frame = frameOf(camera, passed);
    return toStatus(fxView_Render(view_, &frame));
}

base::Status FrameRenderer::count()
{
    const auto scene = effects_->statistics();
    if (!scene.ok())
        return scene.status();
    counters_.scene = *scene;
    counters_.view = {};
    counters_.view.structSize = sizeof counters_.view;
    if (base::Status status = toStatus(fxView_GetStatistics(view_, &counters_.view)); !status)
        return status;
    uint32_t passes = 0;
    if (base::Status status = toStatus(fxView_GetPassCount(view_, &passes)); !status)
        return status;
    counters_.passes.clear();
    for (uint32_t i = 0; i < passes; ++i) {
        char name[64];
        if (base::Status status = toStatus(fxView_GetPassName(view_, i, name, sizeof name)); !status)
            return status;
        counters_.passes.emplace_back(name);
    }
    counters_.volumes = effects_->volumeCounts();
    return {};
}

Picture FrameRenderer::readPicture(uint32_t texture, int channels, float whenAbsent)
{
    if (texture == 0) { // no medium was drawn
        const size_t count = size_t(options_.width) * size_t(options_.height) * size_t(channels);
        return {options_.width, options_.height, channels, std::vector<float>(count, whenAbsent)};
    }
    return fromBottomUp(options_.width, options_.height, channels,
                        render::readTexture(*device_, texture, options_.width, options_.height, channels));
}

base::Result<FrameLayers> FrameRenderer::read()
{
    FrameLayers layers;
    layers.color = readPicture(stage_->colorTexture(), 4);
    if (!options_.settings.layerOutputs)
        return layers;
    FxLayerTextures textures = {};
    textures.structSize = sizeof textures;
    if (base::Status status = toStatus(fxView_GetLayerTextures(view_, &textures)); !status)
        return status;
    layers.background = background_;
    layers.media = {readPicture(textures.fire, 4), readPicture(textures.smoke, 4),
                    readPicture(textures.dust, 4)};
    layers.depth = readPicture(textures.depth, 1, std::numeric_limits<float>::infinity());
    layers.opticalDepth = readPicture(textures.opticalDepth, 1);
    if (base::Status status = readOutputs(layers.outputs); !status)
        return status;
    return layers;
}

/// Ids as numbers of the scene's instances.
Picture FrameRenderer::readInstances(uint32_t texture)
{
    const size_t count = size_t(options_.width) * size_t(options_.height);
    std::vector<float> numbers(count, 0.0f);
    if (texture != 0) {
        const std::vector<uint32_t> words =
            render::readUintTexture(*device_, texture, options_.width, options_.height, 2);
        for (size_t i = 0; i < count; ++i)
            numbers[i] = float(effects_->numberOf(words[2 * i] | uint64_t(words[2 * i + 1]) << 32));
    }
    return fromBottomUp(options_.width, options_.height, 1, std::move(numbers));
}

base::Status FrameRenderer::readOutputs(FrameLayers::Outputs& out)
{
    FxOutputTextures textures = {};
    textures.structSize = sizeof textures;
    if (base::Status status = toStatus(fxView_GetOutputTextures(view_, &textures)); !status)
        return status;
    const uint32_t asked = options_.settings.outputs;
    constexpr float kNone = std::numeric_limits<float>::infinity();
    if ((asked & FX_OUTPUT_INSTANCE_ID) != 0)
        out.instance = readInstances(textures.instanceId);
    if ((asked & FX_OUTPUT_MOTION) != 0)
        out.motion = readPicture(textures.motion, 2);
    if ((asked & FX_OUTPUT_FIRST_DEPTH) != 0)
        out.firstDepth = readPicture(textures.firstDepth, 1, kNone);
    if ((asked & FX_OUTPUT_MEAN_DEPTH) != 0)
        out.meanDepth = readPicture(textures.meanDepth, 1, kNone);
    return {};
}

} // namespace fx::cli
