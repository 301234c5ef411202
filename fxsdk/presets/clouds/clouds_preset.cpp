#include "fxsdk/presets/clouds/clouds_technique.h"

#include "embedded/clouds_schema.h"
#include "fxsdk/presets/layer_names.h"
#include "simulation/cloud/cloud_solver.h"

#include <span>

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
    element.read("name", cloud->name);
    element.read("position", cloud->position);
    element.read("scale", cloud->scale);
    element.read("density", cloud->density);
    element.read("anisotropy", cloud->anisotropy);
    element.read("fireShare", cloud->fireShare);
    element.read("layer", std::span<const std::pair<std::string_view, base::MediaLayer>>(kLayerNames),
                 cloud->layer);
    cloud->balls = readBalls(element);
    effect.solvers.push_back(std::move(cloud));
}

} // namespace fx::preset
