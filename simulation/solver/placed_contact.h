/// @file placed_contact.h
/// The host's contact callback in the space of one instance. Invalid results are ignored and counted.
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/solver/solver.h"

#include <glm/geometric.hpp>

#include <atomic>

namespace fx::sim {

/// The host's contact callback at the placement of one instance. [any thread]
class PlacedContact
{
public:
    /// Creates the callback for one instance. All arguments must outlive this object.
    PlacedContact(const HostContact& host, const base::Placement& placement, std::atomic<uint64_t>& faults)
        : host_(host), placement_(placement), faults_(faults), hook_{this, &PlacedContact::meet}
    {}
    PlacedContact(const PlacedContact&) = delete;
    PlacedContact& operator=(const PlacedContact&) = delete;

    const ContactHook& hook() const { return hook_; }
    /// The arguments of the constructor, valid during the lifetime of this object. With these arguments, a
    /// caller can create the callback at another placement.
    const base::Placement& placement() const { return placement_; }
    const HostContact& host() const { return host_; }
    std::atomic<uint64_t>& faults() const { return faults_; }

private:
    glm::dvec3 toWorld(const float* local) const
    {
        return placement_.position +
               glm::dvec3(placement_.rotation * (placement_.scale * glm::vec3(local[0], local[1], local[2])));
    }

    static int meet(void* user, const float from[3], const float to[3], float* outShare, float outNormal[3])
    {
        const PlacedContact& here = *static_cast<const PlacedContact*>(user);
        const glm::dvec3 a = here.toWorld(from), b = here.toWorld(to);
        const double begin[3] = {a.x, a.y, a.z}, end[3] = {b.x, b.y, b.z};
        float share = 1.0f, normal[3] = {0.0f, 0.0f, 0.0f};
        if (here.host_.meet(here.host_.user, begin, end, &share, normal) == 0)
            return 0;
        const float size = glm::length(glm::vec3(normal[0], normal[1], normal[2]));
        if (!(share >= 0.0f && share <= 1.0f) || !(size > 1e-30f && size < 1e30f)) {
            ++here.faults_;
            return 0;
        }
        const glm::vec3 local =
            glm::conjugate(here.placement_.rotation) * (glm::vec3(normal[0], normal[1], normal[2]) / size);
        *outShare = share;
        for (int axis = 0; axis < 3; ++axis)
            outNormal[axis] = local[axis];
        return 1;
    }

    const HostContact& host_;
    const base::Placement& placement_;
    std::atomic<uint64_t>& faults_;
    const ContactHook hook_;
};

} // namespace fx::sim
