/// @file extinction_grid.h
/// Cheap shadow of media on themselves: their extinction on a coarse grid, marched towards the light.
#pragma once

#include "foundation/math/geometry.h"
#include "rendering/lights/light.h"

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A ball of medium as the grid takes it.
struct GridBlob
{
    glm::vec3 center;   ///< [m]
    float radius;       ///< [m]
    float crossSection; ///< [m2]
};

/// Up to kCells^3 cells over the bounds of all blobs. Each blob's cross section is dealt to the cells its
/// middle half covers, so the sum over cells is the sum over blobs exactly; positions are resolved to a cell.
/// The error against exact shadow rays is that of the cell size; the blob's own shadow is left to the
/// billboard, which computes it exactly.
class ExtinctionGrid final : public MediaShadow
{
public:
    static constexpr int kCells = 24;

    explicit ExtinctionGrid(std::pmr::memory_resource* memory);

    /// @param cells along an edge, 1..kCells: fewer for what is far. Shadows begin equally near in all
    void build(std::span<const GridBlob> blobs, int cells = kCells);
    float transmittance(const glm::vec3& position, const glm::vec3& direction, float distance) const override;
    double totalCrossSection() const; ///< [m2] sum over all cells

private:
    float extinction(const glm::vec3& cell) const; ///< [1/m] trilinear at a position in cells
    glm::ivec3 toCell(const glm::vec3& p) const;
    size_t cellIndex(int x, int y, int z) const;

    glm::vec3 origin_{0.0f};
    glm::vec3 cellSize_{1.0f};
    float volume_ = 1.0f;           ///< [m3] of a cell
    std::pmr::vector<float> cells_; ///< [m2] cross section
    int n_ = kCells;                ///< cells along an edge
    bool empty_ = true;
};

} // namespace fx::render
