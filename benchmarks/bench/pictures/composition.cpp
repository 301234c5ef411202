// fx bench composition: what it costs to put overlapping media together. Clouds of 10 to 10,000 balls that
// fill most of the picture, drawn in each composition in turn, again and again. Prints one JSON object a
// cloud and setting: least time of a frame, the same over that of the sorted composition in the same round,
// balls in lists, and bytes. Fails when something was left out or nothing was drawn.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/card_picture.h"
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
    bool isSmall = false;
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

void measure(Options options)
{
    if (options.isSmall)
        options.width = 160, options.height = 100, options.repeat = 1;
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
    addSizeOption(command, options->width, options->height);
    addRepeatOption(command, options->repeat);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement compositionBench()
{
    return {"composition",
            "Time and memory of a frame in each composition of overlapping media, from 10 to 10,000 balls",
            addOptions};
}

} // namespace fx::cli
