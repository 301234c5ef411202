/// @file obstacles.h
/// Obstacles that particles are swept against.
///
/// @formula swept-contact
/// First place and time at which a way meets an obstacle.
///
/// symbol   unit   meaning
///   p(t)     m      way; p0, v, a: where it begins, its velocity and acceleration there
///   T        s      its duration
///   n, d     1, m   normal of a plane, distance from it
///   m, w     m      from the center to p0, from p0 to p(T)
///   s        1      share of the straight way, 0..1
///   R, H     m      radius, half extents
///   h(x,z)   m      height
/// @derivation
///   Plane, met by the parabola itself: the first t in [0, T] with
///       d + (v.n) t + (a.n) t^2 / 2 = 0 and falling distance                                  (1)
///   All others are met by the straight way p0 + s w.
///   Sphere: |m + s w|^2 = R^2; the smaller root from outside, the larger one from inside       (2)
///   Box, with m and w turned into its frame: s is in [max of (-+H - m) / w, min of (+-H - m) / w] over the
///   axes while inside; the beginning from outside, the end from inside                         (3)
///   Heights: within one cell of the grid p0.y + s w.y - h is a polynomial of second degree in s; cells are
///   visited in the order in which the way crosses them, the first root that leads below ends it  (4)
/// @source    (2) and (3) as in [ERI05] sections 5.3.2 and 5.3.3; the rest is elementary
/// @deviation none
/// @valid     a way that begins on the wrong side is met at its beginning when it leads farther in
/// @accuracy  double precision; nothing is skipped whatever the speed
/// @tests     tests/simulation/particles/modules/test_obstacles.cpp
#pragma once

#include "simulation/particles/collisions/collision_defs.h"
#include "simulation/particles/collisions/contact_leg.h"
#include "simulation/solver/solver.h"

#include <memory>

namespace fx::base {
class GpuModules;
}

namespace fx::sim {

/// Immutable. Any thread; allocates nothing.
class Obstacle
{
public:
    virtual ~Obstacle() = default;
    /// False when the obstacle does not exist in this step.
    virtual bool isThere(const StepContext&) const { return true; }
    virtual Clearance clearance(const StepContext& step, const glm::vec3& p) const = 0;
    virtual LegContact meet(const StepContext& step, const ContactLeg& leg) const = 0;
    /// A bound that rejects particles far from it, many at once.
    struct Outline
    {
        enum Form : uint8_t
        {
            Everywhere, ///< unbounded
            Plane,
            Ball
        } form = Everywhere;
        glm::vec3 center{0.0f}; ///< of the ball, or of the plane's normal
        float size = 0.0f;      ///< [m] radius, or distance of the plane from the origin along its normal
        bool isHollow = false;  ///< points inside of the ball may be close to the surface
    };
    virtual Outline outline(const StepContext&) const { return {}; }
    /// As GpuModuleSource::describe(): a module whose numbers go on with the response, restitution and
    /// friction.
    virtual bool describe(base::GpuModules&) const { return false; }
};

std::unique_ptr<Obstacle> makeObstacle(const CollisionDef& def);

// One file each.
std::unique_ptr<Obstacle> makePlaneObstacle(const CollisionDef& def); ///< Ground as well
std::unique_ptr<Obstacle> makeSphereObstacle(const CollisionDef& def);
std::unique_ptr<Obstacle> makeBoxObstacle(const CollisionDef& def);
std::unique_ptr<Obstacle> makeFieldObstacle(const CollisionDef& def); ///< Mesh, Scene, Hook
std::unique_ptr<Obstacle> makeHeightObstacle(const CollisionDef& def);
std::unique_ptr<Obstacle> makeDepthObstacle(const CollisionDef& def);

} // namespace fx::sim
