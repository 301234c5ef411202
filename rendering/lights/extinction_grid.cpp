#include "rendering/lights/extinction_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

ExtinctionGrid::ExtinctionGrid(std::pmr::memory_resource* memory)
    : cells_(size_t(kCells) * kCells * kCells, 0.0f, memory)
{}

size_t ExtinctionGrid::cellIndex(int x, int y, int z) const
{
    return (size_t(z) * size_t(n_) + size_t(y)) * size_t(n_) + size_t(x);
}

glm::ivec3 ExtinctionGrid::toCell(const glm::vec3& p) const
{
    return glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), glm::ivec3(n_ - 1));
}

void ExtinctionGrid::build(std::span<const GridBlob> blobs, int cells)
{
    n_ = std::clamp(cells, 1, kCells);
    base::Bounds bounds;
    for (const GridBlob& blob : blobs)
        bounds.add(blob.center, blob.radius);
    empty_ = bounds.empty();
    if (empty_)
        return;
    std::fill_n(cells_.begin(), size_t(n_) * size_t(n_) * size_t(n_), 0.0f);
    origin_ = bounds.min;
    cellSize_ = glm::max((bounds.max - bounds.min) / float(n_), glm::vec3(1e-6f));
    volume_ = cellSize_.x * cellSize_.y * cellSize_.z;

    for (const GridBlob& blob : blobs) {
        const glm::vec3 reach(blob.radius *
                              0.5f); // half of the kernel's mass lies within half its radius, roughly
        const glm::ivec3 low = toCell((blob.center - reach - origin_) / cellSize_);
        const glm::ivec3 high = toCell((blob.center + reach - origin_) / cellSize_);
        const glm::ivec3 n = high - low + 1;
        const float share = blob.crossSection / float(n.x * n.y * n.z);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    cells_[cellIndex(x, y, z)] += share;
    }
}

double ExtinctionGrid::totalCrossSection() const
{
    double sum = 0.0;
    for (size_t i = 0; i < size_t(n_) * size_t(n_) * size_t(n_); ++i)
        sum += double(cells_[i]);
    return empty_ ? 0.0 : sum;
}

float ExtinctionGrid::extinction(const glm::vec3& cell) const
{
    const glm::vec3 p = cell - 0.5f;
    const glm::vec3 base = glm::floor(p);
    const glm::vec3 f = p - base;
    const glm::ivec3 i(base);
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 c = i + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        if (c.x < 0 || c.y < 0 || c.z < 0 || c.x >= n_ || c.y >= n_ || c.z >= n_)
            continue;
        const float weight = (corner & 1 ? f.x : 1.0f - f.x) * (corner >> 1 & 1 ? f.y : 1.0f - f.y) *
                             (corner >> 2 ? f.z : 1.0f - f.z);
        sum += weight * cells_[cellIndex(c.x, c.y, c.z)];
    }
    return sum / volume_;
}

float ExtinctionGrid::transmittance(const glm::vec3& position, const glm::vec3& direction,
                                    float distance) const
{
    if (empty_)
        return 1.0f;
    const glm::vec3 start = (position - origin_) / cellSize_;
    const glm::vec3 perMetre = direction / cellSize_;
    const float cellsPerMetre = glm::length(perMetre);
    const float step = 1.0f / cellsPerMetre; // [m] one cell
    float opticalDepth = 0.0f;
    const float begin = step * float(n_) / float(kCells); // what is nearer belongs to the blob itself
    for (float t = begin + 0.5f * step; t < distance; t += step) {
        const glm::vec3 p = start + perMetre * t;
        const bool outside = glm::any(glm::lessThan(p, glm::vec3(-0.5f))) ||
                             glm::any(glm::greaterThan(p, glm::vec3(float(n_) + 0.5f)));
        if (outside || opticalDepth > 12.0f)
            break;
        opticalDepth += extinction(p) * step;
    }
    return std::exp(-opticalDepth);
}

} // namespace fx::render
