#include "rendering/reference/trace/tile_candidates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/reference/trace/tile_candidates.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/reference/trace/ball_lanes-inl.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace fx::render::trace::HWY_NAMESPACE {
namespace {

/// The planes of a tile in float, for boxes.
struct FloatFrustum
{
    explicit FloatFrustum(const TileFrustum& frustum)
    {
        for (uint32_t p = 0; p < TileFrustum::kPlanes; ++p) {
            const TileFrustum::Plane& plane = frustum.planes[p];
            for (int axis = 0; axis < 3; ++axis) {
                normal[p][axis] = float(plane.normal[axis]);
                magnitude[p][axis] = std::abs(float(plane.normal[axis]));
            }
            // Rounding of what is computed from it below is less than this.
            offset[p] = float(plane.offset + 1e-6 * std::abs(plane.offset));
        }
    }
    float normal[TileFrustum::kPlanes][3];
    float magnitude[TileFrustum::kPlanes][3];
    float offset[TileFrustum::kPlanes];
};

/// Bit k is set when child k of the node may reach into the frustum.
HWY_INLINE uint32_t childrenInside(const BallTree::Node& node, const FloatFrustum& frustum)
{
    const FloatTag tag;
    uint32_t bits = 0;
    for (uint32_t k = 0; k < BallTree::kWidth; k += uint32_t(hn::Lanes(tag))) {
        FloatVector center[3];
        FloatVector extent[3];
        for (int axis = 0; axis < 3; ++axis) {
            center[axis] = hn::Load(tag, node.center[axis] + k);
            extent[axis] = hn::Load(tag, node.extent[axis] + k);
        }
        auto inside = hn::Ge(extent[0], hn::Zero(tag));
        for (uint32_t p = 0; p < TileFrustum::kPlanes; ++p) {
            FloatVector reach = hn::Set(tag, frustum.offset[p]);
            for (int axis = 0; axis < 3; ++axis) {
                reach = hn::Add(reach, hn::Mul(center[axis], hn::Set(tag, frustum.normal[p][axis])));
                reach = hn::Add(reach, hn::Mul(extent[axis], hn::Set(tag, frustum.magnitude[p][axis])));
            }
            inside = hn::And(inside, hn::Ge(reach, hn::Zero(tag)));
        }
        bits |= bitsOf(tag, inside) << k;
    }
    return bits;
}

/// Which of some balls reach into the frustum.
HWY_INLINE DoubleMask ballsInside(const Balls& balls, const TileFrustum& frustum)
{
    const DoubleTag tag;
    auto inside = hn::Ge(balls.radius, hn::Zero(tag));
    for (const TileFrustum::Plane& plane : frustum.planes) {
        DoubleVector reach = hn::Add(balls.radius, hn::Set(tag, plane.offset));
        reach = hn::Add(reach, hn::Mul(balls.x, hn::Set(tag, plane.normal.x)));
        reach = hn::Add(reach, hn::Mul(balls.y, hn::Set(tag, plane.normal.y)));
        reach = hn::Add(reach, hn::Mul(balls.z, hn::Set(tag, plane.normal.z)));
        inside = hn::And(inside, hn::Ge(reach, hn::Zero(tag)));
    }
    return inside;
}

/// Appends the balls of a mask to the columns, which have room for a whole vector.
HWY_INLINE size_t append(TileCandidates& out, size_t size, const Balls& balls, PlaceVector places,
                         DoubleMask inside)
{
    const DoubleTag tag;
    storeSelected(tag, balls.x, inside, out.editColumn(TileCandidates::X) + size);
    storeSelected(tag, balls.y, inside, out.editColumn(TileCandidates::Y) + size);
    storeSelected(tag, balls.z, inside, out.editColumn(TileCandidates::Z) + size);
    storeSelected(tag, balls.radius, inside, out.editColumn(TileCandidates::Radius) + size);
    storeSelected(PlaceTag(), places, placeMask(inside), out.editPlaces() + size);
    return size + hn::CountTrue(tag, inside);
}

HWY_INLINE Balls ballsAt(const TileCandidates& candidates, size_t i)
{
    return loadBalls(candidates.column(TileCandidates::X) + i, candidates.column(TileCandidates::Y) + i,
                     candidates.column(TileCandidates::Z) + i, candidates.column(TileCandidates::Radius) + i);
}

size_t appendLeaf(const BallTree::Leaf& leaf, uint32_t firstPlace, const TileFrustum& frustum, size_t size,
                  TileCandidates& out)
{
    for (uint32_t k = 0; k < BallTree::kWidth; k += kLanes) {
        const Balls balls = loadBalls(leaf.x + k, leaf.y + k, leaf.z + k, leaf.radius + k);
        const DoubleMask inside = ballsInside(balls, frustum);
        if (!hn::AllFalse(DoubleTag(), inside))
            size = append(out, size, balls, hn::Iota(PlaceTag(), firstPlace + k), inside);
    }
    return size;
}

/// Depth first, children by rising number: balls come in the order of the tree.
void walk(const BallTree& tree, const TileFrustum& frustum, TileCandidates& out)
{
    const FloatFrustum floats(frustum);
    std::array<TreePosition, kTreeStack> stack;
    size_t height = 0;
    stack[height++] = {tree.levels() - 1, 0};
    size_t size = 0;
    while (height > 0) {
        const TreePosition at = stack[--height];
        uint32_t children = childrenInside(tree.node(at.level, at.index), floats);
        if (at.level > 0) {
            for (; children != 0; children &= ~(1u << lastBit(children)))
                stack[height++] = {at.level - 1, at.index * BallTree::kWidth + lastBit(children)};
            continue;
        }
        out.reserve(size + BallTree::kWidth * BallTree::kWidth);
        for (; children != 0; children &= children - 1) {
            const uint32_t leaf = at.index * BallTree::kWidth + firstBit(children);
            size = appendLeaf(tree.leaves()[leaf], leaf * BallTree::kWidth, frustum, size, out);
        }
    }
    out.close(size);
}

void filter(const TileCandidates& from, const TileFrustum& frustum, TileCandidates& out)
{
    out.reserve(from.size());
    size_t size = 0;
    for (size_t i = 0; i < from.size(); i += kLanes) {
        const Balls balls = ballsAt(from, i);
        size =
            append(out, size, balls, hn::LoadU(PlaceTag(), from.places() + i), ballsInside(balls, frustum));
    }
    out.close(size);
}

void test(const TileCandidates& candidates, const TraceRay& ray, double begin, double end, RayHits& out)
{
    const RayLanes lanes(ray);
    out.clear();
    out.reserve(candidates.size());
    for (size_t i = 0; i < candidates.size(); i += kLanes)
        appendHits(ballsAt(candidates, i), hn::LoadU(PlaceTag(), candidates.places() + i), lanes, out);
    finishHits(begin, end, out);
}

} // namespace
} // namespace fx::render::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

namespace trace {
namespace {
HWY_EXPORT(walk);
HWY_EXPORT(filter);
HWY_EXPORT(test);
} // namespace
} // namespace trace

void TileCandidates::reserve(size_t size)
{
    const size_t wanted = size + RayHits::kSlack;
    if (place_.size() >= wanted)
        return;
    const size_t room = std::max(wanted, 2 * place_.size());
    for (std::vector<double>& column : columns_)
        column.resize(room);
    place_.resize(room);
}

void TileCandidates::close(size_t size)
{
    size_ = size;
    // What vectors read behind the last candidate are balls that no test lets through.
    std::fill_n(columns_[Radius].begin() + std::ptrdiff_t(size), RayHits::kSlack, -1e30);
}

void TileCandidates::collect(const BallTree& tree, const TileFrustum& frustum)
{
    base::applyInstructionSetLimit();
    using namespace trace;
    reserve(0);
    close(0);
    if (tree.levels() > 0)
        HWY_DYNAMIC_DISPATCH(walk)(tree, frustum, *this);
}

void TileCandidates::narrow(const TileCandidates& from, const TileFrustum& frustum)
{
    base::applyInstructionSetLimit();
    using namespace trace;
    HWY_DYNAMIC_DISPATCH(filter)(from, frustum, *this);
}

void TileCandidates::hits(const TraceRay& ray, double begin, double end, RayHits& out) const
{
    base::applyInstructionSetLimit();
    using namespace trace;
    HWY_DYNAMIC_DISPATCH(test)(*this, ray, begin, end, out);
}

} // namespace fx::render
#endif
