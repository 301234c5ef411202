/// @file voxel_detail.h
/// Detail of the medium of balls, as voxelization asks for it.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Balls belong to groups. Detail multiplies extinction and temperature of all balls of a group at a place
/// alike. Threads: any thread may call const functions.
class VoxelDetail
{
public:
    static constexpr size_t kValues = 7;
    /// Numbers of a ball whose means, weighted with the extinction, the detail of a place depends on.
    using Values = std::array<double, kValues>;

    struct Factors
    {
        float share = 1.0f;       ///< [1] of the extinction
        float temperature = 1.0f; ///< [1] of the temperature
    };

    virtual ~VoxelDetail() = default;
    virtual size_t groups() const = 0;
    /// @param ball index in the list that is voxelized  @return group, or -1: no detail
    virtual int32_t groupOf(uint32_t ball) const = 0;
    virtual Values valuesOf(uint32_t ball) const = 0;
    /// @param extinction [1/m] of all balls of the group, > 0  @param place [m] in the world
    virtual Factors at(size_t group, double extinction, const Values& means,
                       const glm::dvec3& place) const = 0;
    /// [cd/m2] Luminance per optical depth of a ball whose temperature is multiplied by a factor.
    virtual double luminance(uint32_t ball, float temperature) const = 0;
};

} // namespace fx::render
