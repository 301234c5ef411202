/// @file effect_framing.h
/// Computes a camera position from which an effect is visible at several moments.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "fxsdk/scene/id_table.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <memory_resource>
#include <utility>
#include <vector>

namespace fx::scene {

/// Collects weighted bounding spheres for each moment. At each moment the picture contains all but a few
/// percent of the weight, so that single sparks do not determine the camera.
class EffectFraming
{
public:
    explicit EffectFraming(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : moments_(memory)
    {}
    /// Begins the next moment. Spheres added after this call belong to the new moment.
    void nextMoment() { moments_.emplace_back(); }
    /// Adds all media of the snapshot.
    void add(const base::FrameSnapshot& snapshot);
    /// Adds media, sprites and meshes of one instance.
    void add(const base::FrameSnapshot& snapshot, LocalId instance);
    /// Adds sprites and meshes. @param places center and radius [m] of each sprite or mesh
    void add(const std::vector<glm::vec4>& places);
    bool isEmpty() const;

    struct Camera
    {
        glm::dvec3 position; ///< [m]
        glm::dvec3 target;   ///< [m]
        float nearDistance;  ///< [m] of a near plane that cuts nothing off
    };
    /// A camera that has all moments in view and stands above the ground.
    /// @param fovY   [rad] vertical field of view
    /// @param aspect width of the picture over its height
    /// @param ground [m] height of the ground
    /// @param mostHalfHeight [m] that the picture has at most where it looks
    Camera place(double fovY, double aspect, double ground, double mostHalfHeight) const;

private:
    struct Ball
    {
        glm::dvec3 center; ///< [m]
        double radius;     ///< [m] radius of the visible part of the sphere
        double weight;     ///< > 0
    };
    struct Span
    {
        double low, high; ///< [m]
        double middle() const { return 0.5 * (low + high); }
    };
    using Weights = std::pmr::vector<std::pair<double, double>>; ///< values and their weights
    void addBounds(const base::GroupInfo& info);
    void addMedia(const base::SnapshotGroup& group);
    void addParticles(const base::SnapshotGroup& group);
    static double quantile(Weights& values, double share);
    void addBall(const Ball& ball);
    Span spanAlong(const glm::dvec3& axis) const;

    std::pmr::vector<std::pmr::vector<Ball>> moments_;
};

} // namespace fx::scene
