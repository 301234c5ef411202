/// @file piece_search-inl.h
/// Searches the list of one particle in pieces, with little memory. The file is compiled once for each
/// instruction set.
#if defined(FX_PIECE_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PIECE_SEARCH_INL_H
#undef FX_PIECE_SEARCH_INL_H
#else
#define FX_PIECE_SEARCH_INL_H
#endif

#include "simulation/sph/neighbors/list_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::HWY_NAMESPACE {

/// Buffer of entries that are passed to the caller in pieces.
class PieceBuffer
{
public:
    PieceBuffer(uint32_t owner, ListPiece piece, void* argument)
        : owner_(owner), piece_(piece), argument_(argument)
    {}

    uint32_t* end() { return entries_ + count_; }
    /// Adds `count` entries, at most kRoom, which the caller has written at end().
    void add(uint32_t count)
    {
        count_ += count;
        if (count_ < kPiece)
            return;
        piece_(argument_, entries_, kPiece, false);
        std::copy(entries_ + kPiece, entries_ + count_, entries_);
        count_ -= kPiece;
    }
    void finish()
    {
        std::fill(entries_ + count_, entries_ + (count_ + kLanes - 1) / kLanes * kLanes, owner_);
        piece_(argument_, entries_, count_, true);
    }

private:
    static constexpr uint32_t kPiece = 1024;
    static constexpr uint32_t kRoom = 64;
    static_assert(kPiece % kLanes == 0);

    uint32_t owner_;
    ListPiece piece_;
    void* argument_;
    uint32_t count_ = 0;
    uint32_t entries_[kPiece + 2 * kRoom];
};

/// Tests the particles in runs of slots as neighbors of one owner in one image. A TreeWalk passes the runs to
/// this class.
template <bool kPlain, class T>
class PieceSink
{
public:
    PieceSink(const SearchSetup<T>& setup, const SeenImage<T>& image, uint32_t slot, PieceBuffer& out)
        : setup_(setup), image_(image), slot_(slot), owner_(ownerSeen(setup, image, slot)), out_(out)
    {}

    bool operator()(uint32_t begin, uint32_t end)
    {
        const hn::ScalableTag<T> d;
        const hn::Rebind<uint32_t, decltype(d)> d32;
        const uint32_t lanes = uint32_t(hn::Lanes(d));
        for (uint32_t slot = begin; slot < end; slot += lanes) {
            const auto reach = hn::Mul(hn::LoadU(d, setup_.tree.support + slot), hn::Set(d, setup_.scale));
            auto near = isNear<!kPlain>(setup_, owner_, d, shown(d, 0, slot), shown(d, 1, slot),
                                        shown(d, 2, slot), hn::Mul(reach, reach));
            near = hn::And(near, hn::FirstN(d, end - slot));
            if (image_.bits == 0 && slot_ - slot < lanes) // no particle is its own neighbor
                near = hn::And(near, hn::Not(hn::And(hn::FirstN(d, slot_ - slot + 1),
                                                     hn::Not(hn::FirstN(d, slot_ - slot)))));
            const Packing packing(d, near);
            packing.storeEntries(hn::Iota(d32, slot | image_.bits), out_.end());
            out_.add(packing.kept());
        }
        return true;
    }

private:
    template <class D>
    hn::Vec<D> shown(D d, uint32_t axis, uint32_t slot) const
    {
        return shownAt(image_, axis, d, hn::LoadU(d, setup_.tree.position[axis] + slot));
    }

    const SearchSetup<T>& setup_;
    const SeenImage<T>& image_;
    uint32_t slot_;
    Owner<T> owner_;
    PieceBuffer& out_;
};

template <bool kPlain, class T>
void searchImage(const SearchSetup<T>& setup, const SeenImage<T>& image, uint32_t slot, PieceBuffer& out)
{
    const TreeView<T>& tree = setup.tree;
    const std::array<T, 3> at{tree.position[0][slot], tree.position[1][slot], tree.position[2][slot]};
    const T reach = tree.support[slot] * setup.scale;
    const Query<T> seen = seenFrom(Query<T>{at, at, reach * reach}, image);
    PieceSink<kPlain, T> sink(setup, image, slot, out);
    TreeWalk<kPlain, T, PieceSink<kPlain, T>>(setup, image, seen, sink).run();
}

template <class T>
void searchPieces(const SearchSetup<T>& setup, uint32_t slot, ListPiece piece, void* argument)
{
    PieceBuffer out(slot, piece, argument);
    for (uint32_t k = 0; k < setup.imageCount; ++k) {
        const SeenImage<T>& image = setup.images[k];
        if (!isSeenBy(setup, image, slot))
            continue;
        if (k == 0 && !setup.wraps)
            searchImage<true>(setup, image, slot, out);
        else
            searchImage<false>(setup, image, slot, out);
    }
    out.finish();
}

} // namespace fx::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
