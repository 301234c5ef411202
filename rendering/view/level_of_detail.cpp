#include "rendering/view/level_of_detail.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace fx::render {

namespace {

constexpr float kEverything = std::numeric_limits<float>::infinity();
constexpr float kFinestCells = 24.0f; ///< along an edge of the finest grid of shadows

size_t countedAs(const LodRamp& ramp)
{
    return ramp.isAll() ? 0 : ramp.mean() >= 0.5f ? 1 : ramp.mean() >= 0.125f ? 2 : 3;
}

} // namespace

LodRamp::LodRamp(float share)
{
    if (!(share < kAll))
        return;
    begin_ = share * (1.0f - kFade);
    end_ = share * (1.0f + kFade);
    const float over = std::max(end_ - 1.0f, 0.0f);
    const float width = end_ - begin_;
    mean_ = begin_ + 0.5f * width - over * over / (2.0f * width); // (2)
}

float LodRamp::weight(float rank) const
{
    return std::clamp((end_ - rank) / (end_ - begin_), 0.0f, 1.0f); // (1)
}

bool LevelOfDetail::Entry::operator<(const Entry& other) const
{
    return std::tie(instance, solver, kind) < std::tie(other.instance, other.solver, other.kind);
}

void LevelOfDetail::begin(const LodSettings& settings, const CameraGeometry& camera, int height, bool forget)
{
    const bool isSame = settings == settings_ && !forget;
    settings_ = settings;
    camera_ = &camera;
    pixelsPerSlope_ = 0.5f * float(height) * std::abs(camera.clipScale.y);
    counts_ = {};
    last_.swap(now_);
    now_.clear();
    if (!isSame)
        last_.clear();
    else if (!std::is_sorted(last_.begin(), last_.end()))
        std::sort(last_.begin(), last_.end());
}

/// [pixel] of the ball around the group's bounds; infinite from inside, or when nothing is known.
float LevelOfDetail::radiusOnPicture(const base::GroupInfo& group, const base::Placement& place) const
{
    if (group.bounds.empty())
        return kEverything;
    const glm::vec3 middle = 0.5f * (group.bounds.min + group.bounds.max);
    const glm::vec3 center = glm::vec3(place.position) + place.rotation * (middle * place.scale);
    const float radius = 0.5f * glm::length(group.bounds.max - group.bounds.min) * place.scale;
    if (camera_->orthographic)
        return radius * pixelsPerSlope_;
    const float distance = glm::length(center);
    return distance > radius ? radius * pixelsPerSlope_ / distance : kEverything;
}

/// Stays where it is within a band around what is wanted, so that small movements of the camera change
/// nothing, and follows along the border of the band without a jump.
float LevelOfDetail::follow(const base::GroupInfo& group, float wanted)
{
    Entry entry{group.instance, group.solver, uint32_t(group.kind), wanted};
    const auto before = std::lower_bound(last_.begin(), last_.end(), entry);
    if (before != last_.end() && !(entry < *before))
        entry.share = std::clamp(before->share, wanted / kBand, wanted * kBand);
    now_.push_back(entry);
    return entry.share;
}

LodLevel LevelOfDetail::levelOf(const base::GroupInfo& group, const base::Placement& place)
{
    const float radius =
        settings_.bias > 0.0f && group.count > 0 ? radiusOnPicture(group, place) : kEverything;
    if (!(radius < kEverything)) {
        ++counts_[0];
        return {};
    }
    const float fineness = 1.0f / std::sqrt(settings_.bias);
    const float disc = std::numbers::pi_v<float> * radius * radius;
    const float kept = std::max(disc / settings_.bias, kLeastKept);
    LodLevel level;
    level.ramp = LodRamp(follow(group, kept / float(group.count)));
    level.grownPixels = kGrown / fineness;
    level.swollenPixels = kSwollen * radius;
    const float cells = 2.0f * radius * fineness / kShadowCell;
    level.shadowCoarse = std::clamp(std::log2(kFinestCells / cells), 0.0f, LodLevel::kCoarsest);
    ++counts_[countedAs(level.ramp)];
    return level;
}

} // namespace fx::render
