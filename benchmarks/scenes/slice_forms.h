/// @file slice_forms.h
/// Forms of storing the optical depth between a light and every point of a cloud, texel by texel. The forms
/// are planes, planes between the first and the last depth of the medium, and Fourier coefficients. The forms
/// are compared in measurements; views use planes.
#pragma once

#include "rendering/lights/slices/slice_stack.h"
#include "rendering/reference/blob_medium/blob_medium.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace fx::cli {

/// `count` balls distributed evenly in a ball of radius 1 around the origin.
/// @param depth [1] mean optical depth through the center, over all directions
std::vector<render::MediumCaster> lightCloud(uint32_t count, double depth);

/// [1] Mean optical depth through the center over all directions, for balls within 2 m of the origin.
double meanDiameter(std::span<const render::MediumCaster> casters);

/// [m] Points within the balls at which the light is evaluated.
std::vector<glm::vec3> pointsWithin(std::span<const render::MediumCaster> casters, uint32_t count);

render::BlobMedium mediumOf(std::span<const render::MediumCaster> casters);

/// [1] Optical depth by a shadow ray; exact, in double precision. @param stack light slices of the light
double shadowRayDepth(const render::BlobMedium& medium, const render::SliceStack& stack,
                      const glm::vec3& point);

struct SliceForm
{
    enum class Kind
    {
        Planes,  ///< optical depth at the planes of the slice stack
        Deep,    ///< optical depth at planes from the first to the last depth of the medium on the ray
        Fourier, ///< Fourier coefficients of the density over the depth of the stack
    };
    Kind kind = Kind::Planes;
    int values = 32; ///< number of values per texel: number of planes, or of coefficients (odd)
};

/// Content of a texel.
struct SliceColumn
{
    float first = 0.0f; ///< [m] distance along the ray of the first plane
    float step = 1.0f;  ///< [m] distance between planes; Fourier: length of the period
    std::vector<float> values;
};

SliceColumn makeColumn(const SliceForm& form, const render::SliceStack& stack, const render::SliceRay& ray,
                       std::span<const render::MediumCaster> casters);

/// [1] Optical depth of a column. @param distance [m] along the ray
float columnDepth(const SliceForm& form, const SliceColumn& column, float distance);

/// Columns that are created on demand, interpolated between four texels as in drawing.
class SliceField
{
public:
    SliceField(const SliceForm& form, const render::SliceStack& stack,
               std::span<const render::MediumCaster> casters)
        : form_(form), stack_(stack), casters_(casters)
    {}

    double depthAt(const glm::vec3& point);

private:
    float columnAt(int x, int y, float distance);

    SliceForm form_;
    render::SliceStack stack_;
    std::span<const render::MediumCaster> casters_;
    std::unordered_map<uint64_t, SliceColumn> columns_;
};

} // namespace fx::cli
