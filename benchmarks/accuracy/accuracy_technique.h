/// @file accuracy_technique.h
/// Interface of a technique for fx accuracy: settings with their errors and times.
///
/// A new technique is a file in benchmarks/accuracy/techniques/ with a class derived from AccuracyTechnique
/// and a function that describes it, and an entry in the CMakeLists.txt there.
#pragma once

#include "benchmarks/measure/counted_work.h"
#include "foundation/result/status.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

/// One way to compute the same thing.
struct AccuracySetting
{
    std::string name;
    std::string tier; ///< empty, "low", "default" or "high"
    nlohmann::json parameters = nlohmann::json::object();
};

/// One run of a setting. Errors are relative to the reference.
struct AccuracySample
{
    double errorMean = 0;
    double errorP50 = 0;
    double errorP99 = 0;
    double errorMax = 0;
    double bias = 0;                                ///< mean of the signed error
    double seconds = 0;                             ///< of the timed part
    double items = 0;                               ///< number of processed items, such as particle steps
    double instructions = 0;                        ///< of the timed part, 0 when the system does not count
    nlohmann::json work = nlohmann::json::object(); ///< counters
    double variance = 0; ///< of one item, for techniques that draw random numbers; 0 for all others
    std::string note;    ///< remark, shown at the end of the row of the table

    /// Of techniques with a bound: whether the setting keeps it or, if it is a control, breaks it.
    bool isAsPromised = true;
};

struct AccuracyScale
{
    uint32_t particles = 0; ///< size of the baseline, 0 for the technique's own
    uint32_t threads = 1;
    uint32_t frames = 0;       ///< of a sequence, 0 for the technique's own, as the next
    int width = 0, height = 0; ///< [pixel]
    double bound = 0.0;        ///< [1] of the change from frame to frame, in units of the reference's
};

class AccuracyTechnique
{
public:
    virtual ~AccuracyTechnique() = default;

    virtual std::string_view scene() const = 0;
    /// The first is the baseline of all ratios.
    virtual const std::vector<AccuracySetting>& settings() const = 0;
    /// @param stop true to leave as soon as possible with Code::Interrupted
    virtual base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) = 0;
    /// Does the timed part alone, once, by measureWork(). Nothing for techniques whose work is too long to be
    /// counted by a simulated processor.
    virtual std::optional<MeasuredWork> work(size_t /*setting*/) { return std::nullopt; }
};

/// A technique whose work is short enough to count instructions: work() is timed and counted.
class CountedAccuracy : public AccuracyTechnique
{
public:
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) final;

protected:
    /// Of one work().
    virtual double items() const = 0;
    /// Stores the errors and counters of the last work(), which was with this setting.
    virtual void judge(size_t setting, AccuracySample& outSample) = 0;
};

/// Which of the errors the plot shows and the front is made of.
enum class ShownError
{
    Mean,
    P99
};

struct AccuracyTechniqueEntry
{
    std::string_view name;
    std::string_view summary;
    std::string_view item; ///< what ns_per_item is about
    ShownError shown;
    std::vector<std::string> scenes;
    size_t usualScenes; ///< so many of them, from the first, are run when none is named
    bool isScalable;    ///< takes particles and threads of AccuracyScale into account
    std::unique_ptr<AccuracyTechnique> (*make)(const std::string& scene, const AccuracyScale& scale);
    bool hasFrames = false; ///< uses --frames; excluded from "all", because it is long
};

/// All techniques, in the order of techniques/CMakeLists.txt.
const std::vector<AccuracyTechniqueEntry>& accuracyTechniques();

/// Mean, quantiles and largest of |error|, bias of the signed ones. A value that is not finite counts as an
/// infinite error. Nothing is stored for an empty list.
void storeErrors(std::vector<double> errors, AccuracySample& outSample);

} // namespace fx::cli
