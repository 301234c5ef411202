/// @file stability_row.h
/// What fx stability needs of a hard case: sweeps over one or two parameters, the error at each place, the
/// limit.
///
/// A new row is a function that makes its sweeps, and a line in the list in stability_rows.cpp.
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
    std::string_view reference; ///< what errors are measured against
    std::vector<StabilitySweep> (*sweeps)(bool isQuick);
};

/// All rows, in the order in which they run.
const std::vector<StabilityRow>& stabilityRows();

std::vector<StabilityRow> rayMomentRows();
std::vector<StabilityRow> rayLightRows();
std::vector<StabilityRow> rayEventRows();
std::vector<StabilityRow> rayPlaceRows();
std::vector<StabilityRow> rayRangeRows();
std::vector<StabilityRow> billboardRows();
std::vector<StabilityRow> layerRows();
std::vector<StabilityRow> heatRows();
std::vector<StabilityRow> dazzleRows();
std::vector<StabilityRow> dazzleLightRows();

} // namespace fx::cli
