#include "foundation/assets/volume_lattice.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fx::base {

namespace {

constexpr double kRounding = 1e-6; // [voxel]

/// Bricks, and how much of a length of a volume along one axis is in each.
struct Shares
{
    int first = 0, last = 0;
    double low = 0.0, high = 0.0; // [brick]

    /// @param from, to [brick]
    Shares(double from, double to)
        : first(int(std::floor(from))), last(std::max(first, int(std::ceil(to)) - 1)), low(from), high(to)
    {}
    double of(int brick) const
    {
        return std::max(std::min(high, brick + 1.0) - std::max(low, double(brick)), 0.0) / (high - low);
    }
};

bool isInRange(const glm::ivec3& brick)
{
    for (int a = 0; a < 3; ++a)
        if (brick[a] < 0 || brick[a] >= kMaxVolumeBricksPerAxis)
            return false;
    return true;
}

/// Sorts cells, and makes one of those of the same brick.
void uniteBricks(std::vector<VolumeCells>& io)
{
    std::ranges::stable_sort(io, isBefore, &VolumeCells::brick);
    size_t count = 0;
    for (const VolumeCells& own : io) {
        if (count > 0 && io[count - 1].brick == own.brick)
            blendInto(io[count - 1], own, 1.0f);
        else
            io[count++] = own;
    }
    io.resize(count);
}

} // namespace

bool isBefore(const glm::ivec3& a, const glm::ivec3& b)
{
    return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x);
}

void blendInto(VolumeCells& io, const VolumeCells& more, float share)
{
    const float own = share * more.crossSection, sum = io.crossSection + own;
    const float part = sum > 0.0f ? own / sum : 0.0f;
    io.crossSection = sum;
    io.temperature += part * (more.temperature - io.temperature);
    io.albedo += part * (more.albedo - io.albedo);
    io.emission += part * (more.emission - io.emission);
}

LatticeMap::LatticeMap(const VolumeLattice& from, const VolumeLattice& to)
    : scale(from.side / to.side), offset((from.origin - to.origin) / to.side)
{}

std::vector<glm::ivec3> bricksReached(const std::vector<glm::ivec3>& bricks, const LatticeMap& toVolume)
{
    if (toVolume.isSame())
        return bricks;
    std::vector<glm::ivec3> reached;
    reached.reserve(8 * bricks.size());
    for (const glm::ivec3& brick : bricks) {
        // voxels are interpolated until the next ones, where there may be nothing
        const glm::dvec3 low = (glm::dvec3(brick * kVolumeBrickSide - 1) - toVolume.offset) / toVolume.scale;
        const glm::dvec3 high =
            (glm::dvec3(brick * kVolumeBrickSide + kVolumeBrickSide) - toVolume.offset) / toVolume.scale;
        const glm::ivec3 first = glm::ivec3(glm::floor(low + kRounding)) + 1;
        const glm::ivec3 last = glm::ivec3(glm::ceil(high - kRounding)) - 1;
        for (int z = first.z >> 3; z <= last.z >> 3; ++z)
            for (int y = first.y >> 3; y <= last.y >> 3; ++y)
                for (int x = first.x >> 3; x <= last.x >> 3; ++x)
                    reached.emplace_back(x, y, z);
    }
    std::ranges::sort(reached, isBefore);
    reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
    return reached;
}

std::vector<VolumeCells> cellsOn(const VolumeLattice& to, const std::vector<VolumeCells>& cells,
                                 const VolumeLattice& from)
{
    const LatticeMap map(from, to);
    constexpr double kBrick = kVolumeBrickSide;
    std::vector<VolumeCells> out;
    out.reserve(8 * cells.size());
    for (const VolumeCells& own : cells) {
        const glm::dvec3 low = map(kBrick * glm::dvec3(own.brick)) / kBrick;
        const glm::dvec3 high = map(kBrick * (glm::dvec3(own.brick) + 1.0)) / kBrick;
        const Shares x(low.x, high.x), y(low.y, high.y), z(low.z, high.z);
        for (int k = z.first; k <= z.last; ++k)
            for (int j = y.first; j <= y.last; ++j)
                for (int i = x.first; i <= x.last; ++i) {
                    const auto share = float(x.of(i) * y.of(j) * z.of(k));
                    if (!(share > 0.0f) || !isInRange({i, j, k}))
                        continue;
                    VolumeCells& part = out.emplace_back(own);
                    part.brick = {i, j, k};
                    part.crossSection *= share;
                }
    }
    uniteBricks(out);
    return out;
}

} // namespace fx::base
