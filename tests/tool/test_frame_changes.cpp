#include "benchmarks/scenes/frame_changes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fx::cli {
namespace {

/// A picture of `count` pixels that fade evenly, but for a pixel that jumps.
std::vector<float> fading(size_t count, float light, float jump = 0.0f)
{
    std::vector<float> picture(count, light);
    picture[0] += jump;
    return picture;
}

} // namespace

TEST(FrameChanges, areThoseOfPixelsThatAreCoveredInEitherFrame)
{
    const std::vector<float> before{1.0f, 2.0f, 3.0f, 4.0f}, after{2.0f, 2.0f, 1.0f, 9.0f};
    EXPECT_DOUBLE_EQ(meanChange(before, after, {true, true, false, false}, {false, true, true, false}), 1.0);
    EXPECT_DOUBLE_EQ(meanChange(before, after, {false, false, false, false}, {false, false, false, false}),
                     0.0);
    EXPECT_DOUBLE_EQ(meanChange(before, before, {true, true, true, true}, {true, true, true, true}), 0.0);
}

TEST(FrameChanges, theReferenceKeepsEveryBound)
{
    const std::vector<double> reference{0.1, 0.2, 0.0, 0.4};
    for (const double factor : {1.01, 1.5, 4.0}) {
        const ChangeJudgment judgment = judgeChanges(reference, reference, {factor, 0.1});
        EXPECT_TRUE(judgment.isKept());
        for (const double excess : judgment.excess)
            EXPECT_DOUBLE_EQ(excess, 0.0);
    }
}

TEST(FrameChanges, excessOfOneIsTheBoundItself)
{
    const std::vector<double> reference{0.1, 0.2, 0.3, 0.4, 0.5}; // median 0.3
    std::vector<double> changes;
    for (const double change : reference)
        changes.push_back(1.5 * change + 0.03);
    for (const double excess : judgeChanges(changes, reference, {1.5, 0.1}).excess)
        EXPECT_NEAR(excess, 1.0, 1e-12);
    changes[3] += 1e-3;
    const ChangeJudgment judgment = judgeChanges(changes, reference, {1.5, 0.1});
    EXPECT_GE(judgment.beyond, 1u);
    EXPECT_EQ(judgment.worst, 3u);
    EXPECT_FALSE(judgment.isKept());
    EXPECT_DOUBLE_EQ(judgment.medianReference, 0.3);
}

TEST(FrameChanges, aSingleFrameThatJumpsIsFoundHoweverManyKeepTheBound)
{
    const size_t frames = 500, pixels = 100;
    const std::vector<bool> all(pixels, true);
    std::vector<double> changes, reference;
    for (size_t k = 0; k + 1 < frames; ++k) {
        const float now = 1e-3f * float(k), next = 1e-3f * float(k + 1);
        reference.push_back(meanChange(fading(pixels, now), fading(pixels, next), all, all));
        changes.push_back(
            meanChange(fading(pixels, now), fading(pixels, next, k == 77 ? 0.1f : 0.0f), all, all));
    }
    const ChangeJudgment judgment = judgeChanges(changes, reference, {});
    EXPECT_EQ(judgment.beyond, 1u);
    EXPECT_EQ(judgment.worst, 77u);
    EXPECT_NEAR(judgment.medianRatio, 1.0, 1e-3);
}

TEST(FrameChanges, lessChangeThanTheReferenceIsNoExcess)
{
    const ChangeJudgment judgment =
        judgeChanges(std::vector<double>{0.0, 0.05}, std::vector<double>{0.1, 0.1}, {});
    EXPECT_TRUE(judgment.isKept());
    EXPECT_DOUBLE_EQ(judgment.excess[0], 0.0);
}

TEST(FrameChanges, whatIsNoNumberBreaksTheBound)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ChangeJudgment judgment =
        judgeChanges(std::vector<double>{0.1, nan}, std::vector<double>{0.1, 0.1}, {});
    EXPECT_EQ(judgment.beyond, 1u);
    EXPECT_TRUE(std::isinf(judgment.excess[1]));
}

} // namespace fx::cli
