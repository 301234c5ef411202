#include "rendering/field_detail/conservation_factor.h"

#include "foundation/math/geometry.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>

namespace fx::render {

namespace {

constexpr int kCells = 16;          ///< along each side of the box of all balls
constexpr float kMaxSets = 1024;    ///< M
constexpr uint32_t kRank = 14;      ///< purpose of lumpHash()
constexpr float kLumpPixels = 5.0f; ///< [pixel] of the largest lumps: those of a fifth of it are half faded

/// Gauss's nodes in r^2: corners of two tetrahedra.
struct Shell
{
    float corner; ///< [radius] over the root of 3
    float weight; ///< [1] of all four
};
constexpr Shell kShells[] = {{0.44424f, 0.37643f}, {-0.24300f, 0.62357f}};
constexpr float kRoot2 = 1.41421356f;
/// Corners of tetrahedra, of length root of 3; those of a set are the negative ones of the set before or
/// after.
constexpr glm::vec3 kSets[][4] = {
    {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
    {{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}},
    {{kRoot2, 1, 0}, {-kRoot2, 1, 0}, {0, -1, kRoot2}, {0, -1, -kRoot2}},
    {{-kRoot2, -1, 0}, {kRoot2, -1, 0}, {0, 1, -kRoot2}, {0, 1, kRoot2}},
};

/// (3)
float weightOf(uint64_t id, size_t set, size_t count)
{
    constexpr auto kCount = float(std::size(kSets));
    const float random = float(lumpHash(uint32_t(id), uint32_t(id >> 32), 0, kRank)) * 0x1.0p-24f;
    const float rank = (float(set) + random) / kCount;
    const float p = kMaxSets / 0.9f / (kCount * float(count));
    return glm::clamp((p - rank) / (0.1f * p), 0.0f, 1.0f);
}

} // namespace

ConservationFactor::ConservationFactor(std::pmr::memory_resource* memory)
    : thinning_(memory), starts_(memory), inCells_(memory)
{}

glm::ivec3 ConservationFactor::cellAt(const Cells& cells, const glm::vec3& point)
{
    const glm::vec3 place = glm::clamp((point - cells.low) / cells.side, 0.0f, float(kCells - 1));
    return glm::ivec3(place);
}

void ConservationFactor::sortIntoCells(std::span<const DetailedCaster> balls)
{
    base::Bounds box;
    for (const DetailedCaster& caster : balls)
        box.add(caster.ball.center, caster.ball.radius);
    cells_.low = box.min;
    cells_.side = glm::max((box.max - box.min) / float(kCells), glm::vec3(1e-30f));
    const auto forCells = [&](const MediumCaster& ball, auto&& use) {
        const glm::ivec3 low = cellAt(cells_, ball.center - ball.radius);
        const glm::ivec3 high = cellAt(cells_, ball.center + ball.radius);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    use(size_t((z * kCells + y) * kCells + x));
    };
    starts_.assign(size_t(kCells) * kCells * kCells + 2, 0);
    for (const DetailedCaster& caster : balls)
        forCells(caster.ball, [this](size_t cell) { ++starts_[cell + 2]; });
    for (size_t i = 2; i < starts_.size(); ++i)
        starts_[i] += starts_[i - 1];
    inCells_.resize(starts_.back());
    for (size_t i = 0; i < balls.size(); ++i)
        forCells(balls[i].ball, [&](size_t cell) { inCells_[starts_[cell + 1]++] = uint32_t(i); });
}

float ConservationFactor::shareAt(const GroupDetail& detail, std::span<const DetailedCaster> balls,
                                  const glm::vec3& point) const
{
    const glm::ivec3 at = cellAt(cells_, point);
    const size_t cell = size_t((at.z * kCells + at.y) * kCells + at.x);
    SmoothMedium sum{0.0f, {glm::vec3(0.0f), glm::vec3(0.0f)}, 0.0f};
    for (size_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
        const DetailedCaster& caster = balls[inCells_[i]];
        const glm::vec3 away = point - caster.ball.center;
        const float own =
            formula::fxKernelExtinction(caster.ball.crossSection, caster.ball.radius, glm::dot(away, away));
        sum.extinction += own;
        sum.thinning += own * thinning_[inCells_[i]];
        for (size_t g = 0; g < 2; ++g)
            sum.place[g] += own * caster.carried[g];
    }
    const float perExtinction = 1.0f / std::max(sum.extinction, 1e-30f);
    sum.thinning *= perExtinction;
    for (size_t g = 0; g < 2; ++g) {
        const FieldDetailNumbers::Generation& own = detail.numbers.generations[g];
        const glm::vec3 cells = detail.toCells[g] * point + detail.first[g] + perExtinction * sum.place[g];
        sum.place[g] = own.length * (cells - own.offset);
    }
    sum.extinction *= detail.scale;
    const float pixel = detail.numbers.length() / kLumpPixels;
    return detailAt(detail.numbers, sharedLumpTile(), sum, pixel, kMaxDetailOctaves).share;
}

/// The mean of g over a ball.
float ConservationFactor::meanShare(const GroupDetail& detail, std::span<const DetailedCaster> balls,
                                    const MediumCaster& ball, size_t set) const
{
    float mean = 0.0f;
    for (const Shell& shell : kShells)
        for (const glm::vec3& corner : kSets[set])
            mean += 0.25f * shell.weight *
                    shareAt(detail, balls, ball.center + ball.radius * shell.corner * corner);
    return mean;
}

float ConservationFactor::of(const GroupDetail& detail, std::span<const DetailedCaster> balls)
{
    if (!detail.numbers.isConserved)
        return 1.0f;
    thinning_.clear();
    for (const DetailedCaster& caster : balls)
        thinning_.push_back(thinningOf(detail, caster.ball.crossSection, caster.ball.radius));
    sortIntoCells(balls);
    double before = 0, after = 0; // (2)
    for (const DetailedCaster& caster : balls)
        for (size_t set = 0; set < std::size(kSets); ++set) {
            const float weight = weightOf(caster.id, set, balls.size()) * caster.ball.crossSection;
            if (weight == 0.0f)
                break;
            before += double(weight);
            after += double(weight * meanShare(detail, balls, caster.ball, set));
        }
    if (!(after * double(kMax) > before))
        return kMax;
    return std::max(float(before / after), kMin);
}

} // namespace fx::render
