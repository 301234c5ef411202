#include "fxsdk/cli/support/progress.h"

#include <gtest/gtest.h>

namespace fx::cli {
namespace {

TEST(Progress, theTimeLeftIsTheElapsedTimeScaledByWhatRemains)
{
    const std::string text = progressText("frame", 15, 60, 10.0);
    EXPECT_NE(text.find("frame 15/60"), std::string::npos);
    EXPECT_NE(text.find("25 %"), std::string::npos);
    EXPECT_NE(text.find("30 s left"), std::string::npos);
}

TEST(Progress, noTimeIsPromisedBeforeTheFirstPartAndAfterTheLast)
{
    EXPECT_EQ(progressText("frame", 0, 60, 5.0).find("left"), std::string::npos);
    EXPECT_EQ(progressText("frame", 60, 60, 5.0).find("left"), std::string::npos);
}

TEST(Progress, theBarIsEmptyAtTheStartAndFullAtTheEnd)
{
    EXPECT_EQ(progressText("x", 0, 4, 0.0).find('#'), std::string::npos);
    const std::string full = progressText("x", 4, 4, 1.0);
    EXPECT_EQ(full.find(' ', full.find('[')), full.find("] ") + 1);
}

TEST(Progress, longTimesAreRoundedUpToMinutes)
{
    EXPECT_NE(progressText("x", 1, 2, 121.0).find("3 min left"), std::string::npos);
}

TEST(Progress, nothingToDoIsDone)
{
    EXPECT_NE(progressText("x", 0, 0, 0.0).find("100 %"), std::string::npos);
}

} // namespace
} // namespace fx::cli
