/// @file view_fixture.h
/// A headless GL context with a view, a float texture as the host's picture, and hand-made snapshots.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_messages.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "rendering/stage/stage_camera.h"
#include "rendering/view/view_renderer.h"

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

namespace fx::test {

/// One blob of a hand-made snapshot.
struct TestBlob
{
    glm::vec3 center{0.0f};
    float radius = 1.0f;
    float crossSection = 1.0f;
    float emission = 0.0f; ///< exposed value of the emitted light, equal in all channels
    float albedo = 0.0f;
    float fireShare = 0.0f;
    float heat = 0.0f;
    base::MediaLayer layer = base::MediaLayer::Smoke;
    std::optional<uint64_t> id = {}; ///< empty: number in the list
};

/// RGBA of a picture, row by row from the bottom.
struct Picture
{
    int width, height;
    std::vector<float> texels;
    const float* at(int x, int y) const { return &texels[(size_t(y) * size_t(width) + size_t(x)) * 4]; }
};

/// Largest difference over all channels of all texels.
double maxDifference(const Picture& a, const Picture& b);

class ViewTest : public testing::Test
{
protected:
    static constexpr float kEv100 = 0.0f;

    void SetUp() override;
    void TearDown() override;

    /// Creates a snapshot with one group per layer at `placement`. Ids count up from 0.
    base::FrameSnapshot snapshotOf(const std::vector<TestBlob>& blobs,
                                   const glm::dvec3& placement = glm::dvec3(0.0));
    /// Creates a snapshot with one group of smoke whose field has detail. The noise coordinates of a ball are
    /// `shrunk` times its place. @param gain amplitude of an octave over that of the previous octave
    base::FrameSnapshot detailedSnapshotOf(const std::vector<TestBlob>& blobs, float shrunk = 1.0f,
                                           float gain = 0.55f);
    void makeTargets(int width, int height);
    void setPicture(const std::vector<float>& rgba); ///< sets the host's picture before effects are drawn
    /// sets the stored depth values; without this call nothing occludes effects
    void setDepth(const std::vector<float>& stored);
    Picture render(const base::FrameSnapshot& snapshot, const render::CameraView& camera);
    Picture read(uint32_t texture, int channels = 4);

    // These members are destroyed in reverse order, after the members of derived fixtures. Derived fixtures
    // own objects of the device.
    base::SnapshotSchema schema_;
    std::unique_ptr<render::GlContext> context_;
    std::unique_ptr<render::GlDevice> device_;
    std::unique_ptr<render::GlMessages> messages_;
    std::unique_ptr<render::ViewRenderer> view_;
    std::optional<render::GlTexture> color_;
    std::optional<render::GlTexture> depth_;
    bool useDepth_ = false;
    uint64_t sequence_ = 0; ///< sequence number of the last snapshot
};

} // namespace fx::test
