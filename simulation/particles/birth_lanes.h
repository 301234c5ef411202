/// @file birth_lanes.h
/// Random numbers and positions of a tile of births, compiled for each instruction set.
///
/// @formula birth-lanes
/// birth-shapes for ball, disc and cone of directions, in single precision, lane by lane.
///
/// symbol   unit   meaning
///   u1..u4  1      independent uniform numbers in [0, 1)
///   y       1      approximation of u3^(1/3)
/// @derivation
///   direction and radius are those of birth-shapes, with sine and cosine of u2 turns for the azimuth  (1)
///   A third of the bit pattern of u3 approximates its cube root within 6 %. Two steps of Halley's iteration
///   y (y^3 + 2 u) / (2 y^3 + u) improve it to float rounding                                      (2)
/// @source    elementary; [MUL16] for bit-pattern guesses
/// @deviation none
/// @valid     u3 = 0 gives the center
/// @accuracy  4e-7 of the size of the shape; directions have unit length within 4e-7
/// @tests     tests/simulation/particles/core/test_birth_kernel.cpp
#pragma once

#include "simulation/particles/tile.h"

#include <cstdint>

namespace fx::sim {

/// Working columns of up to kTileRows births. The rows up to the next multiple of kTilePadding are also
/// written.
struct alignas(64) BirthTile
{
    float u[4][kTileRows];       ///< [1] random numbers of the last draw
    float heading[4][kTileRows]; ///< [1] random numbers for directions
    float position[3][kTileRows];
    float direction[3][kTileRows];
    float value[kTileRows];
    uint32_t indexLow[kTileRows];
    uint32_t indexHigh[kTileRows];
    uint32_t seedLow[kTileRows]; ///< seed of each birth; used only if seeds differ
    uint32_t seedHigh[kTileRows];
    uint32_t count;
    bool seedsDiffer = false;
};

/// Draws four uniform numbers for each birth, with the same bits as base::randomUnit4.
/// @param seed seed of all births, unless tile.seedsDiffer is set
void drawUnits(const BirthTile& tile, uint64_t seed, uint32_t solver, uint32_t purpose,
               float (*out)[kTileRows]);

enum class LaneShape : uint8_t
{
    Point,
    Ball,
    Box,
    Cone
};

/// Computes position and direction from `u` and `heading`. The position is relative to the center of the
/// shape.
/// @param size size of the shape, see EmitterDef::size
/// @param cosLimit cosine of the cone's half angle
void sampleShape(LaneShape shape, const glm::vec3& size, float cosLimit, BirthTile& tile);

} // namespace fx::sim
