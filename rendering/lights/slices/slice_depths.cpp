#include "rendering/lights/slices/slice_depths.h"

#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

/// Adds what a ray gathers of a caster before the first plane and between each plane and the one before it.
void addCaster(const SliceStack& stack, const SliceRay& ray, const MediumCaster& caster,
               std::span<float> ioBetween)
{
    const glm::vec3 toCenter = caster.center - ray.start;
    const float tc = glm::dot(toCenter, ray.direction);
    const float h = glm::length(toCenter - tc * ray.direction);
    if (!(h < caster.radius))
        return;
    const bool isParallel = stack.mapping == SliceMapping::Parallel;
    const int last = stack.resolution.planes - 1;
    const float half = std::sqrt((caster.radius - h) * (caster.radius + h));
    const auto planeAfter = [&](float t) {
        return std::clamp(int(std::floor((t - stack.first) / stack.spacing)) + 1, 0, last);
    };
    const int end = planeAfter(tc + half);
    for (int k = planeAfter(tc - half); k <= end; ++k) {
        const float begin = k > 0        ? std::max(stack.distanceOf(k - 1), stack.begin)
                            : isParallel ? -1e30f
                                         : stack.begin;
        ioBetween[size_t(k)] += formula::fxKernelOpticalDepth(caster.crossSection, caster.radius, h, tc,
                                                              begin, stack.distanceOf(k));
    }
}

} // namespace

SliceDepths::SliceDepths(std::pmr::memory_resource* memory) : depths_(memory) {}

size_t SliceDepths::indexOf(int plane, int x, int y) const
{
    const auto n = size_t(stack_.resolution.texels);
    return (size_t(plane) * n + size_t(y)) * n + size_t(x);
}

void SliceDepths::build(const SliceStack& stack, std::span<const MediumCaster> casters)
{
    stack_ = stack;
    const int n = stack.resolution.texels;
    const int planes = stack.resolution.planes;
    depths_.assign(size_t(planes) * size_t(n) * size_t(n), 0.0f);
    std::array<float, kMaxSlicePlanes> between;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            between.fill(0.0f);
            const SliceRay ray = sliceRay(stack, float(x) + 0.5f, float(y) + 0.5f);
            for (const MediumCaster& caster : casters)
                addCaster(stack, ray, caster, std::span(between).first(size_t(planes)));
            float depth = 0.0f;
            for (int k = 0; k < planes; ++k) {
                depth += between[size_t(k)];
                depths_[indexOf(k, x, y)] = depth;
            }
        }
}

float SliceDepths::planeAt(int plane, float x, float y) const
{
    const float px = x - 0.5f, py = y - 0.5f;
    const int x0 = int(px), y0 = int(py);
    const int x1 = std::min(x0 + 1, stack_.resolution.texels - 1);
    const int y1 = std::min(y0 + 1, stack_.resolution.texels - 1);
    const float fx = px - float(x0), fy = py - float(y0);
    return glm::mix(glm::mix(at(plane, x0, y0), at(plane, x1, y0), fx),
                    glm::mix(at(plane, x0, y1), at(plane, x1, y1), fx), fy);
}

SliceDepth SliceDepths::depthAt(const glm::vec3& position) const
{
    const SlicePlace place = stack_.placeOf(position);
    const float edge = float(stack_.resolution.texels) - 0.5f;
    const float x = std::clamp(place.x, 0.5f, edge);
    const float y = std::clamp(place.y, 0.5f, edge);
    const int last = stack_.resolution.planes - 1;
    const float plane = std::clamp(place.plane, 0.0f, float(last));
    const int lower = std::min(int(plane), last - 1);
    const float front = planeAt(lower, x, y);
    const float between = planeAt(lower + 1, x, y) - front;
    const float before = lower > 0 ? front - planeAt(lower - 1, x, y) : between;
    const float behind = lower + 2 <= last ? planeAt(lower + 2, x, y) - planeAt(lower + 1, x, y) : 0.0f;
    return {front + formula::fxSliceDepth(before, between, behind, plane - float(lower)),
            planeAt(last, x, y)};
}

} // namespace fx::render
