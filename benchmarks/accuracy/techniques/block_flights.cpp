/// @file block_flights.cpp
/// Whether pictures of blocks change from frame to frame as little as those of their balls do: flights of an
/// eye around a cumulus and through one, drawn with impostors, against the same frames ball by ball with 16
/// slabs. Controls do what a faulty view would do, and have to break a bound: `in-turn` draws balls and
/// impostors of any error in turn; `at-once` turns all impostors into balls in one frame, without fading. A
/// third scene has blocks that interpenetrate, listed in both orders.
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/block_order.h"
#include "benchmarks/accuracy/techniques/cumulus_scenes.h"
#include "benchmarks/scenes/chance.h"
#include "benchmarks/scenes/frame_changes.h"
#include "benchmarks/scenes/quality_stage.h"
#include "foundation/time/ticks.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

namespace fx::cli {
namespace {

constexpr uint32_t kFrames = 60; ///< 1/60 s apart
/// [1] Of the mean luminance: by how much a frame may change more than that of the balls, and by how much
/// blocks that become balls may change it. No block is seen to do so.
constexpr double kMostJump = 0.02;

/// [m] Distance at which the smallest blocks of `cumulus-through`, of radius 2.4 m, have 86 pixels of 54 rows
/// and are half balls: an eye that approaches changes the size of these fastest. With more rows blocks become
/// balls farther away and more slowly.
constexpr double kSwitchDistance = 5.6;

enum class Fault
{
    None,
    InTurn, ///< every other frame has balls only
    AtOnce  ///< balls only from the middle of the flight on, before it impostors of any error
};

struct BlockFlightSetting
{
    const char* name;
    float parallax; ///< see BlockSettings
    float error;    ///< likewise
    Fault fault;

    bool isControl() const { return fault != Fault::None; }
};

constexpr BlockFlightSetting kImpostors{"impostors", render::BlockSettings().parallax,
                                        render::BlockSettings().error, Fault::None};
constexpr std::array<BlockFlightSetting, 2> kAround{
    {kImpostors, {"in-turn", render::BlockSettings::kMaxParallax, 0.0f, Fault::InTurn}}};
constexpr std::array<BlockFlightSetting, 2> kThrough{
    {kImpostors, {"at-once", render::BlockSettings().parallax, 0.0f, Fault::AtOnce}}};

struct BlockFlight
{
    const char* name;
    Cumulus cumulus;
    bool isThrough; ///< from outside through the middle; else around
    uint64_t seed;
    float fovYDegrees;
    int width, height; ///< [pixel] by default
    std::span<const BlockFlightSetting> settings;
};

/// `cumulus-through` has a small cumulus because the time of a frame grows with the balls, and a narrow field
/// of view in which blocks of 77 to 96 pixels are farther away than 2 radii, so that their size alone
/// decides.
constexpr std::array<BlockFlight, 2> kFlights{
    {{"cumulus-orbit", {false, {0.0, 27.0, 0.0}, 22.0}, false, 1, 45.0f, 160, 90, kAround},
     {"cumulus-through", {true, {0.0, 27.0, 0.0}, 13.0}, true, 2, 30.0f, 96, 54, kThrough}}};

/// From 2.4 radii of the cloud before its middle to 0.3 behind it. Most blocks in front become balls
/// about 1.05 radii away, where the eye is slow: motion that changes the whole picture hides what they
/// change.
/// @param s 0 at the beginning of the flight, 1 at its end
double throughAt(double s)
{
    const double u = 2.0 * s - 1.0;
    return 1.05 - 0.6 * u - 0.75 * u * u * u;
}

/// @param s 0 at the beginning of the flight, 1 at its end
scene_file::CameraPath cameraAt(const BlockFlight& flight, double s)
{
    bench::Chance chance(flight.seed);
    const double turn = chance.between(0.0, 2.0 * std::numbers::pi), height = chance.between(-0.3, 0.3);
    const auto around = [&](double angle) {
        return glm::dvec3(std::cos(turn + angle), 0.0, std::sin(turn + angle));
    };
    const double radius = flight.cumulus.radius;
    scene_file::CameraPath path;
    path.fovYDegrees = flight.fovYDegrees;
    if (flight.isThrough) {
        const double from = throughAt(s);
        path.position =
            flight.cumulus.middle + radius * (from * around(0.0) + glm::dvec3(0.0, 0.3 * height, 0.0));
        path.target = path.position - radius * around(0.0);
    } else {
        path.position =
            flight.cumulus.middle + radius * (3.0 * around(0.3 * s) + glm::dvec3(0.0, height, 0.0));
        path.target = flight.cumulus.middle;
    }
    return path;
}

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

struct FlightPictures
{
    std::vector<FrameLight> frames;
    std::vector<uint32_t> impostors; ///< in each frame
    uint64_t deferred = 0;           ///< tiles that were due in a frame and not drawn in it, of all frames
    std::vector<double> switches;    ///< [1] mean change by blocks that become balls in each frame
    double seconds = 0.0;
};

class BlockFlightAccuracy final : public AccuracyTechnique
{
public:
    BlockFlightAccuracy(const BlockFlight& flight, const AccuracyScale& scale);

    std::string_view scene() const override { return flight_.name; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t index, const std::function<bool()>& stop) override;

private:
    base::Status start(const std::function<bool()>& stop);
    template <class F>
    base::Status fly(const render::BlockSettings& blocks, const std::function<bool()>& stop, F&& add);
    /// [1] Of the whole flight; the frames that are drawn are those in its middle.
    double shareAt(double frame) const
    {
        return (double((kFrames - frames_) / 2) + frame) / double(kFrames - 1);
    }
    glm::dvec3 eyeAt(double frame) const { return cameraAt(flight_, shareAt(frame)).position; }
    base::Status show(uint32_t frame, const std::function<bool()>& stop);
    base::Result<FrameLight> draw(const render::BlockSettings& blocks, double& ioSeconds);
    bool isOfBalls(const BlockFlightSetting& setting, uint32_t frame) const;
    base::Status addFrame(uint32_t frame, const BlockFlightSetting& setting, FlightPictures& io);
    base::Status addSwitch(uint32_t frame, const BlockFlightSetting& setting, FlightPictures& io);
    std::vector<double> changesOf(const FlightPictures& pictures) const;
    struct Largest
    {
        double jump = 0.0, switched = 0.0, difference = 0.0;
    };
    Largest largestOf(const FlightPictures& pictures, std::span<const double> changes,
                      std::span<const double> ofBalls) const;

    const BlockFlight& flight_;
    ChangeBound bound_;
    uint32_t frames_;
    int width_, height_; ///< [pixel]
    std::vector<AccuracySetting> settings_;
    std::optional<scene_file::SceneFile> scene_; ///< no value before the first run
    std::unique_ptr<QualityStage> stage_;
    FlightPictures balls_; ///< the reference
};

BlockFlightAccuracy::BlockFlightAccuracy(const BlockFlight& flight, const AccuracyScale& scale)
    : flight_(flight), bound_{scale.bound > 0 ? scale.bound : 1.5, 0.1},
      frames_(scale.frames > 0 ? std::min(scale.frames, kFrames) : kFrames),
      width_(scale.width > 0 ? scale.width : flight.width),
      height_(scale.width > 0 ? scale.height : flight.height)
{
    for (const BlockFlightSetting& setting : flight.settings)
        settings_.push_back({setting.name,
                             "",
                             {{"frames", frames_},
                              {"width", width_},
                              {"height", height_},
                              {"parallax", setting.parallax},
                              {"block_error", setting.error},
                              {"bound", bound_.factor},
                              {"control", setting.isControl()}}});
}

/// Moves scene and eye to a frame.
base::Status BlockFlightAccuracy::show(uint32_t frame, const std::function<bool()>& stop)
{
    if (stop())
        return {base::Code::Interrupted, "interrupted"};
    if (base::Status status = stage_->simulate(base::toTicks(1.0 + double(frame) / 60.0)); !status)
        return status;
    return stage_->look(cameraAt(flight_, shareAt(double(frame))));
}

base::Result<FrameLight> BlockFlightAccuracy::draw(const render::BlockSettings& blocks, double& ioSeconds)
{
    render::ViewSettings settings = stage_->view().renderer.settings();
    settings.blocks = blocks;
    stage_->view().setSettings(settings);
    if (base::Status status = stage_->draw(); !status)
        return status;
    ioSeconds += 1e-3 * stage_->processorMilliseconds();
    return lightOf(stage_->picture(), stage_->background());
}

/// How a view with the setting, and with its fault, would draw the blocks.
render::BlockSettings blocksOf(const BlockFlightSetting& setting)
{
    render::BlockSettings blocks;
    blocks.parallax = setting.parallax;
    blocks.error = setting.error;
    if (setting.fault == Fault::AtOnce)
        blocks.maxPixels = render::BlockSettings::kMaxPixels;
    return blocks;
}

/// Whether a setting draws balls in a frame.
bool BlockFlightAccuracy::isOfBalls(const BlockFlightSetting& setting, uint32_t frame) const
{
    return (setting.fault == Fault::InTurn && frame % 2 == 1) ||
           (setting.fault == Fault::AtOnce && frame >= frames_ / 2);
}

base::Status BlockFlightAccuracy::addFrame(uint32_t frame, const BlockFlightSetting& setting,
                                           FlightPictures& io)
{
    if (isOfBalls(setting, frame)) {
        io.frames.push_back(balls_.frames[frame]);
        io.impostors.push_back(0);
        return {};
    }
    auto light = draw(blocksOf(setting), io.seconds);
    if (!light.ok())
        return light.status();
    io.frames.push_back(std::move(*light));
    const render::FrameStatistics& drawn = stage_->view().renderer.statistics();
    io.impostors.push_back(drawn.blockImpostors);
    io.deferred += drawn.blockTilesDeferred;
    return {};
}

/// What blocks that become balls in a frame change: the same frame with the shares of balls by size that
/// blocks had a frame before, so that no motion hides their change.
base::Status BlockFlightAccuracy::addSwitch(uint32_t frame, const BlockFlightSetting& setting,
                                            FlightPictures& io)
{
    if (isOfBalls(setting, frame) && frame != frames_ / 2) {
        io.switches.push_back(0.0);
        return {};
    }
    render::BlockSettings before = blocksOf(setting);
    if (setting.fault == Fault::None) {
        const double step = glm::distance(eyeAt(double(frame) - 1.0), eyeAt(double(frame)));
        before.maxPixels *= float(1.0 + step / kSwitchDistance);
    }
    double unused = 0.0;
    const auto light = draw(before, unused);
    if (!light.ok())
        return light.status();
    const std::vector<bool>& covered = balls_.frames[frame].isCovered;
    io.switches.push_back(meanChange(light->luminance, io.frames[frame].luminance, covered, covered));
    return {};
}

/// Calls add(frame) for each frame of a flight in a view of its own, whose tiles are those of one picture a
/// frame.
/// @param blocks with which the first frame is drawn until its tiles are there
template <class F>
base::Status BlockFlightAccuracy::fly(const render::BlockSettings& blocks, const std::function<bool()>& stop,
                                      F&& add)
{
    stage_.reset();
    auto stage = QualityStage::create(*scene_, width_, height_);
    if (!stage.ok())
        return stage.status();
    stage_ = std::move(*stage);
    const render::FrameStatistics& drawn = stage_->view().renderer.statistics();
    for (uint32_t frame = 0; frame < frames_; ++frame) {
        if (base::Status status = show(frame, stop); !status)
            return status;
        constexpr int kSettling = 16; // tiles are spread over frames
        double unused = 0.0;
        for (int k = 0; frame == 0 && k < kSettling && (k == 0 || drawn.blockTilesDeferred > 0); ++k)
            if (const auto light = draw(blocks, unused); !light.ok())
                return light.status();
        if (base::Status status = add(frame); !status)
            return status;
    }
    return {};
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

base::Status BlockFlightAccuracy::start(const std::function<bool()>& stop)
{
    if (scene_)
        return {};
    auto scene = cumulusScene(flight_.cumulus);
    if (!scene.ok())
        return scene.status();
    scene_ = std::move(*scene);
    render::BlockSettings balls;
    balls.parallax = 0.0f;
    return fly(balls, stop, [&](uint32_t) -> base::Status {
        auto light = draw(balls, balls_.seconds);
        if (light.ok())
            balls_.frames.push_back(std::move(*light));
        return light.status();
    });
}

/// Largest of all frames, of the mean luminance of the balls.
BlockFlightAccuracy::Largest BlockFlightAccuracy::largestOf(const FlightPictures& pictures,
                                                            std::span<const double> changes,
                                                            std::span<const double> ofBalls) const
{
    Largest largest;
    for (size_t k = 0; k < pictures.frames.size(); ++k) {
        const FrameLight& balls = balls_.frames[k];
        const double light = meanLuminance(balls);
        const double difference =
            meanChange(pictures.frames[k].luminance, balls.luminance, balls.isCovered, balls.isCovered);
        largest.difference = std::max(largest.difference, difference / light);
        largest.switched = std::max(largest.switched, pictures.switches[k] / light);
        if (k > 0)
            largest.jump = std::max(largest.jump, (changes[k - 1] - ofBalls[k - 1]) / light);
    }
    return largest;
}

base::Result<AccuracySample> BlockFlightAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (base::Status status = start(stop); !status)
        return status;
    const BlockFlightSetting& setting = flight_.settings[index];
    FlightPictures pictures;
    if (base::Status status =
            fly(blocksOf(setting), stop, [&](uint32_t frame) { return addFrame(frame, setting, pictures); });
        !status)
        return status;
    if (flight_.isThrough)
        if (base::Status status = fly(blocksOf(setting), stop,
                                      [&](uint32_t frame) { return addSwitch(frame, setting, pictures); });
            !status)
            return status;
    pictures.switches.resize(frames_, 0.0);
    const std::vector<double> changes = changesOf(pictures), ofBalls = changesOf(balls_);
    const ChangeJudgment judgment = judgeChanges(changes, ofBalls, bound_);
    const Largest largest = largestOf(pictures, changes, ofBalls);
    const std::vector<uint32_t>& impostors = pictures.impostors;
    AccuracySample sample;
    storeErrors(judgment.excess, sample);
    sample.seconds = pictures.seconds;
    sample.items = double(frames_);
    const bool isKept = judgment.isKept() && largest.jump <= kMostJump && largest.switched <= kMostJump;
    sample.isAsPromised = impostors.front() > 0 && isKept != setting.isControl();
    sample.work = {
        {"pairs", judgment.excess.size()},
        {"pairs_beyond", judgment.beyond},
        {"worst_pair", judgment.worst},
        {"change_ratio", judgment.medianRatio},
        {"change_balls", judgment.medianReference},
        {"jump", largest.jump},
        {"switch", largest.switched},
        {"difference", largest.difference},
        {"impostors_first", impostors.front()},
        {"impostors_last", impostors.back()},
        {"impostors_per_frame", std::accumulate(impostors.begin(), impostors.end(), 0.0) / double(frames_)},
        {"tiles_deferred_per_frame", double(pictures.deferred) / double(frames_)},
        {"seconds_balls", balls_.seconds}};
    char note[200];
    std::snprintf(note, sizeof note,
                  "%zu of %zu beyond, worst %.2f at %zu, ratio %.3f, jump %.2f %%, switch %.2f %%, "
                  "difference %.2f %%, impostors %u to %u%s",
                  judgment.beyond, judgment.excess.size(), sample.errorMax, judgment.worst,
                  judgment.medianRatio, 100.0 * largest.jump, 100.0 * largest.switched,
                  100.0 * largest.difference, impostors.front(), impostors.back(),
                  setting.isControl() ? ", control" : "");
    sample.note = note;
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale& scale)
{
    if (scene == kBlockOrderScene)
        return makeBlockOrder(scale);
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
    scenes.emplace_back(kBlockOrderScene);
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
