#include "benchmarks/accuracy/accuracy_curve.h"

#include "benchmarks/report/provenance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace fx::cli {
namespace {

constexpr double kSameTime =
    0.97; ///< settings that do the same work differ by up to so much on a shared machine

double fastest(const AccuracyPoint& point)
{
    return *std::min_element(point.seconds.begin(), point.seconds.end());
}

double fewestInstructions(const AccuracyPoint& point)
{
    return point.instructions.empty()
               ? 0
               : *std::min_element(point.instructions.begin(), point.instructions.end());
}

/// The first whose time was taken: some only compare.
const AccuracyPoint& baselineOf(const AccuracyCurve& curve)
{
    const auto isTimed = [](const AccuracyPoint& point) { return fastest(point) > 0; };
    const auto found = std::ranges::find_if(curve.points, isTimed);
    return found != curve.points.end() ? *found : curve.points.front();
}

/// `"` doubled, as CSV requires.
std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

nlohmann::json numberOrNull(double value)
{
    return value > 0 ? nlohmann::json(value) : nlohmann::json(nullptr);
}

std::string csvRow(const AccuracyCurve& curve, size_t k)
{
    const AccuracyPoint& point = curve.points[k];
    const AccuracySample& s = point.sample;
    const TimeRatio ratio = timeRatio(curve, k);
    char numbers[320];
    std::snprintf(numbers, sizeof numbers, "%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.0f,%.6g,%d\n",
                  s.errorMean, s.errorP50, s.errorP99, s.errorMax, s.bias, fastest(point), ratio.best,
                  ratio.low, ratio.high, nanosecondsPerItem(point), fewestInstructions(point),
                  instructionRatio(curve, k), int(isOnFront(curve, k)));
    return curve.technique + "," + curve.scene + "," + quoted(point.setting.name) + "," + point.setting.tier +
           "," + numbers;
}

} // namespace

double nanosecondsPerItem(const AccuracyPoint& point)
{
    return point.sample.items > 0 ? 1e9 * fastest(point) / point.sample.items : 0;
}

double shownError(const AccuracyCurve& curve, size_t index)
{
    const AccuracySample& sample = curve.points[index].sample;
    return curve.shown == ShownError::Mean ? sample.errorMean : sample.errorP99;
}

const char* shownErrorName(const AccuracyCurve& curve)
{
    return curve.shown == ShownError::Mean ? "mean error" : "p99 error";
}

TimeRatio timeRatio(const AccuracyCurve& curve, size_t index)
{
    const AccuracyPoint& baseline = baselineOf(curve);
    const AccuracyPoint& point = curve.points[index];
    if (fastest(point) <= 0)
        return {0, 0, 0};
    TimeRatio ratio{fastest(point) / fastest(baseline), std::numeric_limits<double>::infinity(), 0};
    for (size_t k = 0; k < point.seconds.size(); ++k) {
        const double round = point.seconds[k] / baseline.seconds[k];
        ratio.low = std::min(ratio.low, round);
        ratio.high = std::max(ratio.high, round);
    }
    return ratio;
}

double efficiencyRatio(const AccuracyCurve& curve, size_t index)
{
    const AccuracyPoint& baseline = curve.points.front();
    const AccuracyPoint& point = curve.points[index];
    const double work = point.sample.variance * nanosecondsPerItem(point);
    return work > 0 ? baseline.sample.variance * nanosecondsPerItem(baseline) / work : 0;
}

double instructionRatio(const AccuracyCurve& curve, size_t index)
{
    const double baseline = fewestInstructions(curve.points.front());
    return baseline > 0 ? fewestInstructions(curve.points[index]) / baseline : 0;
}

bool isOnFront(const AccuracyCurve& curve, size_t index)
{
    const double time = fastest(curve.points[index]);
    const double error = shownError(curve, index);
    if (time <= 0)
        return false;
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const double otherTime = fastest(curve.points[k]);
        if (otherTime <= 0)
            continue;
        const double otherError = shownError(curve, k);
        const bool isBetter = otherTime < kSameTime * time || otherError < error;
        if (otherTime <= time && otherError <= error && isBetter)
            return false;
    }
    return true;
}

std::string curveTable(const AccuracyCurve& curve)
{
    char line[256];
    std::snprintf(line, sizeof line, "%-28s %10s %10s %10s %10s  %7s %15s %12s %9s\n", "setting",
                  "mean error", "p50", "p99", "bias", "time", "(range)", "instructions",
                  ("ns/" + curve.item).c_str());
    std::string text =
        curve.technique + " on " + curve.scene + "; * no other setting is as fast and as exact\n\n" + line;
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const TimeRatio ratio = timeRatio(curve, k);
        std::string note = point.sample.note;
        if (efficiencyRatio(curve, k) > 0) {
            char efficiency[32];
            std::snprintf(efficiency, sizeof efficiency, "efficiency %.2f", efficiencyRatio(curve, k));
            note = note.empty() ? efficiency : efficiency + (", " + note);
        }
        char instructions[16] = "-";
        if (instructionRatio(curve, k) > 0)
            std::snprintf(instructions, sizeof instructions, "%.3f", instructionRatio(curve, k));
        std::snprintf(
            line, sizeof line, "%-28s %10.4g %10.4g %10.4g %10.2g  %7.3f (%5.2f .. %5.2f) %12s %9.1f %s %s",
            point.setting.name.c_str(), point.sample.errorMean, point.sample.errorP50, point.sample.errorP99,
            point.sample.bias, ratio.best, ratio.low, ratio.high, instructions, nanosecondsPerItem(point),
            isOnFront(curve, k) ? "*" : " ", point.setting.tier.c_str());
        text += line + (note.empty() ? note : " " + note) + "\n";
    }
    return text;
}

std::string curvesCsv(const std::vector<AccuracyCurve>& curves, const std::string& origin)
{
    std::string text = "# " + origin + "\n";
    text += "technique,scene,setting,tier,error_mean[1],error_p50[1],error_p99[1],error_max[1],bias[1],"
            "seconds[s],time_ratio[1],time_ratio_low[1],time_ratio_high[1],ns_per_item[ns],instructions,"
            "instruction_ratio[1],front\n";
    for (const AccuracyCurve& curve : curves)
        for (size_t k = 0; k < curve.points.size(); ++k)
            text += csvRow(curve, k);
    return text;
}

std::vector<nlohmann::json> curveJson(const AccuracyCurve& curve)
{
    std::vector<nlohmann::json> lines;
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const TimeRatio ratio = timeRatio(curve, k);
        lines.push_back({{"technique", curve.technique},
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
                         {"baseline", baselineOf(curve).setting.name},
                         {"front", isOnFront(curve, k)},
                         {"item", curve.item},
                         {"ns_per_item", nanosecondsPerItem(point)},
                         {"instructions", numberOrNull(fewestInstructions(point))},
                         {"instruction_ratio", numberOrNull(instructionRatio(curve, k))},
                         {"instructions_by", curve.instructionsBy},
                         {"variance", numberOrNull(point.sample.variance)},
                         {"efficiency_ratio", numberOrNull(efficiencyRatio(curve, k))},
                         {"as_promised", point.sample.isAsPromised},
                         {"threads", curve.threads},
                         {"commit", commitName()},
                         {"work", point.sample.work}});
    }
    return lines;
}

} // namespace fx::cli
