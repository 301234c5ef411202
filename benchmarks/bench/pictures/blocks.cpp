// fx bench blocks: what impostors of blocks save. Blocks of many small balls that cover half of the picture,
// lit, drawn as impostors and ball by ball in the composition `slabs` with 16 slabs, in turn. Prints one JSON
// object: processor time of a frame at rest (all lists are built again), with a moving light and with
// animated blocks, of both; time of the first frame, which draws all tiles; PSNR of the tone-mapped pictures
// over covered pixels; bytes; impostors. Fails when blocks are refused, or when impostors whose error is not
// limited change nothing. More balls
// than can be drawn one by one are compared in 16 random crops of the picture.
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
constexpr float kCropSize = 0.15f; ///< [1] of the picture
constexpr float kWhite = 16.0f;    ///< [1] exposed value that is shown as 1
constexpr int kMaxSettling = 64;   ///< frames

struct Options
{
    uint64_t count = 1'000'000;
    int width = 640, height = 360, repeat = 3;
    float error = render::BlockSettings().error; ///< [1] of impostors; 0: not limited
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
    BlockPictures(const BlockSceneSize& size, float error, const std::optional<PictureCrop>& crop = {})
        : error_(error), scene_(taken(blockScene(size, crop))),
          stage_(taken(QualityStage::create(scene_, size.width, size.height)))
    {
        require(stage_->simulate(base::toTicks(1.0)));
        require(stage_->look(scene_.camera));
    }

    /// [ms] processor time. @param blocks true: as impostors  @param turn [rad] of the sun
    double draw(bool blocks, float turn = 0.0f, float resolution = 1.0f)
    {
        render::ViewSettings settings = stage_->view().renderer.settings();
        settings.blocks.parallax = blocks ? render::BlockSettings().parallax : 0.0f;
        settings.blocks.resolution = resolution;
        settings.blocks.error = error_;
        settings.exposureEv100 = scene_.view.exposureEv100 + 1e-5f * float(++frames_ % 64); // nothing is kept
        const glm::vec3 sun = scene_.view.lighting.sunDirection;
        settings.lighting.sunDirection = {std::cos(turn) * sun.x - std::sin(turn) * sun.z, sun.y,
                                          std::sin(turn) * sun.x + std::cos(turn) * sun.z};
        stage_->view().setSettings(settings);
        require(stage_->draw());
        const render::FrameStatistics& drawn = statistics();
        const bool isAsAsked = blocks ? drawn.blockImpostors > 0 || error_ > 0.0f : drawn.blockImpostors == 0;
        if (drawn.spilledBalls > 0 || drawn.blockParticlesRefused > 0 || !isAsAsked)
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
    uint64_t values = 0;

    void add(const std::vector<float>& a, const std::vector<float>& b, const std::vector<float>& background,
             int width, const PictureCrop& crop)
    {
        const auto shown = [](float x) {
            return double(formula::fxSrgbEncode(formula::fxToneCurve(std::max(x, 0.0f), kWhite)));
        };
        const int height = int(a.size() / 4) / width;
        for (size_t i = 0; i < a.size(); i += 4) {
            const float x = (float(int(i / 4) % width) + 0.5f) / float(width);
            const float y = (float(int(i / 4) / width) + 0.5f) / float(height);
            if (std::abs(x - crop.x) > 0.5f * crop.size || std::abs(y - crop.y) > 0.5f * crop.size)
                continue;
            if (a[i] == background[i] && b[i] == background[i] && a[i + 1] == background[i + 1] &&
                b[i + 1] == background[i + 1])
                continue;
            for (size_t k = 0; k < 3; ++k) {
                const double difference = shown(a[i + k]) - shown(b[i + k]);
                sum += difference * difference;
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

double psnrOfCrops(const BlockSceneSize& size, float error)
{
    SquaredError squares;
    for (int i = 0; i < kCrops; ++i) {
        const auto u = base::randomUnit4(16, 0, uint64_t(i), base::RandomPurpose::Position);
        const PictureCrop crop{0.2f + 0.6f * u[0], 0.25f + 0.5f * u[1], kCropSize};
        BlockPictures pictures(size, error, crop);
        pictures.settle();
        const std::vector<float> blocks = pictures.stage().picture();
        pictures.draw(false);
        squares.add(blocks, pictures.stage().picture(), pictures.stage().background(), size.width, crop);
    }
    return squares.psnr();
}

void measure(Options options)
{
    if (options.isSmall)
        options.width = 160, options.height = 90, options.count = 20'000, options.repeat = 1;
    BlockSceneSize size;
    size.width = options.width;
    size.height = options.height;
    size.blocks = uint32_t(std::clamp<uint64_t>(options.count / kBallsPerBlock, 1, kMaxBlocks));
    size.ballsPerBlock = uint32_t(std::clamp<uint64_t>(options.count / size.blocks, 1, 16384));
    const uint64_t count = uint64_t(size.blocks) * size.ballsPerBlock;
    const bool isSingle = count <= kMaxSingle;

    nlohmann::json line = {{"name", "blocks"},
                           {"count", count},
                           {"blocks", size.blocks},
                           {"particles_per_block", size.ballsPerBlock},
                           {"width", options.width},
                           {"height", options.height},
                           {"block_error", options.error}};
    Machine machine = readMachine();
    {
        BlockPictures pictures(size, options.error);
        machine.glRenderer = pictures.stage().rendererName();
        if (isSingle)
            pictures.draw(false);
        pictures.draw(true, 0.0f, 0.5f); // compiles, and draws tiles of another size
        line["ms_first"] = pictures.draw(true);
        line["tiles_first"] = pictures.statistics().blockTilesDrawn;
        pictures.settle();
        const std::vector<float> blocks = pictures.stage().picture();
        line["bytes"] = pictures.statistics().textureBytes;
        line["impostors"] = pictures.statistics().blockImpostors;
        addTimes(line, "", timesOf(pictures, options.repeat, isSingle, [](int) { return 0.0f; }), isSingle);
        if (isSingle) {
            SquaredError error;
            error.add(blocks, pictures.stage().picture(), pictures.stage().background(), options.width,
                      {0.5f, 0.5f, 1.0f});
            line["psnr"] = error.psnr();
            std::fprintf(stderr, "PSNR %.1f dB\n", error.psnr());
        }
        addTimes(line, "_light",
                 timesOf(pictures, options.repeat, isSingle, [](int i) { return 0.01f * float(i + 1); }),
                 isSingle);
    }
    if (!isSingle)
        line["psnr"] = psnrOfCrops(size, options.error);
    if (isSingle) {
        size.isMoving = true;
        BlockPictures pictures(size, options.error);
        pictures.settle();
        addTimes(line, "_animated",
                 timesOf(pictures, options.repeat, true,
                         [&](int i) {
                             pictures.step(i + 1);
                             return 0.0f;
                         }),
                 true);
    }
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
