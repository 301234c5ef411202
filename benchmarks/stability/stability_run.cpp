#include "benchmarks/stability/stability_run.h"

#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>

namespace fx::cli {
namespace {

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// How near a map is to its limit; exact limits are either kept or broken.
double share(const StabilityMap& map)
{
    if (map.largest == 0.0)
        return 0.0;
    return map.sweep.limit > 0.0 ? map.largest / map.sweep.limit : std::numeric_limits<double>::infinity();
}

void storeError(StabilityMap& map, double x, double y, double error)
{
    const double stored = error >= 0.0 ? error : std::numeric_limits<double>::infinity();
    if (stored > map.largest || map.errors.empty()) {
        map.largest = stored;
        map.atX = x;
        map.atY = y;
    }
    map.errors.push_back(stored);
}

std::string place(const StabilityMap& map)
{
    return map.sweep.x.name + " = " + number(map.atX) + ", " + map.sweep.y.name + " = " + number(map.atY);
}

} // namespace

bool StabilityResult::isAsItMust() const
{
    return std::all_of(maps.begin(), maps.end(), [](const StabilityMap& map) { return map.isAsItMust(); });
}

const StabilityMap& StabilityResult::tightest() const
{
    const StabilityMap* worst = nullptr;
    for (const StabilityMap& map : maps)
        if (!map.sweep.isControl && (worst == nullptr || share(map) > share(*worst)))
            worst = &map;
    return *worst;
}

base::Result<StabilityResult> runStability(const StabilityRow& row, bool isQuick, const RunWatch& watch)
{
    StabilityResult result{row, {}};
    uint64_t all = 0, done = 0;
    for (StabilitySweep& sweep : row.sweeps(isQuick)) {
        all += sweep.x.values.size() * sweep.y.values.size();
        result.maps.push_back({std::move(sweep), {}});
    }
    for (StabilityMap& map : result.maps)
        for (const double y : map.sweep.y.values)
            for (const double x : map.sweep.x.values) {
                if (watch.stop())
                    return interruptedStatus();
                storeError(map, x, y, map.sweep.error(x, y));
                watch.progress(++done, all);
            }
    return result;
}

std::string toText(const StabilityResult& result)
{
    const StabilityMap& worst = result.tightest();
    std::string text = std::string(result.row.id) + (result.isAsItMust() ? " ok      " : " BROKEN  ");
    text += number(worst.largest) + " of " + number(worst.sweep.limit) + ", " + worst.sweep.name;
    if (worst.largest > 0.0)
        text += ", at " + place(worst);
    for (const StabilityMap& map : result.maps)
        if (!map.sweep.isControl && map.exceedsLimit() && &map != &worst)
            text += "; also " + map.sweep.name + ": " + number(map.largest) + " of " +
                    number(map.sweep.limit) + " at " + place(map);
    for (const StabilityMap& map : result.maps)
        if (map.sweep.isControl)
            text += std::string(map.exceedsLimit() ? "; control breaks: " : "; CONTROL HOLDS: ") +
                    map.sweep.name + " " + number(map.largest);
    return text;
}

std::string sweepsText(const StabilityResult& result)
{
    std::string text;
    for (const StabilityMap& map : result.maps)
        text += "  " + map.sweep.name + (map.sweep.isControl ? " (control): " : ": ") + number(map.largest) +
                " of " + number(map.sweep.limit) + (map.largest > 0.0 ? " at " + place(map) : "") + "\n";
    return text;
}

std::string mapCsv(const StabilityResult& result, const StabilityMap& map, const std::string& origin)
{
    std::string text = "# " + std::string(result.row.id) + ", " + map.sweep.name + ": " +
                       std::string(result.row.says) + "\n# against " + std::string(result.row.reference) +
                       "; limit " + number(map.sweep.limit) +
                       (map.sweep.isControl ? ", which this control has to exceed" : "") + "\n# " + origin +
                       "\n\"" + map.sweep.x.name + "\",\"" + map.sweep.y.name + "\",\"error\"\n";
    size_t i = 0;
    char line[96];
    for (const double y : map.sweep.y.values)
        for (const double x : map.sweep.x.values) {
            std::snprintf(line, sizeof line, "%.9g,%.9g,%.6g\n", x, y, map.errors[i++]);
            text += line;
        }
    return text;
}

std::string fileStem(const StabilityResult& result, const StabilityMap& map)
{
    std::string stem = std::string(result.row.id) + "-";
    for (const char c : map.sweep.name)
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '.')
            stem += c;
        else if (stem.back() != '-')
            stem += '-';
    while (stem.back() == '-')
        stem.pop_back();
    return stem;
}

} // namespace fx::cli
