#include "view_fixture.h"

#include "foundation/snapshot/material_kind.h"
#include "rendering/frame/exposure.h"
#include "rendering/frame/view_block.h"
#include "rendering/gl/gl_read_texture.h"

#include <algorithm>
#include <cmath>

namespace fx::test {

namespace blob = base::blob_column;

double maxDifference(const Picture& a, const Picture& b)
{
    double most = 0.0;
    for (size_t i = 0; i < a.texels.size(); ++i)
        if (const double difference = double(std::abs(a.texels[i] - b.texels[i])); !(difference <= most))
            most = difference; // NaN too
    return most;
}

void ViewTest::SetUp()
{
    schema_.add(base::kBlobKind);
    auto context = render::createEglContext({.debug = true});
    ASSERT_TRUE(context.ok()) << context.status().message();
    context_ = std::move(*context);
    auto device = render::GlDevice::create(context_->loader(), std::pmr::get_default_resource());
    ASSERT_TRUE(device.ok()) << device.status().message();
    device_ = std::move(*device);
    messages_ = std::make_unique<render::GlMessages>(*device_);
    view_ = std::make_unique<render::ViewRenderer>(device_.get(), &schema_, std::pmr::get_default_resource());
    view_->settings().dazzle.enabled = false;
    view_->settings().exposureEv100 = kEv100;
    view_->settings().lighting.skyLuminance = glm::vec3(0.0f);
}

void ViewTest::TearDown()
{
    EXPECT_EQ(messages_ ? messages_->serious() : 0u, 0u) << messages_->first();
}

base::FrameSnapshot ViewTest::snapshotOf(const std::vector<TestBlob>& blobs, const glm::dvec3& placement)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    snapshot.begin(0, ++sequence_);
    for (uint32_t layer = 0; layer < uint32_t(base::MediaLayer::Count); ++layer) {
        auto& group = snapshot.addGroup(schema_.find("blob"), blobs.size());
        uint32_t count = 0;
        for (size_t i = 0; i < blobs.size(); ++i) {
            const TestBlob& b = blobs[i];
            if (uint32_t(b.layer) != layer)
                continue;
            for (size_t c = 0; c < blob::Count; ++c)
                group.editColumn(c)[count] = 0.0f;
            const auto set = [&](size_t c, float value) { group.editColumn(c)[count] = value; };
            for (size_t k = 0; k < 3; ++k) {
                set(blob::PositionX + k, b.center[int(k)]);
                set(blob::AlbedoR + k, b.albedo);
                set(blob::EmissionR + k, b.emission / render::exposureFromEv100(kEv100));
            }
            set(blob::Radius, b.radius);
            set(blob::CrossSection, b.crossSection);
            set(blob::FireShare, b.fireShare);
            set(blob::Heat, b.heat);
            group.editIds()[count++] = b.id.value_or(i);
        }
        group.editInfo().count = count;
        group.editInfo().solver = layer;
        group.editInfo().placement.position = placement;
        group.editConstants()[base::blob_constant::Layer] = float(layer);
    }
    return snapshot;
}

base::FrameSnapshot ViewTest::detailedSnapshotOf(const std::vector<TestBlob>& blobs, float shrunk, float gain)
{
    const base::KindId found = schema_.find("material");
    const base::KindId material = found != base::kNoKind ? found : schema_.add(base::kMaterialKind);
    const base::FrameSnapshot plain = snapshotOf(blobs);
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    snapshot.begin(0, ++sequence_);
    const base::SnapshotGroup& from = plain.group(uint32_t(base::MediaLayer::Smoke));
    base::SnapshotGroup& group = snapshot.addGroup(schema_.find("blob"), from.count());
    group.editInfo() = from.info();
    for (size_t c = 0; c < blob::Count; ++c)
        std::copy_n(from.column(c).begin(), from.count(), group.editColumn(c).begin());
    std::copy_n(from.ids().begin(), from.count(), group.editIds().begin());
    std::ranges::copy(from.constants(), group.editConstants().begin());
    base::SnapshotGroup& carried = snapshot.addGroup(material, from.count());
    carried.editInfo() = from.info();
    carried.editInfo().kind = material;
    for (size_t c = 0; c < base::material_column::Count; ++c) {
        const auto places = from.column(blob::PositionX + c % 3).first(from.count());
        std::ranges::transform(places, carried.editColumn(c).begin(), [&](float x) { return shrunk * x; });
    }
    std::copy_n(from.ids().begin(), from.count(), carried.editIds().begin());
    const float constants[] = {1.0f, 0.4f, 0.5f, 0.5f, 1.0f, 1.0f, 0.3f, 8.0f, 0.2f, gain, 0.0f, 0.0f};
    std::ranges::copy(constants, carried.editConstants().begin());
    return snapshot;
}

void ViewTest::makeTargets(int width, int height)
{
    auto color = render::GlTexture::create(*device_, width, height, GL_RGBA32F, "host color");
    auto depth = render::GlTexture::create(*device_, width, height, GL_DEPTH_COMPONENT32F, "host depth");
    ASSERT_TRUE(color.ok() && depth.ok());
    color_ = std::move(*color);
    depth_ = std::move(*depth);
    useDepth_ = false;
}

void ViewTest::setPicture(const std::vector<float>& rgba)
{
    device_->gl.TextureSubImage2D(color_->name(), 0, 0, 0, color_->width(), color_->height(), GL_RGBA,
                                  GL_FLOAT, rgba.data());
}

void ViewTest::setDepth(const std::vector<float>& stored)
{
    device_->gl.TextureSubImage2D(depth_->name(), 0, 0, 0, depth_->width(), depth_->height(),
                                  GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
    useDepth_ = true;
}

Picture ViewTest::render(const base::FrameSnapshot& snapshot, const render::CameraView& camera)
{
    render::FrameRequest request;
    request.camera = camera;
    request.targets.color = color_->name();
    request.targets.depth = useDepth_ ? depth_->name() : 0;
    request.targets.width = color_->width();
    request.targets.height = color_->height();
    base::SnapshotPair pair;
    pair.newer = &snapshot;
    const base::Status status = view_->render(pair, request);
    EXPECT_TRUE(status.ok()) << status.message();
    return read(color_->name());
}

Picture ViewTest::read(uint32_t texture, int channels)
{
    return {color_->width(), color_->height(),
            render::readTexture(*device_, texture, color_->width(), color_->height(), channels)};
}

} // namespace fx::test
