/// @file lump_tile.h
/// A periodic cube of lump noise, from which the octaves of a field's detail are read.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::render {

constexpr int kLumpCells = 8;         ///< along a side of the cube, after which it repeats
constexpr float kLumpMean = 0.54464f; ///< [1] of lumpAt(), see tests/rendering/core/test_field_detail.cpp
/// [1] standard deviation; 5 % less with linear interpolation between 64 texels.
constexpr float kLumpDeviation = 0.13360f;

/// 0 .. 2^24 - 1 for a corner or a cell of the lattice, equal for GLSL: shaders/field/lump_tile.comp.glsl.
uint32_t lumpHash(uint32_t x, uint32_t y, uint32_t z, uint32_t purpose);

/// B of formula lump-noise at a place in cells, none below -kLumpCells; 0 .. 1.
float lumpAt(const glm::vec3& cells);

/// The same at the texels of a cube, brought to mean 0 and deviation 1, and read linearly between them.
/// Immutable; any thread.
class LumpTile
{
public:
    /// @param texels along a side, a multiple of kLumpCells; a power of two times that: 64 take 1 MiB
    explicit LumpTile(int texels = 64);

    float at(const glm::vec3& cells) const;
    int texels() const { return texels_; }
    const std::vector<float>& values() const { return values_; } ///< x fastest

private:
    int texels_;
    std::vector<float> values_;
};

/// The tile that all renderers share. It is filled at the first call. Any thread.
const LumpTile& sharedLumpTile();

} // namespace fx::render
