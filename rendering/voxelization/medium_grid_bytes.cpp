/// @file medium_grid_bytes.cpp
/// Medium grids as bytes between processes.

#include "rendering/voxelization/medium_grid.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace fx::render {
namespace {

constexpr uint64_t kMark = 0x34646972676d7866; // "fxmgrid4"
constexpr uint64_t kMostBlocks = uint64_t(1) << 24;
constexpr uint64_t kMostWarnings = 64;
constexpr uint64_t kMostText = 4096; // [byte] of a warning
constexpr int kFarthest = 1 << 28;   // [voxel]

template <class T>
void put(std::string& io, const T* values, size_t count)
{
    static_assert(std::is_trivially_copyable_v<T>);
    const uint64_t n = count;
    io.append(reinterpret_cast<const char*>(&n), sizeof n);
    if (count > 0)
        io.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// Reads what put() has written.
class Parts
{
public:
    explicit Parts(std::string_view bytes) : rest_(bytes) {}

    /// @return false when the bytes hold less, or more than `most` elements
    template <class T>
    bool take(std::vector<T>& out, uint64_t most)
    {
        uint64_t count = 0;
        if (rest_.size() < sizeof count)
            return false;
        std::memcpy(&count, rest_.data(), sizeof count);
        rest_.remove_prefix(sizeof count);
        if (count > most || count > rest_.size() / sizeof(T))
            return false;
        out.resize(count);
        if (count > 0)
            std::memcpy(out.data(), rest_.data(), count * sizeof(T));
        rest_.remove_prefix(count * sizeof(T));
        return true;
    }

    bool isEmpty() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

bool areInRange(const std::vector<float>& values)
{
    for (const float value : values)
        if (!(value >= 0.0f) || !std::isfinite(value))
            return false;
    return true;
}

bool areRates(const std::vector<float>& values)
{
    return std::ranges::all_of(values, [](float value) { return std::abs(value) <= base::kMostVolumeRate; });
}

bool areFinite(const std::vector<glm::vec3>& values, float low, float high)
{
    for (const glm::vec3& value : values)
        for (int a = 0; a < 3; ++a)
            if (!(value[a] >= low && value[a] <= high))
                return false;
    return true;
}

bool isValid(const MediumGrid& grid)
{
    const auto fits = [&](size_t count) {
        return count == 0 || count == grid.blocks.size() * size_t(kBlockVoxels);
    };
    if (grid.density.size() != grid.blocks.size() * size_t(kBlockVoxels) || !fits(grid.temperature.size()) ||
        !fits(grid.flame.size()) || !fits(grid.flameRate.size()) || !fits(grid.albedo.size()) ||
        !fits(grid.velocity.size()))
        return false;
    const auto key = [](const glm::ivec3& b) { return std::array{b.x, b.y, b.z}; };
    for (size_t i = 0; i < grid.blocks.size(); ++i) {
        for (int a = 0; a < 3; ++a)
            if (grid.blocks[i][a] % kBlockSide != 0 || std::abs(int64_t(grid.blocks[i][a])) > kFarthest)
                return false;
        if (i > 0 && !(key(grid.blocks[i - 1]) < key(grid.blocks[i])))
            return false;
    }
    for (const VoxelBall& ball : grid.balls)
        if (!isInRange(ball))
            return false;
    const double volume = grid.voxelVolume();
    constexpr float kFast = 1e9f; // [m/s]
    return std::isfinite(volume) && volume > 0.0 && std::abs(grid.anisotropy) <= kMostAnisotropy &&
           std::isfinite(grid.origin.x + grid.origin.y + grid.origin.z) && areInRange(grid.density) &&
           areInRange(grid.temperature) && areInRange(grid.flame) && areRates(grid.flameRate) &&
           areFinite(grid.albedo, 0.0f, 1.0f) && areFinite(grid.velocity, -kFast, kFast);
}

} // namespace

bool isInRange(const VoxelBall& ball)
{
    constexpr double kFar = 1e6, kFast = 1e9;
    const auto isIn = [](double value, double low, double high) { return value >= low && value <= high; };
    for (int a = 0; a < 3; ++a)
        if (!isIn(ball.center[a], -kFar, kFar) || !isIn(ball.velocity[a], -kFast, kFast) ||
            !isIn(ball.streak[a], -kFar, kFar) || !isIn(ball.albedo[a], 0.0, 1.0))
            return false;
    return isIn(ball.radius, 1e-6, kFar) && isIn(ball.crossSection, 0.0, 1e12) &&
           isIn(ball.temperature, 0.0, 1e5) && isIn(ball.luminance, 0.0, 1e11) &&
           isIn(ball.age, 0.0, VoxelBall::kUnknownAge) &&
           isIn(ball.luminanceRate, -VoxelBall::kMostRate, VoxelBall::kMostRate);
}

std::string toBytes(const MediumGrid& grid)
{
    std::string bytes;
    put(bytes, &kMark, 1);
    put(bytes, &grid.axes, 1);
    put(bytes, &grid.origin, 1);
    put(bytes, &grid.anisotropy, 1);
    put(bytes, grid.blocks.data(), grid.blocks.size());
    put(bytes, grid.density.data(), grid.density.size());
    put(bytes, grid.temperature.data(), grid.temperature.size());
    put(bytes, grid.flame.data(), grid.flame.size());
    put(bytes, grid.flameRate.data(), grid.flameRate.size());
    put(bytes, grid.albedo.data(), grid.albedo.size());
    put(bytes, grid.velocity.data(), grid.velocity.size());
    put(bytes, grid.balls.data(), grid.balls.size());
    const uint64_t warnings = std::min<uint64_t>(grid.warnings.size(), kMostWarnings);
    put(bytes, &warnings, 1);
    for (size_t i = 0; i < warnings; ++i)
        put(bytes, grid.warnings[i].data(), std::min<size_t>(grid.warnings[i].size(), kMostText));
    return bytes;
}

base::Result<MediumGrid> mediumGridFromBytes(std::string_view bytes)
{
    const base::Status damaged(base::Code::Parse, "the grid is damaged");
    constexpr uint64_t kMostVoxels = kMostBlocks * uint64_t(kBlockVoxels);
    Parts parts(bytes);
    MediumGrid grid;
    std::vector<uint64_t> mark, warnings;
    std::vector<glm::dmat3> axes;
    std::vector<glm::dvec3> origin;
    std::vector<double> anisotropy;
    if (!parts.take(mark, 1) || mark.size() != 1 || mark[0] != kMark || !parts.take(axes, 1) ||
        axes.size() != 1 || !parts.take(origin, 1) || origin.size() != 1 || !parts.take(anisotropy, 1) ||
        anisotropy.size() != 1 || !parts.take(grid.blocks, kMostBlocks) ||
        !parts.take(grid.density, kMostVoxels) || !parts.take(grid.temperature, kMostVoxels) ||
        !parts.take(grid.flame, kMostVoxels) || !parts.take(grid.flameRate, kMostVoxels) ||
        !parts.take(grid.albedo, kMostVoxels) || !parts.take(grid.velocity, kMostVoxels) ||
        !parts.take(grid.balls, kMostGridBalls) || !parts.take(warnings, 1) || warnings.size() != 1 ||
        warnings[0] > kMostWarnings)
        return damaged;
    grid.axes = axes[0];
    grid.origin = origin[0];
    grid.anisotropy = anisotropy[0];
    for (uint64_t i = 0; i < warnings[0]; ++i) {
        std::vector<char> text;
        if (!parts.take(text, kMostText))
            return damaged;
        grid.warnings.emplace_back(text.begin(), text.end());
    }
    if (!parts.isEmpty() || !isValid(grid))
        return damaged;
    return grid;
}

} // namespace fx::render
