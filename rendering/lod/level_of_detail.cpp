#include "rendering/lod/level_of_detail.h"

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
    settings_.hold = settings.hold;
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

const LevelOfDetail::Entry* LevelOfDetail::lastOf(const base::GroupInfo& group) const
{
    const Entry entry{group.instance, group.solver, uint32_t(group.kind), 0.0f, 0.0f};
    const auto found = std::lower_bound(last_.begin(), last_.end(), entry);
    return found != last_.end() && !(entry < *found) ? &*found : nullptr;
}

LodLevel LevelOfDetail::find(const base::GroupInfo& group, const base::Placement& place, uint32_t pieces,
                             uint32_t wholes)
{
    float radius = isOn() && wholes > 0 ? radiusOnPicture(group, place) : kEverything;
    if (!(radius < kEverything))
        return {};
    const Entry* last = lastOf(group);
    if (settings_.hold && last)
        radius = last->radius;
    const float fineness = 1.0f / std::sqrt(settings_.bias);
    const float disc = std::numbers::pi_v<float> * radius * radius;
    float share = std::max(disc / (settings_.bias * float(pieces)), kMinKeptBlobs / float(wholes));
    if (last) // within the band it stays, so that a trembling camera changes nothing; beyond it follows
        share = settings_.hold ? last->share : std::clamp(last->share, share / kBand, share * kBand);
    now_.push_back({group.instance, group.solver, uint32_t(group.kind), share, radius});
    LodLevel level;
    level.ramp = LodRamp(share);
    level.grownPixels = kGrown / fineness;
    level.swollenPixels = kSwollen * radius;
    return level;
}

LodLevel LevelOfDetail::levelOf(const base::GroupInfo& group, const base::Placement& place)
{
    const LodLevel level = find(group, place, group.count, group.count);
    ++counts_[countedAs(level.ramp)];
    return level;
}

LodLevel LevelOfDetail::levelOfRows(const base::GroupInfo& group, const base::Placement& place,
                                    uint32_t pieces, uint32_t wholes)
{
    return find(group, place, std::max(pieces, 1u), wholes);
}

} // namespace fx::render
