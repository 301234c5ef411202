#include "fxsdk/cli/import/brick_volume.h"

#include "fxsdk/assets/volume_file.h"
#include "rendering/optics/color_temperature.h"
#include "rendering/volumes/block_table.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace fx::cli {
namespace {

constexpr size_t kVoxels = base::kVolumeBrickVoxels;
constexpr double kStraight = 1e-6;                           // of the side of a voxel
constexpr double kMostTemperature = 1e5;                     // [K]
constexpr int kFarthest = 1 << 25;                           // [brick]
constexpr size_t kMostTouched = 64 * base::kMaxVolumeBricks; // bricks that may have medium

/// A lattice of cubes along the axes of the world.
struct Lattice
{
    double side = 1.0;      // [m]
    glm::dvec3 origin{0.0}; // [m] of the voxel (0, 0, 0)
};

bool isStraight(const render::MediumGrid& grid)
{
    const double side = grid.axes[0][0];
    if (!(side > 0.0))
        return false;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            if (std::abs(grid.axes[c][r] - (c == r ? side : 0.0)) > kStraight * side)
                return false;
    return true;
}

/// What a voxel has.
struct Voxel
{
    double density = 0.0, heat = 0.0, flame = 0.0; // heat: density times temperature
    double change = 0.0;                           // flame times its rate
    glm::dvec3 albedo{0.0}, velocity{0.0};         // times density
};

class GridSampler
{
public:
    explicit GridSampler(const render::MediumGrid& grid) : grid_(grid), toVoxels_(glm::inverse(grid.axes)) {}

    Voxel atVoxel(const glm::ivec3& voxel, double weight) const
    {
        const glm::ivec3 origin(voxel.x >> 3, voxel.y >> 3, voxel.z >> 3);
        const size_t block = render::findBlock(grid_.blocks, origin * 8);
        if (block == render::kNoBlock)
            return {};
        const glm::ivec3 in = voxel - origin * 8;
        const size_t at = block * size_t(render::kBlockVoxels) + render::voxelInBlock(in.x, in.y, in.z);
        Voxel out;
        out.density = weight * double(grid_.density[at]);
        if (!grid_.temperature.empty())
            out.heat = out.density * double(grid_.temperature[at]);
        if (!grid_.flame.empty())
            out.flame = weight * double(grid_.flame[at]);
        if (!grid_.flameRate.empty())
            out.change = out.flame * double(grid_.flameRate[at]);
        if (!grid_.albedo.empty())
            out.albedo = out.density * glm::dvec3(grid_.albedo[at]);
        if (!grid_.velocity.empty())
            out.velocity = out.density * glm::dvec3(grid_.velocity[at]);
        return out;
    }

    Voxel atPlace(const glm::dvec3& place) const
    {
        const glm::dvec3 index = toVoxels_ * (place - grid_.origin);
        const glm::dvec3 low = glm::floor(index), part = index - low;
        Voxel sum;
        for (int k = 0; k < 8; ++k) {
            const glm::ivec3 corner(k & 1, k >> 1 & 1, k >> 2);
            double weight = 1.0;
            for (int a = 0; a < 3; ++a)
                weight *= corner[a] == 1 ? part[a] : 1.0 - part[a];
            const Voxel own = atVoxel(glm::ivec3(low) + corner, weight);
            sum.density += own.density;
            sum.heat += own.heat;
            sum.flame += own.flame;
            sum.change += own.change;
            sum.albedo += own.albedo;
            sum.velocity += own.velocity;
        }
        return sum;
    }

private:
    const render::MediumGrid& grid_;
    glm::dmat3 toVoxels_;
};

std::array<int, 3> keyOf(const glm::ivec3& brick)
{
    return {brick.z, brick.y, brick.x};
}

base::Status tooLarge(const std::string& what)
{
    return {base::Code::TooLarge, what + "; write the volume with larger voxels, or fit balls to it (--fit)"};
}

base::Status noMedium(const render::MediumGrid& grid)
{
    if (grid.balls.empty())
        return {base::Code::InvalidArgument, "the volume has no medium"};
    return {base::Code::InvalidArgument,
            "the voxels have no medium: all of it is in " + std::to_string(grid.balls.size()) +
                " balls beside them, and a preset needs voxels; export with --balls-below 0"};
}

/// Bricks of the lattice that blocks of the grid touch, ascending.
base::Result<std::vector<glm::ivec3>> bricksOf(const render::MediumGrid& grid, const Lattice& lattice,
                                               bool isCopied)
{
    std::set<std::array<int, 3>> found;
    for (const glm::ivec3& block : grid.blocks) {
        if (isCopied) {
            found.insert(keyOf(block / 8)); // multiples of 8
            continue;
        }
        glm::dvec3 low(1e300), high(-1e300);
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 corner(k & 1 ? 8.0 : -1.0, k & 2 ? 8.0 : -1.0, k & 4 ? 8.0 : -1.0);
            const glm::dvec3 place =
                (grid.place(glm::dvec3(block) + corner) - lattice.origin) / lattice.side / 8.0;
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
        const glm::dvec3 first = glm::floor(low), last = glm::floor(high);
        const glm::dvec3 count = last - first + 1.0;
        if (!(count.x * count.y * count.z <= double(kMostTouched - found.size())))
            return tooLarge("the volume has too many voxels");
        if (glm::any(glm::greaterThan(glm::max(-first, last), glm::dvec3(double(kFarthest)))))
            return tooLarge("the volume is too far from the origin for its voxels");
        for (int z = int(first.z); z <= int(last.z); ++z)
            for (int y = int(first.y); y <= int(last.y); ++y)
                for (int x = int(first.x); x <= int(last.x); ++x)
                    found.insert({z, y, x});
    }
    std::vector<glm::ivec3> bricks;
    bricks.reserve(found.size());
    for (const std::array<int, 3>& key : found)
        bricks.push_back({key[2], key[1], key[0]});
    return bricks;
}

void append(const Voxel& voxel, bool isFrame, base::VoxelVolume& io, const render::MediumGrid& grid)
{
    const bool hasFlame = !grid.flame.empty();
    const bool isThere = voxel.density > 0.0;
    const double per = isThere ? 1.0 / voxel.density : 0.0;
    const double temperature = std::min(voxel.heat * per, kMostTemperature);
    io.extinction.push_back(float(voxel.density));
    if (hasFlame)
        io.emission.push_back(float(voxel.flame) * render::blackBodyColor(float(temperature)));
    else if (!grid.temperature.empty())
        io.temperature.push_back(float(temperature));
    if (!grid.albedo.empty())
        io.albedo.push_back(glm::clamp(glm::vec3(voxel.albedo * per), glm::vec3(0.0f), glm::vec3(1.0f)));
    if (isFrame && !grid.velocity.empty())
        io.velocity.push_back(glm::vec3(voxel.velocity * per));
    if (isFrame && hasFlame && !grid.flameRate.empty())
        io.emissionRate.push_back(voxel.flame > 0.0 ? float(voxel.change / voxel.flame) : 0.0f);
}

/// Gives voxels without medium the mean velocity of their neighbors that have one, again and again, until all
/// have: medium moves through them between two frames.
void spreadVelocities(base::VoxelVolume& io)
{
    if (io.velocity.empty())
        return;
    const base::BrickIndex index(io.bricks);
    std::vector<char> isKnown(io.extinction.size());
    std::vector<size_t> open;
    for (size_t v = 0; v < isKnown.size(); ++v) {
        isKnown[v] = io.extinction[v] > 0.0f ? 1 : 0;
        if (isKnown[v] == 0)
            open.push_back(v);
    }
    std::vector<std::pair<size_t, glm::vec3>> found;
    do {
        found.clear();
        for (const size_t v : open) {
            const glm::ivec3 voxel =
                io.bricks[v / kVoxels] * 8 + glm::ivec3(int(v % 8), int(v / 8 % 8), int(v / 64 % 8));
            glm::vec3 sum(0.0f);
            int count = 0;
            for (int k = 0; k < 6; ++k) {
                glm::ivec3 other = voxel;
                other[k / 2] += k % 2 == 0 ? 1 : -1;
                const uint32_t brick = index.find({other.x >> 3, other.y >> 3, other.z >> 3});
                if (brick == base::BrickIndex::kNone)
                    continue;
                const size_t at =
                    brick * kVoxels + size_t((other.x & 7) + 8 * (other.y & 7) + 64 * (other.z & 7));
                sum += isKnown[at] != 0 ? io.velocity[at] : glm::vec3(0.0f);
                count += isKnown[at];
            }
            if (count > 0)
                found.emplace_back(v, sum / float(count));
        }
        for (const auto& [v, velocity] : found) {
            io.velocity[v] = velocity;
            isKnown[v] = 1;
        }
        std::erase_if(open, [&](size_t v) { return isKnown[v] != 0; });
    } while (!found.empty());
}

double massOf(const base::VoxelVolume& volume)
{
    double sum = 0.0;
    for (const float extinction : volume.extinction)
        sum += double(extinction);
    return sum * std::pow(double(volume.side), 3.0);
}

} // namespace

base::Result<base::VoxelVolume> voxelVolumeOf(const render::MediumGrid& grid, double albedo, bool isFrame)
{
    const bool isCopied = isStraight(grid);
    Lattice lattice;
    lattice.side =
        isCopied
            ? grid.axes[0][0]
            : std::min({glm::length(grid.axes[0]), glm::length(grid.axes[1]), glm::length(grid.axes[2])});
    lattice.origin = isCopied ? grid.origin : glm::dvec3(0.0);
    const double mass = render::sumsOf(grid).crossSection;
    if (!(mass > 0.0))
        return noMedium(grid);
    const base::Result<std::vector<glm::ivec3>> bricks = bricksOf(grid, lattice, isCopied);
    if (!bricks)
        return bricks.status();
    const GridSampler sampler(grid);
    base::VoxelVolume volume;
    volume.side = float(lattice.side);
    volume.evenAlbedo = glm::vec3(float(albedo));
    for (const glm::ivec3& brick : *bricks) {
        std::array<Voxel, kVoxels> voxels;
        bool isEmpty = true;
        for (size_t v = 0; v < kVoxels; ++v) {
            const glm::ivec3 voxel = brick * 8 + glm::ivec3(int(v % 8), int(v / 8 % 8), int(v / 64));
            voxels[v] = isCopied ? sampler.atVoxel(voxel, 1.0)
                                 : sampler.atPlace(lattice.origin + lattice.side * glm::dvec3(voxel));
            isEmpty = isEmpty && !(voxels[v].density > 0.0);
        }
        if (isEmpty)
            continue;
        if (volume.bricks.size() == base::kMaxVolumeBricks)
            return tooLarge("the volume has more than " + std::to_string(base::kMaxVolumeBricks) +
                            " bricks of 8 x 8 x 8 voxels");
        volume.bricks.push_back(brick);
        for (const Voxel& voxel : voxels)
            append(voxel, isFrame, volume, grid);
    }
    if (volume.bricks.empty())
        return noMedium(grid);
    glm::ivec3 low = volume.bricks.front(), high = low;
    for (const glm::ivec3& brick : volume.bricks) {
        low = glm::min(low, brick);
        high = glm::max(high, brick);
    }
    for (int a = 0; a < 3; ++a)
        if (high[a] - low[a] >= base::kMaxVolumeBricksPerAxis - 1)
            return tooLarge("the volume has more than " +
                            std::to_string((base::kMaxVolumeBricksPerAxis - 1) * 8) +
                            " voxels along an axis");
    for (glm::ivec3& brick : volume.bricks)
        brick += 1 - low;
    volume.origin = glm::vec3(lattice.origin + lattice.side * 8.0 * glm::dvec3(low - 1));
    spreadVelocities(volume);
    if (!isCopied)
        for (const double factor = mass / massOf(volume); float& extinction : volume.extinction)
            extinction = float(double(extinction) * factor);
    return volume;
}

base::Result<VolumeBytes> volumeBytesOf(const render::MediumGrid& grid, double albedo, bool isFrame)
{
    const base::Result<base::VoxelVolume> volume = voxelVolumeOf(grid, albedo, isFrame);
    if (!volume)
        return volume.status();
    base::Result<std::string> bytes = asset::writeVolume(*volume);
    if (!bytes)
        return bytes.status();
    const base::Result<base::VoxelVolume> readBack = asset::parseVolume(*bytes);
    if (!readBack)
        return readBack.status();
    VolumeBytes out;
    out.bytes = std::move(*bytes);
    out.bricks = volume->bricks.size();
    out.side = double(volume->side);
    const double mass = render::sumsOf(grid).crossSection;
    out.massError = (massOf(*readBack) - mass) / mass;
    out.isResampled = !isStraight(grid);
    out.hasVelocities = !volume->velocity.empty();
    return out;
}

} // namespace fx::cli
