#include "fxsdk/presets/clouds/clouds_technique.h"

#include "embedded/clouds_schema.h"
#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/assets/frame_name.h"
#include "fxsdk/presets/still_medium.h"
#include "simulation/cloud/cloud_solver.h"
#include "simulation/cloud/moving_cloud.h"

namespace fx::preset {
namespace {

bool hasFile(const PresetValue& element)
{
    if (!element.has("file"))
        element.error("file", "found no file; this needs balls (*.fxballs), such as \"file\": "
                              "\"smoke.fxballs\"; \"fx import\" makes one");
    return element.has("file");
}

std::shared_ptr<const sim::BallList> readBalls(const PresetValue& element)
{
    if (!hasFile(element))
        return nullptr;
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

/// Reads numbered files; findings name the one that is missing or damaged.
/// @return whether all were read
bool readFrames(const PresetValue& element, uint32_t count, sim::MovingCloudDef& out)
{
    if (!hasFile(element))
        return false;
    if (!element.assets()) {
        element.error("file", "this document may not name files");
        return false;
    }
    std::string pattern;
    element.read("file", pattern);
    uint32_t first = 0;
    element.read("firstFrame", first);
    element.read("framesPerSecond", out.framesPerSecond);
    readSequenceEnd(element, out.end);
    std::vector<std::shared_ptr<const sim::MovingBalls>> frames;
    size_t sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const base::Result<std::string> name = asset::frameName(pattern, first + i);
        if (!name) {
            element.error("file", name.status().message());
            return false;
        }
        const base::Result<std::string> bytes = element.assets()->read(*name, sim::kMaxBallListBytes);
        if (!bytes) {
            element.error("file", bytes.status().message());
            return false;
        }
        auto balls = sim::parseMovingBalls(*bytes);
        if (!balls) {
            element.error("file", "asset \"" + *name + "\": " + balls.status().message());
            return false;
        }
        sum += (*balls)->size();
        if (sum > sim::kMaxPlayedBalls) {
            element.error("file", "asset \"" + *name + "\": the frames up to this one have " +
                                      std::to_string(sum) + " balls; allowed are " +
                                      std::to_string(sim::kMaxPlayedBalls) +
                                      ": use fewer frames, or a smaller --balls-below");
            return false;
        }
        frames.push_back(std::move(*balls));
    }
    out.setFrames(std::move(frames));
    return true;
}

} // namespace

std::string_view cloudsSchema()
{
    return clouds_schema::texts()[0].text;
}

void buildCloud(const PresetValue& element, sim::EffectDef& effect)
{
    uint32_t frames = 0;
    element.read("frames", frames);
    if (frames > 0) {
        auto moving = std::make_unique<sim::MovingCloudDef>();
        readStillMedium(element, *moving);
        if (readFrames(element, frames, *moving))
            effect.solvers.push_back(std::move(moving));
        return;
    }
    auto cloud = std::make_unique<sim::CloudDef>();
    readStillMedium(element, *cloud);
    cloud->balls = readBalls(element);
    effect.solvers.push_back(std::move(cloud));
}

} // namespace fx::preset
