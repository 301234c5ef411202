// Media from files: voxels (*.fxvolume) and balls (*.fxballs).
#include "fxsdk/assets/volume_file.h"
#include "simulation/cloud/ball_list.h"
#include "tests/fuzz/fuzz_target.h"

#include <cmath>

namespace fx::fuzz {

namespace {

constexpr std::string_view kHash = "\nhash ", kData = "\ndata\n";

/// Writes the hash that the data have, so that what lies behind its check is reached.
void repairHash(std::string& io)
{
    const size_t hash = io.find(kHash), data = io.find(kData);
    if (hash == std::string::npos || data == std::string::npos || data < hash)
        return;
    constexpr std::string_view kDigits = "0123456789abcdef";
    const uint64_t value = asset::volumeHash(std::string_view(io).substr(0, hash + 1),
                                             std::string_view(io).substr(data + kData.size()));
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4)
        text += kDigits[value >> shift & 15];
    io.replace(hash + kHash.size(), data - hash - kHash.size(), text);
}

void checkVolume(const base::VoxelVolume& volume)
{
    const size_t voxels = volume.bricks.size() * base::kVolumeBrickVoxels;
    require(volume.extinction.size() == voxels, "each voxel has an extinction");
    for (const size_t size : {volume.temperature.size(), volume.emission.size(), volume.emissionRate.size(),
                              volume.albedo.size(), volume.velocity.size()})
        require(size == 0 || size == voxels, "a channel has all voxels or none");
    double sum = 0.0;
    for (const float extinction : volume.extinction) {
        require(std::isfinite(extinction) && extinction >= 0.0f, "extinctions are finite and not negative");
        sum += double(extinction);
    }
    double cells = 0.0;
    const double voxel = std::pow(double(volume.side), 3.0);
    for (const base::VolumeCells& brick : base::volumeCells(volume))
        cells += double(brick.crossSection);
    require(!std::isfinite(cells) || sum * voxel < 1e-30 ||
                std::abs(cells - sum * voxel) <= 1e-3 * sum * voxel,
            "the cells of bricks have the medium of the voxels");
    const auto again = asset::writeVolume(volume);
    require(again.ok(), "a volume that was read can be written");
    const auto reread = asset::parseVolume(*again);
    require(reread.ok(), "and read again");
    require(*asset::writeVolume(*reread) == *again, "with the same bytes");
    require(reread->bricks == volume.bricks, "with the same bricks");
}

std::string smallVolume(bool hasLight)
{
    base::VoxelVolume volume;
    volume.side = 0.25f;
    volume.origin = {-1.0f, 0.5f, 2.0f};
    volume.bricks = {{1, 1, 1}, {3, 2, 1}};
    volume.extinction.assign(2 * base::kVolumeBrickVoxels, 0.5f);
    volume.extinction[7] = 8.0f;
    if (hasLight) {
        volume.temperature.assign(volume.extinction.size(), 900.0f);
        volume.emission.assign(volume.extinction.size(), {1.0f, 2.0f, 0.0f});
        volume.albedo.assign(volume.extinction.size(), {0.5f, 0.25f, 1.0f});
        volume.emissionRate.assign(volume.extinction.size(), -30.0f);
    }
    return *asset::writeVolume(volume);
}

} // namespace

/// The first byte chooses the format, and whether the hash is repaired.
void runInput(std::span<const uint8_t> input)
{
    InputReader reader(input);
    const uint8_t format = reader.byte();
    std::string bytes(textOf(reader.rest()));
    if (format == 'b') {
        const auto balls = sim::parseBallList(bytes);
        if (balls)
            require(sim::parseBallList(sim::writeBallList(**balls)).ok(), "balls that were read are written");
        else
            require(!balls.status().message().empty(), "a refused list has a message");
        return;
    }
    if (format == 'r')
        repairHash(bytes);
    const auto volume = asset::parseVolume(bytes);
    if (volume)
        checkVolume(*volume);
    else
        require(!volume.status().message().empty(), "a refused volume has a message");
}

std::vector<std::string> seeds()
{
    const sim::BallList balls(2);
    const std::string head =
        "fxvolume 1\nbricks 1\nside 1\norigin 0 0 0\nalbedo 0 0 0\nextinction 1\nhash 0\ndata\n";
    return {
        "v" + smallVolume(false),
        "r" + smallVolume(true),
        "r" + head + std::string(1030, '\1'),
        "r" + head + std::string(1030, '\x7f'),
        "vfxvolume 1\nbricks 32768\nside 1\norigin 0 0 0\nalbedo 0 0 0\nextinction 1\nhash 0\ndata\n",
        "vfxvolume 2\n",
        "vfxvolume 1\nbricks 99999999999999999999\n",
        "b" + sim::writeBallList(balls),
        "bfxballs 1\ncount 1048576\ndata\n",
    };
}

} // namespace fx::fuzz
