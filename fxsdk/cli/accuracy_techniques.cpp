#include "fxsdk/cli/accuracy_technique.h"

#include "fxsdk/cli/interrupt.h"

namespace fx::cli {

base::Result<AccuracySample> CountedAccuracy::run(size_t setting, const std::function<bool()>& stop)
{
    if (stop())
        return interruptedStatus();
    const MeasuredWork measured = *work(setting);
    AccuracySample sample;
    sample.seconds = measured.seconds;
    sample.instructions = measured.instructions;
    sample.items = items();
    judge(setting, sample);
    return sample;
}

const std::vector<AccuracyTechniqueEntry>& accuracyTechniques()
{
    static const std::vector<AccuracyTechniqueEntry> kTechniques = {
        {"ray-integral",
         "light through 270 overlapping blobs, over schemes",
         "ray",
         ShownError::P99,
         {"tau-0.1", "tau-1", "tau-10", "tau-100"},
         4,
         false,
         makeRayIntegralAccuracy},
        {"furnace",
         "blobs that emit 1 against 1 - exp(-tau), over schemes",
         "ray",
         ShownError::P99,
         {"float", "double"},
         2,
         false,
         makeFurnaceAccuracy},
        {"billboards",
         "planar, constant and kernel billboards against the integral",
         "ray",
         ShownError::P99,
         {"isolated-1", "isolated-10", "isolated-270", "overlapping-10", "overlapping-270", "sorted-wrong-10",
          "sorted-wrong-270"},
         7,
         false,
         makeBillboardAccuracy},
        {"dazzle",
         "glare by integers, by floating-point sums and by the paper's algorithm",
         "pixel",
         ShownError::P99,
         {"explosion", "gray"},
         2,
         false,
         makeDazzleAccuracy},
        {"sph",
         "gas dynamics against exact flows, over particles, neighbors, steps and kernels",
         "particle step",
         ShownError::Mean,
         {"sedov", "sod", "noh", "explosion"},
         1,
         true,
         makeSphAccuracy},
    };
    return kTechniques;
}

} // namespace fx::cli
