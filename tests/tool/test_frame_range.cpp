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

} // namespace
} // namespace fx::cli
