#include "rendering/voxelization/medium_grid.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

double MediumGrid::voxelVolume() const
{
    return std::abs(glm::determinant(axes));
}

MediumGridSums sumsOf(const MediumGrid& grid)
{
    MediumGridSums sums;
    const double volume = grid.voxelVolume();
    double heat = 0.0;
    glm::dvec3 moment(0.0); // in voxels
    for (size_t b = 0; b < grid.blocks.size(); ++b)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v) {
            const size_t at = b * size_t(kBlockVoxels) + v;
            const double density = double(grid.density[at]);
            if (!(density > 0.0))
                continue;
            const glm::ivec3 voxel = grid.blocks[b] + glm::ivec3(int(v >> 6), int(v >> 3 & 7), int(v & 7));
            const glm::dvec3 place = grid.place(glm::dvec3(voxel));
            const bool isFirst = sums.voxels++ == 0;
            sums.low = isFirst ? voxel : glm::min(sums.low, voxel);
            sums.high = isFirst ? voxel : glm::max(sums.high, voxel);
            sums.boxLow = isFirst ? place : glm::min(sums.boxLow, place);
            sums.boxHigh = isFirst ? place : glm::max(sums.boxHigh, place);
            sums.crossSection += density * volume;
            moment += density * volume * glm::dvec3(voxel);
            sums.largestDensity = std::max(sums.largestDensity, density);
            if (!grid.temperature.empty())
                heat += density * volume * double(grid.temperature[at]);
            if (!grid.flame.empty())
                sums.luminousVolume += volume * double(grid.flame[at]);
        }
    if (sums.crossSection > 0.0) {
        sums.center = grid.place(moment / sums.crossSection);
        sums.temperature = heat / sums.crossSection;
    }
    return sums;
}

} // namespace fx::render
