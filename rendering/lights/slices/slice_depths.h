/// @file slice_depths.h
/// Light slices on the CPU, for tests, measurements and hosts without OpenGL. Optical depths differ from the
/// GPU's by at most 1e-5 of the largest depth.
#pragma once

#include "rendering/lights/slices/slice_stack.h"

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Optical depths at a point of a stack.
struct SliceDepth
{
    float toLight; ///< [1] optical depth of the media between the light and the point
    float total;   ///< [1] optical depth of all media on the line through light and point
};

/// Optical depths at all texels of the planes of a stack. Threads: one at a time during build().
class SliceDepths
{
public:
    explicit SliceDepths(std::pmr::memory_resource* memory);

    /// Integrates the media of all casters up to each plane. The integrals along the rays of texels are
    /// exact.
    void build(const SliceStack& stack, std::span<const MediumCaster> casters);

    const SliceStack& stack() const { return stack_; }
    /// [1] Optical depth of the media between the light and the center of a texel of a plane.
    float at(int plane, int x, int y) const { return depths_[indexOf(plane, x, y)]; }
    /// Optical depths at a point, interpolated linearly between texels and between planes.
    /// @param position [m] position, in the coordinates of the stack
    SliceDepth depthAt(const glm::vec3& position) const;

private:
    size_t indexOf(int plane, int x, int y) const;
    float planeAt(int plane, float x, float y) const;

    SliceStack stack_;
    std::pmr::vector<float> depths_;
};

} // namespace fx::render
