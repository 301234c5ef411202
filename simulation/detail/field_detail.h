/// @file field_detail.h
/// Parameters of the detail of a medium's field from a preset, and derived numbers. The detail is computed
/// where the field is drawn: balls are summed, and their extinction is eroded by a threshold on its
/// logarithm, shaders/formulas/field_detail.fx.h.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <cstdint>

namespace fx::sim {

/// Appearance of a medium; selects the thresholds.
enum class DetailMaterial : uint8_t
{
    Fireball, ///< burning gas with soot: firm billows, cold creases
    Smoke,
    Steam, ///< denser at the rim than smoke
    Dust,  ///< thinner and finer
};

struct FieldDetail
{
    bool given = false; ///< false: smooth balls, or separate noise for each ball
    DetailMaterial material = DetailMaterial::Smoke;
    float billowSize = 1.0f; ///< [1] largest lumps over 1.1 median radii, 0.1 .. 10
    float crispness = 0.5f;  ///< [1] 0 .. 1, of the edges of lumps
    float raggedness = 0.5f; ///< [1] 0 .. 1, strength of small lumps on large ones
    float softening = 1.5f;  ///< [1] 0 .. 4, how soon lumps become haze as the medium thins
    float liveliness = 1.0f; ///< [1] 0.1 .. 10, rate at which the pattern is renewed, over that of the flow
};

/// Two generations of coordinates, as all balls of a group have them in common.
struct DetailGenerations
{
    uint64_t younger = 1;     ///< number of the younger generation
    double fade = 0;          ///< [1] its weight
    float radius[2] = {1, 1}; ///< [m] median radius of the balls at the birth of the generation of parity i
    float radiusNow[2] = {1, 1}; ///< [m] the same now
};

/// Adds the group of the kind "material" that belongs to the group of blobs added last, with its constants
/// and ids; the columns are to be written.
/// @param capacity elements the solver can ever have
base::SnapshotGroup& addMaterial(const FieldDetail& detail, const DetailGenerations& generations,
                                 base::KindId kind, uint32_t capacity, base::FrameSnapshot& snapshot);

} // namespace fx::sim
