/// @file accuracy_technique.h
/// What fx accuracy needs of a technique: settings to try, and how wrong and how fast each is.
///
/// A new technique derives from AccuracyTechnique and adds its line to the list in accuracy_techniques.cpp.
#pragma once

#include "foundation/result/status.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
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
    double items = 0;                               ///< what the time is spent on, such as particle steps
    nlohmann::json work = nlohmann::json::object(); ///< counters
};

struct AccuracyScale
{
    uint32_t particles = 0; ///< size of the baseline, 0 for the technique's own
    uint32_t threads = 1;
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
};

struct AccuracyTechniqueEntry
{
    std::string_view name;
    std::string_view summary;
    std::vector<std::string> scenes; ///< the first is the default
    std::unique_ptr<AccuracyTechnique> (*make)(const std::string& scene, const AccuracyScale& scale);
};

const std::vector<AccuracyTechniqueEntry>& accuracyTechniques();

std::unique_ptr<AccuracyTechnique> makeExplosionAccuracy(const AccuracyScale& scale);
std::unique_ptr<AccuracyTechnique> makeSphAccuracy(const std::string& scene, const AccuracyScale& scale);

} // namespace fx::cli
