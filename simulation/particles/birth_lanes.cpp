#include "simulation/particles/birth_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/birth_lanes.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/motion/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {
namespace {

struct WidePair
{
    Words low;
    Words high;
};

/// The 64-bit products of all lanes by one factor.
HWY_INLINE WidePair multiplyWide(Words a, uint32_t factor)
{
#if HWY_TARGET == HWY_SCALAR
    const uint64_t product = uint64_t(factor) * hn::GetLane(a);
    return {hn::Set(kWords, uint32_t(product)), hn::Set(kWords, uint32_t(product >> 32))};
#else
    const Words f = hn::Set(kWords, factor);
    const auto even = hn::MulEven(a, f);
    const hn::RepartitionToWide<WordTag> wide;
    const auto odd = hn::MulEven(hn::BitCast(kWords, hn::ShiftRight<32>(hn::BitCast(wide, a))), f);
    return {hn::OddEven(hn::BitCast(kWords, hn::ShiftLeft<32>(odd)), hn::BitCast(kWords, even)),
            hn::OddEven(hn::BitCast(kWords, odd), hn::BitCast(kWords, hn::ShiftRight<32>(even)))};
#endif
}

void drawUnitsLanes(const BirthTile& tile, uint64_t seed, uint32_t solver, uint32_t purpose,
                    float (*out)[kTileRows])
{
    for (uint32_t i = 0; i < tile.count; i += kWidth) {
        Words c0 = hn::Load(kWords, tile.indexLow + i);
        Words c1 = hn::Load(kWords, tile.indexHigh + i);
        Words c2 = hn::Set(kWords, solver);
        Words c3 = hn::Set(kWords, purpose);
        Words k0 = tile.seedsDiffer ? hn::Load(kWords, tile.seedLow + i) : hn::Set(kWords, uint32_t(seed));
        Words k1 =
            tile.seedsDiffer ? hn::Load(kWords, tile.seedHigh + i) : hn::Set(kWords, uint32_t(seed >> 32));
        for (int round = 0; round < 10; ++round) { // philox4x32-10
            const WidePair p0 = multiplyWide(c0, 0xD2511F53u);
            const WidePair p1 = multiplyWide(c2, 0xCD9E8D57u);
            c0 = hn::Xor(hn::Xor(p1.high, c1), k0);
            c2 = hn::Xor(hn::Xor(p0.high, c3), k1);
            c1 = p1.low;
            c3 = p0.low;
            k0 = hn::Add(k0, hn::Set(kWords, 0x9E3779B9u));
            k1 = hn::Add(k1, hn::Set(kWords, 0xBB67AE85u));
        }
        hn::Store(unitFloats(c0), kFloats, out[0] + i);
        hn::Store(unitFloats(c1), kFloats, out[1] + i);
        hn::Store(unitFloats(c2), kFloats, out[2] + i);
        hn::Store(unitFloats(c3), kFloats, out[3] + i);
    }
}

HWY_INLINE Floats cubeRoot(Floats u)
{
    const auto bits = hn::ConvertTo(kFloats, hn::BitCast(kInts, u)) * all(0.33333333f);
    Floats y = hn::BitCast(kFloats, hn::Add(hn::ConvertTo(kInts, bits), hn::Set(kInts, 709921077)));
    for (int i = 0; i < 2; ++i) {
        const Floats cube = y * y * y;
        y = y * ((cube + u + u) / (cube + cube + u)); // (2)
    }
    return hn::IfThenElseZero(hn::Gt(u, all(0.0f)), y);
}

/// (1) of birth-shapes.
HWY_INLINE void storeCone(Floats u1, Floats u2, float cosLimit, BirthTile& tile, uint32_t i)
{
    const Floats cosine = all(1.0f) - u1 * all(1.0f - cosLimit);
    const Floats sine = hn::Sqrt(hn::Max((all(1.0f) - cosine) * (all(1.0f) + cosine), hn::Zero(kFloats)));
    const SinCosLanes azimuth = sinCosTurns(u2);
    hn::Store(sine * azimuth.cos, kFloats, tile.direction[0] + i);
    hn::Store(cosine, kFloats, tile.direction[1] + i);
    hn::Store(sine * azimuth.sin, kFloats, tile.direction[2] + i);
}

HWY_INLINE void storeBall(float radius, BirthTile& tile, uint32_t i)
{
    storeCone(hn::Load(kFloats, tile.u[0] + i), hn::Load(kFloats, tile.u[1] + i), -1.0f, tile, i);
    const Floats r = all(radius) * cubeRoot(hn::Load(kFloats, tile.u[2] + i));
    for (int a = 0; a < 3; ++a)
        hn::Store(r * hn::Load(kFloats, tile.direction[a] + i), kFloats, tile.position[a] + i);
}

HWY_INLINE void storeBox(const glm::vec3& size, BirthTile& tile, uint32_t i)
{
    for (int a = 0; a < 3; ++a) {
        const Floats u = hn::Load(kFloats, tile.u[a] + i);
        hn::Store(all(size[a]) * (u + u - all(1.0f)), kFloats, tile.position[a] + i);
        hn::Store(all(a == 1 ? 1.0f : 0.0f), kFloats, tile.direction[a] + i);
    }
}

HWY_INLINE void storeDisc(float radius, BirthTile& tile, uint32_t i)
{
    const SinCosLanes azimuth = sinCosTurns(hn::Load(kFloats, tile.u[0] + i));
    const Floats r = all(radius) * hn::Sqrt(hn::Load(kFloats, tile.u[1] + i));
    hn::Store(r * azimuth.cos, kFloats, tile.position[0] + i);
    hn::Store(hn::Zero(kFloats), kFloats, tile.position[1] + i);
    hn::Store(r * azimuth.sin, kFloats, tile.position[2] + i);
}

void sampleShapeLanes(LaneShape shape, const glm::vec3& size, float cosLimit, BirthTile& tile)
{
    for (uint32_t i = 0; i < tile.count; i += kWidth) {
        if (shape == LaneShape::Ball) {
            storeBall(size.x, tile, i);
            continue;
        }
        if (shape == LaneShape::Box) {
            storeBox(size, tile, i);
            continue;
        }
        if (shape == LaneShape::Cone)
            storeDisc(size.x, tile, i);
        else
            for (int a = 0; a < 3; ++a)
                hn::Store(hn::Zero(kFloats), kFloats, tile.position[a] + i);
        storeCone(hn::Load(kFloats, tile.heading[0] + i), hn::Load(kFloats, tile.heading[1] + i), cosLimit,
                  tile, i);
    }
}

} // namespace
} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace particles {
namespace {
HWY_EXPORT(drawUnitsLanes);
HWY_EXPORT(sampleShapeLanes);
} // namespace
} // namespace particles

void drawUnits(const BirthTile& tile, uint64_t seed, uint32_t solver, uint32_t purpose,
               float (*out)[kTileRows])
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(drawUnitsLanes)(tile, seed, solver, purpose, out);
}

void sampleShape(LaneShape shape, const glm::vec3& size, float cosLimit, BirthTile& tile)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(sampleShapeLanes)(shape, size, cosLimit, tile);
}

} // namespace fx::sim
#endif
