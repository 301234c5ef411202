#include "simulation/motion/curl_noise.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/motion/curl_noise_lanes.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/particles/lanes-inl.h"

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

/// Adds what one corner of the cell contributes to the slopes of the three potentials.
HWY_INLINE void addCorner(const CurlNoise::Parts& parts, const AxisLanes* axes, uint32_t bits,
                          Floats slope[3][3])
{
    const uint32_t b[3] = {bits & 1u, (bits >> 1) & 1u, bits >> 2};
    const auto at = [&](uint32_t a, uint32_t factor) HWY_ATTR {
        return hn::Mul(hn::Add(axes[a].cell, hn::Set(kWords, b[a])), hn::Set(kWords, factor));
    };
    const Words h =
        hn::Add(hn::Add(hn::Add(hn::Set(kWords, parts.seed), at(0, 0x8DA6B343u)), at(1, 0xD8163841u)),
                at(2, 0xCB1AB31Fu));
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
    const Floats c = hn::GatherIndex(kFloats, parts.cosine, place);
    const Floats s = hn::GatherIndex(kFloats, parts.sine, place);
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
    for (uint32_t i = 0; i < count; i += kWidth) {
        const Floats scale = all(parts.perScale);
        const AxisLanes axes[3] = {AxisLanes(hn::Load(kFloats, position[0] + i) * scale),
                                   AxisLanes(hn::Load(kFloats, position[1] + i) * scale),
                                   AxisLanes(hn::Load(kFloats, position[2] + i) * scale)};
        const Floats zero = hn::Zero(kFloats);
        Floats slope[3][3] = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
        for (uint32_t bits = 0; bits < 8; ++bits)
            addCorner(parts, axes, bits, slope);
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
