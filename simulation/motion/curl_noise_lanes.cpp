#include "simulation/motion/curl_noise.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/motion/curl_noise_lanes.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/motion/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {
namespace {

HWY_INLINE Words mix(Words x)
{
    x = hn::Mul(hn::Xor(x, hn::ShiftRight<16>(x)), hn::Set(kWords, 0x85EBCA6Bu));
    x = hn::Mul(hn::Xor(x, hn::ShiftRight<13>(x)), hn::Set(kWords, 0xC2B2AE35u));
    return hn::Xor(x, hn::ShiftRight<16>(x));
}

/// Where positions lie on one axis of the lattice.
struct AxisLanes
{
    Words cell;
    Floats f;
    Floats fade[2];
    Floats slope[2];

    explicit HWY_INLINE AxisLanes(Floats p)
    {
        const Floats high = hn::IfThenElse(hn::Lt(p, all(1e9f)), p, all(1e9f));
        const Floats bounded = hn::IfThenElse(hn::Gt(p, all(-1e9f)), high, all(-1e9f));
        const Floats low = hn::Floor(bounded);
        f = bounded - low;
        const Floats s = f * f * f * (f * (f * all(6.0f) - all(15.0f)) + all(10.0f));
        const Floats ds = all(30.0f) * f * f * (f * (f - all(2.0f)) + all(1.0f));
        fade[0] = all(1.0f) - s;
        fade[1] = s;
        slope[0] = hn::Neg(ds);
        slope[1] = ds;
        cell = hn::BitCast(kWords, hn::ConvertTo(kInts, low));
    }
};

/// A component from the lowest ten bits.
HWY_INLINE Floats componentOf(Words bits)
{
    const Words ten = hn::And(bits, hn::Set(kWords, 1023u));
    return hn::ConvertTo(kFloats, hn::BitCast(kInts, ten)) * all(2.0f / 1023.0f) - all(1.0f);
}

/// Products of lattice coordinates for the hash of the cell's two borders on one axis.
struct BorderLanes
{
    Words product[2];

    HWY_INLINE BorderLanes(Words cell, uint32_t factor)
    {
        product[0] = hn::Mul(cell, hn::Set(kWords, factor));
        product[1] = hn::Add(product[0], hn::Set(kWords, factor)); // (cell + 1) factor, modulo 2^32
    }
};

/// A table of 16 numbers, in registers where they are wide.
class PhaseTable
{
public:
    explicit HWY_INLINE PhaseTable(const float* table) : table_(table)
    {
        low_ = hn::LoadU(kFloats, table);
        if constexpr (kWidth == 8)
            high_ = hn::LoadU(kFloats, table + 8);
    }
    HWY_INLINE Floats at(hn::Vec<IntTag> place) const
    {
#if HWY_TARGET != HWY_SCALAR
        if constexpr (kWidth == 16)
            return hn::TableLookupLanes(low_, hn::IndicesFromVec(kFloats, place));
        if constexpr (kWidth == 8) {
            const auto within = hn::IndicesFromVec(kFloats, hn::And(place, hn::Set(kInts, 7)));
            const Which isHigh = hn::RebindMask(kFloats, hn::Gt(place, hn::Set(kInts, 7)));
            return hn::IfThenElse(isHigh, hn::TableLookupLanes(high_, within),
                                  hn::TableLookupLanes(low_, within));
        }
#endif
        return hn::GatherIndex(kFloats, table_, place);
    }

private:
    const float* table_;
    Floats low_;
    Floats high_ = hn::Zero(kFloats);
};

/// Adds what one corner of the cell contributes to the slopes of the three potentials.
HWY_INLINE void addCorner(uint32_t seed, const PhaseTable& cosine, const PhaseTable& sine,
                          const AxisLanes* axes, const BorderLanes* borders, uint32_t bits,
                          Floats slope[3][3])
{
    const uint32_t b[3] = {bits & 1u, (bits >> 1) & 1u, bits >> 2};
    const Words h =
        hn::Add(hn::Add(hn::Add(hn::Set(kWords, seed), borders[0].product[b[0]]), borders[1].product[b[1]]),
                borders[2].product[b[2]]);
    Words word = mix(h);
    Words phase = hn::ShiftRight<30>(word);
    Floats gradient[3][3];
    for (auto& row : gradient) {
        word = mix(hn::Add(word, hn::Set(kWords, 0x9E3779B9u)));
        row[0] = componentOf(word);
        row[1] = componentOf(hn::ShiftRight<10>(word));
        row[2] = componentOf(hn::ShiftRight<20>(word));
        phase = hn::Add(hn::ShiftLeft<2>(phase), hn::ShiftRight<30>(word));
    }
    const auto place = hn::BitCast(kInts, hn::And(phase, hn::Set(kWords, 15u)));
    const Floats c = cosine.at(place);
    const Floats s = sine.at(place);
    Floats d[3];
    for (uint32_t a = 0; a < 3; ++a)
        d[a] = axes[a].f - all(float(b[a]));
    const Floats fx = axes[0].fade[b[0]], fy = axes[1].fade[b[1]], fz = axes[2].fade[b[2]];
    const Floats w = fx * fy * fz;
    const Floats dw[3] = {axes[0].slope[b[0]] * fy * fz, fx * axes[1].slope[b[1]] * fz,
                          fx * fy * axes[2].slope[b[2]]};
    for (int k = 0; k < 3; ++k) {
        Floats g[3];
        for (int a = 0; a < 3; ++a)
            g[a] = c * gradient[k][a] + s * gradient[(k + 1) % 3][a]; // (4)
        const Floats along = g[0] * d[0] + g[1] * d[1] + g[2] * d[2];
        for (int a = 0; a < 3; ++a)
            slope[k][a] = slope[k][a] + (dw[a] * along + w * g[a]); // (2)
    }
}

void addCurlLanes(const CurlNoise::Parts& parts, const std::array<const float*, 3>& position,
                  const std::array<float*, 3>& velocity, uint32_t count)
{
    const PhaseTable cosine(parts.cosine);
    const PhaseTable sine(parts.sine);
    for (uint32_t i = 0; i < count; i += kWidth) {
        const Floats scale = all(parts.perScale);
        const AxisLanes axes[3] = {AxisLanes(hn::Load(kFloats, position[0] + i) * scale),
                                   AxisLanes(hn::Load(kFloats, position[1] + i) * scale),
                                   AxisLanes(hn::Load(kFloats, position[2] + i) * scale)};
        const BorderLanes borders[3] = {BorderLanes(axes[0].cell, 0x8DA6B343u),
                                        BorderLanes(axes[1].cell, 0xD8163841u),
                                        BorderLanes(axes[2].cell, 0xCB1AB31Fu)};
        const Floats zero = hn::Zero(kFloats);
        Floats slope[3][3] = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
        for (uint32_t bits = 0; bits < 8; ++bits)
            addCorner(parts.seed, cosine, sine, axes, borders, bits, slope);
        const Floats curl[3] = {slope[2][1] - slope[1][2], slope[0][2] - slope[2][0],
                                slope[1][0] - slope[0][1]}; // (3)
        for (size_t a = 0; a < 3; ++a)
            hn::Store(hn::Load(kFloats, velocity[a] + i) + curl[a] * all(parts.gain), kFloats,
                      velocity[a] + i);
    }
}

} // namespace
} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace particles {
namespace {
HWY_EXPORT(addCurlLanes);
} // namespace
} // namespace particles

void CurlNoise::addTo(const std::array<const float*, 3>& position, const std::array<float*, 3>& velocity,
                      uint32_t count) const
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(addCurlLanes)(parts(), position, velocity, count);
}

} // namespace fx::sim
#endif
