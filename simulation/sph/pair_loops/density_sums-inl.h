/// @file density_sums-inl.h
/// The sums of gas-density over a block of neighbors. The file is included once for each instruction set.
#if defined(FX_PAIR_DENSITY_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PAIR_DENSITY_SUMS_INL
#undef FX_PAIR_DENSITY_SUMS_INL
#else
#define FX_PAIR_DENSITY_SUMS_INL
#endif

#include "simulation/sph/pair_loops/neighbors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {

/// Indices of the sums in LaneSums: S and D without the factor C, then M, G and E.
enum : uint32_t
{
    kSumMass = 0,
    kSumGrowth = 1,
    kSumMoments = 2,
    kSumFlows = 8,
    kSumSlopes = 17,
    kDensitySums = 20
};

/// All sums for the lanes of one vector. The sums are single members instead of an array, because compilers
/// do not keep arrays in registers.
template <class T>
struct FlowSums
{
    Pack<T> mass, growth, xx, xy, xz, yy, yz, zz;
    Pack<T> uxx, uxy, uxz, uyx, uyy, uyz, uzx, uzy, uzz;
    Pack<T> ex, ey, ez;

    using Rows = T (*)[kLanes];

    /// Loads the lanes p .. p + width - 1 of all sums.
    HWY_INLINE FlowSums(Rows row, uint32_t p)
        : mass(from(row, 0, p)), growth(from(row, 1, p)), xx(from(row, 2, p)), xy(from(row, 3, p)),
          xz(from(row, 4, p)), yy(from(row, 5, p)), yz(from(row, 6, p)), zz(from(row, 7, p)),
          uxx(from(row, 8, p)), uxy(from(row, 9, p)), uxz(from(row, 10, p)), uyx(from(row, 11, p)),
          uyy(from(row, 12, p)), uyz(from(row, 13, p)), uzx(from(row, 14, p)), uzy(from(row, 15, p)),
          uzz(from(row, 16, p)), ex(from(row, 17, p)), ey(from(row, 18, p)), ez(from(row, 19, p))
    {}
    HWY_INLINE void store(Rows row, uint32_t p) const
    {
        mass.store(row[0] + p);
        growth.store(row[1] + p);
        xx.store(row[2] + p);
        xy.store(row[3] + p);
        xz.store(row[4] + p);
        yy.store(row[5] + p);
        yz.store(row[6] + p);
        zz.store(row[7] + p);
        uxx.store(row[8] + p);
        uxy.store(row[9] + p);
        uxz.store(row[10] + p);
        uyx.store(row[11] + p);
        uyy.store(row[12] + p);
        uyz.store(row[13] + p);
        uzx.store(row[14] + p);
        uzy.store(row[15] + p);
        uzz.store(row[16] + p);
        ex.store(row[17] + p);
        ey.store(row[18] + p);
        ez.store(row[19] + p);
    }
    static HWY_INLINE Pack<T> from(Rows row, uint32_t s, uint32_t p) { return Pack<T>::load(row[s] + p); }
    /// Adds the terms of the neighbors of one vector.
    /// @param steep m w'(q) / q of the neighbors
    /// @param d, u position and velocity of the owner relative to the neighbors
    HWY_INLINE void addFlow(Pack<T> steep, const Pack<T>* d, const Pack<T>* u)
    {
        const Pack<T> weight = Pack<T>(0.0) - steep;
        const Pack<T> gx = weight * d[0], gy = weight * d[1], gz = weight * d[2];
        ex += gx; // (7)
        ey += gy;
        ez += gz;
        xx += gx * d[0]; // (5)
        xy += gx * d[1];
        xz += gx * d[2];
        yy += gy * d[1];
        yz += gy * d[2];
        zz += gz * d[2];
        uxx += u[0] * gx;
        uxy += u[0] * gy;
        uxz += u[0] * gz;
        uyx += u[1] * gx;
        uyy += u[1] * gy;
        uyz += u[1] * gz;
        uzx += u[2] * gx;
        uzy += u[2] * gy;
        uzz += u[2] * gz;
    }
};

/// Positions and velocities of a particle relative to each of its neighbors, stored for repeated sums.
template <class T>
class NeighborBlock
{
public:
    static constexpr uint32_t kCapacity = 512; // 16 KiB in float: with the records inside of the first cache

    /// Loads the neighbors of a piece of a list.
    /// @param count number of entries, at most kCapacity; entries can be read up to the next multiple of
    ///          kLanes
    void load(const Owner<T>& owner, const GasRecord<T>* records, const uint32_t* entries, uint32_t count)
    {
        size_ = (count + kLanes - 1) / kLanes * kLanes;
        for (uint32_t k = 0; k < size_; k += Pack<T>::kWidth) {
            const Entries<T> lanes(entries + k);
            const Quad<T> slot = loadQuad(records, entries + k, 0);
            const Quad<T> motion = loadQuad(records, entries + k, 1);
            const Pack<T> x[3] = {slot.a, slot.b, slot.c};
            const Pack<T> v[3] = {motion.a, motion.b, motion.c};
            const Relative<T> relative(owner, lanes, x, v);
            const Pack<T>* d = relative.d;
            const Pack<T> r = root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            for (uint32_t a = 0; a < 3; ++a) {
                d[a].store(d_[a] + k);
                relative.u[a].store(u_[a] + k);
            }
            choose<T>(lanes.equal(owner.slot), Pack<T>(kFar), r).store(r_ + k); // padding is out of reach
            motion.d.store(mass_ + k);
        }
    }

    /// Adds the terms of the first two sums, S and D, for the support 1 / perSupport.
    template <class Shape>
    void addMass(T perSupport, LaneSums<T, kDensitySums>& sums) const
    {
        const Pack<T> perH(perSupport), one(1.0);
        for (uint32_t p = 0; p < kLanes; p += Pack<T>::kWidth) {
            Pack<T> mass = Pack<T>::load(sums.lane[kSumMass] + p);
            Pack<T> growth = Pack<T>::load(sums.lane[kSumGrowth] + p);
            for (uint32_t k = p; k < size_; k += kLanes) {
                const Pack<T> q = smaller(at(r_ + k) * perH, one);
                const Pack<T> m = at(mass_ + k);
                mass += m * Shape::template value<Pack<T>>(q);             // (1)
                growth += q * q * (m * Shape::template slope<Pack<T>>(q)); // (3)
            }
            mass.store(sums.lane[kSumMass] + p);
            growth.store(sums.lane[kSumGrowth] + p);
        }
    }

    /// Adds the terms of all sums. Returns the number of neighbors within the support.
    template <class Shape>
    uint32_t addAll(T perSupport, LaneSums<T, kDensitySums>& sums) const
    {
        const typename Pack<T>::Tag tag;
        const Pack<T> perH(perSupport), one(1.0);
        uint32_t inside = 0;
        for (uint32_t p = 0; p < kLanes; p += Pack<T>::kWidth) {
            FlowSums<T> sum(sums.lane, p);
            for (uint32_t k = p; k < size_; k += kLanes) {
                const Pack<T> q = smaller(at(r_ + k) * perH, one);
                const Pack<T> m = at(mass_ + k);
                inside += uint32_t(hn::CountTrue(tag, hn::Lt(q.v, one.v)));
                const Pack<T> steep = m * Shape::template slope<Pack<T>>(q);
                sum.mass += m * Shape::template value<Pack<T>>(q); // (1)
                sum.growth += q * q * steep;                       // (3)
                const Pack<T> d[3] = {at(d_[0] + k), at(d_[1] + k), at(d_[2] + k)};
                const Pack<T> u[3] = {at(u_[0] + k), at(u_[1] + k), at(u_[2] + k)};
                sum.addFlow(steep, d, u);
            }
            sum.store(sums.lane, p);
        }
        return inside;
    }

private:
    static HWY_INLINE Pack<T> at(const T* from) { return Pack<T>::load(from); }

    static constexpr double kFar = 1e30; ///< [m]
    /// Distance between rows in memory. The distance is larger than kCapacity, because rows with a distance
    /// of 4096 bytes would delay loads.
    static constexpr uint32_t kPitch = kCapacity + kLanes;

    uint32_t size_ = 0;
    alignas(64) T d_[3][kPitch];
    alignas(64) T u_[3][kPitch];
    alignas(64) T r_[kPitch];
    alignas(64) T mass_[kPitch];
};

} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
