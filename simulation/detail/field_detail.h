/// @file field_detail.h
/// Parameters of the detail of a medium's field from a preset, and values derived from them. The detail is
/// computed when the field is drawn. The extinction of all balls is summed, and a threshold on the logarithm
/// of the sum erodes it. See shaders/formulas/field_detail.fx.h.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <cstdint>

namespace fx::sim {

/// Appearance of a medium, which selects the thresholds of erosion.
enum class DetailMaterial : uint8_t
{
    Fireball, ///< burning gas with soot; the creases between lumps are colder
    Smoke,
    Steam, ///< denser at the rim than smoke
    Dust,  ///< thinner than smoke, with finer lumps
};

struct FieldDetail
{
    bool given = false; ///< true: the field has detail; false: smooth balls, or separate noise for each ball
    DetailMaterial material = DetailMaterial::Smoke;
    float billowSize = 1.0f; ///< [1] size of the largest lumps divided by 1.1 median radii, 0.1..10
    float crispness = 0.5f;  ///< [1] 0 .. 1, sharpness of the edges of lumps
    float raggedness = 0.5f; ///< [1] 0 .. 1, strength of small lumps on large lumps
    float softening = 1.5f;  ///< [1] 0 .. 4, how soon the detail fades as the medium becomes thin
    float liveliness = 1.0f; ///< [1] 0.1..10, rate of renewal of the pattern divided by the rate of the flow
};

/// Two generations of coordinates, common to all balls of a group.
struct DetailGenerations
{
    uint64_t younger = 1; ///< number of the younger generation
    double fade = 0;      ///< [1] weight of the younger generation
    /// [m] median radius of the balls when a generation began; index: number of the generation modulo 2
    float radius[2] = {1, 1};
    /// [m] present median radius of the balls whose initial median radius is radius[]
    float radiusNow[2] = {1, 1};
};

/// Writes the constants of a group of the kind "material". The total extinction is conserved.
void writeDetail(const FieldDetail& detail, const DetailGenerations& generations, base::SnapshotGroup& io);

/// Adds a group of the kind "material", which belongs to the group of blobs added last, and writes its
/// constants and ids. The caller then writes the columns.
/// @param capacity maximum number of elements of the solver
base::SnapshotGroup& addMaterial(const FieldDetail& detail, const DetailGenerations& generations,
                                 base::KindId kind, uint32_t capacity, base::FrameSnapshot& snapshot);

} // namespace fx::sim
