/// @file stability_row.h
/// Interface of a hard case of fx stability: sweeps over one or two parameters, the error at each point, the
/// limit.
///
/// A new row is a function that makes its sweeps, and a line in the list at the end of its file in
/// benchmarks/stability/rows/; a new file is an entry in the CMakeLists.txt there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

struct StabilityAxis
{
    std::string name; ///< with unit, lower case
    std::vector<double> values;
};

/// Powers of ten from `from` to `to`. A quick axis has a fifth of the steps, and 4 at least.
StabilityAxis powersOfTen(std::string name, double from, double to, uint32_t perDecade, bool isQuick);
/// `steps` equal steps. A quick axis has a fifth of them, and 4 at least.
StabilityAxis evenSteps(std::string name, double from, double to, uint32_t steps, bool isQuick);
StabilityAxis values(std::string name, std::vector<double> list);

struct StabilitySweep
{
    std::string name;
    StabilityAxis x, y;
    double limit = 0;       ///< of the error, inclusive; 0: exact
    bool isControl = false; ///< plain code in the same places: has to exceed the limit somewhere
    std::function<double(double x, double y)> error;
};

/// A control of `sweep`: the same places and limit, another error.
StabilitySweep controlOf(const StabilitySweep& sweep, std::string name,
                         std::function<double(double x, double y)> error);

struct StabilityRow
{
    std::string_view id; ///< as in docs/stability.md
    std::string_view says;
    std::string_view reference; ///< reference of the errors
    std::vector<StabilitySweep> (*sweeps)(bool isQuick);
};

/// Rows of one subject.
using StabilityRows = std::vector<StabilityRow>;

/// As rows/CMakeLists.txt lists their files.
const std::vector<StabilityRows>& stabilityRowGroups();
/// All rows, in the order in which they run.
const std::vector<StabilityRow>& stabilityRows();

} // namespace fx::cli
