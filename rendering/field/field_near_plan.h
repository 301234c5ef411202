/// @file field_near_plan.h
/// Finds the balls near the eye that are integrated exactly along rays instead of through voxels.
///
/// A field is interpolated linearly between its samples. In a dense medium, the visible distance may be much
/// less than a voxel, for example some centimeters. Then interpolation errors would fill the picture, and
/// would change as the eye moves. Therefore a fraction of the extinction of each small ball near the eye is
/// removed from the field, and is drawn as a separate ball. The removed fraction is a continuous function of
/// the distance from the eye and of the radius. The detail of a field is a function of its whole extinction.
/// Therefore balls of a field with detail are not drawn as separate balls, but added to the samples of a ray.
#pragma once

#include "rendering/field/field_blocks.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A ball near the eye.
struct NearBall
{
    uint32_t number; ///< index in the list of all balls
    uint32_t field;
    int detail;  ///< index of the detail of the field; -1: no detail
    float share; ///< [1] fraction of the extinction that is removed from the field, > 0 and at most 1
};

/// Selects the balls and lists the bricks that they touch. Memory is kept from frame to frame. Threads: one
/// at a time.
class FieldNearPlan
{
public:
    explicit FieldNearPlan(std::pmr::memory_resource* memory);

    /// [voxel] Distance from the eye to the surface of a ball at and above which the ball stays in its
    /// field.
    static constexpr float kReach = 2.0f;
    /// [voxel] Radius at and above which a ball stays in its field, because the voxels resolve it
    /// accurately.
    static constexpr float kLargest = 5.5f;
    /// Largest number of near balls in a view. The number is limited because each step of a ray near the eye
    /// reads all near balls.
    static constexpr size_t kMost = 128;

    void clear();
    /// Adds a ball as a candidate. choose() selects the near balls.
    /// @param detail index of the detail of the field; -1: no detail
    /// @param ball xyz [m] position relative to the eye; w radius [m]
    /// @param voxel [m] side of a voxel of the field
    void add(uint32_t number, uint32_t field, int detail, const glm::vec4& ball, float voxel);
    /// Selects the near balls among the added balls, and computes NearBall::share.
    void choose();
    /// The near balls, in the order in which they were added.
    std::span<const NearBall> balls() const { return balls_; }
    /// Returns true if the field of any near ball has detail.
    bool hasDetailed() const;
    bool hasSmooth() const; ///< true: the field of any near ball has no detail

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
        NearBall ball; ///< the ball; `share` depends only on the radius
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
