/// Arguments of the reference renderer.

#include "fxsdk/cli/render/reference_options.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace fx::cli {
namespace {

TEST(ReferenceOptions, aViewIsEyeTargetAndVerticalAngle)
{
    const auto camera = parseView("1,2,3,1,2,-7,90");
    ASSERT_TRUE(camera.ok()) << camera.status().message();
    EXPECT_EQ(camera->eye, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_NEAR(glm::length(camera->forward - glm::dvec3(0.0, 0.0, -1.0)), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(camera->right - glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-15);
    EXPECT_NEAR(camera->halfHeight, 1.0, 1e-15);
    EXPECT_EQ(camera->nearDistance, 0.0);
}

TEST(ReferenceOptions, aViewStraightDownIsAllowed)
{
    const auto camera = parseView("0,10,0,0,0,0,45");
    ASSERT_TRUE(camera.ok());
    EXPECT_NEAR(glm::length(camera->right), 1.0, 1e-12);
    EXPECT_NEAR(camera->up.z, -1.0, 1e-12);
}

TEST(ReferenceOptions, viewsThatMakeNoSenseAreRefusedByName)
{
    for (const char* text :
         {"", "1,2,3", "1,2,3,4,5,6", "1,2,3,4,5,6,7,8", "1,2,3,4,5,6,x", "1,2,3,1,2,3,45", "1,2,3,4,5,6,0",
          "1,2,3,4,5,6,180", "1,2,3,4,5,6,nan", "inf,2,3,4,5,6,45", "1,2,3,4,5,6,45 "})
    {
        const auto camera = parseView(text);
        ASSERT_FALSE(camera.ok()) << text;
        EXPECT_EQ(camera.status().code(), base::Code::InvalidArgument);
        EXPECT_NE(camera.status().message().find("--view"), std::string::npos);
    }
}

TEST(ReferenceOptions, aPictureMustFitIntoTheMachine)
{
    constexpr uint64_t kNeeded = 1024ull * 512 * 4 * (22 + 20 + 22);
    EXPECT_TRUE(checkPictureMemory(1024, 512, kNeeded).ok());
    EXPECT_TRUE(checkPictureMemory(16384, 16384, 0).ok()); // the system does not say
    const base::Status refused = checkPictureMemory(1024, 512, kNeeded / 4);
    EXPECT_EQ(refused.code(), base::Code::OutOfMemory);
    EXPECT_NE(refused.message().find(std::to_string(kNeeded)), std::string::npos) << refused.message();
    EXPECT_NE(refused.message().find("at most 512x256"), std::string::npos) << refused.message();
    EXPECT_TRUE(checkPictureMemory(512, 256, kNeeded / 4).ok());
}

TEST(ReferenceOptions, schemesAreKnownByName)
{
    ReferenceArguments arguments;
    EXPECT_TRUE(planReference(arguments).ok());
    arguments.integrator = "paper-4";
    EXPECT_EQ(planReference(arguments)->integral.scheme.method, render::IntegralMethod::Paper);
    arguments.integrator = "gauss-6";
    EXPECT_EQ(planReference(arguments).status().code(), base::Code::InvalidArgument);
}

TEST(ReferenceOptions, aViewAndACameraExcludeEachOther)
{
    ReferenceArguments arguments;
    arguments.view = "0,0,5,0,0,0,45";
    EXPECT_TRUE(planReference(arguments)->camera.has_value());
    arguments.camera = "a.scene.json";
    EXPECT_FALSE(planReference(arguments).ok());
}

} // namespace
} // namespace fx::cli
