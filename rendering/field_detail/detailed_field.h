/// @file detailed_field.h
/// Evaluates the field of a group of balls, with its detail, at single points. The code is a simple and slow
/// reference implementation.
#pragma once

#include "foundation/snapshot/snapshot_group.h"
#include "rendering/field_detail/field_detail_numbers.h"

#include <span>
#include <vector>

namespace fx::render {

/// A ball of medium with its noise coordinates.
struct DetailedBall
{
    glm::vec3 center;   ///< [m]
    float radius;       ///< [m] > 0
    float crossSection; ///< [m2] >= 0
    glm::vec3 place[2]; ///< [m] noise coordinates of both generations at the center, which move with the ball
};

/// The smooth field of a group of balls, and its extinction with detail. Positions are in the space of the
/// group. Threads: any thread may call const functions.
class DetailedField
{
public:
    /// @param tile noise, which must outlive the field
    DetailedField(std::vector<DetailedBall> balls, const FieldDetailNumbers& numbers, const LumpTile& tile);

    SmoothMedium smoothAt(const glm::vec3& point) const;
    /// [1/m] Eroded extinction at a point, multiplied by factor().
    /// @param pixel [m] width of a pixel at the point
    float extinctionAt(const glm::vec3& point, float pixel, int octaves = kMaxDetailOctaves) const;
    MediumDetail at(const glm::vec3& point, float pixel, int octaves = kMaxDetailOctaves) const;

    /// Computes factor(): the sum of smooth extinctions divided by the sum of eroded extinctions, over the
    /// points of a lattice. With this factor, the eroded field has the integral of the smooth field.
    /// @param spacing [m] distance of lattice points, at most half of the size of lumps
    void conserveIntegral(float spacing);
    float factor() const { return factor_; } ///< [1] > 0

private:
    std::vector<DetailedBall> balls_;
    FieldDetailNumbers numbers_;
    const LumpTile& tile_;
    float factor_ = 1;
};

/// Returns the balls of a group of the kind "blob", with noise coordinates from its group of the kind
/// "material".
std::vector<DetailedBall> detailedBalls(const base::SnapshotGroup& blobs,
                                        const base::SnapshotGroup& material);

} // namespace fx::render
