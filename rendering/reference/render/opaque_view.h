/// @file opaque_view.h
/// The opaque part of a scene: diffuse triangles under the scene's lights, and the background.
#pragma once

#include "rendering/frame/scene_light.h"
#include "rendering/frame/view_types.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/reference/render/medium_details.h"
#include "rendering/reference/render/triangle_scene.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <vector>

namespace fx::render {

/// Radiance of rays that hit no triangle. The caller owns `image`.
struct OpaqueBackground
{
    glm::vec3 luminance{0.0f}; ///< [cd/m2] luminance at the zenith, used if `image` is empty
    glm::vec3 horizon{0.0f};   ///< [cd/m2] luminance at and below the horizon, used if `image` is empty
    int width = 0, height = 0; ///< [pixel] size of `image`
    std::span<const glm::vec3> image; ///< [cd/m2] top row first
    bool panorama = false; ///< true: `image` is equirectangular around the eye; false: it fills the picture
    bool hasHills =
        false; ///< true: wooded hills (formula wooded-horizon) hide the horizon, if `image` is empty
};

/// The opaque part of a scene.
struct OpaqueScene
{
    OpaqueMesh mesh;
    OpaqueBackground background;
    Lighting lighting;
    std::vector<SceneLight> lamps;
    std::vector<EffectLight> lights; ///< lights of the effects
    /// The subset of `lights` that particles emit; the lights of media are omitted. The path tracer uses this
    /// subset, because the light of emitting media results from its paths.
    std::vector<EffectLight> particleLights;
    /// True: there are no surfaces and no background, so that the picture is transparent behind the medium.
    bool isEmpty = false;
};

/// [cd/m2] Luminance of the ground below the scene, seen from above.
glm::dvec3 groundLuminance(const Lighting& lighting);

/// Result of one ray.
struct OpaqueSample
{
    glm::dvec3 luminance{0.0};                                 ///< [cd/m2]
    double distance = std::numeric_limits<double>::infinity(); ///< [m] along the ray
};

/// [lx] Illuminance at a point slightly above a surface. The unit normal points to the visible side.
using Illuminance = std::function<glm::dvec3(const glm::dvec3& position, const glm::dvec3& normal)>;

/// Shades surfaces like rendering/stage, but with exact shadow rays instead of a shadow map. Media cast no
/// shadow on surfaces, and lamps are points at their centers. An Illuminance that is passed to sample()
/// replaces this shading.
class OpaqueView
{
public:
    /// @param scene scene, whose spans must stay valid
    /// @param eye [m] world position to which rays are relative
    /// @param pixel soil and the outline of hills are averaged over pixels of this width
    void build(const OpaqueScene& scene, const glm::dvec3& eye, base::TaskRunner& tasks,
               const PixelWidth& pixel = {});

    const OpaqueScene& scene() const { return scene_; }
    const glm::dvec3& eye() const { return eye_; }
    bool isEmpty() const { return scene_.isEmpty; }
    bool hasMesh() const { return !triangles_.empty(); }
    const BallTree& tree() const { return triangles_.tree(); }

    /// Radiance along a ray, and the distance of the surface that it hits.
    /// @param x, y position in the picture, 0..1 from the upper left
    /// @param hits hits of the ray in tree(); ignored without a mesh
    /// @param begin [m] ray parameter where the ray begins
    /// @param scratch memory for shadow rays
    /// @param illuminance replaces the shading of rendering/stage; may be empty
    OpaqueSample sample(const TraceRay& ray, double x, double y, const RayHits& hits, double begin,
                        RayHits& scratch, const Illuminance& illuminance = {}) const;

    /// [m] Distance along the ray to the first triangle, +infinity if there is none.
    /// @param scratch memory that is overwritten
    double distance(const TraceRay& ray, RayHits& scratch) const
    {
        return hasMesh() ? triangles_.trace(ray, 0.0, scratch).distance
                         : std::numeric_limits<double>::infinity();
    }
    /// True if a triangle intersects the ray before `distance` [m].
    /// @param scratch memory that is overwritten
    bool blocks(const TraceRay& ray, double distance, RayHits& scratch) const
    {
        return this->distance(ray, scratch) < distance;
    }

private:
    glm::dvec3 backgroundAt(const glm::dvec3& direction, double x, double y) const;
    glm::dvec3 withHills(const glm::dvec3& sky, const glm::dvec3& direction) const;
    glm::dvec3 imageAt(double x, double y, bool wraps) const;
    glm::dvec3 surfaceAt(const TraceRay& ray, const SurfaceHit& hit, RayHits& scratch,
                         const Illuminance& illuminance) const;
    glm::dvec3 lampLight(const SceneLight& lamp, const glm::dvec3& point, const glm::dvec3& normal,
                         double lift, RayHits& scratch) const;
    glm::dvec3 stageLight(const glm::dvec3& point, const glm::dvec3& normal, double lift,
                          RayHits& scratch) const;

    OpaqueScene scene_;
    glm::dvec3 eye_{0.0};
    PixelWidth pixel_;
    TriangleScene triangles_;
};

} // namespace fx::render
