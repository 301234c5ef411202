#include "foundation/result/status.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

using namespace fx::base;

TEST(Status, startsAsSuccess)
{
    const Status status;
    EXPECT_TRUE(status.ok());
    EXPECT_TRUE(status.message().empty());
}

TEST(Status, anErrorKeepsItsCodeAndMessage)
{
    const Status status(Code::NotFound, "no such file");
    EXPECT_FALSE(status);
    EXPECT_EQ(status.code(), Code::NotFound);
    EXPECT_EQ(status.message(), "no such file");
}

TEST(Status, everyCodeHasItsOwnName)
{
    std::set<std::string> names;
    for (int code = 0; code >= -17; --code)
        names.insert(codeName(Code(code)));
    names.insert(codeName(Code::Internal));
    EXPECT_EQ(names.size(), 19u);
    EXPECT_EQ(names.count("unknown"), 0u);
    EXPECT_STREQ(codeName(Code(-50)), "unknown");
}

TEST(Result, holdsAValueOrAnError)
{
    const Result<int> good(7);
    const Result<int> bad(Status(Code::Parse, "line 3"));
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(*good, 7);
    EXPECT_FALSE(bad);
    EXPECT_EQ(bad.status().code(), Code::Parse);
}

TEST(Result, canHoldWhatOnlyMoves)
{
    Result<std::unique_ptr<int>> result(std::make_unique<int>(5));
    const std::unique_ptr<int> taken = std::move(*result);
    EXPECT_EQ(*taken, 5);
}
