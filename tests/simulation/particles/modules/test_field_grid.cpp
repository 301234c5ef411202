#include "simulation/particles/fields/field_grid.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::sim;

namespace {

FieldGrid smallGrid()
{
    FieldGrid grid;
    grid.nodes = {2, 3, 2};
    grid.channels = 3;
    grid.low = {-1.5f, 0.25f, 1e-3f};
    grid.cell = {0.1f, 2.0f, 3.0f};
    for (size_t i = 0; i < grid.count() * 3; ++i)
        grid.values.push_back(0.1f * float(i) - 1.0f);
    return grid;
}

base::Code codeOf(const std::string& bytes)
{
    const auto parsed = parseFieldGrid(bytes);
    EXPECT_FALSE(parsed.ok());
    return parsed.status().code();
}

std::string replaced(std::string text, const std::string& what, const std::string& with)
{
    const size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

} // namespace

TEST(FieldGrid, comesBackFromItsFileBitForBit)
{
    const FieldGrid grid = smallGrid();
    const auto parsed = parseFieldGrid(writeFieldGrid(grid));
    ASSERT_TRUE(parsed.ok()) << parsed.status().message();
    EXPECT_EQ((*parsed)->nodes, grid.nodes);
    EXPECT_EQ((*parsed)->channels, 3u);
    EXPECT_EQ((*parsed)->low, grid.low);
    EXPECT_EQ((*parsed)->cell, grid.cell);
    EXPECT_EQ((*parsed)->values, grid.values);
}

TEST(FieldGrid, whateverIsWrongWithAFileIsAnErrorWithItsPlace)
{
    const std::string good = writeFieldGrid(smallGrid());
    EXPECT_EQ(codeOf(""), base::Code::Parse);
    EXPECT_EQ(codeOf(replaced(good, "fxgrid 1", "fxgrid 2")), base::Code::Version);
    EXPECT_EQ(codeOf(replaced(good, "fxgrid", "fxgrit")), base::Code::Parse);
    EXPECT_EQ(codeOf(replaced(good, "nodes 2", "nodes 0")), base::Code::TooLarge);
    EXPECT_EQ(codeOf(replaced(good, "nodes 2", "nodes -2")), base::Code::Parse);
    EXPECT_EQ(codeOf(replaced(good, "nodes 2 3 2", "nodes 4096 4096 4096")), base::Code::TooLarge);
    EXPECT_EQ(codeOf(replaced(good, "channels 3", "channels 2")), base::Code::InvalidArgument);
    EXPECT_EQ(codeOf(replaced(good, "cell 0.1", "cell 0")), base::Code::InvalidArgument);
    EXPECT_EQ(codeOf(replaced(good, "low -1.5", "low nan")), base::Code::InvalidArgument);
    EXPECT_EQ(codeOf(good + "x"), base::Code::Parse);
    EXPECT_EQ(codeOf(good.substr(0, good.size() - 1)), base::Code::Parse);
    EXPECT_NE(parseFieldGrid(replaced(good, "channels 3", "channels x")).status().message().find("byte 30"),
              std::string::npos)
        << parseFieldGrid(replaced(good, "channels 3", "channels x")).status().message();
}

TEST(FieldGrid, everyTruncatedFileIsRefused)
{
    const std::string good = writeFieldGrid(smallGrid());
    for (size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(parseFieldGrid(std::string_view(good).substr(0, size)).ok()) << size;
}

TEST(FieldGrid, numbersThatAreNotFiniteAreRefused)
{
    FieldGrid grid = smallGrid();
    grid.values[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(codeOf(writeFieldGrid(grid)), base::Code::InvalidArgument);
}
