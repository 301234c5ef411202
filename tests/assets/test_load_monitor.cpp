#include "fxsdk/assets/load_monitor.h"

#include <gtest/gtest.h>

#include <string>

using fx::asset::LoadCanceled;
using fx::asset::LoadMonitor;

TEST(LoadMonitor, beginsAtNothing)
{
    const LoadMonitor monitor;
    EXPECT_EQ(monitor.progress().fraction, 0.0f);
    EXPECT_EQ(monitor.progress().filesRead, 0u);
    EXPECT_STREQ(monitor.progress().item.data(), "");
}

TEST(LoadMonitor, filesOfAPartStayWithinIt)
{
    LoadMonitor monitor;
    monitor.beginPart("emitters 1 of 2", 0.2f, 0.6f);
    EXPECT_EQ(monitor.progress().fraction, 0.2f);
    EXPECT_STREQ(monitor.progress().item.data(), "emitters 1 of 2");
    float last = 0.2f;
    for (int i = 0; i < 10; ++i) {
        monitor.beginFile("a.png");
        EXPECT_GE(monitor.progress().fraction, last);
        EXPECT_LE(monitor.progress().fraction, 0.6f);
        last = monitor.progress().fraction;
    }
    EXPECT_STREQ(monitor.progress().item.data(), "a.png");
    EXPECT_EQ(monitor.progress().filesRead, 10u);
}

TEST(LoadMonitor, dividesAPartIntoAKnownNumberOfFiles)
{
    LoadMonitor monitor;
    monitor.beginPart("volumes 1 of 1", 0.0f, 1.0f);
    monitor.divide(3);
    for (int i = 1; i <= 3; ++i) {
        monitor.beginFile("frame");
        EXPECT_NEAR(monitor.progress().fraction, 0.25f * float(i), 1e-6f);
    }
}

TEST(LoadMonitor, neverGoesBack)
{
    LoadMonitor monitor;
    monitor.beginPart("late", 0.8f, 1.0f);
    monitor.beginPart("early", 0.1f, 0.2f);
    EXPECT_EQ(monitor.progress().fraction, 0.8f);
}

TEST(LoadMonitor, cutsLongNamesBetweenLetters)
{
    LoadMonitor monitor;
    const std::string name(LoadMonitor::kItemBytes - 2, 'x');
    monitor.beginPart(name + "\xC3\xA9", 0.0f, 1.0f); // the last letter has two bytes
    EXPECT_EQ(monitor.progress().item.data(), name);
    monitor.beginPart(std::string(LoadMonitor::kItemBytes - 3, 'x') + "\xC3\xA9", 0.0f, 1.0f);
    EXPECT_EQ(std::string(monitor.progress().item.data()).size(), LoadMonitor::kItemBytes - 1);
}

TEST(LoadMonitor, endsACanceledLoadAtItsNextPartFileOrCheck)
{
    LoadMonitor monitor;
    EXPECT_FALSE(monitor.isCanceled());
    EXPECT_NO_THROW(monitor.check());
    monitor.beginPart("first", 0.0f, 0.5f);
    monitor.cancel();
    EXPECT_TRUE(monitor.isCanceled());
    EXPECT_THROW(monitor.beginPart("second", 0.5f, 1.0f), LoadCanceled);
    EXPECT_THROW(monitor.beginFile("a.png"), LoadCanceled);
    EXPECT_THROW(monitor.check(), LoadCanceled);
    EXPECT_STREQ(monitor.progress().item.data(), "first");
}
