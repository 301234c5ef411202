/// @file homogeneous_medium.h
/// Media of one extinction inside a ball, a slab or a box: for which closed forms are known.
#pragma once

#include "rendering/reference/path/path_medium.h"

namespace fx::render {

/// Region that a ray cuts in one piece.
struct MediumShape
{
    enum class Kind
    {
        Ball, ///< `extent.x` is the radius
        Slab, ///< |y - center.y| <= extent.y, infinite in x and z
        Box   ///< |p - center| <= extent in each coordinate
    };
    Kind kind = Kind::Ball;
    glm::dvec3 center{0.0}; ///< [m]
    glm::dvec3 extent{1.0}; ///< [m] > 0
};

class HomogeneousMedium final : public PathMedium
{
public:
    /// @param point extinction, scattering, emission and phase of every point
    /// @param knowsDepth false: optical depths are left to be estimated, to test the estimator
    /// @param looseness >= 1, by which majorants are too large, so that null collisions happen
    HomogeneousMedium(const MediumShape& shape, const MediumPoint& point, bool knowsDepth = true,
                      double looseness = 1.0)
        : shape_(shape), point_(point), knowsDepth_(knowsDepth), looseness_(looseness)
    {}
    std::unique_ptr<MediumWalk> walk() const override;
    /// Null when the extinction differs between channels, or depths are to be estimated.
    std::unique_ptr<DepthWalk> depthWalk() const override;
    double majorant() const override;

private:
    MediumShape shape_;
    MediumPoint point_;
    bool knowsDepth_;
    double looseness_;
};

} // namespace fx::render
