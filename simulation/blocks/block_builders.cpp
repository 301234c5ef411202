#include "simulation/blocks/block_builders.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/blocks/block_noise.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

using base::RandomPurpose;
using base::randomUnit4;

constexpr uint32_t kTrials = 256;                  ///< places tried for each lump
constexpr uint64_t kMaxTrials = uint64_t(1) << 21; ///< places tried for all lumps, some tenths of a second
constexpr float kAnvilFoot = 0.72f;                ///< [1] share of the height above which an anvil spreads
constexpr float kFilamentShare = 0.35f;
constexpr float kPlumeFoot = 0.18f; ///< [1] width of a plume at its foot over that at its top

/// A dome: an ellipsoid about the foot of which the part above the foot counts.
struct Tower
{
    glm::vec2 middle;
    float radius, height;
};

/// 1 in the middle, 0 at the outline, negative outside.
float depthInEllipsoid(const glm::vec3& p, const glm::vec3& half)
{
    const glm::vec3 q = p / half;
    return 1.0f - std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
}

float smooth(float t)
{
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// The forms have their foot at the origin, a nebula its middle.
class Form
{
public:
    explicit Form(const BlockBuild& build)
        : build_(build), noise_(build.seed, build.noiseLength, build.octaves)
    {
        if (build.form == BlockForm::Cloud)
            placeTowers();
    }

    /// Box that holds the form with its noise.
    glm::vec3 low() const
    {
        return {-0.5f * width().x, hasFoot() ? 0.0f : -0.5f * width().y, -0.5f * width().z};
    }
    glm::vec3 high() const
    {
        return {0.5f * width().x + std::max(build_.lean, 0.0f), (hasFoot() ? 1.0f : 0.5f) * width().y,
                0.5f * width().z};
    }
    glm::vec3 lowest() const { return low() + glm::vec3(std::min(build_.lean, 0.0f), 0.0f, 0.0f); }

    float depthAt(const glm::vec3& p) const
    {
        const float cut = build_.base * build_.size.y;
        if (hasFoot() && p.y < cut)
            return -1.0f;
        const float bare = bareDepthAt(p);
        return bare < -build_.noise ? bare : std::min(bare + build_.noise * noise_.at(p), 1.0f);
    }

    /// Of a lump. With an exponent of radii, those above a flat foot do not reach far below it; without,
    /// forms stay as they were.
    float radiusAt(const glm::vec3& p, float depth) const
    {
        const float grown = (build_.largest - build_.smallest) * std::min(2.0f * depth, 1.0f);
        const float cut = build_.base * build_.size.y;
        const bool isFlat = build_.radiusExponent > 0.0f && cut > 0.0f;
        return build_.smallest + (isFlat ? std::min(grown, std::max(p.y - cut, 0.0f)) : grown);
    }

private:
    bool hasFoot() const { return build_.form != BlockForm::Nebula; }
    glm::vec3 width() const
    {
        const float spread = 1.0f + build_.noise;
        const float anvil = 1.0f + build_.anvil;
        return build_.size * glm::vec3(spread * anvil, spread, spread * anvil);
    }

    void placeTowers()
    {
        for (uint32_t i = 0; i < build_.towers; ++i) {
            const auto u = randomUnit4(build_.seed, 1, i, RandomPurpose::Attributes);
            const auto place = randomUnit4(build_.seed, 1, i, RandomPurpose::Position);
            Tower tower;
            const float first = i == 0 ? 0.0f : 1.0f; // the highest stands in the middle
            tower.height = build_.size.y * (1.0f - first * (0.25f + 0.55f * u[0]));
            tower.radius = (0.22f + 0.16f * u[1]) * std::min(build_.size.x, build_.size.z);
            const glm::vec2 room =
                glm::max(0.5f * glm::vec2(build_.size.x, build_.size.z) - tower.radius, glm::vec2(0.0f));
            tower.middle = first * room * (2.0f * glm::vec2(place[0], place[1]) - 1.0f);
            towers_.push_back(tower);
        }
    }

    float bareDepthAt(const glm::vec3& p) const
    {
        switch (build_.form) {
        case BlockForm::Cloud:
            return std::max(cloudAt(p), anvilAt(p, 0.0f));
        case BlockForm::Plume:
            return std::max(plumeAt(p), anvilAt(p, build_.lean));
        case BlockForm::DustWall:
            return wallAt(p);
        case BlockForm::Nebula:
            break;
        }
        return nebulaAt(p);
    }

    float cloudAt(const glm::vec3& p) const
    {
        float depth = -1.0f;
        for (const Tower& tower : towers_)
            depth = std::max(depth, depthInEllipsoid({p.x - tower.middle.x, p.y, p.z - tower.middle.y},
                                                     {tower.radius, tower.height, tower.radius}));
        const glm::vec3 flat(0.5f * build_.size.x, 0.3f * build_.size.y, 0.5f * build_.size.z);
        return std::max(depth, depthInEllipsoid(p, flat));
    }

    /// A lens at the top.
    float anvilAt(const glm::vec3& p, float lean) const
    {
        if (!(build_.anvil > 0.0f))
            return -1.0f;
        const float thickness = 0.5f * (1.0f - kAnvilFoot) * build_.size.y;
        const glm::vec3 middle(lean, build_.size.y - thickness, 0.0f);
        const float spread = 0.5f * (1.0f + build_.anvil);
        return depthInEllipsoid(p - middle, {spread * build_.size.x, thickness, spread * build_.size.z});
    }

    float plumeAt(const glm::vec3& p) const
    {
        const float y = p.y / build_.size.y;
        if (y < 0.0f || y > 1.0f)
            return -1.0f;
        const float share = kPlumeFoot + (1.0f - kPlumeFoot) * std::sqrt(y);
        const float end = 1.0f - smooth((y - 0.9f) / 0.1f) * 0.5f;
        const glm::vec2 half = 0.5f * share * end * glm::vec2(build_.size.x, build_.size.z);
        const glm::vec2 q = glm::vec2(p.x - build_.lean * y * y, p.z) / half;
        return 1.0f - std::sqrt(q.x * q.x + q.y * q.y);
    }

    /// The front is as high as the wall; behind it, the height falls to nothing.
    float wallAt(const glm::vec3& p) const
    {
        const float back = std::clamp(0.5f - p.z / build_.size.z, 0.0f, 1.0f); // 0 in front
        const float edge = smooth(back / 0.3f), fall = 1.0f - smooth((back - 0.3f) / 0.7f);
        const float side = smooth(8.0f * (0.5f - std::abs(p.x) / build_.size.x));
        const float height = build_.size.y * std::sqrt(edge) * fall * side;
        return height > 0.0f ? 1.0f - p.y / height : -1.0f;
    }

    /// Where the noise is near 0 there are sheets; two of them meet in filaments.
    float nebulaAt(const glm::vec3& p) const
    {
        const float inside = depthInEllipsoid(p, 0.5f * build_.size);
        if (inside < -build_.noise)
            return -1.0f;
        const float a = noise_.at(p + glm::vec3(17.0f * build_.noiseLength)),
                    b = noise_.at(p - glm::vec3(31.0f * build_.noiseLength));
        return std::min(inside, 1.0f - (std::abs(a) + std::abs(b)) / kFilamentShare);
    }

    const BlockBuild& build_;
    BlockNoise noise_;
    std::vector<Tower> towers_;
};

} // namespace

std::vector<BlockLump> buildLumps(const BlockBuild& build)
{
    const Form form(build);
    std::vector<BlockLump> lumps;
    lumps.reserve(build.count);
    const glm::vec3 low = form.lowest(), high = form.high();
    const uint64_t trials = std::min(uint64_t(build.count) * kTrials, kMaxTrials);
    for (uint64_t trial = 0; trial < trials && lumps.size() < build.count; ++trial) {
        const auto u = randomUnit4(build.seed, 0, trial, RandomPurpose::Position);
        const glm::vec3 place = low + glm::vec3(u[0], u[1], u[2]) * (high - low);
        const float depth = form.depthAt(place);
        if (!(depth > 0.0f))
            continue;
        const float radius = form.radiusAt(place, depth);
        if (build.radiusExponent > 0.0f &&
            double(randomUnit4(build.seed, 0, trial, RandomPurpose::Attributes)[0]) >=
                base::power(double(build.smallest / radius), double(build.radiusExponent)))
            continue;
        lumps.push_back({build.position + place, radius * (0.8f + 0.4f * u[3]), depth});
    }
    return lumps;
}

} // namespace fx::sim
