/// @file candidates-inl.h
/// Candidate neighbors in contiguous arrays. The file is compiled once for each instruction set.
#if defined(FX_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_CANDIDATES_INL_H
#undef FX_CANDIDATES_INL_H
#else
#define FX_CANDIDATES_INL_H
#endif

#include "simulation/sph/neighbors/packed_lanes.h"
#include "simulation/sph/neighbors/tree_walk-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::HWY_NAMESPACE {

/// Moves the selected lanes of a vector to its beginning. Highway's Compress is used only for 16 lanes, where
/// it is one instruction. For fewer lanes, GCC copies the table of Compress in every call.
template <class D>
class Packing
{
public:
    using T = hn::TFromD<D>;
    using D32 = hn::Rebind<uint32_t, D>;

    HWY_INLINE Packing(D d, hn::Mask<D> mask) : mask_(mask), kept_(uint32_t(hn::CountTrue(d, mask)))
    {
        if constexpr (!kNative)
            row_ = kPackedLanes[bitsOf(d, mask)].data();
    }

    uint32_t kept() const { return kept_; }
    /// Stores the selected lanes to `out`. The function may write as many values as a vector has.
    HWY_INLINE void store(hn::Vec<D> v, T* out) const
    {
        const D d;
        if constexpr (kNative)
            hn::StoreU(hn::Compress(v, mask_), d, out);
        else
            hn::StoreU(hn::TableLookupLanes(v, indices(d)), d, out);
    }
    HWY_INLINE void storeEntries(hn::Vec<D32> entries, uint32_t* out) const
    {
        const D32 d32;
        if constexpr (kNative)
            hn::StoreU(hn::Compress(entries, hn::RebindMask(d32, mask_)), d32, out);
        else
            hn::StoreU(hn::TableLookupLanes(entries, indices(d32)), d32, out);
    }

private:
    static constexpr bool kNative = hn::MaxLanes(D()) > 8;

    template <class E>
    HWY_INLINE auto indices(E e) const
    {
        const auto lanes = hn::LoadU(D32(), row_);
        if constexpr (sizeof(hn::TFromD<E>) == 4)
            return hn::IndicesFromVec(e, lanes);
        else
            return hn::IndicesFromVec(e, hn::PromoteTo(hn::RebindToUnsigned<E>(), lanes));
    }

    hn::Mask<D> mask_;
    uint32_t kept_;
    const uint32_t* row_ = nullptr;
};

/// Candidates of all images, one segment for each image. Every segment starts at a multiple of the vector
/// width. Every segment is padded with candidates at NaN, which are never neighbors.
template <class T>
struct Candidates
{
    static constexpr uint32_t kMax = 2048;
    static constexpr uint32_t kPadding = 64;

    uint32_t count = 0;
    /// index of the first candidate of each image; the last element is the end
    std::array<uint32_t, kMaxImages + 1> segment{};
    alignas(64) T at[3][kMax + kPadding];  ///< [m] positions in the coordinates of the image of the segment
    alignas(64) T reach2[kMax + kPadding]; ///< [m2] square of the reach (1 + margin) support
    alignas(64) uint32_t entry[kMax + kPadding];

    static bool isFull(uint32_t end) { return end + hn::MaxLanes(hn::ScalableTag<T>()) > kMax; }

    /// Appends the lanes selected by `mask`, beginning at index `end`. @return the new end
    template <class D, class V, class M>
    HWY_INLINE uint32_t append(uint32_t end, D d, M mask, V x, V y, V z, V square,
                               hn::Vec<hn::Rebind<uint32_t, D>> entries)
    {
        const Packing<D> packing(d, mask);
        packing.store(x, at[0] + end);
        packing.store(y, at[1] + end);
        packing.store(z, at[2] + end);
        packing.store(square, reach2 + end);
        packing.storeEntries(entries, entry + end);
        return end + packing.kept();
    }
    void endSegment(uint32_t image)
    {
        const hn::ScalableTag<T> d;
        const uint32_t lanes = uint32_t(hn::Lanes(d));
        const auto nowhere = hn::Set(d, std::numeric_limits<T>::quiet_NaN());
        for (uint32_t a = 0; a < 3; ++a)
            hn::StoreU(nowhere, d, at[a] + count);
        count = (count + lanes - 1) / lanes * lanes;
        segment[image + 1] = count;
    }
};

/// Collects the particles in the runs of slots that a query touches in one image. A TreeWalk passes the runs
/// to this class.
template <bool kPlain, class T>
class Gatherer
{
public:
    Gatherer(const SearchSetup<T>& setup, const SeenImage<T>& image, const Query<T>& query,
             Candidates<T>& out)
        : setup_(setup), image_(image), query_(query), out_(out)
    {}

    /// Adds a run of slots. Adjacent runs are merged.
    bool operator()(uint32_t begin, uint32_t end)
    {
        if (begin == end_) {
            end_ = end;
            return true;
        }
        const bool fits = flush();
        begin_ = begin;
        end_ = end;
        return fits;
    }
    /// Tests the particles of the pending run and appends the candidates. @return false if there was not
    /// enough memory
    bool flush()
    {
        const hn::ScalableTag<T> d;
        const hn::Rebind<uint32_t, decltype(d)> d32;
        const uint32_t lanes = uint32_t(hn::Lanes(d));
        uint32_t count = out_.count;
        for (uint32_t slot = begin_; slot < end_; slot += lanes) {
            if (Candidates<T>::isFull(count))
                return false;
            const auto x = shown(d, 0, slot);
            const auto y = shown(d, 1, slot);
            const auto z = shown(d, 2, slot);
            const auto reach = hn::Mul(hn::LoadU(d, setup_.tree.support + slot), hn::Set(d, setup_.scale));
            const auto reach2 = hn::Mul(reach, reach);
            const auto gap2 = sumOfSquares(gap(d, 0, x), gap(d, 1, y), gap(d, 2, z));
            const auto near =
                hn::And(hn::Lt(gap2, hn::Max(reach2, hn::Set(d, query_.reach2))), hn::FirstN(d, end_ - slot));
            count = out_.append(count, d, near, x, y, z, reach2, hn::Iota(d32, slot | image_.bits));
        }
        out_.count = count;
        return true;
    }

private:
    template <class D>
    HWY_INLINE hn::Vec<D> shown(D d, uint32_t axis, uint32_t slot) const
    {
        const auto x = hn::LoadU(d, setup_.tree.position[axis] + slot);
        if constexpr (kPlain)
            return x;
        return shownAt(image_, axis, d, x);
    }
    template <class D>
    HWY_INLINE hn::Vec<D> gap(D d, uint32_t axis, hn::Vec<D> x) const
    {
        return axisGap<!kPlain>(setup_, query_, axis, d, x, x);
    }

    const SearchSetup<T>& setup_;
    const SeenImage<T>& image_;
    const Query<T>& query_;
    Candidates<T>& out_;
    uint32_t begin_ = 0;
    uint32_t end_ = 0;
};

template <bool kPlain, class T>
bool gatherImage(const SearchSetup<T>& setup, const Query<T>& query, uint32_t index, Candidates<T>& out)
{
    const SeenImage<T>& image = setup.images[index];
    const Query<T> seen = seenFrom(query, image);
    Gatherer<kPlain, T> gatherer(setup, image, seen, out);
    TreeWalk<kPlain, T, Gatherer<kPlain, T>> walk(setup, image, seen, gatherer);
    const bool complete = walk.run() && gatherer.flush();
    out.endSegment(index);
    return complete;
}

/// Collects all candidates that a query box touches. @return false if there are too many
template <class T>
bool gather(const SearchSetup<T>& setup, const Query<T>& query, Candidates<T>& out)
{
    out.count = 0;
    for (uint32_t image = 0; image < setup.imageCount; ++image) {
        const bool plain = image == 0 && !setup.wraps;
        const bool complete = plain ? gatherImage<true>(setup, query, image, out)
                                    : gatherImage<false>(setup, query, image, out);
        if (!complete)
            return false;
    }
    return true;
}

/// Collects the candidates of `from` that a smaller query box touches.
template <bool kWraps, class T>
void refine(const SearchSetup<T>& setup, const Query<T>& query, const Candidates<T>& from, Candidates<T>& out)
{
    const hn::ScalableTag<T> d;
    const hn::Rebind<uint32_t, decltype(d)> d32;
    out.count = 0;
    for (uint32_t image = 0; image < setup.imageCount; ++image) {
        const Query<T> seen = seenFrom(query, setup.images[image]);
        uint32_t count = out.count;
        for (uint32_t k = from.segment[image]; k < from.segment[image + 1]; k += uint32_t(hn::Lanes(d))) {
            const auto x = hn::Load(d, from.at[0] + k);
            const auto y = hn::Load(d, from.at[1] + k);
            const auto z = hn::Load(d, from.at[2] + k);
            const auto reach2 = hn::Load(d, from.reach2 + k);
            const auto gap2 = sumOfSquares(axisGap<kWraps>(setup, seen, 0, d, x, x),
                                           axisGap<kWraps>(setup, seen, 1, d, y, y),
                                           axisGap<kWraps>(setup, seen, 2, d, z, z));
            const auto near = hn::Lt(gap2, hn::Max(reach2, hn::Set(d, seen.reach2)));
            count = out.append(count, d, near, x, y, z, reach2, hn::LoadU(d32, from.entry + k));
        }
        out.count = count;
        out.endSegment(image);
    }
}

} // namespace fx::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
