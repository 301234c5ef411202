/// @file overlays.h
/// What can be drawn over the picture of the editor, and the data that the host of the panels gives for it.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace fx::editor {

struct OverlayChoice
{
    bool shapes = true; ///< spawn shapes and force fields of the selected element, with handles
    bool bounds = false;
    bool velocities = false;
    bool overdraw = false;
    bool lightSlices = false;
    bool slice = false; ///< through the media, parallel to the picture, at the target of the camera

    bool operator==(const OverlayChoice&) const = default;
};

enum class WireKind : uint8_t
{
    Bounds,     ///< of the particles of an emitter, gas or other element
    Velocity,   ///< way of a particle in 1/10 s
    LightSlices ///< volume in which media cast shadows in the sun
};

struct WireLine
{
    glm::dvec3 from{0.0}; ///< [m] world
    glm::dvec3 to{0.0};   ///< [m] world
    WireKind kind = WireKind::Bounds;
};

/// Number of particles over each other, on a grid over the picture. It is counted on the processor from the
/// disks that particles cover; a disk that covers a part of a cell counts by that part.
struct OverdrawMap
{
    int columns = 0;
    int rows = 0;
    std::vector<float> counts; ///< by rows from the top
    double largest = 0.0;
    double mean = 0.0; ///< over the cells with any
};

struct OverlayData
{
    std::vector<WireLine> lines;
    OverdrawMap overdraw;
    OverdrawMap slice;    ///< balls over each other at the places of the slice
    uint32_t bounded = 0; ///< elements whose bounds are drawn
    uint32_t arrows = 0;  ///< particles whose velocity is drawn
    uint32_t moving = 0;  ///< particles that have a velocity
    uint32_t volumes = 0; ///< volumes of light slices that are drawn
};

/// From the coordinates of a preset to those of the picture.
struct EffectPlacement
{
    glm::dvec3 position{0.0}; ///< [m]
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;

    glm::dvec3 toWorld(const glm::dvec3& p) const { return position + rotation * (scale * p); }
    glm::dvec3 toEffect(const glm::dvec3& p) const
    {
        return glm::conjugate(rotation) * ((p - position) / scale);
    }
};

/// Text of the numbers of the overlays, such as "120 of 800 velocities"; empty if none is drawn.
std::string overlayText(const OverlayChoice& choice, const OverlayData& data);

} // namespace fx::editor
