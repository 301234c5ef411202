#include "fxsdk/editor/preview/overlay_data.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace fx::editor {

namespace {

constexpr uint32_t kMostArrows = 3000;
constexpr double kArrowSeconds = 0.1;   ///< [s] way that an arrow shows
constexpr int kCell = 8;                ///< [pixel]
constexpr double kLargestDisk = 4000.0; ///< [pixel] radius

/// A group of the snapshot with its placement and columns.
struct Group
{
    FxSnapshotGroup group{};
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;
    std::array<const float*, 3> places{};
    std::array<const float*, 3> velocities{}; ///< null: the kind has none
    const float* radii = nullptr;             ///< null: the kind has none

    glm::dvec3 toWorld(const glm::dvec3& local) const { return position + rotation * (scale * local); }
    static glm::dvec3 at(const std::array<const float*, 3>& columns, uint32_t i)
    {
        return {double(columns[0][i]), double(columns[1][i]), double(columns[2][i])};
    }
};

void forEachGroup(const fxsdk::Scene& scene, const std::function<void(const Group&)>& use)
{
    FxSnapshotId id{};
    if (fxScene_AcquireSnapshot(scene.get(), &id) != FX_OK)
        return;
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    const bool isRead = fxScene_GetSnapshotInfo(scene.get(), id, &info) == FX_OK;
    for (uint32_t g = 0; isRead && g < info.groupsNewer; ++g) {
        Group group;
        group.group.structSize = sizeof group.group;
        if (fxScene_GetSnapshotGroup(scene.get(), id, FX_SNAPSHOT_NEWER, g, &group.group) != FX_OK)
            continue;
        const auto column = [&](const char* name) -> const float* {
            FxSnapshotColumn found{};
            found.structSize = sizeof found;
            return fxScene_FindSnapshotColumn(scene.get(), id, FX_SNAPSHOT_NEWER, g, name, &found) == FX_OK
                       ? found.values
                       : nullptr;
        };
        const FxSnapshotGroup& of = group.group;
        group.position = {of.position[0], of.position[1], of.position[2]};
        group.rotation = {double(of.rotation[3]), double(of.rotation[0]), double(of.rotation[1]),
                          double(of.rotation[2])};
        group.scale = double(of.scale);
        group.places = {column("x"), column("y"), column("z")};
        group.velocities = {column("vx"), column("vy"), column("vz")};
        group.radii = column("radius");
        use(group);
    }
    (void)fxScene_ReleaseSnapshot(scene.get(), id);
}

/// The twelve edges of a box whose corners `corner` gives for the bits of 0..7.
template <class Corner>
void addBox(Corner&& corner, WireKind kind, OverlayData& io)
{
    for (int k = 0; k < 8; ++k)
        for (const int bit : {1, 2, 4})
            if ((k & bit) == 0)
                io.lines.push_back({corner(k), corner(k | bit), kind});
}

void addBounds(const Group& group, OverlayData& io)
{
    const float* const low = group.group.boundsMin;
    const float* const high = group.group.boundsMax;
    if (group.group.count == 0 || low[0] > high[0])
        return;
    const auto corner = [&](int k) {
        return group.toWorld({double((k & 1) ? high[0] : low[0]), double((k & 2) ? high[1] : low[1]),
                              double((k & 4) ? high[2] : low[2])});
    };
    addBox(corner, WireKind::Bounds, io);
    ++io.bounded;
}

bool hasAll(const std::array<const float*, 3>& columns)
{
    return columns[0] && columns[1] && columns[2];
}

/// Adds the disk of a particle to the cells that it covers.
void cover(OverdrawMap& io, const glm::dvec2& center, double radius)
{
    const double r = radius / kCell;
    const glm::dvec2 c = center / double(kCell);
    const int left = std::max(int(std::floor(c.x - r)), 0),
              right = std::min(int(std::floor(c.x + r)), io.columns - 1);
    const int top = std::max(int(std::floor(c.y - r)), 0),
              bottom = std::min(int(std::floor(c.y + r)), io.rows - 1);
    for (int row = top; row <= bottom; ++row)
        for (int column = left; column <= right; ++column) {
            const double away = glm::length(glm::dvec2(column + 0.5, row + 0.5) - c);
            // A disk that is smaller than a cell covers a part of it; the rim of a larger one likewise.
            const double share = r < 0.5 ? 3.14159265 * r * r : std::clamp(r + 0.5 - away, 0.0, 1.0);
            io.counts[size_t(row) * size_t(io.columns) + size_t(column)] += float(share);
        }
}

OverdrawMap mapFor(int width, int height)
{
    OverdrawMap map;
    map.columns = (width + kCell - 1) / kCell;
    map.rows = (height + kCell - 1) / kCell;
    map.counts.assign(size_t(map.columns) * size_t(map.rows), 0.0f);
    return map;
}

/// Finds the mean of the covered cells, and the largest.
void sumUp(OverdrawMap& io)
{
    size_t covered = 0;
    for (const float count : io.counts) {
        io.largest = std::max(io.largest, double(count));
        io.mean += double(count);
        covered += count > 0.0f ? 1 : 0;
    }
    io.mean /= double(std::max<size_t>(covered, 1));
}

/// What covers the picture of a ball. [m]
struct BallDisk
{
    glm::dvec3 place;
    double radius;
};

/// How many balls cover each pixel. @param cut changes the disk of a ball; false: it covers nothing
template <class Cut>
OverdrawMap mapOfBalls(const fxsdk::Scene& scene, const ViewProjection& view, int width, int height,
                       Cut&& cut)
{
    OverdrawMap map = mapFor(width, height);
    forEachGroup(scene, [&](const Group& g) {
        for (uint32_t i = 0; hasAll(g.places) && g.radii && i < g.group.count; ++i) {
            BallDisk disk{g.toWorld(Group::at(g.places, i)), double(g.radii[i]) * g.scale};
            if (!cut(disk))
                continue;
            if (const auto center = view.project(disk.place))
                cover(map, *center, std::min(view.scaleAt(disk.place) * disk.radius, kLargestDisk));
        }
    });
    sumUp(map);
    return map;
}

} // namespace

void addParticleWires(const fxsdk::Scene& scene, const OverlayChoice& choice, OverlayData& io)
{
    uint32_t moving = 0;
    if (choice.velocities)
        forEachGroup(scene, [&](const Group& g) {
            moving += hasAll(g.places) && hasAll(g.velocities) ? g.group.count : 0;
        });
    io.moving = moving;
    const uint32_t stride = std::max(moving / kMostArrows + (moving % kMostArrows > 0 ? 1u : 0u), 1u);
    forEachGroup(scene, [&](const Group& g) {
        if (choice.bounds)
            addBounds(g, io);
        if (!choice.velocities || !hasAll(g.places) || !hasAll(g.velocities))
            return;
        for (uint32_t i = 0; i < g.group.count; i += stride, ++io.arrows) {
            const glm::dvec3 place = g.toWorld(Group::at(g.places, i));
            const glm::dvec3 velocity = g.rotation * (g.scale * Group::at(g.velocities, i));
            io.lines.push_back({place, place + kArrowSeconds * velocity, WireKind::Velocity});
        }
    });
}

std::vector<uint32_t> countsBySolver(const fxsdk::Scene& scene, size_t solvers)
{
    std::map<std::pair<uint64_t, uint32_t>, uint32_t> most; // of the kinds of one solver of one instance
    forEachGroup(scene, [&](const Group& g) {
        uint32_t alive = g.group.count;
        if (g.radii) // a row without a radius is empty
            alive = uint32_t(
                std::count_if(g.radii, g.radii + g.group.count, [](float radius) { return radius > 0.0f; }));
        uint32_t& count = most[{g.group.instance.bits, g.group.solver}];
        count = std::max(count, alive);
    });
    std::vector<uint32_t> counts(solvers);
    for (const auto& [key, count] : most)
        if (key.second < solvers)
            counts[key.second] += count;
    return counts;
}

OverdrawMap overdrawOf(const fxsdk::Scene& scene, const ViewProjection& view, int width, int height)
{
    return mapOfBalls(scene, view, width, height, [](BallDisk&) { return true; });
}

OverdrawMap sliceOf(const fxsdk::Scene& scene, const ViewProjection& view, int width, int height,
                    const glm::dvec3& through)
{
    return mapOfBalls(scene, view, width, height, [&](BallDisk& io) {
        const double away = glm::dot(io.place - through, view.forward());
        if (!(std::abs(away) < io.radius))
            return false;
        io.place -= away * view.forward(); // the ball is cut in a disk
        io.radius = std::sqrt((io.radius - away) * (io.radius + away));
        return true;
    });
}

void addLightSlices(const render::MediaShadowBlock& sun, const glm::dvec3& origin, OverlayData& io)
{
    for (size_t level = 0; level < render::MediaShadowBlock::kLevels; ++level) {
        const glm::dvec4 right(sun.right[level]), up(sun.up[level]), along(sun.along[level]),
            tiles(sun.tiles[level]);
        // The block maps a place to texel x, texel y and plane; its inverse maps the corners of the stack
        // back.
        const glm::dmat3 toStack =
            glm::transpose(glm::dmat3(glm::dvec3(right), glm::dvec3(up), glm::dvec3(along)));
        if (tiles.w < 2.0 || std::abs(glm::determinant(toStack)) < 1e-15)
            continue;
        const glm::dmat3 fromStack = glm::inverse(toStack);
        const auto corner = [&](int k) {
            const glm::dvec3 at((k & 1) ? tiles.z : 0.0, (k & 2) ? tiles.z : 0.0,
                                (k & 4) ? tiles.w - 1.0 : 0.0);
            return origin + fromStack * (at - glm::dvec3(right.w, up.w, along.w));
        };
        addBox(corner, WireKind::LightSlices, io);
        ++io.volumes;
    }
}

} // namespace fx::editor
