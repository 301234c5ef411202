#include "rendering/reference/trace/ray_query.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/reference/trace/ray_query.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/reference/trace/ball_lanes-inl.h"

#include <algorithm>
#include <array>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace fx::render::trace::HWY_NAMESPACE {
namespace {

/// A ray in float, for boxes. The line and the box overlap unless one of four slabs parts them: three across
/// the ray and a coordinate axis, and one across the ray itself. No division, so axis-parallel rays are no
/// special case.
struct FloatRay
{
    FloatRay(const TraceRay& ray, double beginAt, double endAt)
    {
        double reach = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis] = float(ray.origin[axis]);
            direction[axis] = float(ray.direction[axis]);
            magnitude[axis] = std::abs(direction[axis]);
            reach = std::max(reach, std::abs(ray.origin[axis]));
        }
        slack = float(reach) * 1e-6f; // rounding of the origin
        begin = float(std::clamp(beginAt, -1e30, 1e30)) - 1e-6f * float(std::min(std::abs(beginAt), 1e30));
        end = float(std::clamp(endAt, -1e30, 1e30)) + 1e-6f * float(std::min(std::abs(endAt), 1e30));
    }
    float origin[3];
    float direction[3];
    float magnitude[3];
    float slack;
    float begin, end;
};

HWY_INLINE uint32_t childrenMet(const BallTree::Node& node, const FloatRay& ray)
{
    const FloatTag tag;
    uint32_t bits = 0;
    for (uint32_t k = 0; k < BallTree::kWidth; k += uint32_t(hn::Lanes(tag))) {
        FloatVector c[3];
        FloatVector e[3];
        const FloatVector present = hn::Load(tag, node.extent[0] + k);
        for (int axis = 0; axis < 3; ++axis) {
            c[axis] = hn::Sub(hn::Load(tag, node.center[axis] + k), hn::Set(tag, ray.origin[axis]));
            // What the float arithmetic below can lose is far less than these parts of the coordinates.
            e[axis] =
                hn::Add(hn::Load(tag, node.extent[axis] + k),
                        hn::Add(hn::Set(tag, ray.slack), hn::Mul(hn::Abs(c[axis]), hn::Set(tag, 2e-6f))));
        }
        auto met = hn::Ge(present, hn::Zero(tag));
        FloatVector along = hn::Zero(tag);
        FloatVector reach = hn::Zero(tag);
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            const FloatVector distance = hn::Abs(hn::Sub(hn::Mul(c[v], hn::Set(tag, ray.direction[u])),
                                                         hn::Mul(c[u], hn::Set(tag, ray.direction[v]))));
            const FloatVector limit = hn::Add(hn::Mul(e[v], hn::Set(tag, ray.magnitude[u])),
                                              hn::Mul(e[u], hn::Set(tag, ray.magnitude[v])));
            met = hn::And(met, hn::Le(distance, limit));
            along = hn::Add(along, hn::Mul(c[axis], hn::Set(tag, ray.direction[axis])));
            reach = hn::Add(reach, hn::Mul(e[axis], hn::Set(tag, ray.magnitude[axis])));
        }
        met = hn::And(met, hn::Ge(hn::Add(along, reach), hn::Set(tag, ray.begin)));
        met = hn::And(met, hn::Le(hn::Sub(along, reach), hn::Set(tag, ray.end)));
        bits |= bitsOf(tag, met) << k;
    }
    return bits;
}

void query(const BallTree& tree, const TraceRay& ray, double begin, double end, RayHits& out)
{
    const FloatRay floats(ray, begin, end);
    const RayLanes lanes(ray);
    std::array<TreePosition, kTreeStack> stack;
    size_t height = 0;
    stack[height++] = {tree.levels() - 1, 0};
    while (height > 0) {
        const TreePosition at = stack[--height];
        uint32_t children = childrenMet(tree.node(at.level, at.index), floats);
        if (at.level > 0) {
            for (; children != 0; children &= ~(1u << lastBit(children)))
                stack[height++] = {at.level - 1, at.index * BallTree::kWidth + lastBit(children)};
            continue;
        }
        out.reserve(BallTree::kWidth * BallTree::kWidth);
        for (; children != 0; children &= children - 1) {
            const uint32_t index = at.index * BallTree::kWidth + firstBit(children);
            const BallTree::Leaf& leaf = tree.leaves()[index];
            for (uint32_t k = 0; k < BallTree::kWidth; k += kLanes)
                appendHits(loadBalls(leaf.x + k, leaf.y + k, leaf.z + k, leaf.radius + k),
                           hn::Iota(PlaceTag(), index * BallTree::kWidth + k), lanes, out);
        }
    }
    finishHits(begin, end, out);
}

} // namespace
} // namespace fx::render::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

namespace trace {
namespace {
HWY_EXPORT(query);
} // namespace
} // namespace trace

void findHits(const BallTree& tree, const TraceRay& ray, double begin, double end, RayHits& out)
{
    base::applyInstructionSetLimit();
    using namespace trace;
    out.clear();
    if (tree.levels() == 0)
        return;
    out.reserve(0);
    HWY_DYNAMIC_DISPATCH(query)(tree, ray, begin, end, out);
}

} // namespace fx::render
#endif
