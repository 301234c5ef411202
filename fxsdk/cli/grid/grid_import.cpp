#include "fxsdk/cli/grid/grid_import.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {

namespace {

using base::Code;
using base::Status;

constexpr double kUneven = 1e-3; // of a cell: how far places may lie off the grid

Status atLine(size_t line, const std::string& what)
{
    return {Code::Parse, "line " + std::to_string(line) + ": " + what};
}

struct Row
{
    size_t line;
    std::array<double, 3> place;
    std::array<float, 3> value;
};

/// The numbers of a line, at most seven; nothing when one is none.
std::optional<std::vector<double>> numbersOf(std::string_view line)
{
    constexpr std::string_view kBetween = ",; \t\r";
    std::vector<double> numbers;
    for (size_t at = line.find_first_not_of(kBetween); at != std::string_view::npos && numbers.size() < 7;) {
        const std::string_view word = line.substr(at, line.find_first_of(kBetween, at) - at);
        double number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
            return std::nullopt;
        numbers.push_back(number);
        at = line.find_first_not_of(kBetween, at + word.size());
    }
    return numbers;
}

/// @param outChannels of all rows
Status readRows(std::string_view text, std::vector<Row>& rows, uint32_t& outChannels)
{
    bool mayBeTitle = true;
    for (size_t line = 1; !text.empty(); ++line) {
        const std::string_view here = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(here.size() + 1, text.size()));
        const bool isBlank = here.find_first_not_of(" \t\r") == std::string_view::npos;
        if (isBlank || here.front() == '#')
            continue;
        const auto numbers = numbersOf(here);
        const char first = here[here.find_first_not_of(" \t\r")];
        const bool isTitle =
            mayBeTitle && !numbers && std::string_view("+-.0123456789").find(first) == std::string_view::npos;
        mayBeTitle = false;
        if (isTitle)
            continue;
        if (!numbers || (numbers->size() != 4 && numbers->size() != 6))
            return atLine(line, "expected x,y,z,value or x,y,z,vx,vy,vz");
        const uint32_t channels = uint32_t(numbers->size()) - 3;
        if (!rows.empty() && channels != outChannels)
            return atLine(line, "found " + std::to_string(channels) + " channels after " +
                                    std::to_string(outChannels));
        outChannels = channels;
        if (rows.size() >= sim::kMaxGridNodes)
            return {Code::TooLarge, "more than " + std::to_string(sim::kMaxGridNodes) + " nodes"};
        Row& row = rows.emplace_back(Row{line, {(*numbers)[0], (*numbers)[1], (*numbers)[2]}, {}});
        for (uint32_t c = 0; c < channels; ++c)
            row.value[c] = float((*numbers)[3 + c]);
    }
    return rows.empty() ? Status(Code::Parse, "no line with numbers") : Status();
}

/// Places of nodes along one axis, not rounded yet.
struct Axis
{
    double low = 0;  ///< [m]
    double cell = 1; ///< [m]
};

/// Nodes along one axis, from the places of all rows.
Axis measureAxis(const std::vector<Row>& rows, size_t axis, sim::FieldGrid& grid)
{
    std::vector<double> places;
    for (const Row& row : rows)
        places.push_back(row.place[axis]);
    std::sort(places.begin(), places.end());
    const double extent = places.back() - places.front();
    const double same = 1e-6 * std::max(extent, 1e-6); // closer ones are one node
    uint32_t nodes = 1;
    for (size_t i = 1; i < places.size(); ++i)
        nodes += places[i] - places[i - 1] > same ? 1 : 0;
    const int a = int(axis);
    grid.nodes[a] = nodes;
    const Axis out{places.front(), nodes > 1 ? extent / double(nodes - 1) : 1.0};
    grid.low[a] = float(out.low);
    grid.cell[a] = float(out.cell);
    return out;
}

Status place(const std::vector<Row>& rows, const std::array<Axis, 3>& axes, sim::FieldGrid& grid)
{
    std::vector<bool> taken(grid.count());
    for (const Row& row : rows) {
        glm::uvec3 node(0u);
        for (size_t axis = 0; axis < 3; ++axis) {
            const int a = int(axis);
            const double cells = (row.place[axis] - axes[axis].low) / axes[axis].cell;
            node[a] = uint32_t(std::clamp(std::lround(cells), 0L, long(grid.nodes[a]) - 1));
            if (std::abs(cells - double(node[a])) > kUneven)
                return atLine(row.line, "the place lies between the nodes of a regular grid");
        }
        const size_t index = grid.index(node.x, node.y, node.z);
        if (taken[index / grid.channels])
            return atLine(row.line, "the place occurs twice");
        taken[index / grid.channels] = true;
        std::copy_n(row.value.begin(), grid.channels, grid.values.begin() + std::ptrdiff_t(index));
    }
    return {};
}

/// What a file may hold.
Status checkShape(const sim::FieldGrid& grid)
{
    for (int a = 0; a < 3; ++a)
        if (grid.nodes[a] < 1 || grid.nodes[a] > sim::kMaxGridNodesPerAxis)
            return {Code::TooLarge, "found " + std::to_string(grid.nodes[a]) +
                                        " nodes along an axis; allowed are 1 to " +
                                        std::to_string(sim::kMaxGridNodesPerAxis)};
    if (grid.count() > sim::kMaxGridNodes)
        return {Code::TooLarge, "more than " + std::to_string(sim::kMaxGridNodes) + " nodes"};
    return {};
}

} // namespace

base::Result<sim::FieldGrid> gridFromCsv(std::string_view text)
{
    std::vector<Row> rows;
    sim::FieldGrid grid;
    if (Status status = readRows(text, rows, grid.channels); !status)
        return status;
    std::array<Axis, 3> axes;
    for (size_t axis = 0; axis < 3; ++axis)
        axes[axis] = measureAxis(rows, axis, grid);
    if (Status status = checkShape(grid); !status)
        return status;
    if (grid.count() != rows.size())
        return Status(Code::Parse, "found " + std::to_string(rows.size()) +
                                       " places; a regular grid with these has " +
                                       std::to_string(grid.nodes.x) + " x " + std::to_string(grid.nodes.y) +
                                       " x " + std::to_string(grid.nodes.z));
    grid.values.resize(grid.count() * grid.channels);
    if (Status status = place(rows, axes, grid); !status)
        return status;
    return grid;
}

base::Result<sim::FieldGrid> gridFromRaw(std::string_view bytes, const sim::FieldGrid& shape)
{
    sim::FieldGrid grid = shape;
    if (Status status = checkShape(grid); !status)
        return status;
    const size_t numbers = grid.count() * grid.channels;
    if (bytes.size() != 4 * numbers)
        return Status(Code::Parse, "found " + std::to_string(bytes.size()) + " bytes; " +
                                       std::to_string(numbers) + " numbers of 4 bytes are needed");
    for (size_t i = 0; i < numbers; ++i) {
        uint32_t word = 0;
        for (size_t k = 0; k < 4; ++k)
            word |= uint32_t(static_cast<unsigned char>(bytes[4 * i + k])) << (8 * k);
        grid.values.push_back(std::bit_cast<float>(word));
        if (!std::isfinite(grid.values.back()))
            return Status(Code::InvalidArgument, "number " + std::to_string(i) + " is not finite");
    }
    return grid;
}

} // namespace fx::cli
