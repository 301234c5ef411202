/// @file neighbors-inl.h
/// Loads neighbors from their records and computes their positions relative to the owner of the list. The
/// file is included once for each instruction set.
#if defined(FX_PAIR_NEIGHBORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PAIR_NEIGHBORS_INL
#undef FX_PAIR_NEIGHBORS_INL
#else
#define FX_PAIR_NEIGHBORS_INL
#endif

#include "simulation/sph/pair_loops/lanes-inl.h"
#include "simulation/sph/pair_loops/pair_slots.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {

/// Four fields of several neighbors, one vector per field.
template <class T>
struct Quad
{
    Pack<T> a, b, c, d;
};

#if HWY_TARGET == HWY_SCALAR

/// Loads four fields of one record, for instruction sets without vectors.
template <class Tag>
HWY_INLINE Quad<hn::TFromD<Tag>> loadTransposed(Tag, const hn::TFromD<Tag>* table, const uint32_t* entries)
{
    using T = hn::TFromD<Tag>;
    const T* record = table + size_t(entries[0] & kPlaceMask) * 16;
    return {Pack<T>(record[0]), Pack<T>(record[1]), Pack<T>(record[2]), Pack<T>(record[3])};
}

#else

/// Loads a vector of 128-bit blocks, one block from each of the records entries[0], entries[stride],
/// entries[2 stride], ... `table` points to the block of the first record.
template <class Tag>
HWY_INLINE hn::Vec<Tag> loadBlocks(Tag tag, const hn::TFromD<Tag>* table, const uint32_t* entries,
                                   uint32_t stride)
{
    using T = hn::TFromD<Tag>;
    if constexpr (hn::MaxLanes(Tag()) * sizeof(T) == 16) {
        (void)stride;
        return hn::Load(tag, table + size_t(entries[0] & kPlaceMask) * 16);
    } else {
        const hn::Half<Tag> half;
        const uint32_t blocks = uint32_t(hn::MaxLanes(half)) * uint32_t(sizeof(T)) / 16;
        return hn::Combine(tag, loadBlocks(half, table, entries + stride * blocks, stride),
                           loadBlocks(half, table, entries, stride));
    }
}

/// Loads four float fields of as many records as a vector has lanes.
template <class Tag>
HWY_INLINE Quad<float> loadTransposed(Tag tag, const float* table, const uint32_t* entries)
{
    const hn::Repartition<double, Tag> pairs;
    const auto r0 = loadBlocks(tag, table, entries, 4);
    const auto r1 = loadBlocks(tag, table, entries + 1, 4);
    const auto r2 = loadBlocks(tag, table, entries + 2, 4);
    const auto r3 = loadBlocks(tag, table, entries + 3, 4);
    const auto ab01 = hn::BitCast(pairs, hn::InterleaveLower(tag, r0, r1)); // a0 a1 b0 b1
    const auto cd01 = hn::BitCast(pairs, hn::InterleaveUpper(tag, r0, r1));
    const auto ab23 = hn::BitCast(pairs, hn::InterleaveLower(tag, r2, r3));
    const auto cd23 = hn::BitCast(pairs, hn::InterleaveUpper(tag, r2, r3));
    return {Pack<float>(hn::BitCast(tag, hn::InterleaveLower(pairs, ab01, ab23))),
            Pack<float>(hn::BitCast(tag, hn::InterleaveUpper(pairs, ab01, ab23))),
            Pack<float>(hn::BitCast(tag, hn::InterleaveLower(pairs, cd01, cd23))),
            Pack<float>(hn::BitCast(tag, hn::InterleaveUpper(pairs, cd01, cd23)))};
}

/// Loads four double fields; a 128-bit block holds two of them.
template <class Tag>
HWY_INLINE Quad<double> loadTransposed(Tag tag, const double* table, const uint32_t* entries)
{
    const auto ab0 = loadBlocks(tag, table, entries, 2);
    const auto ab1 = loadBlocks(tag, table, entries + 1, 2);
    const auto cd0 = loadBlocks(tag, table + 2, entries, 2);
    const auto cd1 = loadBlocks(tag, table + 2, entries + 1, 2);
    return {
        Pack<double>(hn::InterleaveLower(tag, ab0, ab1)), Pack<double>(hn::InterleaveUpper(tag, ab0, ab1)),
        Pack<double>(hn::InterleaveLower(tag, cd0, cd1)), Pack<double>(hn::InterleaveUpper(tag, cd0, cd1))};
}

#endif

/// Loads the fields 4 group .. 4 group + 3 of the neighbors entries[0 .. width).
template <class T>
HWY_INLINE Quad<T> loadQuad(const GasRecord<T>* records, const uint32_t* entries, uint32_t group)
{
    const T* table = &records->x + 4 * size_t(group);
    return loadTransposed(typename Pack<T>::Tag(), table, entries);
}

/// The list entries of the lanes of a vector, stored as bits in lanes of the width of T.
template <class T>
class Entries
{
public:
    HWY_INLINE explicit Entries(const uint32_t* entries)
        : bits_(hn::PromoteTo(Words(), hn::LoadU(hn::Rebind<uint32_t, Words>(), entries)))
    {}
    HWY_INLINE typename Pack<T>::Mask equal(uint32_t entry) const
    {
        return hn::RebindMask(typename Pack<T>::Tag(), hn::Eq(bits_, hn::Set(Words(), entry)));
    }
    HWY_INLINE typename Pack<T>::Mask mirrored(uint32_t axis) const
    {
        return hn::RebindMask(typename Pack<T>::Tag(),
                              hn::TestBit(bits_, hn::Set(Words(), kMirrorX << axis)));
    }

private:
    using Words = hn::RebindToUnsigned<typename Pack<T>::Tag>;
    hn::Vec<Words> bits_;
};
template <>
HWY_INLINE Entries<float>::Entries(const uint32_t* entries) : bits_(hn::LoadU(Words(), entries))
{}

/// Positions of the image walls, and the periods, that apply to one particle.
template <class T>
struct ImageRules
{
    explicit ImageRules(const Domain& domain) : images(pairImages<T>(domain))
    {
        for (uint32_t a = 0; a < 3; ++a) {
            periodic = periodic || domain.axes[a] == AxisKind::Periodic;
            walls = walls || domain.axes[a] == AxisKind::Reflecting;
        }
    }
    PairImages<T> images;
    bool periodic = false;
    bool walls = false;
};

/// The particle that owns the list, broadcast to all lanes.
template <class T>
struct Owner
{
    Owner(const GasRecord<T>& record, uint32_t ownPlace, const ImageRules<T>& imageRules)
        : rules(imageRules),
          slot(ownPlace), x{Pack<T>(record.x), Pack<T>(record.y), Pack<T>(record.z)}, v{Pack<T>(record.vx),
                                                                                        Pack<T>(record.vy),
                                                                                        Pack<T>(record.vz)}
    {
        const T position[3] = {record.x, record.y, record.z};
        for (uint32_t a = 0; a < 3; ++a)
            wall[a] = rules.images.nearerWall(a, position[a]);
    }
    const ImageRules<T>& rules;
    uint32_t slot;
    Pack<T> x[3];
    Pack<T> v[3];
    T wall[3];
};

/// Position and velocity of the owner of a list relative to its neighbors.
template <class T>
struct Relative
{
    HWY_INLINE Relative(const Owner<T>& owner, const Entries<T>& entries, const Pack<T>* x, const Pack<T>* v)
    {
        for (uint32_t a = 0; a < 3; ++a) {
            d[a] = owner.x[a] - x[a];
            u[a] = owner.v[a] - v[a];
        }
        if (owner.rules.periodic)
            wrap(owner.rules.images);
        if (owner.rules.walls)
            mirror(owner, entries, x, v);
    }
    HWY_INLINE void wrap(const PairImages<T>& images)
    {
        for (uint32_t a = 0; a < 3; ++a)
            d[a] = d[a] - Pack<T>(images.period[a]) * nearestInteger(d[a] * Pack<T>(images.perPeriod[a]));
    }
    HWY_INLINE void mirror(const Owner<T>& owner, const Entries<T>& entries, const Pack<T>* x,
                           const Pack<T>* v)
    {
        for (uint32_t a = 0; a < 3; ++a) {
            const auto mask = entries.mirrored(a);
            const Pack<T> wall(owner.wall[a]);
            d[a] = choose<T>(mask, (owner.x[a] - wall) + (x[a] - wall), d[a]);
            u[a] = choose<T>(mask, owner.v[a] + v[a], u[a]);
        }
    }
    Pack<T> d[3]; ///< [m]
    Pack<T> u[3]; ///< [m/s]
};

} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
