#include "fxsdk/cli/accuracy_technique.h"

namespace fx::cli {

const std::vector<AccuracyTechniqueEntry>& accuracyTechniques()
{
    static const std::vector<AccuracyTechniqueEntry> kTechniques = {
        {"sph",
         "gas dynamics against exact flows, over particles, neighbors, steps and kernels",
         {"sedov", "sod", "noh", "explosion"},
         makeSphAccuracy},
    };
    return kTechniques;
}

} // namespace fx::cli
