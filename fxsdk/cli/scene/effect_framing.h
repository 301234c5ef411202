/// @file effect_framing.h
/// Computes a camera position from which an effect is visible at several moments.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "fxsdk/scene_file/camera_path.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace fx::cli {

/// Collects weighted bounding spheres for each moment. At each moment the picture contains all but a few
/// percent of the weight, so that single sparks do not determine the camera.
class EffectFraming
{
public:
    /// Begins the next moment. Spheres added after this call belong to the new moment.
    void nextMoment() { moments_.emplace_back(); }
    /// Adds all media of the snapshot.
    void add(const base::FrameSnapshot& snapshot);
    /// Adds sprites and meshes. @param places center and radius [m] of each sprite or mesh
    void add(const std::vector<glm::vec4>& places);
    bool isEmpty() const;

    /// Places the camera so that all moments are in view. The field of view of the camera is not changed.
    /// @param aspect width of the picture over its height
    void place(scene_file::CameraPath& camera, double aspect) const;

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
    void addGroup(const base::SnapshotGroup& group);
    void addBall(const Ball& ball);
    Span spanAlong(const glm::dvec3& axis) const;

    std::vector<std::vector<Ball>> moments_;
};

} // namespace fx::cli
