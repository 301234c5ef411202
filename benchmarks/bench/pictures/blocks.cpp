// fx bench blocks: what impostors of blocks save. Blocks of many small balls that cover half of the picture,
// lit, drawn as impostors and ball by ball in the composition `slabs` with 16 slabs, in turn. Prints one JSON
// object: processor time of a frame at rest (all lists are built again), with a moving light and with
// animated blocks, of both; time of the first frame, which draws all tiles; PSNR of the tone-mapped pictures
// over covered pixels; bytes; impostors. Fails when balls are missing, or when impostors whose error is not
// limited change nothing. More balls than can be drawn one by one are compared in 16 random parts of the
// picture.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/block_scene.h"
#include "benchmarks/scenes/quality_stage.h"
#include "foundation/random/philox.h"
#include "fxsdk/cli/support/json_line.h"
#include "shaders/formulas/formula.h"

#include <CLI/CLI.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr uint32_t kBallsPerBlock = 512;
constexpr uint32_t kMaxBlocks = 2000;
constexpr uint64_t kMaxSingle = 1048576; ///< balls of an effect that are drawn one by one
constexpr int kCrops = 16;
constexpr double kCropSize = 0.05;      ///< [1] of the picture
constexpr uint64_t kMaxCasters = 65536; ///< balls of an effect that all cast shadows
constexpr float kWhite = 16.0f;         ///< [1] exposed value that is shown as 1
constexpr int kMaxSettling = 64;        ///< frames

struct Options
{
    uint64_t count = 1'000'000;
    int width = 640, height = 360, repeat = 3;
    float error = render::BlockSettings().error; ///< [1] of impostors; 0: not limited
    std::optional<int> crops;                    ///< empty: as many as the number of balls needs
    bool isSmall = false;
};

void require(const base::Status& status)
{
    if (!status)
        fail(status.message());
}

/// A scene of blocks that is drawn in both ways.
class BlockPictures
{
public:
    /// @param error [1] limit of the error of impostors; 0: none
    /// @param window part of the picture that is drawn; empty: all of it
    /// @param isForWindow true: only what may be seen there has all of its balls
    BlockPictures(const BlockSceneSize& size, float error, const std::optional<PictureWindow>& window = {},
                  bool isForWindow = false)
        : error_(error), scene_(taken(blockScene(size, isForWindow ? window : std::nullopt))),
          stage_(taken(QualityStage::create(scene_, window ? window->width : size.width,
                                            window ? window->height : size.height)))
    {
        require(stage_->simulate(base::toTicks(1.0)));
        look(window);
    }

    void look(const std::optional<PictureWindow>& window) { require(stage_->look(scene_.camera, window)); }

    /// [ms] processor time. @param blocks true: as impostors  @param turn [rad] of the sun
    double draw(bool blocks, float turn = 0.0f, float resolution = 1.0f)
    {
        render::ViewSettings settings = stage_->view().renderer.settings();
        settings.blocks.parallax = blocks ? render::BlockSettings().parallax : 0.0f;
        settings.blocks.resolution = resolution;
        settings.blocks.error = error_;
        settings.exposureEv100 = scene_.view.exposureEv100 + 4e-6f * float(++frames_ % 4); // nothing is kept
        const glm::vec3 sun = scene_.view.lighting.sunDirection;
        settings.lighting.sunDirection = {std::cos(turn) * sun.x - std::sin(turn) * sun.z, sun.y,
                                          std::sin(turn) * sun.x + std::cos(turn) * sun.z};
        stage_->view().setSettings(settings);
        require(stage_->draw());
        const render::FrameStatistics& drawn = statistics();
        const bool isAsAsked = blocks ? drawn.blockImpostors > 0 || error_ > 0.0f : drawn.blockImpostors == 0;
        const bool areRefused = !blocks && drawn.blockParticlesRefused > 0; // impostors stand for any number
        if (drawn.spilledBalls > 0 || areRefused || !isAsAsked)
            fail("blocks are missing or are not drawn as asked: impostors " +
                 std::to_string(drawn.blockImpostors) + ", balls spilled " +
                 std::to_string(drawn.spilledBalls) + ", refused " +
                 std::to_string(drawn.blockParticlesRefused));
        return stage_->processorMilliseconds();
    }
    void settle()
    {
        int frames = 0;
        do
            draw(true);
        while (statistics().blockTilesDeferred > 0 && ++frames < kMaxSettling);
        if (statistics().blockTilesDeferred > 0)
            fail("tiles are missing after " + std::to_string(frames) + " frames");
        if (statistics().blockImpostors == 0)
            fail("no block is drawn as an impostor: allow a larger error with --block-error");
    }
    void step(int number) { require(stage_->simulate(base::toTicks(1.0 + double(number) / 60.0))); }

    const render::FrameStatistics& statistics() const { return stage_->view().renderer.statistics(); }
    QualityStage& stage() { return *stage_; }

private:
    float error_;
    scene_file::SceneFile scene_;
    std::unique_ptr<QualityStage> stage_;
    uint64_t frames_ = 0;
};

/// Sum of squared differences of tone-mapped values, over pixels that media cover.
struct SquaredError
{
    double sum = 0.0;
    double lightA = 0.0, lightB = 0.0; ///< sums of linear values
    uint64_t values = 0;

    void add(const std::vector<float>& a, const std::vector<float>& b, const std::vector<float>& background)
    {
        const auto shown = [](float x) {
            return double(formula::fxSrgbEncode(formula::fxToneCurve(std::max(x, 0.0f), kWhite)));
        };
        for (size_t i = 0; i < a.size(); i += 4) {
            if (a[i] == background[i] && b[i] == background[i] && a[i + 1] == background[i + 1] &&
                b[i + 1] == background[i + 1])
                continue;
            for (size_t k = 0; k < 3; ++k) {
                const double difference = shown(a[i + k]) - shown(b[i + k]);
                sum += difference * difference;
                lightA += double(a[i + k]);
                lightB += double(b[i + k]);
                ++values;
            }
        }
    }
    double psnr() const
    {
        return -10.0 * std::log10(std::max(sum / double(std::max<uint64_t>(values, 1)), 1e-12));
    }
};

/// Least processor times of a frame [ms].
struct Times
{
    double blocks = 1e30, single = 1e30;

    double ratio() const { return single / blocks; }
};

Times timesOf(BlockPictures& pictures, int repeat, bool isSingle, const std::function<float(int)>& prepare)
{
    Times times;
    for (int i = 0; i < repeat; ++i) {
        const float turn = prepare(i);
        times.blocks = std::min(times.blocks, pictures.draw(true, turn));
        if (isSingle)
            times.single = std::min(times.single, pictures.draw(false, turn));
    }
    return times;
}

void addTimes(nlohmann::json& io, const std::string& name, const Times& times, bool isSingle)
{
    io["ms_blocks" + name] = times.blocks;
    if (!isSingle)
        return;
    io["ms_single" + name] = times.single;
    io["ratio" + name] = times.ratio();
    // a million balls take half an hour: what is known is not lost
    std::fprintf(stderr, "%s: %.0f ms ball by ball, %.0f ms as impostors, %.2f times as fast\n",
                 name.empty() ? "at rest" : name.c_str() + 1, times.single, times.blocks, times.ratio());
}

std::vector<PictureWindow> cropsOf(const BlockSceneSize& size, int count)
{
    std::vector<PictureWindow> crops;
    for (int i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(16, 0, uint64_t(i), base::RandomPurpose::Position);
        PictureWindow crop;
        crop.pictureWidth = size.width;
        crop.pictureHeight = size.height;
        crop.width = std::max(int(std::lround(kCropSize * size.width)), 1);
        crop.height = std::max(int(std::lround(kCropSize * size.height)), 1);
        crop.x = int((0.2 + 0.6 * double(u[0])) * size.width) - crop.width / 2;
        crop.y = int((0.25 + 0.5 * double(u[1])) * size.height) - crop.height / 2;
        crops.push_back(crop);
    }
    return crops;
}

std::vector<float> partOf(const std::vector<float>& picture, const PictureWindow& window)
{
    std::vector<float> part;
    for (int y = 0; y < window.height; ++y) {
        const auto row = picture.begin() + 4 * (ptrdiff_t(window.y + y) * window.pictureWidth + window.x);
        part.insert(part.end(), row, row + 4 * ptrdiff_t(window.width));
    }
    return part;
}

/// Compares random parts of the picture. The light is that of the whole picture: light slices belong to the
/// eye and to all that casts shadows. Ball by ball, blocks beside the part cast the shadow of one ball, as
/// blocks that are drawn as impostors do where there are many balls.
/// @param whole the picture of impostors, to see that parts of it have its places and its light
void measureCrops(const BlockSceneSize& size, float error, int count, const std::vector<float>& whole,
                  nlohmann::json& io)
{
    const std::vector<PictureWindow> crops = cropsOf(size, count);
    const bool areMany = uint64_t(size.blocks) * size.ballsPerBlock() > kMaxCasters;
    std::vector<std::vector<float>> blocks;
    SquaredError squares, squaresOfParts;
    Times times{0.0, 0.0};
    {
        BlockPictures pictures(size, error, crops.front());
        for (const PictureWindow& crop : crops) {
            pictures.look(crop);
            pictures.settle();
            blocks.push_back(pictures.stage().picture());
            squaresOfParts.add(blocks.back(), partOf(whole, crop), pictures.stage().background());
        }
        // In turning light, so that light slices are filled again, as they are ball by ball.
        for (size_t i = 0; i < crops.size(); ++i) {
            pictures.look(crops[i]);
            times.blocks += pictures.draw(true, 0.01f * float(i + 1));
        }
    }
    uint64_t balls = 0;
    for (size_t i = 0; i < crops.size(); ++i) {
        BlockPictures pictures(size, error, crops[i], areMany);
        if (i == 0) // drivers compile
            pictures.draw(false);
        times.single += pictures.draw(false);
        balls += pictures.statistics().blobs;
        squares.add(blocks[i], pictures.stage().picture(), pictures.stage().background());
        std::fprintf(stderr, "crop %zu: %llu balls, %.0f ms, PSNR so far %.1f dB\n", i + 1,
                     static_cast<unsigned long long>(pictures.statistics().blobs), times.single,
                     squares.psnr());
    }
    io["crops"] = count;
    io["crop_width"] = crops.front().width;
    io["crop_height"] = crops.front().height;
    io["crop_balls"] = balls;
    io["psnr"] = squares.psnr();
    io["psnr_whole"] = squaresOfParts.psnr(); // impostors of the parts against those of the whole picture
    io["brighter"] = squares.lightA / squares.lightB - 1.0;
    io["ms_single"] = times.single; // of first frames, which also upload what does not change
    io["ms_blocks_crops"] = times.blocks;
    io["ratio"] = times.ratio();
}

void measureAnimated(BlockSceneSize size, const Options& options, bool isSingle, nlohmann::json& io)
{
    size.isMoving = true;
    BlockPictures pictures(size, options.error);
    pictures.settle();
    const auto step = [&](int i) {
        pictures.step(i + 1);
        return 0.0f;
    };
    addTimes(io, "_animated", timesOf(pictures, options.repeat, isSingle, step), isSingle);
}

void measure(Options options)
{
    if (options.isSmall) { // with crops: enough balls for shadows of single balls
        options.width = 160, options.height = 90, options.repeat = 1;
        options.count = options.crops ? kMaxCasters + 5'000 : 20'000;
    }
    BlockSceneSize size;
    size.width = options.width;
    size.height = options.height;
    size.blocks = uint32_t(std::clamp<uint64_t>(options.count / kBallsPerBlock, 1, kMaxBlocks));
    const uint64_t perBlock = std::max<uint64_t>(options.count / size.blocks, 1);
    size.partsPerBlock = uint32_t(std::max<uint64_t>((perBlock + kBallsPerBlock / 2) / kBallsPerBlock, 1));
    size.ballsPerPart = uint32_t(perBlock / size.partsPerBlock);
    const uint64_t count = uint64_t(size.blocks) * size.ballsPerBlock();
    const int crops = options.crops.value_or(count > kMaxSingle ? kCrops : 0);
    const bool isSingle = crops == 0;

    nlohmann::json line = {{"name", "blocks"},
                           {"count", count},
                           {"blocks", size.blocks},
                           {"particles_per_block", size.ballsPerBlock()},
                           {"parts_per_block", size.partsPerBlock},
                           {"width", options.width},
                           {"height", options.height},
                           {"block_error", options.error}};
    Machine machine = readMachine();
    std::vector<float> blocks;
    {
        BlockPictures pictures(size, options.error);
        machine.glRenderer = pictures.stage().rendererName();
        if (isSingle)
            pictures.draw(false);
        pictures.draw(true, 0.0f, 0.5f); // compiles, and draws tiles of another size
        line["ms_first"] = pictures.draw(true);
        line["tiles_first"] = pictures.statistics().blockTilesDrawn;
        pictures.settle();
        blocks = pictures.stage().picture();
        line["bytes"] = pictures.statistics().textureBytes;
        line["impostors"] = pictures.statistics().blockImpostors;
        addTimes(line, "", timesOf(pictures, options.repeat, isSingle, [](int) { return 0.0f; }), isSingle);
        if (isSingle) {
            SquaredError error;
            error.add(blocks, pictures.stage().picture(), pictures.stage().background());
            line["psnr"] = error.psnr();
            std::fprintf(stderr, "PSNR %.1f dB\n", error.psnr());
        }
        addTimes(line, "_light",
                 timesOf(pictures, options.repeat, isSingle, [](int i) { return 0.01f * float(i + 1); }),
                 isSingle);
    }
    if (!isSingle)
        measureCrops(size, options.error, crops, blocks, line);
    measureAnimated(size, options, isSingle, line);
    printJsonLine(withMachine(line, machine));
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--count", options->count, "Balls of all blocks together; default 1,000,000")
        ->check(CLI::Range(uint64_t(1), uint64_t(30'000'000)));
    command
        .add_option("--block-error", options->error,
                    "[1] Root mean square error, in units of white, up to which blocks are impostors; "
                    "0: not limited; default 4/255")
        ->check(CLI::Range(0.0f, 1.0f));
    command
        .add_option("--crops", options->crops,
                    "Random parts of the picture that are drawn ball by ball, instead of the whole picture; "
                    "default 16 for more than 1,048,576 balls, otherwise 0")
        ->check(CLI::Range(0, 1000));
    addSizeOption(command, options->width, options->height);
    addRepeatOption(command, options->repeat);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement blocksBench()
{
    return {"blocks", "Time, memory and error of blocks as impostors against the same balls one by one",
            addOptions};
}

} // namespace fx::cli
