/// @file effect_lights.h
/// The light that burning gas and shining particles throw on everything around them, as a few ball lights.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

namespace fx::render {

/// Light of one group of a snapshot.
struct EffectLight
{
    glm::dvec3 position;     ///< [m] world: center of the emitted light
    glm::vec3 intensity;     ///< [cd] in every direction
    float radius;            ///< [m] root mean square extent of the emission, > 0
    bool isOfMedium = false; ///< of balls of medium, whose own fields may spread it better than a point does
    float ownReach = 0.0f;   ///< [m] within which what hides the light is in the intensity already
};

constexpr size_t kMaxEffectLights = 4;  ///< largest number of lights in drawing
constexpr size_t kMaxLightSources = 16; ///< kinds of snapshot data that shed light

/// How groups of one kind of snapshot data shed light.
struct LightSource
{
    const base::KindDesc* kind;

    /// Light of a group with elements. @return false: it sheds none, or its light is that of another group
    bool (*lightOf)(const base::FrameSnapshot& snapshot, const base::SnapshotGroup& group,
                    EffectLight& outLight);

    /// Completes the light of a group that is among the brightest; null: it is complete. Here costly work
    /// belongs.
    void (*complete)(const base::FrameSnapshot& snapshot, size_t group, EffectLight& ioLight) = nullptr;
};

/// One light for each group that glows, those that are brightest before complete() first, as many as fit and
/// at most kMaxEffectLights.
/// @param sources at most kMaxLightSources are used
/// @return how many were written to `out`
size_t effectLights(const base::FrameSnapshot& snapshot, std::span<const LightSource* const> sources,
                    std::span<EffectLight> out);

/// The light of the elements of one group, summed in the space of the group.
class GroupGlow
{
public:
    /// An element with values that are not finite is ignored; it is not drawn either.
    /// @param intensity [cd]  @param radius [m]  @return whether it was added
    bool add(const glm::vec3& position, const glm::vec3& intensity, float radius);

    bool isDark() const; ///< too little to be a light

    glm::dvec3 center() const { return moment_ / weight_; } ///< [m] radius of the part that emits light

    /// [m] root mean square extent.
    /// @param leastSquare [m2] of the result where the elements are at one place
    float extent(float leastSquare) const;

    /// @param extent [m]
    /// @param visible [1] share of the light that leaves the group
    EffectLight light(const base::Placement& placement, float extent, float visible) const;

private:
    glm::vec3 intensity_{0.0f};
    glm::dvec3 moment_{0.0}; ///< luminous weight times position
    double weight_ = 0.0;
    double spread_ = 0.0; ///< weight times squared extent
};

} // namespace fx::render
