/// @file ball_lanes-inl.h
/// Intersection of rays and balls with SIMD vectors; all tests of rays against balls use this code. The file
/// is included once for each instruction set. Operations are not fused, so all instruction sets give the same
/// bits.
#if defined(FX_BALL_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_BALL_LANES_INL
#undef FX_BALL_LANES_INL
#else
#define FX_BALL_LANES_INL
#endif

#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"
#include "rendering/reference/trace/ray_hits.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fx::render::trace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, BallTree::kWidth>;
using FloatVector = hn::Vec<FloatTag>;
using DoubleTag = hn::CappedTag<double, BallTree::kWidth>;
using DoubleVector = hn::Vec<DoubleTag>;
using DoubleMask = hn::Mask<DoubleTag>;
using PlaceTag = hn::Rebind<uint32_t, DoubleTag>;
using PlaceVector = hn::Vec<PlaceTag>;

constexpr uint32_t kLanes =
    HWY_LANES(double) < BallTree::kWidth ? uint32_t(HWY_LANES(double)) : BallTree::kWidth;

HWY_INLINE uint32_t firstBit(uint32_t bits)
{
    return uint32_t(__builtin_ctz(bits));
}

HWY_INLINE uint32_t lastBit(uint32_t bits)
{
    return 31u - uint32_t(__builtin_clz(bits));
}

/// Converts a mask to bits. Bit k belongs to lane k.
template <class Tag>
HWY_INLINE uint32_t bitsOf(Tag tag, hn::Mask<Tag> mask)
{
    uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    return bits[0];
}

/// Converts a mask of doubles to a mask of 32-bit indices.
HWY_INLINE hn::Mask<PlaceTag> placeMask(DoubleMask mask)
{
    uint8_t bits[8] = {};
    hn::StoreMaskBits(DoubleTag(), mask, bits);
    return hn::LoadMaskBits(PlaceTag(), bits);
}

/// Stores the selected lanes contiguously. Memory behind the stored values may be overwritten.
template <class Tag, class T>
HWY_INLINE void storeSelected(Tag tag, hn::Vec<Tag> v, hn::Mask<Tag> selected, T* to)
{
#if HWY_TARGET <= HWY_AVX3 // these targets have an instruction for it
    hn::CompressStore(v, selected, tag, to);
#else // for other targets, Highway would build tables at each call
    alignas(64) T lane[BallTree::kWidth];
    hn::Store(v, tag, lane);
    const uint32_t bits = bitsOf(tag, selected);
    for (uint32_t k = 0; k < kLanes; ++k) {
        *to = lane[k];
        to += bits >> k & 1u;
    }
#endif
}

/// One ball in each lane.
struct Balls
{
    DoubleVector x, y, z, radius;
};

HWY_INLINE Balls loadBalls(const double* x, const double* y, const double* z, const double* radius)
{
    const DoubleTag tag;
    return {hn::LoadU(tag, x), hn::LoadU(tag, y), hn::LoadU(tag, z), hn::LoadU(tag, radius)};
}

/// One ray, copied to every lane.
struct RayLanes
{
    HWY_INLINE explicit RayLanes(const TraceRay& ray)
        : originX(hn::Set(DoubleTag(), ray.origin.x)), originY(hn::Set(DoubleTag(), ray.origin.y)),
          originZ(hn::Set(DoubleTag(), ray.origin.z)), directionX(hn::Set(DoubleTag(), ray.direction.x)),
          directionY(hn::Set(DoubleTag(), ray.direction.y)), directionZ(hn::Set(DoubleTag(), ray.direction.z))
    {}
    DoubleVector originX, originY, originZ;
    DoubleVector directionX, directionY, directionZ;
};

/// Chords of a ray in balls, one in each lane.
struct Chords
{
    DoubleVector nearest; ///< [m] ray parameter of the point nearest to the center
    DoubleVector square;  ///< [m2] square of half the chord; if it is <= 0, the ray misses the ball
};

/// @formula ball-chord
/// Half the chord of a ray through a ball, without cancellation for distant balls.
///
/// symbol   unit   meaning
///   o, d   m, 1   origin and unit direction of the ray
///   c, R   m      center and radius of the ball
///   t_c    m      ray parameter of the point nearest to the center
///   p      m      vector from that point to the center, perpendicular to the ray
///   h2     m2     square of half the chord, positive if the ray meets the ball
/// @derivation
///   t_c = (c - o) . d                                                                          (1)
///   p = (c - o) - t_c d                                                                        (2)
///   h2 = R^2 - p . p                                                                           (3)
/// @source    [HAG19] the perpendicular vector is computed before it is squared
/// @deviation without the square root, because integrators use the square
/// @valid     |d| = 1 within rounding; R < 1e150
/// @accuracy  |error of h2| <= 8 eps (|c - o| R + R^2) with eps = 2^-53, while |c - o|^2 - t_c^2 would
///            have an error of eps |c - o|^2; all instruction sets give the same bits
/// @tests     tests/rendering/reference/trace/test_ball_tree.cpp
HWY_INLINE Chords chordsOf(const Balls& balls, const RayLanes& ray)
{
    const DoubleVector x = hn::Sub(balls.x, ray.originX);
    const DoubleVector y = hn::Sub(balls.y, ray.originY);
    const DoubleVector z = hn::Sub(balls.z, ray.originZ);
    Chords chords;
    chords.nearest = hn::Add(hn::Add(hn::Mul(x, ray.directionX), hn::Mul(y, ray.directionY)),
                             hn::Mul(z, ray.directionZ));                        // (1)
    const DoubleVector px = hn::Sub(x, hn::Mul(chords.nearest, ray.directionX)); // (2)
    const DoubleVector py = hn::Sub(y, hn::Mul(chords.nearest, ray.directionY));
    const DoubleVector pz = hn::Sub(z, hn::Mul(chords.nearest, ray.directionZ));
    const DoubleVector across = hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz));
    chords.square = hn::Sub(hn::Mul(balls.radius, balls.radius), across); // (3)
    return chords;
}

/// Appends the balls that the infinite line of the ray meets. `out` must have room for a whole vector.
HWY_INLINE void appendHits(const Balls& balls, PlaceVector places, const RayLanes& ray, RayHits& out)
{
    const DoubleTag tag;
    const Chords chords = chordsOf(balls, ray);
    const DoubleMask met = hn::And(hn::Gt(chords.square, hn::Zero(tag)), hn::Gt(balls.radius, hn::Zero(tag)));
    const size_t size = out.size();
    storeSelected(tag, chords.nearest, met, out.nearest.data() + size);
    storeSelected(tag, chords.square, met, out.chordSquare.data() + size);
    storeSelected(PlaceTag(), places, placeMask(met), out.place.data() + size);
    out.setSize(size + hn::CountTrue(tag, met));
}

/// Removes the hits that are completely outside of [begin, end].
inline void cutHits(double begin, double end, RayHits& io)
{
    size_t kept = 0;
    for (size_t i = 0; i < io.size(); ++i) {
        const double leave = io.nearest[i] + (io.nearest[i] - io.enter[i]);
        if (!(leave > begin && io.enter[i] < end))
            continue;
        io.enter[kept] = io.enter[i];
        io.nearest[kept] = io.nearest[i];
        io.chordSquare[kept] = io.chordSquare[i];
        io.place[kept++] = io.place[i];
    }
    io.setSize(kept);
}

/// Computes the entry points of hits, and removes hits that lie completely before `begin` or after `end`.
///
HWY_INLINE void finishHits(double begin, double end, RayHits& io)
{
    const DoubleTag tag;
    const size_t size = io.size();
    for (size_t k = size; k < size + RayHits::kSlack; ++k) { // vector stores after the last hit stay inside
        io.nearest[k] = begin;
        io.chordSquare[k] = 1.0;
    }
    DoubleMask inside = hn::Eq(hn::Zero(tag), hn::Zero(tag));
    const DoubleVector first = hn::Set(tag, begin);
    const DoubleVector last = hn::Set(tag, end);
    for (size_t i = 0; i < size; i += kLanes) {
        const DoubleVector nearest = hn::LoadU(tag, io.nearest.data() + i);
        const DoubleVector half = hn::Sqrt(hn::LoadU(tag, io.chordSquare.data() + i));
        const DoubleVector enter = hn::Sub(nearest, half);
        hn::StoreU(enter, tag, io.enter.data() + i);
        inside = hn::And(
            inside, hn::And(hn::Gt(hn::Add(nearest, hn::Sub(nearest, enter)), first), hn::Lt(enter, last)));
    }
    if (!hn::AllTrue(tag, inside))
        cutHits(begin, end, io);
}

} // namespace fx::render::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
