/// @file impostors.cpp
/// Impostors of blocks, drawn by OpenGL, against the ray integral through the balls that they stand for:
/// tiles of any resolution and direction, blocks of any size on the picture and near to the eye, and random
/// cases. Balls emit light and scatter none, so that how media are lit has no part in the error.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/block_picture.h"
#include "benchmarks/scenes/chance.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>

namespace fx::cli {
namespace {

constexpr uint32_t kUsualCases = 100;
constexpr double kLimit = 1.0 / 255.0; ///< [1] root mean square error that an impostor should not exceed
constexpr double kCovered = 0.01;      ///< [1] opacity from which on a pixel counts
constexpr int kNearViews = 3;
constexpr uint64_t kFirstCase = 200'000; ///< others than those that predictions were tuned by

struct ImpostorSetting
{
    const char* name;
    const char* tier;
    float parallax;   ///< [pixel] 0: all balls are drawn
    float resolution; ///< texels a pixel
    float error;      ///< [1] limit of the predicted error; 0: not limited
    bool isForCases;  ///< random cases are drawn with it
    bool isForScenes; ///< the other scenes are
};
constexpr render::BlockSettings kUsual;
constexpr ImpostorSetting kSettings[] = {
    {"balls", "", 0.0f, kUsual.resolution, 0.0f, true, true},
    {"default", "default", kUsual.parallax, kUsual.resolution, kUsual.error, true, true},
    {"error-1", "", kUsual.parallax, kUsual.resolution, 1.0f / 255.0f, true, true},
    {"error-2", "", kUsual.parallax, kUsual.resolution, 2.0f / 255.0f, false, true},
    {"any-error", "", kUsual.parallax, kUsual.resolution, 0.0f, true, true},
    {"resolution-0.5", "", kUsual.parallax, 0.5f, 0.0f, false, true},
    {"resolution-2", "", kUsual.parallax, 2.0f, 0.0f, false, true},
    {"parallax-0.125", "", 0.125f, kUsual.resolution, 0.0f, false, true},
    {"parallax-2", "", 2.0f, kUsual.resolution, 0.0f, false, true},
    {"finest", "", 0.02f, 4.0f, 0.0f, false, true},
};

/// Blocks, and a camera that sees them all.
struct Subject
{
    sim::BlocksDef blocks;
    LitView view;
    LitSize size;
};

/// A view of blocks of radius 1 m about the origin. @param pixels [pixel] diameter of a block
LitView viewFrom(const glm::dvec3& eye, double pixels, int height)
{
    LitView view;
    view.eye = eye;
    view.exposureEv100 = 0.0f;
    view.fovYDegrees = 360.0 / std::numbers::pi * std::atan(double(height) / (pixels * glm::length(eye)));
    return view;
}

sim::BlocksDef blocksOf(const HeapOfBalls& heap)
{
    sim::BlocksDef def;
    def.types.push_back(heapOf(heap, whiteOf(0.0f)));
    (void)sim::completeTypes(def.types); // one short list of balls is never refused
    return def;
}

/// Blocks side by side, turned at random, 24 radii away. @param most blocks along a side
std::vector<Subject> rowsOfBlocks(double pixels, bool isColored, int most)
{
    const int side = std::clamp(int(96.0 / pixels), 1, most);
    Subject subject;
    HeapOfBalls heap;
    heap.isColored = isColored;
    subject.blocks = blocksOf(heap);
    for (int i = 0; i < side * side; ++i) {
        sim::BlockPlacement block;
        block.position = 2.2f * (glm::vec3(float(i % side), float(i / side), 0.0f) -
                                 0.5f * float(side - 1) * glm::vec3(1.0f, 1.0f, 0.0f));
        block.rotation = anyTurn(7, uint64_t(i));
        subject.blocks.blocks.push_back(block);
    }
    subject.size.width = subject.size.height = int(std::ceil(1.15 * pixels * side));
    subject.view = viewFrom({0.0, 0.0, 24.0}, pixels, subject.size.height);
    return {subject};
}

/// One block of 64 pixels, seen from so many of its radii away, in the middle and at the side of the picture.
std::vector<Subject> nearBlock(double distance)
{
    std::vector<Subject> subjects;
    for (int i = 0; i < kNearViews; ++i) {
        Subject subject;
        subject.blocks = blocksOf({});
        sim::BlockPlacement block;
        block.rotation = anyTurn(11, uint64_t(i));
        subject.blocks.blocks.push_back(block);
        subject.size.width = subject.size.height = 96;
        subject.view = viewFrom({0.0, 0.0, distance}, 64.0, subject.size.height);
        subject.view.target = glm::dvec3(0.25 * double(i), 0.15 * double(i), 0.0);
        subjects.push_back(subject);
    }
    return subjects;
}

/// Any block of 6 to 96 pixels from any side, 8 to 100 of its radii away.
/// @param isWide of more balls of more radii, and thinner or denser than its content
Subject randomCase(uint64_t number, bool isWide)
{
    bench::Chance chance(1000 + number);
    const auto logarithmic = [&](double low, double high) { return low * std::pow(high / low, chance()); };
    HeapOfBalls heap;
    heap.seed = number + 1;
    heap.balls = uint32_t(logarithmic(1.0, isWide ? 1000.0 : 100.0));
    heap.smallest = isWide ? logarithmic(0.03, 0.4) : chance.between(0.2, 0.4);
    heap.largest = heap.smallest + chance.between(0.0, 0.2);
    heap.depth = logarithmic(0.1, 10.0);
    heap.isColored = chance() < 0.5;
    const double pixels = logarithmic(6.0, 96.0), distance = logarithmic(8.0, 100.0);
    Subject subject;
    subject.blocks = blocksOf(heap);
    sim::BlockPlacement block;
    block.rotation = anyTurn(13, number);
    block.density = isWide ? float(logarithmic(0.1, 10.0)) : 1.0f;
    subject.blocks.blocks.push_back(block);
    subject.size.width = subject.size.height = 112;
    subject.view = viewFrom(distance * glm::normalize(chance.direction() + glm::dvec3(0.0, 0.0, 0.01)),
                            pixels, subject.size.height);
    return subject;
}

/// What a setting has given so far.
struct Collected
{
    /// of all covered pixels and channels, white is 1; of random cases the root mean square of each
    std::vector<double> errors;
    double squares = 0.0;
    uint64_t values = 0;
    double light = 0.0, wanted = 0.0;
    double seconds = 0.0, firstSeconds = 0.0;
    uint64_t tiles = 0, impostors = 0, bytes = 0;
    std::vector<double> rmse;         ///< of each picture
    std::vector<double> anyRmse;      ///< of those in which blocks are impostors, at least in part
    std::vector<double> impostorRmse; ///< of those in which blocks are impostors and none fades to its balls
    double impostorSeconds = 0.0;     ///< of those
    double ballSeconds = 0.0;         ///< of the same pictures, ball by ball
};

class ImpostorAccuracy final : public AccuracyTechnique
{
public:
    ImpostorAccuracy(const std::string& scene, const AccuracyScale& scale)
        : scene_(scene),
          cases_(scene.starts_with("cases") ? (scale.cases > 0 ? scale.cases : kUsualCases) : 0)
    {
        for (const ImpostorSetting& setting : kSettings) {
            if (!(cases_ > 0 ? setting.isForCases : setting.isForScenes))
                continue;
            nlohmann::json parameters = {
                {"parallax", setting.parallax}, {"resolution", setting.resolution}, {"error", setting.error}};
            if (cases_ > 0)
                parameters["cases"] = cases_;
            settings_.push_back({setting.name, setting.tier, parameters});
            used_.push_back(setting);
        }
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    base::Status measure(const Subject& subject, const std::function<bool()>& stop);
    base::Status draw(const Subject& subject, const LitPicture& truth, const ImpostorSetting& setting,
                      Collected& io);
    base::Status measureAll(const std::function<bool()>& stop);

    std::string scene_;
    uint32_t cases_;
    std::vector<AccuracySetting> settings_;
    std::vector<ImpostorSetting> used_;
    std::vector<Collected> collected_;      ///< of each setting
    double secondsOfBalls_ = 0.0;           ///< of the last picture, ball by ball, which is drawn first
    size_t given_ = 0;                      ///< settings that have been given since they were measured
    std::unique_ptr<BlockPainter> painter_; ///< all pictures of a scene have one size
};

base::Status ImpostorAccuracy::draw(const Subject& subject, const LitPicture& truth,
                                    const ImpostorSetting& setting, Collected& io)
{
    painter_->settings() = {setting.parallax, setting.resolution, render::BlockSettings::kMaxPixels,
                            setting.error};
    if (setting.parallax > 0.0f) {
        const auto first = painter_->paint(subject.blocks, subject.view);
        if (!first.ok())
            return first.status();
        io.tiles += painter_->statistics().blockTilesDrawn;
        io.firstSeconds += first->seconds;
    }
    const auto picture = painter_->paint(subject.blocks, subject.view); // with tiles that are there
    if (!picture.ok())
        return picture.status();
    io.impostors += painter_->statistics().blockImpostors;
    io.bytes = std::max(io.bytes, uint64_t(painter_->statistics().textureBytes));
    io.seconds += picture->seconds;
    double squares = 0.0;
    size_t values = 0;
    for (size_t i = 0; i < truth.light.size(); ++i) {
        if (truth.opacity[i] < kCovered)
            continue;
        for (int c = 0; c < 3; ++c) {
            const double error = picture->light[i][c] - truth.light[i][c];
            if (cases_ == 0)
                io.errors.push_back(error);
            io.light += picture->light[i][c];
            io.wanted += truth.light[i][c];
            squares += error * error;
            ++values;
        }
    }
    io.squares += squares;
    io.values += values;
    io.rmse.push_back(std::sqrt(squares / double(std::max<size_t>(values, 1))));
    if (cases_ > 0)
        io.errors.push_back(io.rmse.back());
    const render::FrameStatistics& drawn = painter_->statistics();
    if (drawn.blockImpostors > 0)
        io.anyRmse.push_back(io.rmse.back());
    if (drawn.blockImpostors > 0 && drawn.blobs == drawn.blockImpostors) {
        io.impostorRmse.push_back(io.rmse.back());
        io.impostorSeconds += picture->seconds;
        io.ballSeconds += secondsOfBalls_;
    } else if (setting.parallax == 0.0f) {
        secondsOfBalls_ = picture->seconds;
    }
    return {};
}

base::Status ImpostorAccuracy::measure(const Subject& subject, const std::function<bool()>& stop)
{
    if (stop())
        return {base::Code::Interrupted, "interrupted"};
    if (!painter_) {
        auto made = BlockPainter::create(subject.size.width, subject.size.height);
        if (!made.ok())
            return made.status();
        painter_ = std::move(*made);
    }
    const auto truth = integrated(ballsOf(subject.blocks), subject.view, subject.size, stop);
    if (!truth.ok())
        return truth.status();
    for (size_t i = 0; i < used_.size(); ++i)
        if (base::Status status = draw(subject, *truth, used_[i], collected_[i]); !status)
            return status;
    return {};
}

/// The reference of a picture serves all settings.
base::Status ImpostorAccuracy::measureAll(const std::function<bool()>& stop)
{
    collected_.assign(used_.size(), {});
    given_ = 1;
    if (cases_ > 0) {
        for (uint32_t i = 0; i < cases_; ++i)
            if (base::Status status = measure(randomCase(kFirstCase + i, scene_ == "cases-wide"), stop);
                !status)
                return status;
        return {};
    }
    const double number = std::atof(scene_.c_str() + scene_.find('-') + 1);
    for (const Subject& subject :
         scene_.starts_with("near")
             ? nearBlock(number)
             : rowsOfBlocks(number, scene_.starts_with("colors"), scene_.ends_with("small") ? 1 : 8))
        if (base::Status status = measure(subject, stop); !status)
            return status;
    return {};
}

double shareWithin(double limit, const std::vector<double>& rmse)
{
    const auto within = std::ranges::count_if(rmse, [limit](double error) { return error <= limit; });
    return double(within) / double(std::max<size_t>(rmse.size(), 1));
}

double quantileOf(std::vector<double> values, double share)
{
    if (values.empty())
        return 0.0;
    const auto place = values.begin() + ptrdiff_t(share * double(values.size() - 1));
    std::ranges::nth_element(values, place);
    return *place;
}

/// Of random cases: how often blocks become impostors, and how exact these are.
std::string noteOfCases(const Collected& got, double limit)
{
    char note[240];
    std::snprintf(
        note, sizeof note,
        "%.1f %% impostors, %.2f %% of these within %.2g/255, median %.2f, largest %.2f, time %.2f; "
        "with those that fade %.1f %%, %.2f %% within",
        100.0 * double(got.impostorRmse.size()) / double(std::max<size_t>(got.rmse.size(), 1)),
        100.0 * shareWithin(limit, got.impostorRmse), 255.0 * limit,
        255.0 * quantileOf(got.impostorRmse, 0.5), 255.0 * quantileOf(got.impostorRmse, 1.0),
        got.impostorSeconds / std::max(got.ballSeconds, 1e-9),
        100.0 * double(got.anyRmse.size()) / double(std::max<size_t>(got.rmse.size(), 1)),
        100.0 * shareWithin(limit, got.anyRmse));
    return note;
}

base::Result<AccuracySample> ImpostorAccuracy::run(size_t setting, const std::function<bool()>& stop)
{
    const bool isDue = given_++ % used_.size() == 0 && (cases_ == 0 || collected_.empty()); // cases are many
    if (isDue)
        if (base::Status status = measureAll(stop); !status)
            return status;
    const Collected& got = collected_[setting];
    AccuracySample sample;
    storeErrors(got.errors, sample);
    sample.seconds = got.seconds;
    sample.items = double(got.rmse.size());
    const double rmse = std::sqrt(got.squares / double(std::max<uint64_t>(got.values, 1)));
    const double share = shareWithin(kLimit, got.rmse);
    const double brighter = got.wanted > 0.0 ? got.light / got.wanted - 1.0 : 0.0;
    const double limit = used_[setting].error > 0.0f ? double(used_[setting].error) : kLimit;
    sample.work = {{"rmse", rmse},
                   {"pictures", got.rmse.size()},
                   {"share_within_limit", share},
                   {"impostor_pictures", got.impostorRmse.size()},
                   {"impostor_share_within_error", shareWithin(limit, got.impostorRmse)},
                   {"impostor_pictures_with_fading", got.anyRmse.size()},
                   {"impostor_share_within_error_with_fading", shareWithin(limit, got.anyRmse)},
                   {"impostor_rmse_max_with_fading", quantileOf(got.anyRmse, 1.0)},
                   {"impostor_rmse_median", quantileOf(got.impostorRmse, 0.5)},
                   {"impostor_rmse_max", quantileOf(got.impostorRmse, 1.0)},
                   {"impostor_time", got.impostorSeconds / std::max(got.ballSeconds, 1e-9)},
                   {"brighter", brighter},
                   {"impostors", got.impostors},
                   {"tiles", got.tiles},
                   {"milliseconds_with_tiles", 1e3 * got.firstSeconds},
                   {"texture_bytes", got.bytes}};
    char note[128];
    std::snprintf(note, sizeof note, "rmse %.2f/255, %.1f %% within 1/255, %+.2f %% light, %.0f kB",
                  255.0 * rmse, 100.0 * share, 100.0 * brighter, 1e-3 * double(got.bytes));
    sample.note = cases_ > 0 ? noteOfCases(got, limit) : note;
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale& scale)
{
    return std::make_unique<ImpostorAccuracy>(scene, scale);
}

} // namespace

AccuracyTechniqueEntry impostorsAccuracy()
{
    AccuracyTechniqueEntry entry{"impostors",
                                 "impostors of blocks by OpenGL against the ray integral through their balls",
                                 "picture",
                                 ShownError::P99,
                                 {"size-96", "size-48", "size-24", "size-12", "size-6", "colors-24",
                                  "near-2.5", "near-8", "size-48-small", "cases", "cases-wide"},
                                 7,
                                 false,
                                 make};
    entry.hasCases = true;
    return entry;
}

} // namespace fx::cli
