/// @file field_near_plan.h
/// Balls near the eye that rays sum up exactly, and not through voxels.
///
/// Between its samples a field is linear. An eye in a dense medium sees some centimeters, which may be much
/// less than a voxel, so that the errors of the interpolation fill its picture, and change as it moves.
/// Therefore a share of each small ball near the eye is taken out of its field, and summed up as loose balls
/// are. Shares are continuous in the place of the eye and in radii; what a field keeps is the rest.
#pragma once

#include "rendering/field/field_blocks.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A ball, of which a share is not in its field.
struct NearBall
{
    uint32_t number; ///< in the list of all balls
    uint32_t field;
    float share; ///< [1] > 0, at most 1
};

/// Keeps its memory from frame to frame. Threads: one at a time.
class FieldNearPlan
{
public:
    explicit FieldNearPlan(std::pmr::memory_resource* memory);

    /// [voxel] from the eye, beyond which no ball is near.
    static constexpr float kReach = 2.0f;
    /// [voxel] radius at and above which fields are exact enough by themselves.
    static constexpr float kLargest = 5.5f;
    /// At most so many balls of a view are near: each step of a ray near the eye reads them.
    static constexpr size_t kMost = 128;

    void clear();
    /// A ball that may be near. @param ball xyz [m] relative to the eye; w radius [m] @param voxel [m] of its
    /// field
    void add(uint32_t number, uint32_t field, const glm::vec4& ball, float voxel);
    /// Gives shares to the balls that were added, in their order.
    void choose();
    std::span<const NearBall> balls() const { return balls_; }

    /// One of balls() touches a brick.
    void addToBrick(uint32_t brick, const NearBall& ball)
    {
        parts_.push_back({brick, ball.number, ball.share});
    }
    /// Lists the bricks of all calls of addToBrick().
    void listBricks();
    std::span<const NearBrickBlock> bricks() const { return bricks_; }
    std::span<const NearPartBlock> parts() const { return brickParts_; }

private:
    struct Candidate
    {
        NearBall ball; ///< its share follows from its radius alone
        float away;    ///< [voxel] from the eye to its surface, below 0 inside
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
