#include "fxsdk/cli/export/ball_source.h"

#include "foundation/math/bits.h"
#include "fxsdk/cli/render/blob_list_reader.h"
#include "fxsdk/cli/render/reference_scene.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace fx::cli {
namespace {

MomentBalls ballsOf(const std::vector<render::MediumBlob>& blobs, const render::MediumDetails& details = {})
{
    MomentBalls moment;
    moment.balls.reserve(blobs.size());
    moment.details.groups = details.groups;
    moment.details.octaves = details.octaves;
    double scattered = 0.0; // [m2]
    for (size_t i = 0; i < blobs.size(); ++i) {
        const render::MediumBlob& blob = blobs[i];
        if (!base::isFinite(blob.velocity.x + blob.velocity.y + blob.velocity.z)) {
            ++moment.nonFinite;
            continue;
        }
        if (!(blob.crossSection > 0.0))
            continue;
        render::VoxelBall& ball = moment.balls.emplace_back();
        ball.center = blob.center;
        ball.radius = blob.radius;
        ball.crossSection = blob.crossSection;
        ball.temperature = blob.temperature;
        ball.luminance = glm::dot(render::kLuminance, blob.source);
        ball.luminanceRate =
            std::clamp(blob.sourceRate, -render::VoxelBall::kMostRate, render::VoxelBall::kMostRate);
        ball.age = std::clamp(blob.age, 0.0, render::VoxelBall::kUnknownAge);
        ball.velocity = blob.velocity;
        ball.albedo = blob.albedo;
        ball.id = blob.id;
        ball.instance = blob.instance;
        const double scatters = blob.crossSection * glm::dot(blob.albedo, glm::dvec3(1.0 / 3.0));
        scattered += scatters;
        moment.anisotropy += scatters * blob.anisotropy;
        if (details.isGiven())
            moment.details.balls.push_back(details.balls[i]);
    }
    moment.anisotropy = scattered > 0.0 ? moment.anisotropy / scattered : 0.0;
    return moment;
}

/// The same at all times.
class ListSource : public BallSource
{
public:
    explicit ListSource(const MomentBalls& balls) : balls_(balls) {}
    base::Result<MomentBalls> at(base::Ticks) override { return balls_; }

private:
    const MomentBalls& balls_;
};

class ListFile : public BallFile
{
public:
    explicit ListFile(MomentBalls balls) : balls_(std::move(balls)) {}
    base::Result<std::unique_ptr<BallSource>> start(const EffectSceneOptions&) const override
    {
        return std::unique_ptr<BallSource>(new ListSource(balls_));
    }

private:
    MomentBalls balls_;
};

class SceneSource : public BallSource
{
public:
    explicit SceneSource(std::unique_ptr<ReferenceSceneSource> scene) : scene_(std::move(scene)) {}
    base::Result<MomentBalls> at(base::Ticks tick) override
    {
        const auto frame = scene_->frameAt(tick);
        if (!frame.ok())
            return frame.status();
        MomentBalls moment = ballsOf(frame->scene.blobs, frame->scene.details);
        moment.nonFinite += frame->nonFinite;
        return moment;
    }

private:
    std::unique_ptr<ReferenceSceneSource> scene_;
};

class SceneBallFile : public BallFile
{
public:
    SceneBallFile(scene_file::SceneFile scene, std::optional<double> time)
        : scene_(std::move(scene)), time_(time)
    {}
    base::Result<std::unique_ptr<BallSource>> start(const EffectSceneOptions& options) const override
    {
        auto source = ReferenceSceneSource::create(scene_, options);
        if (!source.ok())
            return source.status();
        return std::unique_ptr<BallSource>(new SceneSource(std::move(*source)));
    }
    std::optional<double> previewTime() const override { return time_; }
    std::optional<uint64_t> seed() const override
    {
        return scene_.instances.empty() ? std::nullopt : std::optional(scene_.instances.front().seed);
    }
    std::vector<std::string> warnings() const override
    {
        std::vector<std::string> texts;
        for (const preset::Diagnostic& warning : scene_.warnings)
            texts.push_back(preset::toString(warning));
        return texts;
    }

private:
    scene_file::SceneFile scene_;
    std::optional<double> time_;
};

} // namespace

base::Result<std::unique_ptr<BallFile>> openBallFile(const std::string& input)
{
    if (input.ends_with(".blobs.csv")) {
        auto blobs = loadBlobList(input);
        if (!blobs.ok())
            return blobs.status();
        for (size_t i = 0; i < blobs->size(); ++i)
            (*blobs)[i].id = i; // a list has none; balls of equal ids would be pieces of one streak
        return std::unique_ptr<BallFile>(new ListFile(ballsOf(*blobs)));
    }
    const bool isScene = input.ends_with(".scene.json");
    if (!isScene && !input.ends_with(".fx.json") && !input.starts_with("library:"))
        return base::Status(base::Code::InvalidArgument,
                            input + ": expected *.scene.json, *.fx.json, library:NAME or *.blobs.csv");
    scene_file::Preview preview;
    auto scene = isScene ? scene_file::loadSceneFile(input) : sceneOfPreset(input, &preview);
    if (!scene.ok())
        return scene.status();
    std::optional<double> time;
    if (preview.time)
        time = double(*preview.time);
    return std::unique_ptr<BallFile>(new SceneBallFile(std::move(*scene), time));
}

} // namespace fx::cli
