// Which matrices are cameras' projections.
#include "fxsdk/api/check.h"
#include "fxsdk/api/check_projection.h"
#include "fxsdk/fx_activation.h"
#include "tests/api/view_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cstring>
#include <limits>
#include <string>

namespace {

using fx::api::frameProjectionFault;
using fx::api::projectionFault;

constexpr float kInf = std::numeric_limits<float>::infinity();

glm::mat4 infiniteReversed(float nearPlane)
{
    glm::mat4 p(0.0f);
    p[0][0] = p[1][1] = 1.5f;
    p[2][3] = -1.0f;
    p[3][2] = nearPlane;
    return p;
}

struct Camera
{
    const char* name;
    glm::mat4 projection;
    bool isReversed;
};

std::vector<Camera> cameras()
{
    glm::mat4 jittered = glm::perspectiveRH_NO(1.0f, 1.5f, 0.1f, 100.0f);
    jittered[2][0] = 0.001f;
    jittered[2][1] = -0.002f;
    glm::mat4 mirrored = glm::perspectiveRH_ZO(1.0f, 1.5f, 0.1f, 100.0f);
    mirrored[1][1] *= -1.0f;
    glm::mat4 rounded = glm::perspectiveRH_NO(1.0f, 1.5f, 0.1f, 100.0f);
    rounded[3][3] = 1e-9f;
    rounded[0][3] = -1e-8f;
    return {{"perspective", glm::perspectiveRH_NO(1.0f, 1.5f, 0.1f, 100.0f), false},
            {"perspective from 0", glm::perspectiveRH_ZO(1.0f, 1.5f, 0.1f, 1e4f), false},
            {"near of a metre", glm::infinitePerspectiveRH(1.0f, 1.5f, 1.0f), false},
            {"near of half a metre", glm::infinitePerspectiveRH(1.0f, 1.5f, 0.5f), false},
            {"near of a millimetre", glm::infinitePerspectiveRH(1.0f, 1.5f, 1e-3f), false},
            {"reversed", glm::perspectiveRH_ZO(1.0f, 1.5f, 100.0f, 0.1f), true},
            {"infinite reversed", infiniteReversed(0.1f), true},
            {"infinite reversed, near of a metre", infiniteReversed(1.0f), true},
            {"off-center", glm::frustumRH_NO(-0.1f, 0.3f, -0.2f, 0.1f, 0.1f, 50.0f), false},
            {"jittered", jittered, false},
            {"mirrored", mirrored, false},
            {"rounded", rounded, false},
            {"orthographic", glm::orthoRH_NO(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 50.0f), false},
            {"off-center orthographic", glm::orthoRH_ZO(-1.0f, 4.0f, -3.0f, 2.0f, 0.1f, 50.0f), false},
            {"orthographic about the eye", glm::orthoRH_NO(-4.0f, 4.0f, -3.0f, 3.0f, -50.0f, 50.0f), false},
            {"reversed orthographic", glm::orthoRH_ZO(-4.0f, 4.0f, -3.0f, 3.0f, 50.0f, 0.1f), true}};
}

std::string faultOf(const glm::mat4& projection, bool isReversed = false)
{
    const char* fault = projectionFault(glm::value_ptr(projection));
    if (!fault)
        fault = frameProjectionFault(glm::value_ptr(projection), isReversed);
    return fault ? fault : "";
}

bool has(const std::string& text, const char* part)
{
    return text.find(part) != std::string::npos;
}

using ProjectionApi = fx::test::ViewApiTest;

} // namespace

TEST(Projection, camerasAreAccepted)
{
    for (const Camera& camera : cameras())
        EXPECT_EQ(faultOf(camera.projection, camera.isReversed), "") << camera.name;
}

TEST(Projection, transposedOnesAreCalledRowMajor)
{
    for (const Camera& camera : cameras()) {
        const glm::mat4 transposed = glm::transpose(camera.projection);
        if (transposed != camera.projection) {
            EXPECT_TRUE(has(faultOf(transposed, camera.isReversed), "looks row-major: transpose it"))
                << camera.name << ": " << faultOf(transposed, camera.isReversed);
        }
    }
}

TEST(Projection, conventionsThatDisagreeAreNamed)
{
    for (const Camera& camera : cameras())
        EXPECT_TRUE(has(faultOf(camera.projection, !camera.isReversed), "frame.depthConvention"))
            << camera.name;
}

TEST(Projection, leftHandedOnesAreToldApartFromRowMajorOnes)
{
    EXPECT_TRUE(has(faultOf(glm::perspectiveLH_NO(1.0f, 1.5f, 0.1f, 100.0f)), "looks along +Z"));
    EXPECT_TRUE(has(faultOf(glm::perspectiveLH_ZO(1.0f, 1.5f, 0.1f, 100.0f)), "looks along +Z"));
}

TEST(Projection, whatAFrameCannotFollowIsRefusedWithThePlaceForIt)
{
    const glm::mat4 good = cameras()[0].projection;
    const auto spoilt = [&](int column, int row, float value) {
        glm::mat4 p = good;
        p[column][row] = value;
        return faultOf(p);
    };
    EXPECT_TRUE(has(spoilt(0, 0, 0.0f), "no extent"));
    EXPECT_TRUE(has(spoilt(1, 1, 0.0f), "no extent"));
    EXPECT_TRUE(has(spoilt(3, 2, 0.0f), "singular"));
    EXPECT_TRUE(has(spoilt(1, 0, 0.5f), "frame.view"));
    EXPECT_TRUE(has(spoilt(3, 0, 0.03f), "frame.view")); // an eye of two, in the wrong matrix
    EXPECT_TRUE(has(spoilt(0, 2, 0.5f), "oblique near plane"));
    EXPECT_TRUE(has(spoilt(0, 3, 0.5f), "neither perspective nor orthographic"));
    EXPECT_TRUE(has(spoilt(2, 3, kInf), "not finite"));
    EXPECT_TRUE(has(faultOf(2.0f * good), "scaled"));
    EXPECT_TRUE(has(faultOf(glm::mat4(0.0f)), "no extent"));
    glm::mat4 flat = cameras()[12].projection;
    flat[2][2] = 0.0f;
    EXPECT_TRUE(has(faultOf(flat), "singular"));
    glm::mat4 cabinet = cameras()[12].projection;
    cabinet[2][0] = 0.1f;
    EXPECT_TRUE(has(faultOf(cabinet), "oblique orthographic"));
}

TEST_F(ProjectionApi, framesAndFociNameTheMember)
{
    update(30);
    const std::vector<float> before = picture();
    const glm::mat4 rowMajor = glm::transpose(glm::make_mat4(frame().projection));
    FxFrameDef def = frame();
    std::memcpy(def.projection, glm::value_ptr(rowMajor), sizeof def.projection);
    EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(has(fxGetLastErrorMessage(), "frame.projection looks row-major: transpose it"));
    FxFocus focus = fxDefaultFocus();
    std::memcpy(focus.projection, glm::value_ptr(rowMajor), sizeof focus.projection);
    EXPECT_EQ(fxScene_SetFocus(scene_, &focus, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(has(fxGetLastErrorMessage(), "foci.projection looks row-major: transpose it"));

    def = frame();
    std::memcpy(def.projection, glm::value_ptr(glm::mat4(1.0f)), sizeof def.projection);
    for (const uint32_t convention : {FX_DEPTH_STANDARD, FX_DEPTH_REVERSED}) {
        def.depthConvention = convention;
        EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_INVALID_ARGUMENT);
        EXPECT_TRUE(has(fxGetLastErrorMessage(), "frame.projection is identity, the default"));
    }

    const glm::mat4 view = glm::lookAt(glm::vec3(1, 2, 3), glm::vec3(0), glm::vec3(0, 1, 0));
    def = frame();
    std::memcpy(def.view, glm::value_ptr(glm::transpose(view)), sizeof def.view);
    EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(has(fxGetLastErrorMessage(), "frame.view looks row-major: transpose it"));
    def.view[3] = def.view[7] = def.view[11] = 0.0f;
    def.view[0] = 2.0f;
    EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(has(fxGetLastErrorMessage(), "frame.view is not a rotation and a translation"));
    EXPECT_EQ(picture(), before);
}
