// fx bench composition: what it costs to put overlapping media together. Clouds of 10 to 10,000 balls that
// fill most of the picture, or effects and scenes, drawn in each composition in turn, again and again;
// nothing is kept from the frame before. Prints one JSON object a cloud or file and setting: least time of a
// frame, the same over that of the sorted composition in the same round, balls in lists, and bytes. Fails
// when something was left out or nothing was drawn.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/card_picture.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    int width = 640;
    int height = 360;
    int repeat = 5;
    double time = 2.5; ///< [s] of files
    bool isSmall = false;
    std::vector<std::string> files;
};

struct Setting
{
    const char* name;
    render::Composition composition;
    int slabs = 16;
    int voxels = 96;
};
constexpr Setting kSettings[] = {{"sorted", render::Composition::Sorted},
                                 {"slabs-6", render::Composition::Slabs, 6},
                                 {"slabs-16", render::Composition::Slabs, 16},
                                 {"volume-64", render::Composition::Volume, 16, 64},
                                 {"volume-96", render::Composition::Volume, 16, 96},
                                 {"volume-128", render::Composition::Volume, 16, 128}};

/// The same cloud whatever the count: balls are the smaller the more there are, and all together as thick.
std::vector<Card> cloudOf(uint32_t count)
{
    std::vector<Card> cards = overlappingCards(count);
    for (Card& card : cards)
        card.radius *= count > 270 ? float(std::cbrt(270.0 / double(count))) : 1.0f;
    return cards;
}

double drawOnce(CardPicture& picture, const std::vector<Card>& cards, const Setting& setting)
{
    picture.settings().composition = setting.composition;
    picture.settings().slabs = setting.slabs;
    picture.settings().voxels = setting.voxels;
    const base::FrameSnapshot snapshot = picture.snapshotOf(cards); // each frame shows a new step
    picture.clear();
    double milliseconds = 0.0;
    if (const base::Status status = picture.draw(snapshot, &milliseconds); !status)
        fail(status.message());
    return milliseconds;
}

render::FrameStatistics countOnce(CardPicture& picture, const std::vector<Card>& cards,
                                  const Setting& setting)
{
    picture.settings().countOverdraw = true;
    drawOnce(picture, cards, setting);
    picture.settings().countOverdraw = false;
    return picture.statistics();
}

void report(CardPicture& picture, const std::vector<Card>& cards, const Options& options,
            const std::vector<std::vector<double>>& times, const Machine& machine)
{
    for (size_t k = 0; k < std::size(kSettings); ++k) {
        std::vector<double> ratios;
        for (size_t i = 0; i < times[k].size(); ++i)
            ratios.push_back(times[k][i] / times[0][i]);
        std::sort(ratios.begin(), ratios.end());
        const render::FrameStatistics counted = countOnce(picture, cards, kSettings[k]);
        if (counted.spilledBalls > 0 || counted.coveredPixels == 0)
            fail("the picture lacks something");
        const nlohmann::json line = {{"name", "composition"},
                                     {"setting", kSettings[k].name},
                                     {"balls", cards.size()},
                                     {"width", options.width},
                                     {"height", options.height},
                                     {"ms_frame", *std::min_element(times[k].begin(), times[k].end())},
                                     {"time_ratio", ratios[ratios.size() / 2]},
                                     {"balls_listed", counted.listedBalls},
                                     {"fragments", counted.shadedFragments},
                                     {"covered_pixels", counted.coveredPixels},
                                     {"bytes_frame", counted.sharedBytes},
                                     {"bytes_textures", counted.textureBytes}};
        printJsonLine(withMachine(line, machine));
    }
}

void require(const base::Status& status)
{
    if (!status)
        fail(status.message());
}

/// An effect or a scene at one moment.
class MomentBench
{
public:
    MomentBench(const std::string& file, const Options& options) : options_(options), name_(file)
    {
        const bool isScene = file.ends_with(".scene.json");
        scene_file::Preview preview;
        scene_ = taken(isScene ? scene_file::loadSceneFile(file) : sceneOfPreset(file, &preview));
        const base::Ticks tick = base::toTicks(options.time);
        if (!isScene && !preview.hasCamera)
            require(frameEffect(scene_, tick, {}));
        stage_ = taken(QualityStage::create(scene_, options.width, options.height));
        require(stage_->simulate(tick));
        require(stage_->look(scene_.camera));
    }

    void run()
    {
        std::vector<Times> times(std::size(kSettings));
        for (int round = -1; round < options_.repeat; ++round) // the first may compile
            for (size_t k = 0; k < std::size(kSettings); ++k) {
                draw(kSettings[k]); // makes what the composition keeps
                draw(kSettings[k]);
                if (round < 0)
                    continue;
                times[k].wall.push_back(stage_->wallMilliseconds());
                times[k].processor.push_back(stage_->processorMilliseconds());
            }
        Machine machine = readMachine();
        machine.glRenderer = stage_->rendererName();
        for (size_t k = 0; k < std::size(kSettings); ++k)
            report(k, times, machine);
    }

private:
    struct Times
    {
        std::vector<double> wall, processor; ///< [ms] of each round
    };

    void draw(const Setting& setting)
    {
        render::ViewSettings settings = stage_->view().renderer.settings();
        settings.composition = setting.composition;
        settings.slabs = setting.slabs;
        settings.voxels = setting.voxels;
        settings.exposureEv100 = scene_.view.exposureEv100 + 1e-4f * float(++frames_); // nothing is kept
        stage_->view().setSettings(settings);
        require(stage_->draw());
    }

    static double medianRatio(const std::vector<double>& times, const std::vector<double>& sorted)
    {
        std::vector<double> ratios;
        for (size_t i = 0; i < times.size(); ++i)
            ratios.push_back(times[i] / sorted[i]);
        std::sort(ratios.begin(), ratios.end());
        return ratios[ratios.size() / 2];
    }

    void report(size_t k, const std::vector<Times>& times, const Machine& machine)
    {
        draw(kSettings[k]);
        const render::FrameStatistics& drawn = stage_->view().renderer.statistics();
        if (drawn.blobs == 0 && drawn.sprites == 0)
            fail(name_ + ": nothing was drawn");
        const nlohmann::json line = {
            {"name", "composition"},
            {"setting", kSettings[k].name},
            {"scene", name_},
            {"time", options_.time},
            {"balls", drawn.blobs},
            {"width", options_.width},
            {"height", options_.height},
            {"ms_frame", *std::min_element(times[k].wall.begin(), times[k].wall.end())},
            {"ms_processor", *std::min_element(times[k].processor.begin(), times[k].processor.end())},
            {"time_ratio", medianRatio(times[k].wall, times[0].wall)},
            {"processor_ratio", medianRatio(times[k].processor, times[0].processor)},
            {"bytes_frame", drawn.sharedBytes},
            {"bytes_textures", drawn.textureBytes}};
        printJsonLine(withMachine(line, machine));
    }

    const Options& options_;
    std::string name_;
    scene_file::SceneFile scene_;
    std::unique_ptr<QualityStage> stage_;
    uint64_t frames_ = 0;
};

void measure(Options options)
{
    if (options.isSmall)
        options.width = 160, options.height = 100, options.repeat = 1;
    for (const std::string& file : options.files)
        MomentBench(file, options).run();
    if (!options.files.empty())
        return;
    const auto picture = taken(CardPicture::create(options.width, options.height, 2.4f));
    Machine machine = readMachine();
    machine.glRenderer = picture->renderer();
    for (const uint32_t count : {10u, 270u, 1000u, 10'000u}) {
        if (options.isSmall && count > 1000)
            continue;
        const std::vector<Card> cards = cloudOf(count);
        std::vector<std::vector<double>> times(std::size(kSettings));
        for (int round = -1; round < options.repeat; ++round) // the first may compile
            for (size_t k = 0; k < std::size(kSettings); ++k) {
                const double milliseconds = drawOnce(*picture, cards, kSettings[k]);
                if (round >= 0)
                    times[k].push_back(milliseconds);
            }
        report(*picture, cards, options, times, machine);
    }
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("FILE", options->files,
                       "Effects (*.fx.json, library:NAME) and scenes (*.scene.json) instead of clouds");
    command.add_option("--time", options->time, "[s] Of files: the moment that is drawn; default 2.5")
        ->check(CLI::Range(0.0, 3600.0));
    addSizeOption(command, options->width, options->height);
    addRepeatOption(command, options->repeat);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement compositionBench()
{
    return {
        "composition",
        "Time and memory of a frame in each composition of overlapping media: 10 to 10,000 balls, or effects",
        addOptions};
}

} // namespace fx::cli
