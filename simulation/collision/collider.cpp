#include "simulation/collision/collider.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {

namespace {

constexpr int kMaxMarchSteps = 4096;
constexpr int kHalvings = 6;
constexpr int kMaxPushOuts = 4;
constexpr int kMaxBounces = 3;           ///< in one step
constexpr float kShortestStride = 0.25f; ///< [cell]
constexpr float kFreeCells = 0.02f;      ///< [cell] between a surface and the end of a way that it stops

void reflect(glm::vec3& ioVelocity, const glm::vec3& n, const SurfaceResponse& response)
{
    const float approach = glm::dot(ioVelocity, n);
    if (approach < 0.0f)
        ioVelocity = (1.0f - response.friction) * (ioVelocity - approach * n) -
                     response.restitution * approach * n; // (1)
}

} // namespace

Collider::Collider(const DistanceField& field, const base::Placement& placement)
    : field_(field), offset_(placement.position - field.origin()), rotation_(placement.rotation),
      scale_(placement.scale)
{}

DistanceField::Sample Collider::sample(const glm::vec3& position) const
{
    const DistanceField::Sample s = field_.sample(toField(position));
    return {s.distance / scale_, glm::conjugate(rotation_) * s.normal};
}

Collider::Hit Collider::sweep(const glm::vec3& from, const glm::vec3& to) const
{
    const glm::vec3 start = toField(from);
    const glm::vec3 way = toField(to) - start;
    const float length = glm::length(way);
    float d = field_.distance(start);
    if (!(length > 0.0f) || d <= 0.0f || d - kFieldErrorCells * field_.cell() > length) // (3)
        return {false, 1.0f, {}};
    float x = 0.0f, last = 0.0f;
    for (int stride = 0; d > 0.0f; ++stride) {
        if (x >= length)
            return {false, 1.0f, {}};
        if (stride == kMaxMarchSteps)
            return {true, x / length, glm::vec3(0.0f)};
        last = x;
        const float free = d - kFieldErrorCells * field_.cell();
        x = std::min(x + std::max(free, kShortestStride * field_.cell()), length); // (1)
        d = field_.distance(start + (x / length) * way);
    }
    for (int k = 0; k < kHalvings; ++k) { // (2)
        const float middle = 0.5f * (last + x);
        (field_.distance(start + (middle / length) * way) > 0.0f ? last : x) = middle;
    }
    const glm::vec3 normal = field_.sample(start + (last / length) * way).normal;
    return {true, last / length, glm::conjugate(rotation_) * normal};
}

/// The place itself, or one out of the matter that it is inside of.
glm::vec3 Collider::outside(const glm::vec3& position) const
{
    glm::vec3 place = position;
    const float clearance = kFreeCells * field_.cell() / scale_;
    DistanceField::Sample s = sample(place);
    for (int k = 0; k < kMaxPushOuts && s.distance <= 0.0f; ++k) { // (3)
        place += (clearance - s.distance) * s.normal;
        s = sample(place);
    }
    return place;
}

/// @return true when the place was nearer than the clearance
bool Collider::pushOut(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                       const SurfaceResponse& response) const
{
    const float most = 0.5f * kFieldMargin * field_.cell() / scale_; // beyond the grid there is only a box
    const float clearance = std::clamp(response.clearance, kFreeCells * field_.cell() / scale_, most);
    DistanceField::Sample s = sample(ioPosition);
    if (!(s.distance < clearance))
        return false;
    for (int k = 0; k < kMaxPushOuts && s.distance < clearance; ++k) {
        reflect(ioVelocity, s.normal, response);
        ioPosition += (clearance - s.distance) * s.normal; // (2)
        s = sample(ioPosition);
    }
    if (s.distance <= 0.0f && sample(from).distance > 0.0f)
        ioPosition = from; // (5)
    return true;
}

bool Collider::settle(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                      const SurfaceResponse& response) const
{
    const float lift = kFreeCells * field_.cell() / scale_;
    glm::vec3 start = outside(from);
    bool touched = false;
    for (int k = 0; k < kMaxBounces; ++k) {
        const glm::vec3 way = ioPosition - start;
        const Hit hit = sweep(start, ioPosition);
        if (!hit.found)
            break;
        touched = true;
        reflect(ioVelocity, hit.normal, response);
        start += hit.share * way;
        const glm::vec3 rest = (1.0f - hit.share) * way;
        const float into = std::min(glm::dot(rest, hit.normal), 0.0f);
        const bool isLast = k + 1 == kMaxBounces;
        ioPosition = isLast ? start : start + rest + (lift - into) * hit.normal; // (4)
    }
    const bool isNear = pushOut(start, ioPosition, ioVelocity, response);
    return touched || isNear;
}

bool Collider::bounce(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                      const SurfaceResponse& response, float seconds) const
{
    glm::vec3 start = outside(from);
    bool touched = false;
    for (int k = 0; k < kMaxBounces && seconds > 0.0f; ++k) {
        const Hit hit = sweep(start, ioPosition);
        if (!hit.found)
            break;
        touched = true;
        start += hit.share * (ioPosition - start);
        seconds *= 1.0f - hit.share;
        reflect(ioVelocity, hit.normal, response);
        const bool isLast = k + 1 == kMaxBounces;
        ioPosition = isLast ? start : start + seconds * ioVelocity;
    }
    const bool isNear = pushOut(start, ioPosition, ioVelocity, response);
    return touched || isNear;
}

} // namespace fx::sim
