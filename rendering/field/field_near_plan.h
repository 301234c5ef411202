/// @file field_near_plan.h
/// Finds the balls near the eye that are integrated exactly along rays instead of through voxels.
///
/// A field is interpolated linearly between its samples. In a dense medium the visible distance may be some
/// centimeters, much less than a voxel. Then the interpolation errors would fill the picture, and would
/// change as the eye moves. Therefore a share of each small ball near the eye is removed from its field, and
/// is drawn as a loose ball. Shares are continuous functions of the position of the eye and of the radius.
/// The field keeps the remaining share.
#pragma once

#include "rendering/field/field_blocks.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A ball near the eye, with the share that is removed from its field.
struct NearBall
{
    uint32_t number; ///< index in the list of all balls
    uint32_t field;
    float share; ///< [1] removed share, > 0 and at most 1
};

/// Selects the balls and lists the bricks that they touch. Memory is kept from frame to frame. Threads: one
/// at a time.
class FieldNearPlan
{
public:
    explicit FieldNearPlan(std::pmr::memory_resource* memory);

    /// [voxel] Balls farther from the eye than this are not near.
    static constexpr float kReach = 2.0f;
    /// [voxel] At and above this radius, fields are accurate without removing balls.
    static constexpr float kLargest = 5.5f;
    /// Largest number of near balls in a view. It is limited because each step of a ray near the eye reads
    /// all of them.
    static constexpr size_t kMost = 128;

    void clear();
    /// Adds a ball that may be near.
    /// @param ball xyz [m] position relative to the eye; w radius [m]
    /// @param voxel [m] side of a voxel of its field
    void add(uint32_t number, uint32_t field, const glm::vec4& ball, float voxel);
    /// Computes the shares of the added balls, in the order in which they were added.
    void choose();
    std::span<const NearBall> balls() const { return balls_; }

    /// Records that one of balls() touches a brick.
    void addToBrick(uint32_t brick, const NearBall& ball)
    {
        parts_.push_back({brick, ball.number, ball.share});
    }
    /// Lists the bricks that were passed to addToBrick().
    void listBricks();
    std::span<const NearBrickBlock> bricks() const { return bricks_; }
    std::span<const NearPartBlock> parts() const { return brickParts_; }

private:
    struct Candidate
    {
        NearBall ball; ///< its share is a function of its radius only
        /// [voxel] Distance from the eye to the surface of the ball; negative if the eye is inside.
        float away;
    };
    struct Part
    {
        uint32_t brick, number;
        float share;
    };

    std::pmr::vector<Candidate> candidates_;
    std::pmr::vector<float> aways_;
    std::pmr::vector<NearBall> balls_;
    std::pmr::vector<Part> parts_;
    std::pmr::vector<NearBrickBlock> bricks_;
    std::pmr::vector<NearPartBlock> brickParts_;
};

} // namespace fx::render
