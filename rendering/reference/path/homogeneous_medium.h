/// @file homogeneous_medium.h
/// Media of constant extinction in a ball, a slab or a box, for which closed forms are known.
#pragma once

#include "rendering/reference/path/path_medium.h"

namespace fx::render {

/// A convex region, so that a ray intersects it in one interval.
struct MediumShape
{
    enum class Kind
    {
        Ball, ///< ball with the radius `extent.x`
        Slab, ///< points with |y - center.y| <= extent.y; infinite in x and z
        Box   ///< points p with |p - center| <= extent in each coordinate
    };
    Kind kind = Kind::Ball;
    glm::dvec3 center{0.0}; ///< [m]
    glm::dvec3 extent{1.0}; ///< [m] > 0
};

class HomogeneousMedium final : public PathMedium
{
public:
    /// @param point extinction, scattering, emission and phase function at every point
    /// @param knowsDepth false: depthWalk() returns null, which serves to test the estimator of transmittance
    /// @param looseness factor by which majorants exceed the extinction, >= 1; if it is above 1, null
    ///         collisions occur
    HomogeneousMedium(const MediumShape& shape, const MediumPoint& point, bool knowsDepth = true,
                      double looseness = 1.0)
        : shape_(shape), point_(point), knowsDepth_(knowsDepth), looseness_(looseness)
    {}
    std::unique_ptr<MediumWalk> walk() const override;
    /// Null if the extinction differs between channels, or if the argument knowsDepth of the constructor was
    /// false.
    std::unique_ptr<DepthWalk> depthWalk() const override;
    double majorant() const override;

private:
    MediumShape shape_;
    MediumPoint point_;
    bool knowsDepth_;
    double looseness_;
};

} // namespace fx::render
