#include "fxsdk/cli/render/snapshot_renderer.h"

#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/view/view_renderer.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory_resource>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMinNearDistance = 1e-3;    ///< [m]
constexpr float kOrthographicFar = 10000.0f; ///< [m]

} // namespace

render::CameraView viewOf(const render::ReferenceCamera& camera, double aspect)
{
    render::CameraView view;
    view.origin = camera.eye;
    for (int axis = 0; axis < 3; ++axis) {
        view.view[axis][0] = float(camera.right[axis]);
        view.view[axis][1] = float(camera.up[axis]);
        view.view[axis][2] = float(-camera.forward[axis]);
    }
    const float near = float(std::max(camera.nearDistance, kMinNearDistance));
    const float high = float(camera.halfHeight), wide = float(camera.halfHeight * aspect);
    view.projection = camera.orthographic
                          ? glm::ortho(-wide, wide, -high, high, near, kOrthographicFar)
                          : glm::infinitePerspective(2.0f * std::atan(high), float(aspect), near);
    return view;
}

struct SnapshotRenderer::Impl
{
    Picture read(uint32_t texture, int channels, float whenAbsent = 0.0f)
    {
        if (texture == 0) { // no medium was drawn
            const size_t count = size_t(width) * size_t(height) * size_t(channels);
            return {width, height, channels, std::vector<float>(count, whenAbsent)};
        }
        return fromBottomUp(width, height, channels,
                            render::readTexture(*device, texture, width, height, channels));
    }
    void readOutputs(FrameLayers::Outputs& out);
    base::Status start(const base::SnapshotSchema& schema);

    int width = 0, height = 0;
    std::unique_ptr<render::GlContext> context;
    std::unique_ptr<render::GlDevice> device;
    render::GlTexture color;
    std::unique_ptr<render::ViewRenderer> view;
    double lastTime = -1.0; ///< [s] of the picture before; -1: there was none
    double milliseconds = 0.0;
};

SnapshotRenderer::SnapshotRenderer() : impl_(std::make_unique<Impl>()) {}
SnapshotRenderer::~SnapshotRenderer() = default;

base::Result<std::unique_ptr<SnapshotRenderer>> SnapshotRenderer::create(const base::SnapshotSchema& schema,
                                                                         const render::ViewSettings& settings,
                                                                         int width, int height)
{
    std::unique_ptr<SnapshotRenderer> renderer(new SnapshotRenderer());
    renderer->impl_->width = width;
    renderer->impl_->height = height;
    if (base::Status status = renderer->impl_->start(schema); !status)
        return status;
    renderer->settings() = settings;
    return renderer;
}

void SnapshotRenderer::Impl::readOutputs(FrameLayers::Outputs& out)
{
    namespace output = render::view_output;
    constexpr float kNone = std::numeric_limits<float>::infinity();
    const uint32_t asked = view->settings().outputs;
    if ((asked & output::InstanceId) != 0) {
        std::vector<float> numbers(size_t(width) * size_t(height), 0.0f);
        if (view->output(0) != 0) {
            const auto words = render::readUintTexture(*device, view->output(0), width, height, 2);
            for (size_t i = 0; i < numbers.size(); ++i)
                numbers[i] = float(words[2 * i]);
        }
        out.instance = fromBottomUp(width, height, 1, std::move(numbers));
    }
    if ((asked & output::Motion) != 0)
        out.motion = read(view->output(1), 2);
    if ((asked & output::FirstDepth) != 0)
        out.firstDepth = read(view->output(2), 1, kNone);
    if ((asked & output::MeanDepth) != 0)
        out.meanDepth = read(view->output(3), 1, kNone);
    if ((asked & output::OpticalDepth) != 0)
        out.opticalDepth = read(view->output(4), 1);
}

base::Status SnapshotRenderer::Impl::start(const base::SnapshotSchema& schema)
{
    auto made = render::createEglContext({});
    if (!made.ok())
        return made.status();
    context = std::move(*made);
    auto opened = render::GlDevice::create(context->loader(), std::pmr::get_default_resource());
    if (!opened.ok())
        return opened.status();
    device = std::move(*opened);
    auto texture = render::GlTexture::create(*device, width, height, GL_RGBA32F, "snapshot color");
    if (!texture.ok())
        return texture.status();
    color = std::move(*texture);
    view = std::make_unique<render::ViewRenderer>(device.get(), &schema, std::pmr::get_default_resource());
    return {};
}

base::Status SnapshotRenderer::warmUp()
{
    return impl_->view->warmUp();
}

render::ViewSettings& SnapshotRenderer::settings()
{
    return impl_->view->settings();
}

void SnapshotRenderer::setAssets(const base::AssetTable* assets)
{
    impl_->view->setAssets(assets);
}

base::Status SnapshotRenderer::render(const SceneMoment& moment, const render::ReferenceCamera& camera,
                                      double time)
{
    Impl& impl = *impl_;
    const Clock::time_point start = Clock::now();
    impl.device->gl.ClearTexImage(impl.color.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
    render::FrameRequest request;
    request.camera = viewOf(camera, double(impl.width) / impl.height);
    request.targets.color = impl.color.name();
    request.targets.width = impl.width;
    request.targets.height = impl.height;
    request.interpolation = moment.interpolation;
    request.time = time;
    request.deltaTime = impl.lastTime < 0.0 ? 0.0 : time - impl.lastTime;
    request.resetHistory = impl.lastTime < 0.0;
    if (base::Status status = impl.view->render(moment.snapshots, request); !status)
        return status;
    impl.device->gl.Finish();
    impl.lastTime = time;
    impl.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return {};
}

FrameLayers SnapshotRenderer::read()
{
    Impl& impl = *impl_;
    FrameLayers layers;
    layers.color = impl.read(impl.color.name(), 4);
    if (!impl.view->settings().layerOutputs)
        return layers;
    const render::LayerTextures textures = impl.view->layers();
    layers.background = impl.read(0, 4);
    layers.media = {impl.read(textures.fire, 4), impl.read(textures.smoke, 4), impl.read(textures.dust, 4)};
    layers.depth = impl.read(textures.depth, 1, std::numeric_limits<float>::infinity());
    layers.opticalDepth = impl.read(textures.opticalDepth, 1);
    impl.readOutputs(layers.outputs);
    return layers;
}

const render::FrameStatistics& SnapshotRenderer::statistics() const
{
    return impl_->view->statistics();
}

bool SnapshotRenderer::fillsPlanes() const
{
    return std::ranges::count(impl_->view->executedPasses(), "light slices") > 0;
}

render::GlDevice& SnapshotRenderer::device()
{
    return *impl_->device;
}

double SnapshotRenderer::millisecondsRender() const
{
    return impl_->milliseconds;
}

const std::string& SnapshotRenderer::rendererName() const
{
    return impl_->device->limits().renderer;
}

} // namespace fx::cli
