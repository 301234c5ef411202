#include "fxsdk/scene/motion_track.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace fx::scene {

namespace {

constexpr base::Ticks kLatestTick = INT64_MAX / 4; ///< no clock goes beyond it
constexpr double kFarthest = 1e9;                  ///< [m]
constexpr float kFastest = 1e9f;                   ///< [m/s]

bool isUnit(const glm::quat& q)
{
    const float length2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    return length2 > 0.99f && length2 < 1.01f;
}

base::Placement between(const MotionPose& from, const MotionPose& to, base::Ticks tick)
{
    const double u = double(tick - from.tick) / double(to.tick - from.tick);
    const glm::dvec3 d = to.placement.position - from.placement.position;
    base::Placement placement;
    placement.position = from.placement.position + u * d; // (1)
    if (from.hasVelocity && to.hasVelocity) {
        const double seconds = base::toSeconds(to.tick - from.tick);
        const glm::dvec3 m = seconds * glm::dvec3(from.velocity) - d;
        const glm::dvec3 n = seconds * glm::dvec3(to.velocity) - d;
        placement.position += u * (1.0 - u) * ((1.0 - u) * m - u * n); // (2)
    }
    placement.rotation =
        glm::normalize(glm::slerp(from.placement.rotation, to.placement.rotation, float(u))); // (3)
    placement.scale = from.placement.scale + float(u) * (to.placement.scale - from.placement.scale);
    return placement;
}

} // namespace

void MotionTrack::add(const MotionPose& pose)
{
    while (count_ > 0 && newest() >= pose.tick)
        --count_;
    if (count_ == kMaxPoses) {
        std::move(poses_.begin() + 1, poses_.end(), poses_.begin());
        --count_;
    }
    poses_[count_++] = pose;
}

void MotionTrack::removeSecond()
{
    std::move(poses_.begin() + 2, poses_.begin() + count_, poses_.begin() + 1);
    --count_;
}

base::Placement MotionTrack::at(base::Ticks tick) const
{
    const MotionPose* const first = poses_.data();
    const MotionPose* const end = first + count_;
    const MotionPose* const next =
        std::find_if(first, end, [tick](const MotionPose& pose) { return pose.tick >= tick; });
    if (next == end)
        return (end - 1)->placement;
    return next == first || next->tick == tick ? next->placement : between(*(next - 1), *next, tick);
}

void MotionTrack::save(sim::StateWriter& writer) const
{
    writer.value(count_);
    for (uint32_t i = 0; i < count_; ++i) {
        const MotionPose& pose = poses_[i];
        writer.value(pose.tick);
        writer.vector(pose.placement.position);
        writer.rotation(pose.placement.rotation);
        writer.value(pose.placement.scale);
        writer.vector(pose.velocity);
        writer.flag(pose.hasVelocity);
    }
}

void MotionTrack::restore(sim::StateReader& reader)
{
    count_ = 0;
    const uint32_t count = reader.value<uint32_t>(1, kMaxPoses, "a motion has no poses, or too many");
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        MotionPose pose;
        const base::Ticks earliest = i == 0 ? 0 : newest() + 1;
        pose.tick =
            reader.value<base::Ticks>(earliest, kLatestTick, "the poses of a motion are not in order");
        pose.placement.position = reader.doubleVector();
        pose.placement.rotation = reader.rotation();
        pose.placement.scale = reader.value<float>(1e-3f, 1e3f, "the scale of a pose is out of range");
        pose.velocity = reader.vector();
        pose.hasVelocity = reader.flag();
        const glm::dvec3 distance = glm::abs(pose.placement.position);
        const glm::vec3 speed = glm::abs(pose.velocity);
        reader.require(std::max({distance.x, distance.y, distance.z}) <= kFarthest &&
                           std::max({speed.x, speed.y, speed.z}) <= kFastest,
                       "a pose is too far away or too fast");
        reader.require(isUnit(pose.placement.rotation), "the rotation of a pose is not a unit quaternion");
        if (reader.ok())
            add(pose);
    }
}

} // namespace fx::scene
