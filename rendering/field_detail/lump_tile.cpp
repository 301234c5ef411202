#include "rendering/field_detail/lump_tile.h"

#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

constexpr float kTurn = 6.2831853f;

/// What a number is used for: each has its own.
enum Purpose : uint32_t
{
    kAzimuth = 1,
    kHeight = 2,
    kFeature = 7, ///< and the two that follow
};

/// @param cell >= -kLumpCells
uint32_t wrapped(int cell)
{
    return uint32_t(cell + kLumpCells) % uint32_t(kLumpCells);
}

/// [0, 1)
float unit(const glm::ivec3& cell, uint32_t purpose)
{
    return float(lumpHash(wrapped(cell.x), wrapped(cell.y), wrapped(cell.z), purpose)) * 0x1.0p-24f;
}

/// Random numbers of all cells of the cube.
class Lattice
{
public:
    Lattice()
    {
        for (int i = 0; i < kLumpCells * kLumpCells * kLumpCells; ++i) {
            const glm::ivec3 cell(i % kLumpCells, i / kLumpCells % kLumpCells, i / (kLumpCells * kLumpCells));
            const float azimuth = kTurn * unit(cell, kAzimuth);
            const float height = 2.0f * unit(cell, kHeight) - 1.0f;
            const float flat = std::sqrt(std::max(1.0f - height * height, 0.0f));
            gradients_[size_t(i)] = {flat * std::cos(azimuth), flat * std::sin(azimuth), height};
            features_[size_t(i)] = {unit(cell, kFeature), unit(cell, kFeature + 1), unit(cell, kFeature + 2)};
        }
    }
    const glm::vec3& gradient(const glm::ivec3& cell) const { return gradients_[numberOf(cell)]; }
    const glm::vec3& feature(const glm::ivec3& cell) const { return features_[numberOf(cell)]; }

private:
    static size_t numberOf(const glm::ivec3& cell)
    {
        return (wrapped(cell.z) * kLumpCells + wrapped(cell.y)) * kLumpCells + wrapped(cell.x);
    }
    std::array<glm::vec3, kLumpCells * kLumpCells * kLumpCells> gradients_, features_;
};

const Lattice& lattice()
{
    static const Lattice shared;
    return shared;
}

/// Falls from 1 to 0 at |t| = 1, with two derivatives.
float fade(float t)
{
    t = std::abs(t);
    return 1.0f - t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

/// q of lump-noise.
float gradientNoise(const glm::ivec3& cell, const glm::vec3& p)
{
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 corner = cell + glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
        const glm::vec3 d = p - glm::vec3(corner);
        sum += fade(d.x) * fade(d.y) * fade(d.z) * glm::dot(d, lattice().gradient(corner));
    }
    return sum;
}

/// d2 of lump-noise.
float nearestFeature(const glm::ivec3& cell, const glm::vec3& p)
{
    float least = 9.0f;
    for (int k = 0; k < 27; ++k) {
        const glm::ivec3 other = cell + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const glm::vec3 d = glm::vec3(other) + lattice().feature(other) - p;
        least = std::min(least, glm::dot(d, d));
    }
    return least;
}

} // namespace

uint32_t lumpHash(uint32_t x, uint32_t y, uint32_t z, uint32_t purpose)
{
    uint32_t h = x * 0x8DA6B343u ^ y * 0xD8163841u ^ z * 0xCB1AB31Fu ^ purpose * 0x9E3779B9u;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    return (h ^ h >> 15) >> 8;
}

float lumpAt(const glm::vec3& cells)
{
    const glm::ivec3 cell = glm::ivec3(glm::floor(cells));
    return formula::fxLump(nearestFeature(cell, cells), gradientNoise(cell, cells));
}

LumpTile::LumpTile(int texels) : texels_(texels)
{
    values_.reserve(size_t(texels) * size_t(texels) * size_t(texels));
    const float cellsPerTexel = float(kLumpCells) / float(texels);
    for (int z = 0; z < texels; ++z)
        for (int y = 0; y < texels; ++y)
            for (int x = 0; x < texels; ++x)
                values_.push_back((lumpAt(glm::vec3(x, y, z) * cellsPerTexel) - kLumpMean) / kLumpDeviation);
}

float LumpTile::at(const glm::vec3& cells) const
{
    const glm::vec3 texel = cells * (float(texels_) / float(kLumpCells));
    const glm::vec3 low = glm::floor(texel);
    const glm::vec3 t = texel - low;
    const auto wrap = [this](float x) {
        return int(x - std::floor(x / float(texels_)) * float(texels_)) % texels_;
    };
    const glm::ivec3 a(wrap(low.x), wrap(low.y), wrap(low.z));
    const glm::ivec3 b((a.x + 1) % texels_, (a.y + 1) % texels_, (a.z + 1) % texels_);
    const auto value = [this](int x, int y, int z) {
        return values_[(size_t(z) * size_t(texels_) + size_t(y)) * size_t(texels_) + size_t(x)];
    };
    const auto row = [&](int y, int z) { return glm::mix(value(a.x, y, z), value(b.x, y, z), t.x); };
    return glm::mix(glm::mix(row(a.y, a.z), row(b.y, a.z), t.y), glm::mix(row(a.y, b.z), row(b.y, b.z), t.y),
                    t.z);
}

const LumpTile& sharedLumpTile()
{
    static const LumpTile shared;
    return shared;
}

} // namespace fx::render
