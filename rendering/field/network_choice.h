/// @file network_choice.h
/// Which media gain from an illumination network. The closed form lights the others as well, at less cost.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>

namespace fx::render {

/// Sums over the balls of a medium, of which its optical depth, albedo and size are estimated.
class MediumMoments
{
public:
    /// @param center [m], relative to any point  @param radius [m]  @param crossSection [m2]
    void add(const glm::dvec3& center, double radius, double crossSection, const glm::dvec3& albedo);
    void add(const MediumMoments& other);

    bool isEmpty() const { return !(crossSection_ > 0.0); }
    /// [m] Semi-axes along x, y and z of the homogeneous ellipsoid with the moments of the medium.
    glm::dvec3 semiAxes() const;
    /// [1] Mean optical depth of rays through that ellipsoid: cross section over mean projected area.
    double opticalDepth() const;
    double albedo() const; ///< [1] mean of the color channel that scatters most
    glm::dvec3 center() const { return isEmpty() ? glm::dvec3(0.0) : first_ / crossSection_; } ///< [m]

private:
    double crossSection_ = 0.0;                         ///< [m2]
    glm::dvec3 first_{0.0}, second_{0.0}, albedo_{0.0}; ///< sums weighted by cross section
};

/// Whether a medium has a network, and the reason.
enum class NetworkUse : uint8_t
{
    Network,
    Thin,
    Dark,
    Small
};

// Source: fx accuracy network, errors relative to the mean light of the medium, sun at its side.

/// [1] At this mean optical depth (scene side-0.5) the closed form is off by 0.06 for g 0 and by 0.16 for g
/// 0.7, a network by 0.00 and 0.03; the medium covers 30 % of what is behind it.
constexpr double kLeastNetworkDepth = 0.35;
/// [1] At this albedo (scene side-5-dark) the closed form is off by 0.02 for g 0 and by 0.06 for g 0.7, a
/// network by 0.01 and 0.04.
constexpr double kLeastNetworkAlbedo = 0.3;
/// [pixel] Below this diameter on the picture, the smallest grid, 24^3, has more cells than the medium
/// pixels.
constexpr double kLeastNetworkPixels = 24.0;

/// [1] A medium that had a network in the last frame keeps it down to this share of each of the three limits,
/// so that one at a limit does not change its light to and fro.
constexpr double kKeptNetworkShare = 0.8;
/// [1] Where more media ask for networks than a picture has, one without a network counts as larger than one
/// with a network only if it is so many times as wide on the picture.
constexpr float kNetworkPromotion = 1.25f;

/// With fewer ViewSettings::voxels, as a budget may choose, automatic scattering leaves networks out: the
/// smallest grid would have more cells than half of the voxels along a side.
constexpr int kLeastNetworkVoxels = 48;

/// @param pixel [m] size of a pixel at the medium
/// @param had true: the medium had a network in the last frame
NetworkUse networkUse(const MediumMoments& medium, double pixel, bool had = false);

/// The reason in words with its numbers, for reports.
std::string textOf(NetworkUse use, const MediumMoments& medium, double pixel);

} // namespace fx::render
