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
constexpr float kMaxDetailGain = 6.0f; ///< n of field-detail is no more

/// Constants of a group of the kind "material" at a moment.
struct FieldDetailNumbers
{
    /// One of the two generations of coordinates.
    struct Generation
    {
        float length = 1;       ///< [m] of the largest lumps at birth
        float growth = 1;       ///< [1] see foundation/snapshot/material_kind.h
        glm::vec3 offset{0.0f}; ///< [cell] added to its coordinates, so that no two are alike
    };
    std::array<Generation, 2> generations; ///< in the order of the columns
    float fade = 0;                        ///< [1] weight of the second in that order, 0 .. 1
    float thinnest = 0, densest = 0;       ///< [1] t0, t1 of field-detail; densest 0: no detail
    float ramp = 0.25f;                    ///< [1] w
    float gain = 0.55f;                    ///< [1] amplitude of an octave over that of the one before
    float cooling = 0, glow = 0;           ///< [1] c, b
    float softening = 0;                   ///< [1] a over v

    bool isGiven() const { return densest > thinnest; }
    float length() const; ///< [m] of the largest lumps now, mean of the two by their weights
};

/// @param constants of a group of the kind "material"
FieldDetailNumbers fieldDetailNumbers(std::span<const float> constants);

/// The smooth field at a point.
struct SmoothMedium
{
    float extinction = 0;           ///< [1/m]
    std::array<glm::vec3, 2> place; ///< [m] carried coordinates
    float thinning = 0;             ///< [1] v of field-detail
};

/// The field with detail.
struct MediumDetail
{
    float share = 1;       ///< [1] extinction over that of the smooth field
    float temperature = 1; ///< [1] multiplies the temperature
    float noise = 0;       ///< [1] z
};

/// [1] v of field-detail of a ball by itself.
float thinningOf(const FieldDetailNumbers& numbers, float crossSection, float radius);

/// Formulas field-detail and lump-noise.
/// @param pixel [m] width of a pixel there  @param octaves 1 .. kMaxDetailOctaves
MediumDetail detailAt(const FieldDetailNumbers& numbers, const LumpTile& tile, const SmoothMedium& medium,
                      float pixel, int octaves);

/// [1/m] upper bound of the eroded extinction for a smooth extinction of at most `most`, for any noise and
/// thinning, before the multiplication by GroupDetail::factor.
float maxErodedExtinction(const FieldDetailNumbers& numbers, float most);

/// n m of field-detail: mean eroded extinction over the smooth one.
float meanErodedShare(const FieldDetailNumbers& numbers, float extinction, float thinning = 0);

} // namespace fx::render
