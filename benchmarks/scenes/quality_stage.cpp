#include "benchmarks/scenes/quality_stage.h"

#include "benchmarks/measure/clocks.h"
#include "foundation/result/nearest_name.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/scene/view_settings.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/techniques/draw_techniques.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory_resource>

namespace fx::cli {
namespace {

double processMilliseconds()
{
    return 1e3 * processSeconds();
}

} // namespace

const char* clockName(StageClock clock)
{
    constexpr const char* kNames[] = {"gpu", "wall", "processor"};
    return kNames[size_t(clock)];
}

base::Result<std::unique_ptr<QualityStage>> QualityStage::create(const scene_file::SceneFile& file, int width,
                                                                 int height)
{
    std::unique_ptr<QualityStage> stage(new QualityStage(file, width, height));
    if (base::Status status = stage->start(); !status)
        return status;
    return stage;
}

QualityStage::~QualityStage()
{
    fxDestroyView(view_);
    effects_.reset();
    stage_.reset();
}

base::Status QualityStage::start()
{
    auto glContext = render::createEglContext({});
    if (!glContext.ok())
        return glContext.status();
    glContext_ = std::move(*glContext);
    auto device = render::GlDevice::create(glContext_->loader(), std::pmr::get_default_resource());
    if (!device.ok())
        return device.status();
    device_ = std::move(*device);
    auto color = render::GlTexture::create(*device_, width_, height_, GL_RGBA32F, "frame");
    if (!color.ok())
        return color.status();
    color_ = std::move(*color);
    stage_ = std::make_unique<render::StageRenderer>(device_.get());
    if (base::Status status = stage_->setMesh(file_.mesh); !status)
        return status;
    if (base::Status status = stage_->setBackground(file_.background); !status)
        return status;
    EffectSceneOptions options;
    options.gl = {glContext_->loader().user, glContext_->loader().getProcAddress};
    auto effects = EffectScene::create(file_, options);
    if (!effects.ok())
        return effects.status();
    effects_ = std::move(*effects);
    return makeView();
}

base::Status QualityStage::makeView()
{
    if (base::Status status = toStatus(fxContext_WarmUp(effects_->context())); !status)
        return status;
    const FxViewSettings settings = toApi(file_.view);
    return toStatus(fxCreateView(effects_->context(), effects_->scene(), &settings, &view_));
}

StageClock QualityStage::bestClock() const
{
    const std::string& name = rendererName();
    const bool isSoftware = name.find("llvmpipe") != std::string::npos ||
                            name.find("softpipe") != std::string::npos ||
                            name.find("SwiftShader") != std::string::npos;
    if (isSoftware)
        return StageClock::Processor;
    return view_->renderer.hasGpuClock() ? StageClock::Gpu : StageClock::Wall;
}

base::Status QualityStage::setBudget(double budget, StageClock clock)
{
    view_->renderer.setHostClock(clock == StageClock::Processor ? processMilliseconds
                                                                : render::steadyMilliseconds);
    const render::TimingClock timing =
        clock == StageClock::Gpu ? render::TimingClock::Gpu : render::TimingClock::Host;
    return view_->quality.setOptions({budget, timing});
}

base::Status QualityStage::look(const scene_file::CameraPath& path,
                                const std::optional<PictureWindow>& window)
{
    camera_ = {};
    camera_.origin = path.at(0.0).position;
    camera_.view = path.viewRotation(0.0);
    camera_.projection = window ? window->clip() * path.projection(window->aspect())
                                : path.projection(float(width_) / float(height_));
    const auto snapshot = effects_->snapshot();
    if (!snapshot.ok())
        return snapshot.status();
    std::array<render::EffectLight, 8> lights;
    const size_t count = render::effectLights(**snapshot, lights);
    return stage_->render(camera_, file_.view.lighting, std::span(lights).first(count),
                          file_.view.exposureEv100, width_, height_);
}

base::Status QualityStage::draw()
{
    device_->gl.CopyImageSubData(stage_->colorTexture(), GL_TEXTURE_2D, 0, 0, 0, 0, color_.name(),
                                 GL_TEXTURE_2D, 0, 0, 0, 0, width_, height_, 1);
    device_->gl.Finish(); // what came before the frame is not the frame's
    FxFrameDef frame = fxDefaultFrameDef();
    for (int i = 0; i < 3; ++i)
        frame.origin[i] = camera_.origin[i];
    std::copy_n(glm::value_ptr(camera_.view), 16, frame.view);
    std::copy_n(glm::value_ptr(camera_.projection), 16, frame.projection);
    frame.colorTexture = color_.name();
    frame.depthTexture = stage_->depthTexture();
    frame.width = width_;
    frame.height = height_;
    const double wall = wallSeconds(), processor = processSeconds();
    if (base::Status status = toStatus(fxView_Render(view_, &frame)); !status)
        return status;
    device_->gl.Finish();
    wallMilliseconds_ = 1e3 * (wallSeconds() - wall);
    processorMilliseconds_ = 1e3 * (processSeconds() - processor);
    view_->quality.collect(view_->renderer);
    times_ = view_->quality.times().value_or(render::GroupTimes{});
    return {};
}

std::vector<float> QualityStage::picture()
{
    return render::readTexture(*device_, color_.name(), width_, height_, 4);
}

std::vector<float> QualityStage::background()
{
    return render::readTexture(*device_, stage_->colorTexture(), width_, height_, 4);
}

PictureDifference compare(const std::vector<float>& a, const std::vector<float>& b,
                          const std::vector<float>& background)
{
    PictureDifference sums;
    for (size_t i = 0; i < a.size(); ++i) {
        if (i % 4 == 3)
            continue;
        sums.difference += std::abs(double(a[i]) - double(b[i]));
        sums.light += std::abs(double(b[i]) - double(background[i]));
    }
    return sums;
}

base::Status readSize(const std::string& text, int& outWidth, int& outHeight)
{
    int width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 16 || width > 16'384 ||
        height < 16 || height > 16'384)
        return {base::Code::InvalidArgument,
                "--size: found '" + text + "'; allowed is WIDTHxHEIGHT, each from 16 to 16384, as 320x180"};
    outWidth = width;
    outHeight = height;
    return {};
}

base::Status readClock(const std::string& text, std::optional<StageClock>& outClock)
{
    for (const StageClock clock : {StageClock::Gpu, StageClock::Wall, StageClock::Processor})
        if (text == clockName(clock)) {
            outClock = clock;
            return {};
        }
    const std::vector<std::string> known{"auto", "gpu", "wall", "processor"};
    if (text != "auto")
        return {base::Code::InvalidArgument, "--clock: found '" + text +
                                                 "'; allowed are auto, gpu, wall and processor" +
                                                 base::didYouMean(text, known)};
    outClock.reset();
    return {};
}

} // namespace fx::cli
