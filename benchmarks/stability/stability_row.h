/// @file stability_row.h
/// Interface of a hard case ("row") of fx stability: sweeps over one or two parameters, the error at each
/// point, and its limit.
///
/// To add a row, add a function that creates its sweeps, and a line in the list at the end of the file in
/// benchmarks/stability/rows/. A new file also needs an entry in the CMakeLists.txt of this folder.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

struct StabilityAxis
{
    std::string name; ///< name of the parameter with its unit, lower case
    std::vector<double> values;
};

/// Powers of ten from `from` to `to`. A quick axis has a fifth of the steps, but at least 4.
StabilityAxis powersOfTen(std::string name, double from, double to, uint32_t perDecade, bool isQuick);
/// `steps` equal steps. A quick axis has a fifth of these steps, but at least 4.
StabilityAxis evenSteps(std::string name, double from, double to, uint32_t steps, bool isQuick);
StabilityAxis values(std::string name, std::vector<double> list);

struct StabilitySweep
{
    std::string name;
    StabilityAxis x, y;
    double limit = 0; ///< upper limit of the error, inclusive; 0: exact
    /// true: `error` is the error of naive code, which must exceed the limit at one point or more
    bool isControl = false;
    std::function<double(double x, double y)> error;
};

/// A control of `sweep`: the same points and limit, with another error function.
StabilitySweep controlOf(const StabilitySweep& sweep, std::string name,
                         std::function<double(double x, double y)> error);

struct StabilityRow
{
    std::string_view id; ///< identifier of the row, as in docs/stability.md
    std::string_view says;
    std::string_view reference; ///< reference of the errors
    std::vector<StabilitySweep> (*sweeps)(bool isQuick);
};

/// Rows of one subject.
using StabilityRows = std::vector<StabilityRow>;

/// Groups of rows, in the order in which rows/CMakeLists.txt lists their files.
const std::vector<StabilityRows>& stabilityRowGroups();
/// All rows, in the order in which they run.
const std::vector<StabilityRow>& stabilityRows();

} // namespace fx::cli
