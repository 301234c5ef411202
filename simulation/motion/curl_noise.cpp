#include "simulation/motion/curl_noise.h"

#include "foundation/math/elementary.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr float kNormalization = 0.812f; // N: makes the root mean square speed 1

/// The finalizer of MurmurHash3: every input bit reaches every output bit.
uint32_t mix(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x85EBCA6Bu;
    x = (x ^ (x >> 13)) * 0xC2B2AE35u;
    return x ^ (x >> 16);
}

/// Where a position lies on one axis of the lattice.
struct Axis
{
    uint32_t cell;
    float f;
    float fade[2];  ///< weight of the lower and the upper corner
    float slope[2]; ///< their derivatives
};

Axis makeAxis(float p)
{
    const float bounded = p > -1e9f ? (p < 1e9f ? p : 1e9f) : -1e9f; // NaN becomes the lower bound
    const float low = std::floor(bounded);
    const float f = bounded - low;
    const float s = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const float ds = 30.0f * f * f * (f * (f - 2.0f) + 1.0f);
    return {uint32_t(int32_t(low)), f, {1.0f - s, s}, {-ds, ds}};
}

/// The random numbers of a lattice point.
struct Corner
{
    glm::vec3 gradient[3];
    uint32_t phase;
};

Corner makeCorner(uint32_t seed, uint32_t x, uint32_t y, uint32_t z)
{
    const uint32_t h = seed + x * 0x8DA6B343u + y * 0xD8163841u + z * 0xCB1AB31Fu;
    Corner corner;
    uint32_t word = mix(h);
    corner.phase = word >> 30;
    for (int k = 0; k < 3; ++k) {
        word = mix(word + 0x9E3779B9u);
        corner.gradient[k] = {float(word & 1023u), float((word >> 10) & 1023u), float((word >> 20) & 1023u)};
        corner.gradient[k] = corner.gradient[k] * (2.0f / 1023.0f) - 1.0f;
        corner.phase = corner.phase * 4 + (word >> 30);
    }
    return corner;
}

} // namespace

CurlNoise::CurlNoise(uint32_t seed, float strength, float scale, double turns)
    : seed_(seed), strength_(strength > 0.0f ? strength : 0.0f), perScale_(1.0f / std::max(scale, 1e-6f))
{
    for (uint32_t k = 0; k < kPhases; ++k) {
        const base::SinCos phase = base::sinCosTurns(turns + double(k) / kPhases);
        cosine_[k] = float(phase.cos);
        sine_[k] = float(phase.sin);
    }
}

CurlNoise::Parts CurlNoise::parts() const
{
    return {seed_, kNormalization * strength_, perScale_, cosine_.data(), sine_.data()};
}

glm::vec3 CurlNoise::velocity(const glm::vec3& position) const
{
    const Axis x = makeAxis(position.x * perScale_);
    const Axis y = makeAxis(position.y * perScale_);
    const Axis z = makeAxis(position.z * perScale_);
    glm::vec3 slope[3] = {glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)}; // of the three potentials
    for (uint32_t bits = 0; bits < 8; ++bits) {
        const uint32_t bx = bits & 1u;
        const uint32_t by = (bits >> 1) & 1u;
        const uint32_t bz = bits >> 2;
        const Corner corner = makeCorner(seed_, x.cell + bx, y.cell + by, z.cell + bz);
        const float c = cosine_[corner.phase % kPhases];
        const float s = sine_[corner.phase % kPhases];
        const glm::vec3 d(x.f - float(bx), y.f - float(by), z.f - float(bz));
        const float w = x.fade[bx] * y.fade[by] * z.fade[bz];
        const glm::vec3 dw(x.slope[bx] * y.fade[by] * z.fade[bz], x.fade[bx] * y.slope[by] * z.fade[bz],
                           x.fade[bx] * y.fade[by] * z.slope[bz]);
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 g = c * corner.gradient[k] + s * corner.gradient[(k + 1) % 3]; // (4)
            const float along = g.x * d.x + g.y * d.y + g.z * d.z;
            slope[k] += dw * along + w * g; // (2)
        }
    }
    const glm::vec3 curl(slope[2].y - slope[1].z, slope[0].z - slope[2].x, slope[1].x - slope[0].y); // (3)
    return curl * (kNormalization * strength_);
}

} // namespace fx::sim
