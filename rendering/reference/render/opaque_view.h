/// @file opaque_view.h
/// What stands behind the medium: diffuse triangles under the scene's lights, or the background.
#pragma once

#include "rendering/frame/scene_light.h"
#include "rendering/frame/view_types.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/reference/render/triangle_scene.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <vector>

namespace fx::render {

/// Radiance of a ray that hits no triangle. Owned by the caller.
struct OpaqueBackground
{
    glm::vec3 luminance{0.0f};        ///< [cd/m2] overhead, used when `image` is empty
    glm::vec3 horizon{0.0f};          ///< [cd/m2] at and below eye height
    int width = 0, height = 0;        ///< [pixel] of `image`
    std::span<const glm::vec3> image; ///< [cd/m2] rows from the top
    bool panorama = false;            ///< equirectangular around the eye; false: fills the view
};

/// The opaque part of a scene.
struct OpaqueScene
{
    OpaqueMesh mesh;
    OpaqueBackground background;
    Lighting lighting;
    std::vector<SceneLight> lamps;
    std::vector<EffectLight> lights; ///< of the effects
    /// The lights of `lights` that are not emitted by a medium. The path tracer uses only these, because its
    /// media emit the others.
    std::vector<EffectLight> particleLights;
    bool isEmpty = false; ///< no surface or background is behind the medium: the picture is transparent there
};

/// [cd/m2] light that the ground below the scene sends upwards.
glm::dvec3 groundLuminance(const Lighting& lighting);

/// One pixel of it.
struct OpaqueSample
{
    glm::dvec3 luminance{0.0};                                 ///< [cd/m2]
    double distance = std::numeric_limits<double>::infinity(); ///< [m] along the ray
};

/// [lx] at a place a little above a surface, whose unit normal is towards the side that is seen.
using Illuminance = std::function<glm::dvec3(const glm::dvec3& position, const glm::dvec3& normal)>;

/// Shades as rendering/stage does, but with exact shadow rays in place of a shadow map. The medium casts no
/// shadow on surfaces there, and none here. Lamps light from their middle. An Illuminance replaces all of
/// that.
class OpaqueView
{
public:
    /// @param scene its spans must stay valid
    /// @param eye [m] world position that rays are relative to
    void build(const OpaqueScene& scene, const glm::dvec3& eye, base::TaskRunner& tasks);

    const OpaqueScene& scene() const { return scene_; }
    const glm::dvec3& eye() const { return eye_; }
    bool isEmpty() const { return scene_.isEmpty; }
    bool hasMesh() const { return !triangles_.empty(); }
    const BallTree& tree() const { return triangles_.tree(); }

    /// @param x, y position in the picture, 0..1 from the upper left
    /// @param hits of the ray in tree(); ignored without a mesh
    /// @param begin [m] ray parameter where the ray begins
    /// @param scratch keeps memory for shadow rays
    /// @param illuminance of surfaces, instead of that of rendering/stage; may be empty
    OpaqueSample sample(const TraceRay& ray, double x, double y, const RayHits& hits, double begin,
                        RayHits& scratch, const Illuminance& illuminance = {}) const;

    /// [m] along the ray to the first triangle, +infinity for none. @param scratch keeps memory
    double distance(const TraceRay& ray, RayHits& scratch) const
    {
        return hasMesh() ? triangles_.trace(ray, 0.0, scratch).distance
                         : std::numeric_limits<double>::infinity();
    }
    /// Whether a triangle stands on the ray before `distance`. @param scratch keeps memory
    bool blocks(const TraceRay& ray, double distance, RayHits& scratch) const
    {
        return this->distance(ray, scratch) < distance;
    }

private:
    glm::dvec3 backgroundAt(const glm::dvec3& direction, double x, double y) const;
    glm::dvec3 imageAt(double x, double y, bool wraps) const;
    glm::dvec3 surfaceAt(const TraceRay& ray, const SurfaceHit& hit, RayHits& scratch,
                         const Illuminance& illuminance) const;
    glm::dvec3 lampLight(const SceneLight& lamp, const glm::dvec3& point, const glm::dvec3& normal,
                         double lift, RayHits& scratch) const;
    glm::dvec3 stageLight(const glm::dvec3& point, const glm::dvec3& normal, double lift,
                          RayHits& scratch) const;

    OpaqueScene scene_;
    glm::dvec3 eye_{0.0};
    TriangleScene triangles_;
};

} // namespace fx::render
