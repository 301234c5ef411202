#include "simulation/collision/packet_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/collision/packet_search.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"

#include <hwy/highway.h>

#include <array>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kPacketPoints>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr D kD;
constexpr size_t kLanes = hn::MaxLanes(kD);
constexpr size_t kVectors = kPacketPoints / kLanes;

struct Vector3
{
    V x, y, z;
};

HWY_INLINE Vector3 broadcast(const glm::dvec3& v)
{
    return {hn::Set(kD, v.x), hn::Set(kD, v.y), hn::Set(kD, v.z)};
}

/// In the order of glm::dot().
HWY_INLINE V dot(const Vector3& a, const Vector3& b)
{
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vector3 minus(const Vector3& a, const Vector3& b)
{
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vector3 choose(M mask, const Vector3& yes, const Vector3& no)
{
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE Vector3 along(const Vector3& base, V t, const Vector3& way)
{
    return {hn::Add(base.x, hn::Mul(t, way.x)), hn::Add(base.y, hn::Mul(t, way.y)),
            hn::Add(base.z, hn::Mul(t, way.z))};
}

/// Bit i is that of lane i.
HWY_INLINE uint32_t bitsOf(M mask)
{
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(kD, mask, bytes);
    return bytes[0];
}

/// A triangle in all lanes.
struct Sides
{
    explicit Sides(const Triangle& t)
        : a(broadcast(glm::dvec3(t[0]))), b(broadcast(glm::dvec3(t[1]))), c(broadcast(glm::dvec3(t[2]))),
          ab(minus(b, a)), ac(minus(c, a)), bc(minus(c, b))
    {}
    Vector3 a, b, c, ab, ac, bc;
};

/// Squared distance of points to a triangle: nearestOnTriangle(), each operation in the same order; its
/// equation numbers.
HWY_INLINE V squaredDistance(const Sides& t, const Vector3& p)
{
    const V zero = hn::Zero(kD);
    const Vector3 ap = minus(p, t.a), bp = minus(p, t.b), cp = minus(p, t.c);
    const V d1 = dot(t.ab, ap), d2 = dot(t.ac, ap);
    const V d3 = dot(t.ab, bp), d4 = dot(t.ac, bp);
    const V d5 = dot(t.ab, cp), d6 = dot(t.ac, cp);
    const V vc = hn::Sub(hn::Mul(d1, d4), hn::Mul(d3, d2));
    const V vb = hn::Sub(hn::Mul(d5, d2), hn::Mul(d1, d6));
    const V va = hn::Sub(hn::Mul(d3, d6), hn::Mul(d5, d4));
    const V onC = hn::Sub(d4, d3), onB = hn::Sub(d5, d6);

    const M isA = hn::And(hn::Le(d1, zero), hn::Le(d2, zero));          // (1)
    const M isB = hn::And(hn::Ge(d3, zero), hn::Le(d4, d3));            // (2)
    const M isAB = hn::And(hn::And(hn::Le(vc, zero), hn::Ge(d1, zero)), // (3)
                           hn::And(hn::Le(d3, zero), hn::Gt(d1, d3)));
    const M isC = hn::And(hn::Ge(d6, zero), hn::Le(d5, d6));            // (4)
    const M isCA = hn::And(hn::And(hn::Le(vb, zero), hn::Ge(d2, zero)), // (5)
                           hn::And(hn::Le(d6, zero), hn::Gt(d2, d6)));
    const V onSide = hn::Add(onC, onB);
    const M isBC = hn::And(hn::And(hn::Le(va, zero), hn::Ge(onC, zero)), // (6)
                           hn::And(hn::Ge(onB, zero), hn::Gt(onSide, zero)));

    // base + part / whole * way, from the last case to the first
    V part = onC, whole = onSide;
    Vector3 base = t.b, way = t.bc;
    const auto takeSide = [&](M is, V newPart, V newWhole, const Vector3& newWay) HWY_ATTR {
        part = hn::IfThenElse(is, newPart, part);
        whole = hn::IfThenElse(is, newWhole, whole);
        base = choose(is, t.a, base);
        way = choose(is, newWay, way);
    };
    const auto takeCorner = [&](M is, const Vector3& corner) HWY_ATTR {
        part = hn::IfThenZeroElse(is, part);
        whole = hn::IfThenElse(is, hn::Set(kD, 1.0), whole);
        base = choose(is, corner, base);
    };
    takeSide(isCA, d2, hn::Sub(d2, d6), t.ac);
    takeCorner(isC, t.c);
    takeSide(isAB, d1, hn::Sub(d1, d3), t.ab);
    takeCorner(isB, t.b);
    takeCorner(isA, t.a);
    Vector3 point = along(base, hn::Div(part, whole), way);

    const M isOnRim = hn::Or(hn::Or(hn::Or(isA, isB), hn::Or(isAB, isC)), hn::Or(isCA, isBC));
    if (!hn::AllTrue(kD, isOnRim)) { // (7)
        const V sum = hn::Add(hn::Add(va, vb), vc);
        const auto coordinate = [&](V a, V ab, V ac) HWY_ATTR {
            return hn::Add(a, hn::Div(hn::Add(hn::Mul(vb, ab), hn::Mul(vc, ac)), sum));
        };
        const Vector3 within{coordinate(t.a.x, t.ab.x, t.ac.x), coordinate(t.a.y, t.ab.y, t.ac.y),
                             coordinate(t.a.z, t.ab.z, t.ac.z)};
        point = choose(isOnRim, point, choose(hn::Gt(sum, zero), within, t.a));
    }
    const Vector3 way2 = minus(point, p);
    return dot(way2, way2);
}

/// The search for one packet.
class Search
{
public:
    Search(const TreeView& tree, const PointPacket& points, PacketNearest& out)
        : tree_(tree), points_(points), out_(out)
    {
        for (double& squared : out.squared)
            squared = std::numeric_limits<double>::infinity();
        for (uint32_t& equals : out.equals)
            equals = 0;
    }

    void run(uint32_t guess)
    {
        test(guess);
        size_t depth = 0;
        uint32_t index = 0;
        for (;;) {
            const TriangleTree::Node& node = tree_.nodes[index];
            if (node.count == 0) {
                if (descend(index, node.first, depth))
                    continue;
            } else {
                for (uint32_t place = node.first; place < node.first + node.count; ++place)
                    if (place != guess && isNear(tree_.boxes[place]))
                        test(place);
            }
            if (!rise(index, depth))
                return;
        }
    }

private:
    struct Waiting
    {
        alignas(64) double squared[kPacketPoints]; ///< [m2] of its box
        uint32_t node;
    };

    HWY_INLINE Vector3 point(size_t k) const
    {
        return {hn::Load(kD, points_.x + k * kLanes), hn::Load(kD, points_.y + k * kLanes),
                hn::Load(kD, points_.z + k * kLanes)};
    }
    HWY_INLINE V best(size_t k) const { return hn::Load(kD, out_.squared + k * kLanes); }

    /// [m2] of each point of one vector to a box.
    HWY_INLINE V squaredTo(const Vector3& low, const Vector3& high, size_t k) const
    {
        const V zero = hn::Zero(kD);
        const Vector3 p = point(k);
        const Vector3 out{hn::Max(hn::Max(hn::Sub(low.x, p.x), hn::Sub(p.x, high.x)), zero),
                          hn::Max(hn::Max(hn::Sub(low.y, p.y), hn::Sub(p.y, high.y)), zero),
                          hn::Max(hn::Max(hn::Sub(low.z, p.z), hn::Sub(p.z, high.z)), zero)};
        return dot(out, out);
    }
    /// Whether what is in a box may be as near to one of the points as the nearest so far.
    HWY_INLINE bool isNear(const TriangleTree::Box& box) const
    {
        const Vector3 low = broadcast(glm::dvec3(box.low)), high = broadcast(glm::dvec3(box.high));
        bool isNear = false;
        for (size_t k = 0; k < kVectors; ++k)
            isNear = !hn::AllFalse(kD, hn::Le(squaredTo(low, high, k), best(k))) || isNear;
        return isNear;
    }
    /// The same, and how far the box is.
    HWY_INLINE bool measure(const TriangleTree::Box& box, double* outSquared, double& outSum) const
    {
        const Vector3 low = broadcast(glm::dvec3(box.low)), high = broadcast(glm::dvec3(box.high));
        V sum = hn::Zero(kD);
        bool isNear = false;
        for (size_t k = 0; k < kVectors; ++k) {
            const V squared = squaredTo(low, high, k);
            hn::Store(squared, kD, outSquared + k * kLanes);
            sum = hn::Add(sum, squared);
            isNear = !hn::AllFalse(kD, hn::Le(squared, best(k))) || isNear;
        }
        outSum = hn::GetLane(hn::SumOfLanes(kD, sum));
        return isNear;
    }

    /// Goes to the nearer child and leaves the other for later. @return false when there is nothing to go to
    HWY_INLINE bool descend(uint32_t& ioIndex, uint32_t second, size_t& ioDepth)
    {
        Waiting& later = stack_[ioDepth];
        alignas(64) double squared[kPacketPoints];
        double firstSum, secondSum;
        const bool isFirstNear = measure(tree_.nodes[ioIndex + 1], squared, firstSum);
        const bool isSecondNear = measure(tree_.nodes[second], later.squared, secondSum);
        const uint32_t first = ioIndex + 1;
        if (!isFirstNear && !isSecondNear)
            return false;
        if (!isFirstNear || !isSecondNear) {
            ioIndex = isFirstNear ? first : second;
            return true;
        }
        later.node = second;
        ioIndex = first;
        if (secondSum < firstSum) {
            later.node = first;
            ioIndex = second;
            for (size_t k = 0; k < kVectors; ++k)
                hn::Store(hn::Load(kD, squared + k * kLanes), kD, later.squared + k * kLanes);
        }
        ++ioDepth;
        return true;
    }

    /// Takes up what was left for later and may still hold something nearer.
    HWY_INLINE bool rise(uint32_t& outIndex, size_t& ioDepth)
    {
        while (ioDepth > 0) {
            const Waiting& top = stack_[--ioDepth];
            bool isNear = false;
            for (size_t k = 0; k < kVectors; ++k)
                isNear = !hn::AllFalse(kD, hn::Le(hn::Load(kD, top.squared + k * kLanes), best(k))) || isNear;
            outIndex = top.node;
            if (isNear)
                return true;
        }
        return false;
    }

    HWY_INLINE void test(uint32_t place)
    {
        const Sides sides(tree_.triangles[place]);
        for (size_t k = 0; k < kVectors; ++k) {
            const V squared = squaredDistance(sides, point(k));
            const V before = best(k);
            const M isNearer = hn::Lt(squared, before);
            const uint32_t nearer = bitsOf(isNearer), equal = bitsOf(hn::Eq(squared, before));
            if ((nearer | equal) == 0)
                continue;
            hn::Store(hn::IfThenElse(isNearer, squared, before), kD, out_.squared + k * kLanes);
            for (uint32_t lane = 0; lane < kLanes; ++lane) {
                const uint32_t i = uint32_t(k * kLanes) + lane;
                if ((nearer >> lane & 1) != 0) {
                    out_.triangle[i] = place;
                    out_.equals[i] = 0;
                } else if ((equal >> lane & 1) != 0) {
                    if (const uint32_t n = out_.equals[i]++; n < PacketNearest::kMaxEqualTriangles)
                        out_.equal[i * PacketNearest::kMaxEqualTriangles + n] = place;
                }
            }
        }
    }

    const TreeView& tree_;
    const PointPacket& points_;
    PacketNearest& out_;
    std::array<Waiting, TriangleTree::kDeepest> stack_;
};

void search(const TreeView& tree, const PointPacket& points, uint32_t guess, PacketNearest& out)
{
    Search(tree, points, out).run(guess);
}

} // namespace
} // namespace fx::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace {
HWY_EXPORT(search);
} // namespace

void searchPacket(const TreeView& tree, const PointPacket& points, uint32_t guess, PacketNearest& out)
{
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(search)(tree, points, guess, out);
}

} // namespace fx::sim
#endif
