#include "simulation/emitters/births/moved_space.h"

#include <glm/gtc/quaternion.hpp>

namespace fx::sim {

namespace {

bool isSame(const base::Placement& a, const base::Placement& b)
{
    return a.position == b.position && a.rotation == b.rotation && a.scale == b.scale;
}

void save(StateWriter& writer, const base::Placement& placement)
{
    writer.vector(placement.position);
    writer.rotation(placement.rotation);
    writer.value(placement.scale);
}

base::Placement restored(StateReader& reader)
{
    base::Placement placement;
    placement.position = reader.doubleVector();
    placement.rotation = reader.rotation();
    placement.scale = reader.value<float>(1e-3f, 1e3f, "an emitter's scale is out of range");
    const glm::quat& q = placement.rotation;
    const float length2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    reader.require(length2 > 0.99f && length2 < 1.01f, "an emitter's rotation is not a unit quaternion");
    return placement;
}

} // namespace

base::Placement between(const base::Placement& from, const base::Placement& to, float share)
{
    base::Placement placement;
    placement.position = from.position + double(share) * (to.position - from.position);
    const glm::quat near = glm::dot(from.rotation, to.rotation) < 0.0f ? -to.rotation : to.rotation;
    placement.rotation = glm::normalize(from.rotation * (1.0f - share) + near * share);
    placement.scale = from.scale + share * (to.scale - from.scale);
    return placement;
}

void MovedSpace::begin(const base::Placement& placement)
{
    home_ = last_ = placement;
    begin_ = end_ = Pose{};
}

void MovedSpace::moveTo(const base::Placement& placement, float share)
{
    begin_ = poseOf(last_);
    if (stands(placement)) {
        end_ = begin_;
        return;
    }
    last_ = share < 1.0f ? between(last_, placement, share) : placement;
    end_ = poseOf(last_);
}

void MovedSpace::jumpTo(const base::Placement& placement)
{
    last_ = placement;
    begin_ = end_ = poseOf(placement);
}

bool MovedSpace::stands(const base::Placement& placement) const
{
    return isSame(placement, last_);
}

MovedSpace::Pose MovedSpace::poseOf(const base::Placement& placement) const
{
    if (isSame(placement, home_))
        return {};
    const glm::quat back = glm::conjugate(home_.rotation);
    Pose pose;
    pose.isHome = false;
    pose.offset = (back * glm::vec3(placement.position - home_.position)) / home_.scale;
    pose.rotation = back * placement.rotation;
    pose.scale = placement.scale / home_.scale;
    return pose;
}

glm::vec3 MovedSpace::turnedBy(const Pose& pose, const glm::vec3& v)
{
    return pose.isHome ? v : pose.rotation * (pose.scale * v);
}

void MovedSpace::carry(float share, float seconds, float inherit, glm::vec3& ioPosition,
                       glm::vec3& ioVelocity) const
{
    if (begin_.isHome && end_.isHome)
        return;
    const glm::vec3 from = begin_.offset + turnedBy(begin_, ioPosition);
    const glm::vec3 to = end_.offset + turnedBy(end_, ioPosition);
    ioPosition = from + share * (to - from); // (1)
    const glm::vec3 early = turnedBy(begin_, ioVelocity);
    const glm::vec3 late = turnedBy(end_, ioVelocity);
    ioVelocity = early + share * (late - early); // (3)
    if (inherit != 0.0f && seconds > 0.0f)
        ioVelocity += (inherit / seconds) * (to - from); // (2)
}

glm::vec3 MovedSpace::placed(const glm::vec3& point) const
{
    return begin_.offset + turnedBy(begin_, point);
}

glm::vec3 MovedSpace::turned(const glm::vec3& vector) const
{
    return turnedBy(end_, vector);
}

void MovedSpace::save(StateWriter& writer) const
{
    sim::save(writer, home_);
    sim::save(writer, last_);
}

void MovedSpace::restore(StateReader& reader)
{
    home_ = restored(reader);
    last_ = restored(reader);
    begin_ = end_ = reader.ok() ? poseOf(last_) : Pose{};
}

} // namespace fx::sim
