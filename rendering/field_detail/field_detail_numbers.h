/// @file field_detail_numbers.h
/// Parameters of the detail of one group of media, and its effect on the smooth field at a point.
#pragma once

#include "rendering/field_detail/lump_tile.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

constexpr int kMaxDetailOctaves = 5;
constexpr float kMaxDetailGain = 6.0f; ///< upper bound of the symbol n of formula field-detail

/// Parameters of the detail, from the constants of a group of the kind "material".
struct FieldDetailNumbers
{
    /// One of the two generations of noise coordinates, which are blended.
    struct Generation
    {
        float length = 1; ///< [m] size of the largest lumps when the generation began
        float growth = 1; ///< [1] constant Growth0 or Growth1 of foundation/snapshot/material_kind.h
        /// [cell] Offset of the coordinates. The offsets differ, so that the generations have different
        /// noise.
        glm::vec3 offset{0.0f};
    };
    std::array<Generation, 2> generations; ///< generations in the order of the columns Place0, Place1
    float fade = 0;                        ///< [1] weight of generations[1], 0 .. 1
    float thinnest = 0, densest = 0; ///< [1] t0 and t1 of formula field-detail; densest is 0 without detail
    float ramp = 0.25f;              ///< [1] symbol w of formula field-detail
    float gain = 0.55f;              ///< [1] ratio of the amplitudes of successive octaves
    float cooling = 0, glow = 0;     ///< [1] c and b of formula field-detail
    float softening = 0;             ///< [1] a / v of formula field-detail

    bool isConserved = true; ///< false: the factor of formula detail-conservation is 1

    bool isGiven() const { return densest > thinnest; }
    float length() const; ///< [m] present size of the largest lumps, as a weighted mean of both generations
};

/// Reads the parameters from the constants of a group of the kind "material".
FieldDetailNumbers fieldDetailNumbers(std::span<const float> constants);

/// The smooth field at a point.
struct SmoothMedium
{
    float extinction = 0;           ///< [1/m]
    std::array<glm::vec3, 2> place; ///< [m] noise coordinates of both generations, which move with the medium
    float thinning = 0;             ///< [1] symbol v of formula field-detail
};

/// Effect of the detail on the smooth field at a point.
struct MediumDetail
{
    float share = 1;       ///< [1] extinction with detail, divided by smooth extinction
    float temperature = 1; ///< [1] factor of the temperature
    float noise = 0;       ///< [1] symbol z of formula field-detail
};

/// [1] Symbol v of formula field-detail, for a single ball.
/// @param crossSection [m2]
/// @param radius [m]
float thinningOf(const FieldDetailNumbers& numbers, float crossSection, float radius);

/// Evaluates the detail at a point by the formulas field-detail and lump-noise.
/// @param pixel [m] width of a pixel at the distance of the point  @param octaves 1 .. kMaxDetailOctaves
MediumDetail detailAt(const FieldDetailNumbers& numbers, const LumpTile& tile, const SmoothMedium& medium,
                      float pixel, int octaves);

/// [1/m] Upper bound of the eroded extinction, for any noise and thinning, where the smooth extinction is at
/// most `most` [1/m]. The result is not multiplied by GroupDetail::factor.
float maxErodedExtinction(const FieldDetailNumbers& numbers, float most);

/// [1] Product n m of symbols of formula field-detail: mean eroded extinction divided by smooth extinction.
/// @param extinction [1/m] smooth extinction
float meanErodedShare(const FieldDetailNumbers& numbers, float extinction, float thinning = 0);

} // namespace fx::render
