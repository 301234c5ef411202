#include "rendering/field/field_near_plan.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <tuple>

namespace fx::render {

namespace {

constexpr float kFade = 1.5f;     ///< [voxel] before the reach, across which shares fall to 0
constexpr float kSizeFade = 1.0f; ///< [voxel] of radii below kLargest, across which shares rise to 1

/// 1 up to `end` - `width`, 0 from `end` on.
float fallingShare(float x, float end, float width)
{
    const float t = std::clamp((end - x) / width, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

} // namespace

FieldNearPlan::FieldNearPlan(std::pmr::memory_resource* memory)
    : candidates_(memory), aways_(memory), balls_(memory), parts_(memory), bricks_(memory),
      brickParts_(memory)
{}

void FieldNearPlan::clear()
{
    candidates_.clear();
    balls_.clear();
    parts_.clear();
    bricks_.clear();
    brickParts_.clear();
}

void FieldNearPlan::add(uint32_t number, uint32_t field, int detail, const glm::vec4& ball, float voxel)
{
    const float share = fallingShare(ball.w / voxel, kLargest, kSizeFade);
    const float away = (glm::length(glm::vec3(ball)) - ball.w) / voxel;
    if (share > 0.0f && away < kReach)
        candidates_.push_back({{number, field, detail, share}, away});
}

/// With too many candidates the reach is the distance of the first that is too many, so that it is
/// continuous.
void FieldNearPlan::choose()
{
    float reach = kReach;
    if (candidates_.size() > kMost) {
        aways_.clear();
        for (const Candidate& candidate : candidates_)
            aways_.push_back(candidate.away);
        std::nth_element(aways_.begin(), aways_.begin() + kMost, aways_.end());
        reach = aways_[kMost];
    }
    for (const Candidate& candidate : candidates_) {
        NearBall ball = candidate.ball;
        ball.share *= fallingShare(candidate.away, reach, kFade);
        if (ball.share > 0.0f)
            balls_.push_back(ball);
    }
}

bool FieldNearPlan::hasDetailed() const
{
    return std::ranges::any_of(balls_, [](const NearBall& ball) { return ball.detail >= 0; });
}

bool FieldNearPlan::hasSmooth() const
{
    return std::ranges::any_of(balls_, [](const NearBall& ball) { return ball.detail < 0; });
}

void FieldNearPlan::listBricks()
{
    std::ranges::sort(parts_, {}, [](const Part& part) { return std::tuple(part.brick, part.number); });
    for (const Part& part : parts_) {
        if (bricks_.empty() || bricks_.back().brick != part.brick)
            bricks_.push_back({part.brick, uint32_t(brickParts_.size()), 0, 0});
        ++bricks_.back().count;
        brickParts_.push_back({part.number, part.share});
    }
}

} // namespace fx::render
