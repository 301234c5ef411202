/// @file obstacles.h
/// Obstacles, with intersection tests for paths of particles.
///
/// @formula swept-contact
/// First position and time at which a path meets an obstacle.
///
/// symbol   unit   meaning
///   p(t)     m      path; p0, v, a: its beginning, velocity and acceleration there
///   T        s      its duration
///   n, d     1, m   normal of a plane, distance from it
///   m, w     m      from the center to p0, from p0 to p(T)
///   s        1      share of the straight path, 0..1
///   R, H     m      radius, half extents
///   h(x,z)   m      height
/// @derivation
///   Plane and parabola: the first t in [0, T] with
///       d + (v.n) t + (a.n) t^2 / 2 = 0 and decreasing distance                               (1)
///   All other obstacles are intersected with the straight path p0 + s w.
///   Sphere: |m + s w|^2 = R^2; the smaller root from outside, the larger one from inside       (2)
///   Box, with m and w rotated into its frame: the path is inside while s is in the interval
///   [max of (-+H - m) / w, min of (+-H - m) / w] over the axes. From outside, the contact is its beginning;
///   from inside, its end                                                                            (3)
///   Heights: within one cell of the grid, p0.y + s w.y - h is a quadratic polynomial in s. Cells are visited
///   in the order in which the path crosses them. The first root that leads below is the contact     (4)
/// @source    (2) and (3) as in [ERI05] sections 5.3.2 and 5.3.3; the rest is elementary
/// @deviation none
/// @valid     a path that begins on the wrong side and leads farther in has its contact at its beginning
/// @accuracy  double precision; no contact is missed at any speed
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

/// An obstacle of particles. Obstacles are immutable and allocate no memory. [any thread]
class Obstacle
{
public:
    virtual ~Obstacle() = default;
    /// True if the obstacle exists in this step. For example, an obstacle of the kind Scene exists only if
    /// the host has set its geometry.
    virtual bool isThere(const StepContext&) const { return true; }
    virtual Clearance clearance(const StepContext& step, const glm::vec3& p) const = 0;
    virtual LegContact meet(const StepContext& step, const ContactLeg& leg) const = 0;
    /// A simple bound by which many distant particles are rejected at once.
    struct Outline
    {
        enum Form : uint8_t
        {
            Everywhere, ///< the obstacle is unbounded
            Plane,
            Ball
        } form = Everywhere;
        glm::vec3 center{0.0f}; ///< center of the ball, or normal of the plane
        float size = 0.0f;      ///< [m] radius, or distance of the plane from the origin along its normal
        bool isHollow = false;  ///< true: points inside of the ball may be close to the surface
    };
    virtual Outline outline(const StepContext&) const { return {}; }
    /// Describes the obstacle for the GPU like GpuModuleSource::describe(). Response, restitution and
    /// friction follow the numbers of the obstacle.
    virtual bool describe(base::GpuModules&) const { return false; }
};

std::unique_ptr<Obstacle> makeObstacle(const CollisionDef& def);

// Each function has its own file.
std::unique_ptr<Obstacle> makePlaneObstacle(const CollisionDef& def); ///< for Plane and Ground
std::unique_ptr<Obstacle> makeSphereObstacle(const CollisionDef& def);
std::unique_ptr<Obstacle> makeBoxObstacle(const CollisionDef& def);
std::unique_ptr<Obstacle> makeFieldObstacle(const CollisionDef& def); ///< for Mesh, Scene and Hook
std::unique_ptr<Obstacle> makeHeightObstacle(const CollisionDef& def);
std::unique_ptr<Obstacle> makeDepthObstacle(const CollisionDef& def);

} // namespace fx::sim
