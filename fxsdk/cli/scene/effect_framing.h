/// @file effect_framing.h
/// Where a camera has to stand to see an effect at several moments.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "fxsdk/scene_file/camera_path.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace fx::cli {

/// Bounding spheres that a picture should contain, with their weights, for each moment. At each moment all
/// but a few percent of the weight is inside of the picture, so that single sparks do not decide.
class EffectFraming
{
public:
    /// Begins the next moment: spheres that are added after this call belong to it.
    void nextMoment() { moments_.emplace_back(); }
    /// All media of the snapshot.
    void add(const base::FrameSnapshot& snapshot);
    /// @param places center and radius [m] of sprites and meshes
    void add(const std::vector<glm::vec4>& places);
    bool isEmpty() const;

    /// Places the camera so that all moments are in view, at the camera's own field of view.
    /// @param aspect width of the picture over its height
    void place(scene_file::CameraPath& camera, double aspect) const;

private:
    struct Ball
    {
        glm::dvec3 center; ///< [m]
        double radius;     ///< [m] up to which it is seen
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
