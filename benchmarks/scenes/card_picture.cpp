#include "benchmarks/scenes/card_picture.h"

#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/techniques.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/stage_camera.h"

#include <algorithm>
#include <chrono>

namespace fx::cli {
namespace {

constexpr double kExposure = 1.0 / 1.2; ///< of EV 0

} // namespace

base::Result<std::unique_ptr<CardPicture>> CardPicture::create(int width, int height, float field)
{
    std::unique_ptr<CardPicture> made(new CardPicture(width, height, field));
    auto gl = render::createEglContext({});
    if (!gl)
        return gl.status();
    made->gl_ = std::move(*gl);
    auto device = render::GlDevice::create(made->gl_->loader(), std::pmr::get_default_resource());
    if (!device)
        return device.status();
    made->device_ = std::move(*device);
    auto color = render::GlTexture::create(*made->device_, width, height, GL_RGBA32F, "picture");
    auto depth = render::GlTexture::create(*made->device_, width, height, GL_DEPTH_COMPONENT32F, "surface");
    if (!color || !depth)
        return color ? depth.status() : color.status();
    made->color_ = std::move(*color);
    made->depth_ = std::move(*depth);
    preset::registerKinds(made->schema_);
    made->view_ = std::make_unique<render::ViewRenderer>(made->device_.get(), &made->schema_,
                                                         std::pmr::get_default_resource());
    made->settings().dazzle.enabled = false;
    made->settings().detail = false;
    made->settings().exposureEv100 = 0.0f;
    return made;
}

base::FrameSnapshot CardPicture::snapshotOf(std::span<const Card> cards) const
{
    namespace column = base::blob_column;
    static uint64_t published = 0;
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    snapshot.begin(0, ++published);
    auto& group = snapshot.addGroup(schema_.find(base::kBlobKind.name), cards.size());
    for (size_t c = 0; c < column::Count; ++c)
        std::fill_n(group.editColumn(c).begin(), cards.size(), 0.0f);
    for (size_t i = 0; i < cards.size(); ++i) {
        const Card& card = cards[i];
        const auto set = [&](size_t c, float value) { group.editColumn(c)[i] = value; };
        set(column::PositionX, card.x);
        set(column::PositionY, card.y);
        set(column::PositionZ, -card.z);
        set(column::Radius, card.radius);
        set(column::CrossSection, card.crossSection);
        for (size_t k = 0; k < 3; ++k)
            set(column::EmissionR + k, card.emission[k]);
        group.editIds()[i] = i;
    }
    group.editInfo().count = uint32_t(cards.size());
    group.editConstants()[base::blob_constant::Layer] = float(uint32_t(base::MediaLayer::Smoke));
    return snapshot;
}

void CardPicture::setSurface(std::span<const float> distances)
{
    std::vector<float> stored;
    for (const float distance : distances)
        stored.push_back(std::min(distance / kFarthest, 1.0f));
    device_->gl.TextureSubImage2D(depth_.name(), 0, 0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT,
                                  stored.data());
    hasSurface_ = true;
}

void CardPicture::clear()
{
    const float black[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    device_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, black);
    device_->gl.Finish();
}

base::Status CardPicture::draw(const base::FrameSnapshot& snapshot, double* outMilliseconds)
{
    render::FrameRequest request;
    request.camera = render::orthographicView({glm::dvec3(0.0), {0.0, 0.0, -1.0}, {0.0f, 1.0f, 0.0f}},
                                              field_ * float(height_) / float(width_),
                                              float(width_) / float(height_), 0.0f, kFarthest);
    request.targets.color = color_.name();
    request.targets.depth = hasSurface_ ? depth_.name() : 0;
    request.targets.width = width_;
    request.targets.height = height_;
    const auto start = std::chrono::steady_clock::now();
    base::Status status = view_->render({&snapshot, nullptr}, request);
    if (!outMilliseconds)
        return status;
    device_->gl.Finish();
    *outMilliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return status;
}

std::vector<float> CardPicture::read()
{
    std::vector<float> texels = render::readTexture(*device_, color_.name(), width_, height_, 3);
    for (float& texel : texels)
        texel = float(double(texel) / kExposure);
    return texels;
}

} // namespace fx::cli
