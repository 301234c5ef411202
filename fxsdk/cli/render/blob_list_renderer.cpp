#include "fxsdk/cli/render/blob_list_renderer.h"

#include "fxsdk/cli/render/blob_snapshot.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/view/view_renderer.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <optional>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLeastNear = 1e-3;          ///< [m]
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
    const float near = float(std::max(camera.nearDistance, kLeastNear));
    const float high = float(camera.halfHeight), wide = float(camera.halfHeight * aspect);
    view.projection = camera.orthographic
                          ? glm::ortho(-wide, wide, -high, high, near, kOrthographicFar)
                          : glm::infinitePerspective(2.0f * std::atan(high), float(aspect), near);
    return view;
}

struct BlobListRenderer::Impl
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

    int width = 0, height = 0;
    base::SnapshotSchema schema;
    std::unique_ptr<render::GlContext> context;
    std::unique_ptr<render::GlDevice> device;
    render::GlTexture color;
    std::unique_ptr<render::ViewRenderer> view;
    std::optional<base::FrameSnapshot> snapshot;
    uint64_t sequence = 0;  ///< of the snapshot
    double lastTime = -1.0; ///< [s] of the picture before; -1: there was none
    double milliseconds = 0.0;
};

BlobListRenderer::BlobListRenderer() : impl_(std::make_unique<Impl>()) {}
BlobListRenderer::~BlobListRenderer() = default;

base::Result<std::unique_ptr<BlobListRenderer>>
BlobListRenderer::create(std::span<const render::MediumBlob> blobs, const render::ViewSettings& settings,
                         int width, int height)
{
    std::unique_ptr<BlobListRenderer> renderer(new BlobListRenderer());
    if (base::Status status = renderer->start(blobs, settings, width, height); !status)
        return status;
    return renderer;
}

base::Status BlobListRenderer::start(std::span<const render::MediumBlob> blobs,
                                     const render::ViewSettings& settings, int width, int height)
{
    Impl& impl = *impl_;
    impl.width = width;
    impl.height = height;
    impl.schema.add(base::kBlobKind);
    auto context = render::createEglContext({});
    if (!context.ok())
        return context.status();
    impl.context = std::move(*context);
    auto device = render::GlDevice::create(impl.context->loader(), std::pmr::get_default_resource());
    if (!device.ok())
        return device.status();
    impl.device = std::move(*device);
    auto color = render::GlTexture::create(*impl.device, width, height, GL_RGBA32F, "list color");
    if (!color.ok())
        return color.status();
    impl.color = std::move(*color);
    impl.view = std::make_unique<render::ViewRenderer>(impl.device.get(), &impl.schema,
                                                       std::pmr::get_default_resource());
    impl.view->settings() = settings;
    show(blobs);
    return impl.view->warmUp();
}

void BlobListRenderer::show(std::span<const render::MediumBlob> blobs)
{
    impl_->snapshot.emplace(snapshotOfBlobs(blobs, impl_->schema, ++impl_->sequence));
}

render::ViewSettings& BlobListRenderer::settings()
{
    return impl_->view->settings();
}

base::Status BlobListRenderer::render(const render::ReferenceCamera& camera, double time)
{
    Impl& impl = *impl_;
    const Clock::time_point start = Clock::now();
    impl.device->gl.ClearTexImage(impl.color.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
    render::FrameRequest request;
    request.camera = viewOf(camera, double(impl.width) / impl.height);
    request.targets.color = impl.color.name();
    request.targets.width = impl.width;
    request.targets.height = impl.height;
    request.time = time;
    request.deltaTime = impl.lastTime < 0.0 ? 0.0 : time - impl.lastTime;
    request.resetHistory = impl.lastTime < 0.0;
    if (base::Status status = impl.view->render({&*impl.snapshot, nullptr}, request); !status)
        return status;
    impl.device->gl.Finish();
    impl.lastTime = time;
    impl.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return {};
}

FrameLayers BlobListRenderer::read()
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
    return layers;
}

const render::FrameStatistics& BlobListRenderer::statistics() const
{
    return impl_->view->statistics();
}

bool BlobListRenderer::fillsPlanes() const
{
    return std::ranges::count(impl_->view->executedPasses(), "light slices") > 0;
}

double BlobListRenderer::millisecondsRender() const
{
    return impl_->milliseconds;
}

const std::string& BlobListRenderer::rendererName() const
{
    return impl_->device->limits().renderer;
}

} // namespace fx::cli
