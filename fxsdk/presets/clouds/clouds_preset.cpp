#include "fxsdk/presets/clouds/clouds_technique.h"

#include "embedded/clouds_schema.h"
#include "fxsdk/presets/still_medium.h"
#include "simulation/cloud/cloud_solver.h"

namespace fx::preset {
namespace {

std::shared_ptr<const sim::BallList> readBalls(const PresetValue& element)
{
    if (!element.has("file")) {
        element.error("file", "found no file; this needs balls (*.fxballs), such as \"file\": "
                              "\"smoke.fxballs\"; \"fx import\" makes one");
        return nullptr;
    }
    const base::Result<std::string> bytes = element.readAsset("file", sim::kMaxBallListBytes);
    if (!bytes) {
        element.error("file", bytes.status().message());
        return nullptr;
    }
    base::Result<std::shared_ptr<const sim::BallList>> balls = sim::parseBallList(*bytes);
    if (balls)
        return std::move(*balls);
    std::string name;
    element.read("file", name);
    element.error("file", "asset \"" + name + "\": " + balls.status().message());
    return nullptr;
}

} // namespace

std::string_view cloudsSchema()
{
    return clouds_schema::texts()[0].text;
}

void buildCloud(const PresetValue& element, sim::EffectDef& effect)
{
    auto cloud = std::make_unique<sim::CloudDef>();
    readStillMedium(element, *cloud);
    cloud->balls = readBalls(element);
    effect.solvers.push_back(std::move(cloud));
}

} // namespace fx::preset
