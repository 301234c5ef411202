#include "fxsdk/cli/support/frame_range.h"

#include <gtest/gtest.h>

namespace fx::cli {
namespace {

TEST(FrameRange, bothEndsAreIncludedAndTwoSecondsAreTheDefault)
{
    const auto range = parseFrameRange("3:17", 30.0);
    ASSERT_TRUE(range.ok());
    EXPECT_EQ(range->first, 3);
    EXPECT_EQ(range->last, 17);
    EXPECT_EQ(parseFrameRange("", 24.0)->last, 47);
}

TEST(FrameRange, anythingElseIsRefusedWithTheAllowedForm)
{
    for (const char* text : {"3", "3:", ":3", "5:3", "-1:3", "1:2:3", "a:b", "0:2000000"}) {
        const auto range = parseFrameRange(text, 1000.0);
        ASSERT_FALSE(range.ok()) << text;
        EXPECT_NE(range.status().message().find("--frames"), std::string::npos);
    }
    EXPECT_FALSE(parseFrameRange("0:7200", 1.0).ok()); // beyond the first hour
}

TEST(FrameRange, oneFileHasOneMomentAndASequenceThoseOfItsRange)
{
    const auto still = listFrames({std::nullopt, "", 30.0}, true, 0.5, "a sequence", "a still");
    ASSERT_EQ(still->size(), 1u);
    EXPECT_EQ(still->front().tick, base::toTicks(0.5));
    EXPECT_EQ(listFrames({2.0, "", 30.0}, true, 0.5, "a sequence", "a still")->front().tick,
              base::toTicks(2.0));
    const auto frames = listFrames({std::nullopt, "3:5", 10.0}, false, 0.5, "a sequence", "a still");
    ASSERT_EQ(frames->size(), 3u);
    EXPECT_EQ(frames->back().number, 5);
    EXPECT_EQ(frames->back().tick, base::toTicks(0.5));
    const auto range = listFrames({std::nullopt, "3:5", 10.0}, true, 0.5, "a sequence", "a still");
    EXPECT_EQ(range.status().message(), "--frames needs a sequence");
    const auto time = listFrames({1.0, "", 10.0}, false, 0.5, "a sequence", "a still");
    EXPECT_EQ(time.status().message(), "--time needs a still");
}

} // namespace
} // namespace fx::cli
