/// @file processor_tile.h
/// Tiles of blocks as shaders/blocks/ draws and looks them up, computed on the processor from the formulas
/// that the shaders are compiled from.
#pragma once

#include "rendering/blocks/block_contents.h"
#include "rendering/blocks/block_directions.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace fx::cli {

inline constexpr int kPlanes = 8;
using Planes = std::array<float, kPlanes + 1>; ///< [1] depth up to each plane; 0 up to the first

/// As RGBA16F stores it.
inline float toHalf(float x)
{
    int exponent = 0;
    const float share = std::frexp(std::min(x, 60000.0f), &exponent);
    const int bits = std::min(11, exponent + 24); // below 2^-13 the steps stay
    return std::ldexp(std::nearbyint(std::ldexp(share, bits)), exponent - bits);
}

/// A ray from the eye at the origin.
struct BlockRay
{
    glm::vec3 direction; ///< unit vector
    glm::vec3 toCenter;  ///< [m] of the block, whose radius is `radius`
    float radius = 1.0f; ///< [m]
};

struct TileForm
{
    float nearness = 0.0f; ///< [1] radius over the distance of the eye of the tile; 0: its rays are parallel
    bool isHalf = true;    ///< false: values are stored as float
    bool isForInterpolation = true; ///< false: the depth at the texel itself
    float middle = 0.0f;            ///< [radius] depth of the middle of the content
};

/// shaders/blocks/block_tiles.comp.glsl and block_chord.glsl.
class ProcessorTile
{
public:
    /// @param balls must stay valid
    ProcessorTile(std::span<const render::BlockBall> balls, const render::TileAxes& axes, float radius,
                  int size, const TileForm& form = {})
        : form_(form), balls_(balls), axes_(axes), radius_(radius),
          half_(radius / std::sqrt(1.0f - form.nearness * form.nearness)), size_(size),
          texels_(size_t(size) * size_t(size))
    {}

    int size() const { return size_; }
    /// Computed when it is first read.
    const Planes& texel(int x, int y) const
    {
        std::optional<Planes>& found = texels_[size_t(y) * size_t(size_) + size_t(x)];
        if (!found)
            found = texelAt(glm::vec2(float(x), float(y)));
        return *found;
    }

    /// Depth between two places [m] of a ray.
    double depth(const BlockRay& ray, float t0, float t1) const
    {
        const float perLength = std::max(glm::dot(ray.direction, axes_.along), 0.1f);
        const float middle = glm::dot(ray.toCenter, axes_.along) / perLength;
        float center = form_.middle, sum = 0.0f;
        const auto placeAt = [&](float depth) {
            const float t = middle + depth * ray.radius / perLength;
            return placeOf((t * ray.direction - ray.toCenter) / ray.radius, depth);
        };
        Planes found = lookedUp(placeAt(center));
        for (int k = 1; k < kPlanes; ++k)
            sum += found[size_t(k)];
        if (found[kPlanes] > 0.0f)
            center = std::clamp(1.0f - (sum + 0.5f * found[kPlanes]) * 0.25f / found[kPlanes], -1.0f, 1.0f);
        const glm::vec2 at = placeAt(center);
        found = lookedUp(at);
        const glm::vec2 slope = at * form_.nearness * (half_ / radius_);
        const float longer =
            std::sqrt(1.0f + glm::dot(slope, slope)) * perLength; // ray of the tile over this one
        const float start = middle - ray.radius / perLength, perPlane = 4.0f * perLength / ray.radius;
        const auto passed = [&](float t) {
            const float place = (t - start) * perPlane;
            float share = 0.0f;
            for (int k = 0; k < kPlanes; ++k)
                share += (found[size_t(k) + 1] - found[size_t(k)]) * std::clamp(place - float(k), 0.0f, 1.0f);
            return share;
        };
        return found[kPlanes] > 0.0f ? double((passed(t1) - passed(t0)) / longer) : 0.0;
    }

private:
    /// @param place [texel]
    Planes texelAt(const glm::vec2& place) const
    {
        const float texel = 2.0f * half_ / float(size_ - 1), perDistance = form_.nearness / radius_;
        const glm::vec2 p = place * texel - half_;
        const glm::vec3 direction = glm::normalize(glm::vec3(p * perDistance, 1.0f));
        Planes sum{};
        for (const render::BlockBall& ball : balls_) {
            const glm::vec3 center(ball.place);
            const float radius = std::max(ball.place.w, texel);
            const glm::vec3 away(glm::dot(center, axes_.right) - p.x, glm::dot(center, axes_.up) - p.y,
                                 glm::dot(center, axes_.along));
            const float nearest = glm::dot(away, direction);
            const glm::vec3 d = away - nearest * direction;
            const float s = glm::dot(d, d) / (radius * radius);
            if (s >= 1.0f)
                continue;
            const float q = std::sqrt(1.0f - s), spacing = texel * (1.0f + away.z * perDistance) / radius;
            // q^5 - texel^2 / 12 times its Laplacian, 15 q s - 10 q^3
            const float twelfth = form_.isForInterpolation ? std::min(spacing * spacing, 0.5f) / 12.0f : 0.0f;
            const float depth = 1.11408460164327f * ball.medium.w / (radius * radius) *
                                (q * q * q * q * q - twelfth * (15.0f * q * s - 10.0f * q * q * q));
            for (int k = 1; k <= kPlanes; ++k) {
                const float plane = radius_ * (0.25f * float(k) - 1.0f) / direction.z - nearest;
                sum[size_t(k)] += depth * formula::fxKernelPassed(
                                              std::clamp(plane / (radius * std::max(q, 1e-6f)), -1.0f, 1.0f));
            }
        }
        for (float& value : sum)
            value = form_.isHalf ? toHalf(value) : value;
        return sum;
    }

    /// Place [1] in the tile, -1..1, of a point [radius] at a depth [radius].
    glm::vec2 placeOf(const glm::vec3& p, float depth) const
    {
        const glm::vec2 across(glm::dot(p, axes_.right), glm::dot(p, axes_.up));
        return glm::clamp(across * (radius_ / half_) / std::max(1.0f + depth * form_.nearness, 0.1f), -1.0f,
                          1.0f);
    }

    /// Bilinear. @param p as of placeOf()
    Planes lookedUp(const glm::vec2& p) const
    {
        const float x = (0.5f + 0.5f * p.x) * float(size_ - 1), y = (0.5f + 0.5f * p.y) * float(size_ - 1);
        const int x0 = std::min(int(x), size_ - 2), y0 = std::min(int(y), size_ - 2);
        const float u = x - float(x0), v = y - float(y0);
        Planes mixed{};
        for (size_t k = 0; k < mixed.size(); ++k)
            mixed[k] = (1.0f - v) * ((1.0f - u) * texel(x0, y0)[k] + u * texel(x0 + 1, y0)[k]) +
                       v * ((1.0f - u) * texel(x0, y0 + 1)[k] + u * texel(x0 + 1, y0 + 1)[k]);
        return mixed;
    }

    TileForm form_;
    std::span<const render::BlockBall> balls_;
    render::TileAxes axes_;
    float radius_; ///< [m]
    float half_;   ///< [m] half the side
    int size_;
    mutable std::vector<std::optional<Planes>> texels_;
};

} // namespace fx::cli
