// Grids of numbers: *.fxgrid files, and the lines and raw numbers that `fx grid` imports.
#include "fxsdk/cli/grid/grid_import.h"
#include "tests/fuzz/fuzz_target.h"

#include <algorithm>
#include <cmath>

namespace fx::fuzz {

namespace {

/// What `fx grid` writes is refused when it is read back, or is read as it was.
void checkGrid(const sim::FieldGrid& grid)
{
    const auto read = sim::parseFieldGrid(sim::writeFieldGrid(grid));
    if (!read) {
        require(!read.status().message().empty(), "a refused grid has a message");
        return;
    }
    require((*read)->nodes == grid.nodes && (*read)->values == grid.values,
            "a written grid is read as it was");
}

/// What is behind every field and density.
void checkFile(const sim::FieldGrid& grid)
{
    require(grid.count() >= 1 && grid.count() <= sim::kMaxGridNodes, "a grid has 1 to 2^24 nodes");
    require(grid.channels == 1 || grid.channels == 3, "a grid has 1 or 3 channels");
    require(grid.values.size() == grid.count() * grid.channels, "a grid has one number a node and channel");
    require(std::all_of(grid.values.begin(), grid.values.end(), [](float x) { return std::isfinite(x); }),
            "the numbers of a grid are finite");
    require(sim::parseFieldGrid(sim::writeFieldGrid(grid)).ok(),
            "a grid that was read can be written and read again");
    checkGrid(grid);
}

sim::FieldGrid shapeOf(InputReader& reader)
{
    sim::FieldGrid shape;
    shape.nodes = {1 + reader.below(8), 1 + reader.below(8), 1 + reader.below(8)};
    shape.channels = reader.one(2) ? 1 : 3;
    shape.cell = {0.5f, 1.0f, 2.0f};
    return shape;
}

} // namespace

/// The first byte chooses the format.
void runInput(std::span<const uint8_t> input)
{
    InputReader reader(input);
    const uint8_t format = reader.byte();
    if (format == 'g') {
        if (const auto grid = sim::parseFieldGrid(textOf(reader.rest())))
            checkFile(**grid);
    } else if (format == 'r') {
        const sim::FieldGrid shape = shapeOf(reader);
        if (const auto grid = cli::gridFromRaw(textOf(reader.rest()), shape))
            checkGrid(*grid);
    } else if (const auto grid = cli::gridFromCsv(textOf(reader.rest()))) {
        checkGrid(*grid);
    }
}

std::vector<std::string> seeds()
{
    sim::FieldGrid grid;
    grid.nodes = {2, 3, 1};
    grid.channels = 3;
    grid.low = {-1.0f, 0.5f, 2.0f};
    grid.values.assign(18, 0.25f);
    const std::string raw(size_t(2) * 2 * 2 * sizeof(float), '\0');
    return {
        "g" + sim::writeFieldGrid(grid),
        "gfxgrid 1\nnodes 4096 4096 1\nchannels 1\nlow 0 0 0\ncell 1 1 1\ndata\n",
        "gfxgrid 1\nnodes 1 1 1\nchannels 1\nlow -1e30 0 0\ncell 1e-30 1 1\ndata\nabcd",
        std::string("r\x01\x01\x01\0", 5) + raw,
        "cx,y,z,value\n0,0,0,1\n1,0,0,2\n0,1,0,3\n1,1,0,4\n",
        "c# winds\n0 0 0 1 0 0\n0 0 1 0 1 0\n\n0 0 2 0 0 1e-3\n",
        "c0;0;0;1\n0;0;1e-9;2\n",
        "c-1e300,0,0,1\n1e300,0,0,2\n",
    };
}

} // namespace fx::fuzz
