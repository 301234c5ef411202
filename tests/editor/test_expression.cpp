#include "fxsdk/editor/inspector/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::editor {
namespace {

double valueOf(std::string_view text, std::string_view unit = {})
{
    const auto value = evaluate(text, unit);
    EXPECT_TRUE(value.ok()) << value.status().message();
    return value.ok() ? *value : std::nan("");
}

TEST(Expression, arithmeticHasTheUsualPrecedence)
{
    EXPECT_DOUBLE_EQ(valueOf("1 + 2*3"), 7);
    EXPECT_DOUBLE_EQ(valueOf("(1 + 2)*3"), 9);
    EXPECT_DOUBLE_EQ(valueOf("-2^2"), -4);
    EXPECT_DOUBLE_EQ(valueOf("2^3^2"), 512);
    EXPECT_DOUBLE_EQ(valueOf("8/4/2"), 1);
    EXPECT_DOUBLE_EQ(valueOf("10 - -3"), 13);
    EXPECT_DOUBLE_EQ(valueOf("1.5e3"), 1500);
    EXPECT_DOUBLE_EQ(valueOf("2*pi"), 2 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(valueOf("max(2, sqrt(16)) + min(1, 2)"), 5);
}

TEST(Expression, unitsAreConvertedToThatOfTheMember)
{
    EXPECT_DOUBLE_EQ(valueOf("30 cm", "m"), 0.3);
    EXPECT_DOUBLE_EQ(valueOf("1 m + 25 cm", "m"), 1.25);
    EXPECT_DOUBLE_EQ(valueOf("(2 + 3) cm", "m"), 0.05);
    EXPECT_DOUBLE_EQ(valueOf("36 km/h", "m/s"), 10);
    EXPECT_DOUBLE_EQ(valueOf("20 C", "K"), 293.15);
    EXPECT_DOUBLE_EQ(valueOf("pi rad", "degree"), 180);
    EXPECT_DOUBLE_EQ(valueOf("2 g", "m/s2"), 19.6133);
    EXPECT_DOUBLE_EQ(valueOf("2 g", "kg"), 0.002);
    EXPECT_DOUBLE_EQ(valueOf("250ms", "s"), 0.25);
    EXPECT_DOUBLE_EQ(valueOf("50%"), 0.5);
    EXPECT_DOUBLE_EQ(valueOf("3", "furlong"), 3);
}

TEST(Expression, mistakesAreNamedWithTheirPlace)
{
    const auto message = [](std::string_view text, std::string_view unit = {}) {
        const auto value = evaluate(text, unit);
        return value.ok() ? std::string("accepted") : value.status().message();
    };
    EXPECT_NE(message("2 kg", "m").find("units are mm cm m km"), std::string::npos);
    EXPECT_NE(message("1 + ").find("missing at the end"), std::string::npos);
    EXPECT_NE(message("(1").find("not closed"), std::string::npos);
    EXPECT_NE(message("1/0").find("not a finite"), std::string::npos);
    EXPECT_NE(message("sqrt(-1)").find("not a finite"), std::string::npos);
    EXPECT_NE(message("1 2").find("character 3"), std::string::npos);
    EXPECT_NE(message("foo").find("unknown"), std::string::npos);
    EXPECT_NE(message(std::string(1000, '(')).find("nested"), std::string::npos);
    EXPECT_NE(message(std::string(100000, '-')).find("nested"), std::string::npos);
    EXPECT_NE(message(""), "accepted");
}

} // namespace
} // namespace fx::editor
