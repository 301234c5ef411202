#include "simulation/sph/neighbors/neighbor_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::sim {

namespace {

/// Walls of an axis; the first is that of particles that are not mirrored.
template <class T>
struct AxisWalls
{
    uint32_t count = 1;
    std::array<T, 3> at{};
};

template <class T>
AxisWalls<T> wallsOf(const PairImages<T>& pairs, uint32_t axis)
{
    AxisWalls<T> walls;
    for (const T wall : {pairs.low[axis], pairs.high[axis]})
        if (std::isfinite(wall))
            walls.at[walls.count++] = wall;
    return walls;
}

/// Images that are mirrored in exactly the axes of `mirrors`, in every combination of walls.
template <class T>
void addImages(SearchSetup<T>& setup, uint32_t mirrors, const std::array<AxisWalls<T>, 3>& walls)
{
    std::array<uint32_t, 3> first{};
    std::array<uint32_t, 3> end{};
    for (uint32_t a = 0; a < 3; ++a) {
        const bool mirrored = (mirrors >> a & 1) != 0;
        first[a] = mirrored ? 1 : 0;
        end[a] = mirrored ? walls[a].count : 1;
    }
    for (uint32_t wz = first[2]; wz < end[2]; ++wz)
        for (uint32_t wy = first[1]; wy < end[1]; ++wy)
            for (uint32_t wx = first[0]; wx < end[0]; ++wx) {
                SeenImage<T>& image = setup.images[setup.imageCount++];
                const std::array<uint32_t, 3> choice{wx, wy, wz};
                image.bits = mirrors * kMirrorX;
                for (uint32_t a = 0; a < 3; ++a) {
                    image.wall[a] = image.shift[a] = walls[a].at[choice[a]];
                    image.sign[a] = choice[a] == 0 ? T(1) : T(-1);
                }
            }
}

} // namespace

template <class T>
SearchSetup<T> searchSetup(const TreeView<T>& tree, const Domain& domain, T margin)
{
    SearchSetup<T> setup;
    setup.tree = tree;
    setup.pairs = pairImages<T>(domain);
    setup.scale = T(1) + margin;
    std::array<AxisWalls<T>, 3> walls;
    for (uint32_t a = 0; a < 3; ++a) {
        walls[a] = wallsOf(setup.pairs, a);
        const T period = setup.pairs.period[a];
        if (period == 0 || tree.levels == 0)
            continue;
        setup.wraps = true;
        const uint32_t root = tree.levelFirst[tree.levels - 1];
        const T size = std::max({std::abs(tree.low[a][root]), std::abs(tree.high[a][root]), period});
        setup.slack[a] = 32 * std::numeric_limits<T>::epsilon() * size;
    }
    setup.imageCount = 0;
    for (uint32_t mirrors = 0; mirrors < 8; ++mirrors)
        addImages(setup, mirrors, walls);
    return setup;
}

template SearchSetup<float> searchSetup(const TreeView<float>&, const Domain&, float);
template SearchSetup<double> searchSetup(const TreeView<double>&, const Domain&, double);

} // namespace fx::sim
