#include "fxsdk/cli/import/volume_preset.h"

#include "foundation/math/hash.h"
#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/frame_name.h"
#include "fxsdk/cli/import/preset_files.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/presets/preset_loader.h"
#include "rendering/optics/color_temperature.h"
#include "simulation/cloud/moving_cloud.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fx::cli {
namespace {

/// The balls beside the voxels of a grid. Their numbers are those of the balls in their effect and instance.
sim::MovingBalls movingBallsOf(const render::MediumGrid& grid)
{
    constexpr float kCold = 293.0f; // [K] the luminance is all of the light
    sim::MovingBalls balls;
    for (const render::VoxelBall& from : grid.balls) {
        sim::MovingBall& out = balls.emplace_back();
        out.ball.center = glm::vec3(from.center);
        out.ball.radius = float(from.radius);
        out.ball.crossSection = float(from.crossSection);
        out.ball.temperature = kCold;
        out.ball.albedo = glm::vec3(from.albedo);
        out.ball.emission = float(from.luminance) * render::blackBodyColor(float(from.temperature));
        out.velocity = glm::vec3(from.velocity);
        out.streak = glm::vec3(from.streak);
        out.age = float(from.age);
        out.rate = float(from.luminanceRate);
        out.number = base::hashWord(from.instance, from.id);
    }
    std::ranges::stable_sort(balls, {}, &sim::MovingBall::number);
    const auto isSame = [](const sim::MovingBall& a, const sim::MovingBall& b) {
        return a.number == b.number;
    };
    balls.erase(std::unique(balls.begin(), balls.end(), isSame), balls.end());
    return balls;
}

/// An element of the member "clouds".
nlohmann::ordered_json cloudOf(const std::string& stem, const SequencePlay& play)
{
    return {{"name", stem + " balls"},  {"file", stem + ".%04d.fxballs"},          {"frames", play.count},
            {"firstFrame", play.first}, {"framesPerSecond", play.framesPerSecond}, {"end", play.end}};
}

/// Names of numbered files have one '%', that of the number.
base::Status checkNumberedStem(const std::string& stem, const std::filesystem::path& preset, const char* what)
{
    if (stem.find('%') == std::string::npos)
        return {};
    return {base::Code::InvalidArgument,
            preset.string() + ": the name of the preset of " + what + " has no '%'"};
}

/// Counts the balls of a frame. @return TooLarge if all frames together have more than are allowed
base::Status addBalls(size_t count, uint64_t& io)
{
    io += count;
    if (io <= sim::kMaxPlayedBalls)
        return {};
    return {base::Code::TooLarge, "the frames up to this one have " + std::to_string(io) +
                                      " balls beside the voxels; allowed are " +
                                      std::to_string(sim::kMaxPlayedBalls) +
                                      ": import fewer frames, or export with a smaller --balls-below"};
}

/// @return Io, InvalidArgument for numbers out of range
base::Result<uint64_t> writeBalls(const sim::MovingBalls& balls, const std::filesystem::path& file)
{
    const std::string bytes = sim::writeMovingBalls(balls);
    if (const auto readBack = sim::parseMovingBalls(bytes); !readBack)
        return base::Status(readBack.status().code(), file.string() + ": " + readBack.status().message());
    if (base::Status status = writeFileAtomically(file, bytes); !status)
        return status;
    return uint64_t(bytes.size());
}

} // namespace

base::Result<BrickReport> writeVolumePreset(const render::MediumGrid& grid, double albedo,
                                            const std::filesystem::path& preset)
{
    const base::Result<std::string> stem = presetStem(preset);
    if (!stem)
        return stem.status();
    if (!grid.balls.empty())
        if (base::Status status = checkNumberedStem(*stem, preset, "voxels with balls beside them"); !status)
            return status;
    const base::Result<VolumeBytes> volume = volumeBytesOf(grid, albedo);
    if (!volume)
        return volume.status();
    BrickReport report;
    report.bricks = volume->bricks;
    report.side = volume->side;
    report.massError = volume->massError;
    report.isResampled = volume->isResampled;
    report.file = preset.parent_path() / (*stem + ".fxvolume");
    nlohmann::ordered_json text{{"version", 1},
                                {"name", *stem},
                                {"composition", "volume"},
                                {"volumes", {{{"name", *stem}, {"file", *stem + ".fxvolume"}}}}};
    if (const sim::MovingBalls balls = movingBallsOf(grid); !balls.empty()) {
        report.balls = balls.size();
        text["clouds"] = nlohmann::ordered_json::array({cloudOf(*stem, {})});
        const auto written = writeBalls(balls, preset.parent_path() / (*stem + ".0000.fxballs"));
        if (!written)
            return written.status();
    }
    setAnisotropy(grid.anisotropy, text);
    if (base::Status status = writePresetFiles(preset, text, report.file, volume->bytes); !status)
        return status;
    return report;
}

namespace {

/// Whether the files make a sequence: lattices, range and memory.
base::Status checkWritten(const std::string& text, const std::filesystem::path& path)
{
    const std::string folder = path.parent_path().string();
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, {});
    const auto loaded = preset::loadPresetText(text, path.string(), nullptr, &resolver);
    return loaded ? base::Status() : loaded.status();
}

/// Adds a frame of a sequence. @param isFirst no frame has been added before
void add(const VolumeBytes& volume, bool isFirst, SequenceReport& io)
{
    io.massError = std::max(io.massError, std::abs(volume.massError));
    io.mostBricks = std::max(io.mostBricks, volume.bricks);
    io.bytes += volume.bytes.size();
    io.leastSide = isFirst ? volume.side : std::min(io.leastSide, volume.side);
    io.side = std::max(io.side, volume.side);
    io.hasVelocities = io.hasVelocities && volume.hasVelocities;
    io.isResampled = io.isResampled || volume.isResampled;
}

/// Writes the voxels of all frames, which `report.files` names.  @return the balls beside them, by frame
base::Result<std::vector<sim::MovingBalls>> writeFrames(const FrameGrid& gridOf, const SequencePlay& play,
                                                        double albedo, SequenceReport& report)
{
    std::vector<sim::MovingBalls> balls;
    uint64_t sumOfBalls = 0;
    for (uint32_t i = 0; i < play.count; ++i) {
        const uint32_t number = play.first + i;
        if (interruptRequested())
            return interruptedStatus();
        const base::Result<render::MediumGrid> grid = gridOf(number);
        if (!grid)
            return grid.status();
        const auto inFrame = [&](const base::Status& status) {
            return base::Status(status.code(), "frame " + std::to_string(number) + ": " + status.message());
        };
        if (base::Status status = addBalls(grid->balls.size(), sumOfBalls); !status)
            return inFrame(status);
        const base::Result<VolumeBytes> volume = volumeBytesOf(*grid, albedo, true);
        if (!volume)
            return inFrame(volume.status());
        add(*volume, i == 0, report);
        report.anisotropy += grid->anisotropy / play.count;
        balls.push_back(movingBallsOf(*grid));
        report.mostBalls = std::max(report.mostBalls, balls.back().size());
        const std::filesystem::path file =
            report.files.parent_path() / *asset::frameName(report.files.filename().string(), number);
        if (base::Status status = writeFileAtomically(file, volume->bytes); !status)
            return status;
    }
    return balls;
}

} // namespace

base::Result<SequenceReport> writeSequencePreset(const FrameGrid& gridOf, const SequencePlay& play,
                                                 double albedo, const std::filesystem::path& preset)
{
    const base::Result<std::string> stem = presetStem(preset);
    if (!stem)
        return stem.status();
    if (base::Status status = checkNumberedStem(*stem, preset, "a sequence"); !status)
        return status;
    const std::string pattern = *stem + ".%04d.fxvolume";
    SequenceReport report;
    report.files = preset.parent_path() / pattern;
    const auto balls = writeFrames(gridOf, play, albedo, report);
    if (!balls)
        return balls.status();
    nlohmann::ordered_json text{{"version", 1},
                                {"name", *stem},
                                {"composition", "volume"},
                                {"volumes",
                                 {{{"name", *stem},
                                   {"file", pattern},
                                   {"frames", play.count},
                                   {"firstFrame", play.first},
                                   {"framesPerSecond", play.framesPerSecond},
                                   {"end", play.end},
                                   {"memory", play.memory}}}}};
    if (report.mostBalls > 0) {
        const nlohmann::ordered_json cloud = cloudOf(*stem, play);
        for (uint32_t i = 0; i < play.count; ++i) {
            const auto name = asset::frameName(cloud["file"].get<std::string>(), play.first + i);
            const base::Result<uint64_t> size = writeBalls((*balls)[i], preset.parent_path() / *name);
            if (!size)
                return size.status();
            report.bytes += *size;
        }
        text["clouds"] = nlohmann::ordered_json::array({cloud});
    }
    setAnisotropy(report.anisotropy, text);
    const std::string written = text.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (base::Status status = checkWritten(written, preset); !status)
        return status;
    if (base::Status status = writeFileAtomically(preset, written); !status)
        return status;
    return report;
}

} // namespace fx::cli
