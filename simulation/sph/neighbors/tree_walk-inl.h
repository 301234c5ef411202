/// @file tree_walk-inl.h
/// Traversal from the root to all leaves that a query touches, eight children at once. The file is compiled
/// once for each instruction set.
#if defined(FX_TREE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_TREE_WALK_INL_H
#undef FX_TREE_WALK_INL_H
#else
#define FX_TREE_WALK_INL_H
#endif

#include "simulation/sph/neighbors/neighbor_search.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A query box. The box touches an element if the distance of both is below the reach of the query or of the
/// element.
template <class T>
struct Query
{
    std::array<T, 3> low;  ///< [m]
    std::array<T, 3> high; ///< [m]
    T reach2 = 0; ///< [m2] square of the largest reach of the particles in the query box, margin included
};

/// Transforms the bounding box of the owners to the coordinates of `image`.
template <class T>
Query<T> seenFrom(const Query<T>& query, const SeenImage<T>& image)
{
    Query<T> seen = query;
    for (uint32_t a = 0; a < 3; ++a) {
        seen.low[a] -= image.wall[a];
        seen.high[a] -= image.wall[a];
    }
    return seen;
}

/// Converts a mask of at most eight lanes to bits. Bit k belongs to lane k.
template <class D, class M>
HWY_INLINE uint32_t bitsOf(D d, M mask)
{
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
}

/// Transforms positions of particles to the coordinates of `image`.
template <class T, class D, class V>
HWY_INLINE V shownAt(const SeenImage<T>& image, uint32_t axis, D d, V x)
{
    return hn::Add(hn::Mul(x, hn::Set(d, image.sign[axis])), hn::Set(d, image.shift[axis]));
}

/// The difference of two coordinates to the nearest periodic image: d - period round(d / period) for a
/// difference d.
template <class T, class D, class V>
HWY_INLINE V wrapped(const SearchSetup<T>& setup, uint32_t axis, D d, V difference)
{
    const V turns = hn::Round(hn::Mul(difference, hn::Set(d, setup.pairs.perPeriod[axis])));
    return hn::Sub(difference, hn::Mul(turns, hn::Set(d, setup.pairs.period[axis])));
}

/// Gap between the boxes [low, high] and the query box on one axis, at least 0. The gap never exceeds the
/// distance on this axis between two particles inside the boxes.
template <bool kWraps, class T, class D, class V>
HWY_INLINE V axisGap(const SearchSetup<T>& setup, const Query<T>& query, uint32_t axis, D d, V low, V high)
{
    const V zero = hn::Zero(d);
    if (kWraps && setup.pairs.period[axis] != 0) {
        const V half = hn::Set(d, T(0.5));
        const T center = (query.low[axis] + query.high[axis]) * T(0.5);
        const T spread = (query.high[axis] - query.low[axis]) * T(0.5) + setup.slack[axis];
        const V middle = hn::Mul(hn::Add(low, high), half);
        const V extent = hn::Add(hn::Mul(hn::Sub(high, low), half), hn::Set(d, spread));
        const V distance = hn::Abs(wrapped(setup, axis, d, hn::Sub(middle, hn::Set(d, center))));
        return hn::Max(hn::Sub(distance, extent), zero);
    }
    const V below = hn::Sub(low, hn::Set(d, query.high[axis]));
    const V above = hn::Sub(hn::Set(d, query.low[axis]), high);
    return hn::Max(hn::Max(below, above), zero);
}

template <class V>
HWY_INLINE V sumOfSquares(V x, V y, V z)
{
    return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

/// One traversal of the tree for one query and one image.
/// @tparam kPlain true: the image is neither mirrored nor wrapped
/// @tparam Sink has bool operator()(uint32_t begin, uint32_t end), which receives runs of slots in ascending
///         order and returns false to end the traversal
template <bool kPlain, class T, class Sink>
class TreeWalk
{
public:
    TreeWalk(const SearchSetup<T>& setup, const SeenImage<T>& image, const Query<T>& query, Sink& sink)
        : setup_(setup), tree_(setup.tree), image_(image), query_(query), sink_(sink)
    {}

    /// Traverses the tree. @return false if the sink ended the traversal
    bool run()
    {
        if (tree_.levels == 1)
            return sink_(0, tree_.count);
        return visit(tree_.levels - 1, 0);
    }

private:
    bool visit(uint32_t level, uint32_t node)
    {
        const uint32_t first = node * kTreeFanOut;
        const uint32_t children = std::min(tree_.levelCount[level - 1] - first, kTreeFanOut);
        uint32_t hits = touched(tree_.levelFirst[level - 1] + first) & ((1u << children) - 1);
        for (; hits != 0; hits &= hits - 1) {
            const uint32_t child = first + uint32_t(std::countr_zero(hits));
            const bool more = level == 1 ? sink_(tree_.leafBegin[child], tree_.leafBegin[child + 1])
                                         : visit(level - 1, child);
            if (!more)
                return false;
        }
        return true;
    }

    /// Bit mask of the eight boxes, beginning with box `first`, that the query touches. Bit k belongs to box
    /// first + k.
    uint32_t touched(uint32_t first) const
    {
        const hn::CappedTag<T, kTreeFanOut> d;
        const auto scale = hn::Set(d, setup_.scale);
        const auto reach2 = hn::Set(d, query_.reach2);
        uint32_t hits = 0;
        for (uint32_t k = 0; k < kTreeFanOut; k += uint32_t(hn::Lanes(d))) {
            const auto gap2 = sumOfSquares(gap(d, 0, first + k), gap(d, 1, first + k), gap(d, 2, first + k));
            const auto reach = hn::Mul(hn::LoadU(d, tree_.reach + first + k), scale);
            hits |= bitsOf(d, hn::Lt(gap2, hn::Max(hn::Mul(reach, reach), reach2))) << k;
        }
        return hits;
    }

    template <class D>
    hn::Vec<D> gap(D d, uint32_t axis, uint32_t first) const
    {
        const auto low = hn::LoadU(d, tree_.low[axis] + first);
        const auto high = hn::LoadU(d, tree_.high[axis] + first);
        if constexpr (kPlain)
            return axisGap<false>(setup_, query_, axis, d, low, high);
        const auto one = shownAt(image_, axis, d, low);
        const auto other = shownAt(image_, axis, d, high);
        return axisGap<true>(setup_, query_, axis, d, hn::Min(one, other), hn::Max(one, other));
    }

    const SearchSetup<T>& setup_;
    const TreeView<T>& tree_;
    const SeenImage<T>& image_;
    const Query<T>& query_;
    Sink& sink_;
};

} // namespace fx::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
