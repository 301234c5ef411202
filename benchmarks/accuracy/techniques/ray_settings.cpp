#include "benchmarks/accuracy/techniques/ray_settings.h"

#include "rendering/reference/integral/integral_scheme.h"

namespace fx::cli {

std::vector<AccuracySetting> schemeSettings(const nlohmann::json& parameters)
{
    const std::string usual = render::schemeName(render::defaultScheme());
    const std::string high = render::schemeName(render::highScheme());
    std::vector<AccuracySetting> settings;
    for (const std::string& name : render::comparedSchemes()) {
        const std::string tier = name == usual ? "default" : name == high ? "high" : "";
        settings.push_back({name, tier, parameters});
    }
    return settings;
}

nlohmann::json toJson(const render::RayWork& work)
{
    return {{"rays", work.rays},
            {"hits", work.hits},
            {"intervals", work.intervals},
            {"parts", work.parts},
            {"blob_sums", work.blobSums},
            {"nodes", work.nodes},
            {"exponentials", work.exponentials}};
}

} // namespace fx::cli
