/// @file block_flights.cpp
/// Whether pictures of blocks change from frame to frame as little as those of their balls do: flights of an
/// eye around a cumulus and into it, drawn with impostors, against the same frames ball by ball with 16
/// slabs. The control of cumulus-orbit draws balls and impostors of any error in turn: it has to break the
/// bounds that impostors have to keep. cumulus-into has none: so near, most of the picture is balls, and the
/// control would keep the bounds.
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/chance.h"
#include "benchmarks/scenes/frame_changes.h"
#include "benchmarks/scenes/quality_stage.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/default_stage.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>

namespace fx::cli {
namespace {

constexpr uint32_t kFrames = 60; ///< 1/60 s apart
/// [1] By how much a frame may change more than that of the balls, of the mean luminance: no block that
/// becomes an impostor or balls is seen to do so.
constexpr double kMostJump = 0.02;

struct BlockFlight
{
    const char* name;
    bool isInto; ///< straight towards the middle, from the rim inwards; else around it
    uint64_t seed;
};

constexpr std::array<BlockFlight, 2> kFlights{{{"cumulus-orbit", false, 1}, {"cumulus-into", true, 2}}};

struct BlockFlightSetting
{
    const char* name;
    float parallax; ///< see BlockSettings
    float error;    ///< likewise
    bool isControl; ///< every other frame has balls only
};

constexpr BlockFlightSetting kBalls{"balls", 0.0f, 0.0f, false};
constexpr std::array<BlockFlightSetting, 2> kSettings{
    {{"impostors", render::BlockSettings().parallax, render::BlockSettings().error, false},
     {"in-turn", render::BlockSettings::kMaxParallax, 0.0f, true}}};

/// Of library:cumulus, as its preview shows it.
constexpr glm::dvec3 kMiddle(0.0, 27.0, 0.0); ///< [m]
constexpr double kRadius = 22.0;              ///< [m] of most of the cloud

/// @param s 0 at the beginning of the flight, 1 at its end
scene_file::CameraPath cameraAt(const BlockFlight& flight, double s)
{
    bench::Chance chance(flight.seed);
    const double turn = chance.between(0.0, 2.0 * std::numbers::pi), height = chance.between(-0.3, 0.3);
    const auto around = [&](double angle) {
        return glm::dvec3(std::cos(turn + angle), 0.0, std::sin(turn + angle));
    };
    scene_file::CameraPath path;
    path.fovYDegrees = 45.0f;
    if (flight.isInto) {
        path.position =
            kMiddle + kRadius * ((0.95 - 0.3 * s) * around(0.0) + glm::dvec3(0.0, 0.3 * height, 0.0));
        path.target = path.position - kRadius * around(0.0);
    } else {
        path.position = kMiddle + kRadius * (3.0 * around(0.3 * s) + glm::dvec3(0.0, height, 0.0));
        path.target = kMiddle;
    }
    return path;
}

struct FlightPictures
{
    std::vector<FrameLight> frames;
    double seconds = 0.0;
    uint64_t impostors = 0;
};

class BlockFlightAccuracy final : public AccuracyTechnique
{
public:
    BlockFlightAccuracy(const BlockFlight& flight, const AccuracyScale& scale)
        : flight_(flight), bound_{scale.bound > 0 ? scale.bound : 1.5, 0.1},
          frames_(scale.frames > 0 ? std::min(scale.frames, kFrames) : kFrames),
          width_(scale.width > 0 ? scale.width : 160), height_(scale.width > 0 ? scale.height : 90)
    {
        for (const BlockFlightSetting& setting : std::span(kSettings).first(flight.isInto ? 1 : 2))
            settings_.push_back({setting.name,
                                 "",
                                 {{"frames", frames_},
                                  {"width", width_},
                                  {"height", height_},
                                  {"parallax", setting.parallax},
                                  {"block_error", setting.error},
                                  {"bound", bound_.factor},
                                  {"control", setting.isControl}}});
    }

    std::string_view scene() const override { return flight_.name; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t index, const std::function<bool()>& stop) override;

private:
    base::Result<FlightPictures> fly(const BlockFlightSetting& setting, const std::function<bool()>& stop);
    std::vector<double> changesOf(const FlightPictures& pictures) const;

    const BlockFlight& flight_;
    ChangeBound bound_;
    uint32_t frames_;
    int width_, height_; ///< [pixel]
    std::vector<AccuracySetting> settings_;
    FlightPictures balls_; ///< the reference; empty before the first run
};

FrameLight lightOf(const std::vector<float>& picture, const std::vector<float>& background)
{
    FrameLight light;
    for (size_t i = 0; i < picture.size(); i += 4) {
        light.luminance.push_back(0.2126f * picture[i] + 0.7152f * picture[i + 1] + 0.0722f * picture[i + 2]);
        constexpr float kLeast = 1e-3f; // of white
        light.isCovered.push_back(std::abs(picture[i] - background[i]) > kLeast ||
                                  std::abs(picture[i + 1] - background[i + 1]) > kLeast ||
                                  std::abs(picture[i + 2] - background[i + 2]) > kLeast);
    }
    return light;
}

double meanLuminance(const FrameLight& light)
{
    const std::vector<float> black(light.luminance.size(), 0.0f);
    return std::max(meanChange(black, light.luminance, light.isCovered, light.isCovered), 1e-30);
}

base::Result<FlightPictures> BlockFlightAccuracy::fly(const BlockFlightSetting& setting,
                                                      const std::function<bool()>& stop)
{
    auto scene = sceneOfPreset("library:cumulus");
    if (!scene.ok())
        return scene.status();
    scene->view.composition = render::Composition::Slabs;
    scene->view.slabs = 16;
    scene->view.dazzle.enabled = false;
    scene->view.shimmer.strength = 0.0f;
    auto stage = QualityStage::create(*scene, width_, height_);
    if (!stage.ok())
        return stage.status();
    const auto show = [&](uint32_t frame) -> base::Status {
        if (stop())
            return {base::Code::Interrupted, "interrupted"};
        const bool isOfBalls = setting.isControl && frame % 2 == 1;
        render::ViewSettings settings = (*stage)->view().renderer.settings();
        settings.blocks.parallax = isOfBalls ? 0.0f : setting.parallax;
        settings.blocks.error = setting.error;
        (*stage)->view().setSettings(settings);
        const uint32_t first = (kFrames - frames_) / 2;
        base::Status status = (*stage)->simulate(base::toTicks(1.0 + double(frame) / 60.0));
        if (status)
            status = (*stage)->look(cameraAt(flight_, double(first + frame) / double(kFrames - 1)));
        return status ? (*stage)->draw() : status;
    };
    const render::FrameStatistics& drawn = (*stage)->view().renderer.statistics();
    constexpr int kSettling = 16; // tiles are spread over frames
    for (int k = 0; k < kSettling && (k == 0 || drawn.blockTilesDeferred > 0); ++k)
        if (base::Status status = show(0); !status)
            return status;
    FlightPictures pictures;
    for (uint32_t frame = 0; frame < frames_; ++frame) {
        if (base::Status status = show(frame); !status)
            return status;
        pictures.impostors += drawn.blockImpostors;
        pictures.seconds += 1e-3 * (*stage)->processorMilliseconds();
        pictures.frames.push_back(lightOf((*stage)->picture(), (*stage)->background()));
    }
    return pictures;
}

/// Between frames, over the pixels that the balls cover.
std::vector<double> BlockFlightAccuracy::changesOf(const FlightPictures& pictures) const
{
    std::vector<double> changes;
    for (size_t k = 1; k < pictures.frames.size(); ++k)
        changes.push_back(meanChange(pictures.frames[k - 1].luminance, pictures.frames[k].luminance,
                                     balls_.frames[k - 1].isCovered, balls_.frames[k].isCovered));
    return changes;
}

base::Result<AccuracySample> BlockFlightAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (balls_.frames.empty()) {
        auto balls = fly(kBalls, stop);
        if (!balls.ok())
            return balls.status();
        balls_ = std::move(*balls);
    }
    const BlockFlightSetting& setting = kSettings[index];
    const auto pictures = fly(setting, stop);
    if (!pictures.ok())
        return pictures.status();
    const std::vector<double> changes = changesOf(*pictures), ofBalls = changesOf(balls_);
    const ChangeJudgment judgment = judgeChanges(changes, ofBalls, bound_);
    double difference = 0.0, jump = 0.0; // largest of all frames
    for (size_t k = 0; k < pictures->frames.size(); ++k) {
        const FrameLight& balls = balls_.frames[k];
        const double light = meanLuminance(balls);
        difference = std::max(difference, meanChange(pictures->frames[k].luminance, balls.luminance,
                                                     balls.isCovered, balls.isCovered) /
                                              light);
        if (k > 0)
            jump = std::max(jump, (changes[k - 1] - ofBalls[k - 1]) / light);
    }
    AccuracySample sample;
    storeErrors(judgment.excess, sample);
    sample.seconds = pictures->seconds;
    sample.items = double(frames_);
    const bool isKept = judgment.isKept() && jump <= kMostJump;
    sample.isAsPromised = pictures->impostors > 0 && isKept != setting.isControl;
    sample.work = {{"pairs", judgment.excess.size()},
                   {"pairs_beyond", judgment.beyond},
                   {"worst_pair", judgment.worst},
                   {"change_ratio", judgment.medianRatio},
                   {"change_balls", judgment.medianReference},
                   {"jump", jump},
                   {"difference", difference},
                   {"impostors_per_frame", double(pictures->impostors) / double(frames_)},
                   {"seconds_balls", balls_.seconds}};
    char note[160];
    std::snprintf(note, sizeof note,
                  "%zu of %zu beyond, worst %.2f at %zu, ratio %.3f, jump %.2f %%, difference %.2f %%, "
                  "%.0f impostors%s",
                  judgment.beyond, judgment.excess.size(), sample.errorMax, judgment.worst,
                  judgment.medianRatio, 100.0 * jump, 100.0 * difference,
                  double(pictures->impostors) / double(frames_), setting.isControl ? ", control" : "");
    sample.note = note;
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale& scale)
{
    const auto* flight =
        std::ranges::find_if(kFlights, [&](const BlockFlight& known) { return known.name == scene; });
    return std::make_unique<BlockFlightAccuracy>(*flight, scale);
}

} // namespace

AccuracyTechniqueEntry blockFlightsAccuracy()
{
    std::vector<std::string> scenes;
    for (const BlockFlight& flight : kFlights)
        scenes.emplace_back(flight.name);
    const size_t count = scenes.size();
    return {"block-flights",
            "change from frame to frame of impostors of blocks, against that of their balls",
            "frame",
            ShownError::P99,
            std::move(scenes),
            count,
            false,
            make,
            true};
}

} // namespace fx::cli
