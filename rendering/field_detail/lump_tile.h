/// @file lump_tile.h
/// A periodic cube of noise (formula lump-noise), from which the octaves of a field's detail are sampled.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::render {

constexpr int kLumpCells = 8; ///< [cell] period of the cube
/// [1] Mean of lumpAt(). Test: tests/rendering/core/test_field_detail.cpp
constexpr float kLumpMean = 0.54464f;
/// [1] Standard deviation of lumpAt(). The values of a tile with 64 texels along a side have a 5 % smaller
/// deviation, due to linear interpolation.
constexpr float kLumpDeviation = 0.13360f;

/// Hash of a corner or a cell of the lattice, 0 .. 2^24 - 1. shaders/field/lump_tile.comp.glsl computes the
/// same hash.
uint32_t lumpHash(uint32_t x, uint32_t y, uint32_t z, uint32_t purpose);

/// Symbol B of formula lump-noise, 0 .. 1.
/// @param cells coordinates [cell], each >= -kLumpCells
float lumpAt(const glm::vec3& cells);

/// Values of lumpAt() at the texels of a cube, normalized to mean 0 and deviation 1, and interpolated
/// linearly between texels. Immutable; callable from any thread.
class LumpTile
{
public:
    /// @param texels number of texels along a side, kLumpCells times a power of two; 64 texels use 1 MiB
    explicit LumpTile(int texels = 64);

    float at(const glm::vec3& cells) const;
    int texels() const { return texels_; }
    const std::vector<float>& values() const { return values_; } ///< values of the texels, x fastest

private:
    int texels_;
    std::vector<float> values_;
};

/// Returns a tile for all renderers. The first call fills the tile. Callable from any thread.
const LumpTile& sharedLumpTile();

} // namespace fx::render
