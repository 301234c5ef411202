// The opaque picture: diffuse light in closed form, shadow, depth, and effect lights.
#include "rendering/frame/exposure.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/stage_renderer.h"
#include "view_fixture.h"

#include <cmath>
#include <numbers>
#include <vector>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 64;
constexpr float kPi = std::numbers::pi_v<float>;

/// A horizontal square of half side `half` at `height`, seen from above, of albedo 0.5.
void addSquare(render::StageMesh& mesh, float half, float height)
{
    const glm::vec3 corner[] = {
        {-half, height, half}, {half, height, half}, {half, height, -half}, {-half, height, -half}};
    for (const int i : {0, 1, 2, 0, 2, 3}) {
        mesh.positions.push_back(corner[i]);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.colors.emplace_back(0.5f);
    }
}

class StageTest : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        stage_ = std::make_unique<render::StageRenderer>(device_.get());
        lighting_.sunDirection = {0.0f, 1.0f, 0.0f};
        lighting_.groundAlbedo = 0.0f;
    }
    void TearDown() override
    {
        stage_.reset();
        ViewTest::TearDown();
    }
    /// Straight down from 10 m above the origin. Red of the middle pixel in cd/m2.
    float middle(std::span<const render::EffectLight> lights = {})
    {
        const auto camera = render::perspectiveView({{0.0, 10.0, 0.0}, {0.0, 0.0, 0.0}, {0.0f, 0.0f, -1.0f}},
                                                    0.6f, 1.0f, 0.1f);
        const base::Status status = stage_->render(camera, lighting_, lights, kEv100, kSize, kSize);
        EXPECT_TRUE(status.ok()) << status.message();
        const auto texels = render::readTexture(*device_, stage_->colorTexture(), kSize, kSize, 4);
        return texels[(kSize / 2 * kSize + kSize / 2) * 4] / render::exposureFromEv100(kEv100);
    }

    render::Lighting lighting_;
    std::unique_ptr<render::StageRenderer> stage_;
};

} // namespace

TEST_F(StageTest, aDiffuseSquareUnderTheSunHasAlbedoTimesIlluminanceOverPi)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    lighting_.sunIlluminance = glm::vec3(1000.0f);
    EXPECT_NEAR(middle(), 0.5f * 1000.0f / kPi, 0.5f);
}

TEST_F(StageTest, waterMirrorsTheSkyByFresnelsEquationsAndLetsTheRestOut)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    mesh.waterVertices = mesh.positions.size();
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    render::StageBackground sky;
    sky.luminance = sky.horizon = glm::vec3(1000.0f);
    ASSERT_TRUE(stage_->setBackground(sky).ok());
    EXPECT_NEAR(middle(), 0.02f * 1000.0f, 0.1f); // seen from above; waves of slopes below 0.1 change nothing
    lighting_.skyLuminance = glm::vec3(100.0f);
    EXPECT_NEAR(middle(), 0.02f * 1000.0f + 0.98f * 0.5f * 100.0f, 0.5f);
}

TEST_F(StageTest, waterCastsNoShadowAndTheSunGlintsInIt)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    addSquare(mesh, 5.0f, 1.0f);
    mesh.waterVertices = 6; // the upper square
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    lighting_.sunIlluminance = glm::vec3(1000.0f);
    const float above = middle();
    EXPECT_GT(above,
              1.3f * 0.98f * 0.5f * 1000.0f / kPi); // the camera looks into the glint, which the waves widen
    lighting_.sunDirection = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f));
    const float aside = middle();
    EXPECT_NEAR(aside, 0.98f * 0.5f * 1000.0f * std::sqrt(0.5f) / kPi, 10.0f); // lit, as nothing shades it
}

TEST_F(StageTest, underAnEvenSkyItHasAlbedoTimesTheSkysLuminance)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    lighting_.skyLuminance = glm::vec3(300.0f);
    EXPECT_NEAR(middle(), 150.0f, 0.2f);
}

TEST_F(StageTest, aRoofOutOfTheSunsWayCastsItsShadowWhereItShould)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    addSquare(mesh, 1.0f, 3.0f);
    for (size_t i = 6; i < 12; ++i)
        mesh.positions[i].x += 3.0f; // beside the line of sight
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    lighting_.sunIlluminance = glm::vec3(1000.0f);
    EXPECT_NEAR(middle(), 0.5f * 1000.0f / kPi, 0.5f)
        << "the roof is not between the middle and an overhead sun";
    lighting_.sunDirection = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f)); // now it is
    EXPECT_EQ(middle(), 0.0f);
}

TEST_F(StageTest, depthIsThatOfTheProjection)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 2.0f);
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    middle();
    const auto depth = render::readDepthTexture(*device_, stage_->depthTexture(), kSize, kSize);
    EXPECT_NEAR(depth[kSize / 2 * kSize + kSize / 2], 1.0f - 0.1f / 8.0f, 1e-6f);
}

TEST_F(StageTest, anEffectLightFallsWithTheSquareOfTheDistance)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    ASSERT_TRUE(stage_->setMesh(mesh).ok());
    const auto lit = [&](double height) {
        const render::EffectLight light{{0.0, height, 0.0}, glm::vec3(1000.0f), 0.01f};
        return middle({&light, 1});
    };
    EXPECT_NEAR(lit(2.0), 0.5f / kPi * 1000.0f / 4.0f, 1.0f);
    EXPECT_NEAR(lit(2.0) / lit(4.0), 4.0f, 0.05f);
}

TEST_F(StageTest, withoutAMeshThereIsTheBackground)
{
    render::StageBackground background;
    background.luminance = glm::vec3(70.0f);
    background.horizon = glm::vec3(70.0f);
    ASSERT_TRUE(stage_->setBackground(background).ok());
    EXPECT_NEAR(middle(), 70.0f, 1e-3f);
}

TEST_F(StageTest, uploadsDoNotDependOnTheHostsPixelTransfer)
{
    render::StageBackground background;
    background.width = background.height = 4;
    background.image.assign(16, glm::vec3(70.0f));
    const auto& gl = device_->gl;
    GLuint buffer = 0; // of zeros
    gl.CreateBuffers(1, &buffer);
    gl.NamedBufferStorage(buffer, 4096, std::vector<char>(4096).data(), 0);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    gl.PixelStorei(GL_UNPACK_SWAP_BYTES, 1);
    EXPECT_TRUE(stage_->setBackground(background).ok());
    GLint bound = 0, swaps = 0;
    gl.GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &bound);
    gl.GetIntegerv(GL_UNPACK_SWAP_BYTES, &swaps);
    EXPECT_EQ(GLuint(bound), buffer);
    EXPECT_EQ(swaps, 1);
    gl.PixelStorei(GL_UNPACK_SWAP_BYTES, 0);
    gl.DeleteBuffers(1, &buffer);
    const float shown = middle();
    EXPECT_TRUE(stage_->setBackground(background).ok());
    EXPECT_EQ(shown, middle());
    EXPECT_GT(shown, 1.0f);
}

TEST_F(StageTest, aMeshWhoseArraysDifferIsRefused)
{
    render::StageMesh mesh;
    addSquare(mesh, 5.0f, 0.0f);
    mesh.colors.pop_back();
    EXPECT_EQ(stage_->setMesh(mesh).code(), base::Code::InvalidArgument);
}
