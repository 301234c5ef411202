/// @file effect_lights.h
/// The light that burning gas and luminous particles emit to their surroundings, approximated by a few ball
/// lights.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

namespace fx::render {

/// Light that one group of a snapshot emits.
struct EffectLight
{
    glm::dvec3 position; ///< [m] world position of the center of the emitted light
    glm::vec3 intensity; ///< [cd] intensity, equal in every direction
    float radius;        ///< [m] root mean square extent of the emission, > 0
    /// True: balls of medium emit the light. Fields of balls may propagate emitted light more accurately
    /// than a point light.
    bool isOfMedium = false;
    /// [m] Radius of a ball around the center. The intensity already includes occlusion inside of the ball.
    float ownReach = 0.0f;
};

constexpr size_t kMaxEffectLights = 4;  ///< largest number of effect lights that are used for drawing
constexpr size_t kMaxLightSources = 16; ///< largest number of kinds of snapshot data that emit light

/// Describes how groups of one kind of snapshot data emit light.
struct LightSource
{
    const base::KindDesc* kind;

    /// Computes the light of a group. The group must not be empty.
    /// @return false if the group emits no light, or if its light is included in another group
    bool (*lightOf)(const base::FrameSnapshot& snapshot, const base::SnapshotGroup& group,
                    EffectLight& outLight);

    /// Computes an accurate intensity for one of the brightest lights. Null: lightOf() is accurate.
    /// lightOf() must be fast, but complete() may be slow.
    void (*complete)(const base::FrameSnapshot& snapshot, size_t group, EffectLight& ioLight) = nullptr;
};

/// Computes one light for each group that emits light. Writes the brightest lights to `out`, brightest
/// first, at most kMaxEffectLights. Lights are selected before LightSource::complete() is called.
/// @param sources at most kMaxLightSources sources are used
/// @return number of lights written to `out`
size_t effectLights(const base::FrameSnapshot& snapshot, std::span<const LightSource* const> sources,
                    std::span<EffectLight> out);

/// Sum of the light of the elements of one group, in the space of the group.
class GroupGlow
{
public:
    /// Adds an element. Elements with values that are not finite are ignored, because such elements are not
    /// drawn.
    /// @param intensity [cd]  @param radius [m]  @return true if the element was added
    bool add(const glm::vec3& position, const glm::vec3& intensity, float radius);

    bool isDark() const; ///< true if the sum is too small to be a light

    glm::dvec3 center() const { return moment_ / weight_; } ///< [m] mean position of the emitted light

    /// [m] Root mean square extent of the emission.
    /// @param leastSquare [m2] square of the extent of elements that are all at one point
    float extent(float leastSquare) const;

    /// Returns the sum of the elements as one light in the world.
    /// @param extent [m] in the space of the group
    /// @param visible [1] fraction of the light that leaves the group
    EffectLight light(const base::Placement& placement, float extent, float visible) const;

private:
    glm::vec3 intensity_{0.0f};
    glm::dvec3 moment_{0.0}; ///< sum of luminous weight times position
    double weight_ = 0.0;
    double spread_ = 0.0; ///< sum of luminous weight times squared extent
};

} // namespace fx::render
