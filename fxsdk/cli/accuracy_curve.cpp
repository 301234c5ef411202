#include "fxsdk/cli/accuracy_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace fx::cli {
namespace {

double fastest(const AccuracyPoint& point)
{
    return *std::min_element(point.seconds.begin(), point.seconds.end());
}

double nanosecondsPerItem(const AccuracyPoint& point)
{
    return point.sample.items > 0 ? 1e9 * fastest(point) / point.sample.items : 0;
}

double fewestInstructions(const AccuracyPoint& point)
{
    return point.instructions.empty()
               ? 0
               : *std::min_element(point.instructions.begin(), point.instructions.end());
}

/// `"` doubled, as CSV wants it.
std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

} // namespace

TimeRatio timeRatio(const AccuracyCurve& curve, size_t index)
{
    const AccuracyPoint& baseline = curve.points.front();
    const AccuracyPoint& point = curve.points[index];
    TimeRatio ratio{fastest(point) / fastest(baseline), std::numeric_limits<double>::infinity(), 0};
    for (size_t k = 0; k < point.seconds.size(); ++k) {
        const double round = point.seconds[k] / baseline.seconds[k];
        ratio.low = std::min(ratio.low, round);
        ratio.high = std::max(ratio.high, round);
    }
    return ratio;
}

bool isOnFront(const AccuracyCurve& curve, size_t index)
{
    const AccuracyPoint& point = curve.points[index];
    return std::none_of(curve.points.begin(), curve.points.end(), [&](const AccuracyPoint& other) {
        const bool notWorse =
            fastest(other) <= fastest(point) && other.sample.errorMean <= point.sample.errorMean;
        const bool better =
            fastest(other) < fastest(point) || other.sample.errorMean < point.sample.errorMean;
        return notWorse && better;
    });
}

std::string curveTable(const AccuracyCurve& curve)
{
    char line[256];
    std::snprintf(line, sizeof line, "%-28s %10s %10s %10s %10s  %7s %15s %9s\n", "setting", "mean error",
                  "p50", "p99", "bias", "time", "(range)", "ns/item");
    std::string text =
        curve.technique + " on " + curve.scene + "; * no other setting is as fast and as exact\n\n" + line;
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const TimeRatio ratio = timeRatio(curve, k);
        std::snprintf(line, sizeof line,
                      "%-28s %10.4g %10.4g %10.4g %10.2g  %7.3f (%5.2f .. %5.2f) %9.1f %s\n",
                      point.setting.name.c_str(), point.sample.errorMean, point.sample.errorP50,
                      point.sample.errorP99, point.sample.bias, ratio.best, ratio.low, ratio.high,
                      nanosecondsPerItem(point), isOnFront(curve, k) ? "*" : "");
        text += line;
    }
    return text;
}

std::string curveCsv(const AccuracyCurve& curve, const std::string& machine)
{
    std::string text = "# " + machine + ", fx " FXSDK_VERSION "\n";
    text += "technique,scene,setting,tier,error_mean[1],error_p50[1],error_p99[1],error_max[1],bias[1],"
            "seconds[s],"
            "time_ratio[1],time_ratio_low[1],time_ratio_high[1],ns_per_item[ns],instructions,front\n";
    char numbers[320];
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const AccuracySample& s = point.sample;
        const TimeRatio ratio = timeRatio(curve, k);
        std::snprintf(numbers, sizeof numbers, "%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.0f,%d\n",
                      s.errorMean, s.errorP50, s.errorP99, s.errorMax, s.bias, fastest(point), ratio.best,
                      ratio.low, ratio.high, nanosecondsPerItem(point), fewestInstructions(point),
                      int(isOnFront(curve, k)));
        text += curve.technique + "," + curve.scene + "," + quoted(point.setting.name) + "," +
                point.setting.tier + "," + numbers;
    }
    return text;
}

std::vector<nlohmann::json> curveJson(const AccuracyCurve& curve)
{
    std::vector<nlohmann::json> lines;
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const TimeRatio ratio = timeRatio(curve, k);
        const double instructions = fewestInstructions(point);
        lines.push_back(
            {{"technique", curve.technique},
             {"scene", curve.scene},
             {"setting", point.setting.name},
             {"tier", point.setting.tier},
             {"parameters", point.setting.parameters},
             {"error_mean", point.sample.errorMean},
             {"error_p50", point.sample.errorP50},
             {"error_p99", point.sample.errorP99},
             {"error_max", point.sample.errorMax},
             {"bias", point.sample.bias},
             {"seconds", fastest(point)},
             {"time_ratio", ratio.best},
             {"time_ratio_low", ratio.low},
             {"time_ratio_high", ratio.high},
             {"repetitions", point.seconds.size()},
             {"baseline", curve.points.front().setting.name},
             {"front", isOnFront(curve, k)},
             {"ns_per_item", nanosecondsPerItem(point)},
             {"instructions", instructions > 0 ? nlohmann::json(instructions) : nlohmann::json(nullptr)},
             {"work", point.sample.work}});
    }
    return lines;
}

} // namespace fx::cli
