/// @file grid_command.cpp
/// fx grid: numbers of other programs as a grid that presets can name (*.fxgrid).

#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/grid/grid_import.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr uint64_t kMaxTextBytes = uint64_t(1) << 31; // [byte] of a file that is read

struct GridOptions
{
    std::string input, output;
    std::vector<uint32_t> nodes;
    uint32_t channels = 1;
    std::vector<float> low{0, 0, 0}, cell{1, 1, 1}; ///< [m]
};

base::Result<sim::FieldGrid> readGrid(const GridOptions& options, const std::string& bytes)
{
    if (options.nodes.empty())
        return gridFromCsv(bytes);
    sim::FieldGrid shape;
    shape.nodes = {options.nodes[0], options.nodes[1], options.nodes[2]};
    shape.low = {options.low[0], options.low[1], options.low[2]};
    shape.cell = {options.cell[0], options.cell[1], options.cell[2]};
    shape.channels = options.channels;
    return gridFromRaw(bytes, shape);
}

base::Status runGrid(const GridOptions& options)
{
    const base::Result<std::string> bytes = asset::readFile(options.input, kMaxTextBytes);
    if (!bytes)
        return bytes.status();
    const base::Result<sim::FieldGrid> grid = readGrid(options, *bytes);
    if (!grid)
        return {grid.status().code(), options.input + ": " + grid.status().message()};
    const std::string file = writeFieldGrid(*grid);
    if (const auto readBack = sim::parseFieldGrid(file); !readBack)
        return {readBack.status().code(), options.input + ": " + readBack.status().message()};
    if (base::Status status = writeFileAtomically(options.output, file); !status)
        return status;
    const auto [least, most] = std::minmax_element(grid->values.begin(), grid->values.end());
    std::printf("%s: %u x %u x %u nodes, %u %s, from (%g, %g, %g) m every (%g, %g, %g) m, values %g to %g\n",
                options.output.c_str(), grid->nodes.x, grid->nodes.y, grid->nodes.z, grid->channels,
                grid->channels == 1 ? "channel" : "channels", double(grid->low.x), double(grid->low.y),
                double(grid->low.z), double(grid->cell.x), double(grid->cell.y), double(grid->cell.z),
                double(*least), double(*most));
    return {};
}

} // namespace

void addGridCommand(CLI::App& app, int& outExitCode)
{
    auto options = std::make_shared<GridOptions>();
    CLI::App* command = app.add_subcommand(
        "grid",
        "Make a grid (*.fxgrid) for volumes, vector fields and heights from lines x,y,z,value or from "
        "raw floats");
    command->add_option("FILE", options->input, "Lines x,y,z,value or x,y,z,vx,vy,vz; with --nodes, floats")
        ->required();
    command->add_option("-o,--output", options->output, "*.fxgrid")->required();
    CLI::Option* nodes =
        command->add_option("--nodes", options->nodes, "NX NY NZ of raw little-endian floats")
            ->expected(3)
            ->check(CLI::Range(1u, sim::kMaxGridNodesPerAxis));
    command->add_option("--channels", options->channels, "Of raw floats: 1 or 3; default 1")
        ->check(CLI::IsMember({1u, 3u}))
        ->needs(nodes);
    command->add_option("--low", options->low, "[m] X Y Z of the first of raw floats; default 0 0 0")
        ->expected(3)
        ->needs(nodes);
    command->add_option("--cell", options->cell, "[m] X Y Z between raw floats; default 1 1 1")
        ->expected(3)
        ->check(CLI::Range(1e-6f, 1e6f))
        ->needs(nodes);
    command->callback([options, &outExitCode] {
        const bool isGrid = options->output.ends_with(".fxgrid");
        const base::Status status =
            isGrid ? runGrid(*options)
                   : base::Status(base::Code::InvalidArgument,
                                  options->output + ": the name of a grid ends in .fxgrid");
        if (!status)
            std::fprintf(stderr, "fx grid: %s\n", status.message().c_str());
        outExitCode = status.ok() ? kSuccess : isGrid ? kFailed : kUsage;
    });
}

} // namespace fx::cli
