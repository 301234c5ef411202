/// @file accuracy_technique.h
/// Interface of a technique for fx accuracy: settings with their errors and times.
///
/// To add a technique, add a file in benchmarks/accuracy/techniques/ and an entry in the CMakeLists.txt of
/// this folder. The file contains a class derived from AccuracyTechnique and a function that describes it.
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

/// One method to compute a result.
struct AccuracySetting
{
    std::string name;
    /// quality level of the product that uses the setting: "low", "default" or "high"; empty: none
    std::string tier;
    nlohmann::json parameters = nlohmann::json::object();
};

/// One run of a setting. Errors are relative to the reference.
struct AccuracySample
{
    double errorMean = 0;
    double errorP50 = 0;
    double errorP99 = 0;
    double errorMax = 0;
    double bias = 0;         ///< mean of the signed error
    double seconds = 0;      ///< [s] time of the timed part
    double items = 0;        ///< number of processed items, such as particle steps
    double instructions = 0; ///< instructions of the timed part; 0 if the system cannot count them
    nlohmann::json work = nlohmann::json::object(); ///< counters
    double variance = 0; ///< variance of one item, for techniques that use random numbers; 0 for all others
    std::string note;    ///< remark, shown at the end of the row of the table

    /// For techniques with an error bound: true if the setting keeps the bound or, for a control, violates
    /// the bound.
    bool isAsPromised = true;
};

struct AccuracyScale
{
    uint32_t particles = 0; ///< number of particles of the baseline; 0: default of the technique
    uint32_t threads = 1;
    /// number of frames of the sequence. For this member and the members below, 0 is the default of the
    /// technique.
    uint32_t frames = 0;
    int width = 0, height = 0; ///< [pixel]
    /// [1] upper bound of the change of the picture from frame to frame, relative to the change of the
    /// reference
    double bound = 0.0;
    uint32_t cases = 0; ///< number of random cases
};

class AccuracyTechnique
{
public:
    virtual ~AccuracyTechnique() = default;

    virtual std::string_view scene() const = 0;
    /// Settings; the first is the baseline of all ratios.
    virtual const std::vector<AccuracySetting>& settings() const = 0;
    /// Runs a setting once and measures it.
    /// @param stop callback; when it returns true, the run ends as soon as possible with Code::Interrupted
    virtual base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) = 0;
    /// Runs only the timed part of a setting, once, by measureWork(). Returns nothing for techniques whose
    /// work takes too long to be counted by a simulated processor.
    virtual std::optional<MeasuredWork> work(size_t /*setting*/) { return std::nullopt; }
};

/// A technique whose work is short enough to count instructions. work() is both timed and counted.
class CountedAccuracy : public AccuracyTechnique
{
public:
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) final;

protected:
    /// Number of items that one call of work() processes.
    virtual double items() const = 0;
    /// Stores the errors and counters of the last call of work(), which ran this setting.
    virtual void judge(size_t setting, AccuracySample& outSample) = 0;
};

/// The error that the plot shows and that defines the Pareto front.
enum class ShownError
{
    Mean,
    P99
};

struct AccuracyTechniqueEntry
{
    std::string_view name;
    std::string_view summary;
    std::string_view item; ///< name of the items of the column ns_per_item, such as "pixel"
    ShownError shown;
    std::vector<std::string> scenes;
    size_t usualScenes; ///< if no scene is named, the first `usualScenes` elements of `scenes` run
    bool isScalable;    ///< true: the technique uses the members `particles` and `threads` of AccuracyScale
    std::unique_ptr<AccuracyTechnique> (*make)(const std::string& scene, const AccuracyScale& scale);
    bool hasFrames = false; ///< true: the technique uses --frames and takes long; "all" excludes it
    bool hasCases = false;  ///< true: the technique uses --cases
};

/// All techniques, in the order of techniques/CMakeLists.txt.
const std::vector<AccuracyTechniqueEntry>& accuracyTechniques();

/// Stores mean, quantiles and maximum of |error|, and the mean of the signed errors (bias). A value that is
/// not finite counts as an infinite error. Stores nothing for an empty list.
void storeErrors(std::vector<double> errors, AccuracySample& outSample);

} // namespace fx::cli
