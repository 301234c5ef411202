/// @file list_search-inl.h
/// Computes the neighbor lists of owners. The file is compiled once for each instruction set.
#if defined(FX_LIST_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_LIST_SEARCH_INL_H
#undef FX_LIST_SEARCH_INL_H
#else
#define FX_LIST_SEARCH_INL_H
#endif

#include "simulation/sph/neighbors/candidates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::HWY_NAMESPACE {

/// The particle that owns a list, in the coordinates of one image.
template <class T>
struct Owner
{
    std::array<T, 3> at; ///< [m] position relative to the wall that mirrors the image, on mirrored axes
    T reach2;            ///< [m2]
};

template <class T>
Owner<T> ownerSeen(const SearchSetup<T>& setup, const SeenImage<T>& image, uint32_t slot)
{
    const TreeView<T>& tree = setup.tree;
    const T reach = tree.support[slot] * setup.scale;
    return {{tree.position[0][slot] - image.wall[0], tree.position[1][slot] - image.wall[1],
             tree.position[2][slot] - image.wall[2]},
            reach * reach};
}

/// True if the walls of the image are the walls nearer to the owner.
template <class T>
bool isSeenBy(const SearchSetup<T>& setup, const SeenImage<T>& image, uint32_t slot)
{
    for (uint32_t a = 0; a < 3; ++a)
        if ((image.bits >> a & kMirrorX) != 0 &&
            setup.pairs.nearerWall(a, setup.tree.position[a][slot]) != image.wall[a])
            return false;
    return true;
}

/// Mask of the lanes whose particles are neighbors of the owner.
template <bool kWraps, class T, class D, class V>
HWY_INLINE auto isNear(const SearchSetup<T>& setup, const Owner<T>& owner, D d, V x, V y, V z, V reach2)
{
    V dx = hn::Sub(hn::Set(d, owner.at[0]), x);
    V dy = hn::Sub(hn::Set(d, owner.at[1]), y);
    V dz = hn::Sub(hn::Set(d, owner.at[2]), z);
    if constexpr (kWraps) {
        dx = wrapped(setup, 0, d, dx);
        dy = wrapped(setup, 1, d, dy);
        dz = wrapped(setup, 2, d, dz);
    }
    return hn::Lt(sumOfSquares(dx, dy, dz), hn::Max(reach2, hn::Set(d, owner.reach2)));
}

/// Writes the entries of the candidates [begin, end) that are neighbors of the owner. @return number of
/// entries
template <bool kWraps, class T>
uint32_t keepNear(const SearchSetup<T>& setup, const Owner<T>& owner, const Candidates<T>& from,
                  uint32_t begin, uint32_t end, uint32_t* out)
{
    const hn::ScalableTag<T> d;
    const hn::Rebind<uint32_t, decltype(d)> d32;
    uint32_t found = 0;
    for (uint32_t k = begin; k < end; k += uint32_t(hn::Lanes(d))) {
        const auto near =
            isNear<kWraps>(setup, owner, d, hn::Load(d, from.at[0] + k), hn::Load(d, from.at[1] + k),
                           hn::Load(d, from.at[2] + k), hn::Load(d, from.reach2 + k));
        const Packing packing(d, near);
        packing.storeEntries(hn::LoadU(d32, from.entry + k), out + found);
        found += packing.kept();
    }
    return found;
}

/// Finds lists for owners in ascending order and writes them.
template <class T>
class ListSearch
{
public:
    ListSearch(const SearchSetup<T>& setup, ListWriter& writer)
        : setup_(setup), tree_(setup.tree), writer_(writer)
    {}

    void list(std::span<const uint32_t> owners)
    {
        while (!owners.empty()) {
            const uint32_t group = leafOf(owners.front()) / kGroup;
            const uint32_t end = tree_.leafBegin[std::min((group + 1) * kGroup, tree_.levelCount[0])];
            const auto ours = firstBelow(owners, end);
            listGroup(ours);
            owners = owners.subspan(ours.size());
        }
    }

private:
    static constexpr uint32_t kGroup = kTreeFanOut; ///< number of leaves that share one search

    uint32_t leafOf(uint32_t slot) const
    {
        const uint32_t* const begin = tree_.leafBegin;
        return uint32_t(std::upper_bound(begin, begin + tree_.levelCount[0], slot) - begin) - 1;
    }
    static std::span<const uint32_t> firstBelow(std::span<const uint32_t> owners, uint32_t end)
    {
        size_t count = 1;
        while (count < owners.size() && owners[count] < end)
            ++count;
        return owners.first(count);
    }

    Query<T> boxOf(std::span<const uint32_t> owners) const
    {
        Query<T> box;
        T reach = 0;
        box.low.fill(std::numeric_limits<T>::infinity()); // so that NaN is passed over
        box.high.fill(-std::numeric_limits<T>::infinity());
        for (const uint32_t slot : owners) {
            for (uint32_t a = 0; a < 3; ++a) {
                const T x = tree_.position[a][slot];
                box.low[a] = std::min(box.low[a], x);
                box.high[a] = std::max(box.high[a], x);
            }
            reach = std::max(reach, tree_.support[slot]);
        }
        reach *= setup_.scale;
        box.reach2 = reach * reach;
        return box;
    }

    /// Finds and writes the lists of a group of owners. If there are too many candidates, the group is
    /// divided.
    void listGroup(std::span<const uint32_t> owners)
    {
        if (!writer_.exhausted() && gather(setup_, boxOf(owners), ours_)) {
            while (!owners.empty()) {
                const auto leaf = firstBelow(owners, tree_.leafBegin[leafOf(owners.front()) + 1]);
                listLeaf(leaf);
                owners = owners.subspan(leaf.size());
            }
        } else if (writer_.exhausted() || owners.size() == 1) {
            for (const uint32_t slot : owners)
                writer_.leaveUnlisted(slot);
        } else {
            listGroup(owners.first(owners.size() / 2));
            listGroup(owners.subspan(owners.size() / 2));
        }
    }

    void listLeaf(std::span<const uint32_t> owners)
    {
        Candidates<T>* candidates = &ours_;
        if (owners.size() > 2) { // fewer are quicker without
            const Query<T> box = boxOf(owners);
            if (setup_.wraps)
                refine<true>(setup_, box, ours_, leafs_);
            else
                refine<false>(setup_, box, ours_, leafs_);
            candidates = &leafs_;
        }
        uint32_t own = 0;
        for (const uint32_t slot : owners) {
            uint32_t next = own;
            while (next < candidates->count && candidates->entry[next] != slot)
                ++next;
            if (next == candidates->count) { // at NaN: near no particle, not even itself
                writer_.leaveUnlisted(slot);
                continue;
            }
            own = next;
            listOwner(slot, own, *candidates);
        }
    }

    /// Writes the list of one owner.
    /// @param own index of the owner among the candidates
    void listOwner(uint32_t slot, uint32_t own, Candidates<T>& candidates)
    {
        uint32_t* const out = writer_.room(candidates.count + Candidates<T>::kPadding);
        if (!out) {
            writer_.leaveUnlisted(slot);
            return;
        }
        const T x = candidates.at[0][own];
        candidates.at[0][own] = std::numeric_limits<T>::quiet_NaN(); // no particle is its own neighbor
        uint32_t found = 0;
        for (uint32_t k = 0; k < setup_.imageCount; ++k) {
            const SeenImage<T>& image = setup_.images[k];
            const uint32_t begin = candidates.segment[k];
            const uint32_t end = candidates.segment[k + 1];
            if (begin == end || (k > 0 && !isSeenBy(setup_, image, slot)))
                continue;
            const Owner<T> owner = ownerSeen(setup_, image, slot);
            found += setup_.wraps ? keepNear<true>(setup_, owner, candidates, begin, end, out + found)
                                  : keepNear<false>(setup_, owner, candidates, begin, end, out + found);
        }
        candidates.at[0][own] = x;
        writer_.finish(slot, found);
    }

    const SearchSetup<T>& setup_;
    const TreeView<T>& tree_;
    ListWriter& writer_;
    Candidates<T> ours_;
    Candidates<T> leafs_;
};

} // namespace fx::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
