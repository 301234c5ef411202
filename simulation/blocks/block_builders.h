/// @file block_builders.h
/// Builders of natural forms from overlapping lumps: heaps of cloud, plumes, walls of dust, nebulae.
///
/// A form is the region where a function of the position is above 0. Its value is the depth below the outline
/// in units of the form's own thickness, up to 1; noise moves the outline. Lumps are placed at random in the
/// region, evenly in volume or more of them where they are small. Equal settings give equal lumps on all
/// machines.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::sim {

enum class BlockForm : uint8_t
{
    Cloud,    ///< towers over a flat base, like cumulus; with an anvil at the top
    Plume,    ///< a column that widens as it rises and leans with the wind; with an anvil at the top
    DustWall, ///< a wall along x, steep in front (+z) and sloping behind
    Nebula,   ///< filaments in an ellipsoid
};

struct BlockBuild
{
    BlockForm form = BlockForm::Cloud;
    uint32_t count = 256; ///< lumps, 1 to kMaxBuiltLumps
    uint64_t seed = 1;
    glm::vec3 position{0.0f}; ///< [m] center of the foot; of a nebula its middle
    glm::vec3 size{10.0f};    ///< [m] full extents of the form without noise, > 0
    float smallest = 0.5f;    ///< [m] radius of lumps at the outline, > 0
    float largest = 1.5f;     ///< [m] radius of lumps in the depth, at least `smallest`
    /// [1] Power of the radius with which the number of lumps in a volume falls, 0..6: with 0 small and large
    /// lumps are equally many in equal volumes, with 3 they fill as much of it.
    float radiusExponent = 0.0f;
    float noise = 0.3f;       ///< [1] by which the outline is moved, in units of the form's thickness, 0..1
    float noiseLength = 4.0f; ///< [m] of the largest lumps of the outline, > 0
    uint32_t octaves = 3;     ///< of the noise, 1..8
    uint32_t towers = 5;      ///< of a cloud, 1 to kMaxTowers
    float base = 0.0f;  ///< [1] height of the cut that makes the foot flat, as a share of the height, 0..0.9
    float anvil = 0.0f; ///< [1] by how much the top spreads, as a share of the width, 0..4
    float lean = 0.0f;  ///< [m] by which the top of a plume is moved along +x
};

constexpr uint32_t kMaxBuiltLumps = 1u << 16;
constexpr uint32_t kMaxTowers = 64;

struct BlockLump
{
    glm::vec3 position{0.0f}; ///< [m]
    float radius = 1.0f;      ///< [m]
    float depth = 0.0f;       ///< [1] below the outline, 0..1
};

/// The lumps of a form; fewer than wanted where the form is too thin to find places for all.
std::vector<BlockLump> buildLumps(const BlockBuild& build);

} // namespace fx::sim
