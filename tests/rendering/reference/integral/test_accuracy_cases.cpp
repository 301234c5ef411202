#include "ray_cases.h"
#include "rendering/reference/integral/accuracy_cases.h"

#include <gtest/gtest.h>

namespace fx::render {
namespace {

TEST(AccuracyCases, showTheDefaultSchemeAHundredTimesBetterThanThePublishedOneAndAThousandTimesWhereItIsThick)
{
    for (const auto& [depth, ratio] :
         std::initializer_list<std::pair<double, double>>{{1.0, 100.0}, {100.0, 1000.0}})
    {
        const PacketPicture<float> picture = ballOfBlobs<float>(depth, 480, 300, 601);
        const PacketPicture<double> exact = ballOfBlobs<double>(depth, 480, 300, 601);
        const std::vector<std::array<double, 3>> reference = referenceLight(exact, {});
        const IntegralError paper = integralError(picture, settingsOf("paper-1"), reference);
        const IntegralError gauss = integralError(picture, settingsOf("gauss-5"), reference);
        EXPECT_GT(paper.p99, ratio * gauss.p99) << depth;
        EXPECT_LE(gauss.median, gauss.p99);
        EXPECT_LE(gauss.p99, gauss.largest);
        EXPECT_GT(gauss.values, 500u);
        if (depth > 50.0) // ends early: less work
            EXPECT_LT(gauss.work.blobSums, paper.work.blobSums);
        else
            EXPECT_EQ(gauss.work.blobSums, paper.work.blobSums);
    }
}

TEST(AccuracyCases, haveTheOpticalDepthTheyAreMadeFor)
{
    const PacketPicture<double> picture = ballOfBlobs<double>(10.0, 8, 8);
    PacketIntegrator<double> integrator(settingsOf("gauss-8"));
    std::vector<PacketLight<double>> lights(picture.packets());
    picture.integrate(integrator, 0, picture.packets(), lights.data());
    ASSERT_EQ(picture.packets(), 4u);
    // pixels are 0.25 m: the four around the center are about as deep as the center
    double mean = 0.0;
    for (const double depth : {lights[0].opticalDepth[15], lights[1].opticalDepth[12],
                               lights[2].opticalDepth[3], lights[3].opticalDepth[0]})
        mean += depth / 4.0;
    EXPECT_NEAR(mean, 10.0, 5.0);
    EXPECT_GT(picture.hits(), 64u * 10);
}

} // namespace
} // namespace fx::render
