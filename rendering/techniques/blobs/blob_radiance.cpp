#include "rendering/techniques/blobs/blob_radiance.h"

#include "foundation/math/bits.h"
#include "foundation/snapshot/blob_kind.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/field_detail/lump_tile.h"
#include "rendering/optics/black_body.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace fx::render {

namespace {

namespace column = base::blob_column;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kLines = 96.0f;           ///< M
constexpr size_t kMaxHits = 192;          ///< balls on a line; of more the rest is left out
constexpr int kSteps = 24;                ///< of a line
constexpr int kOctaves = 3;               ///< of the detail
constexpr float kLumpPixels = 16.0f;      ///< [pixel] of the largest lumps
constexpr float kRamp = 0.1f;             ///< [1] of the chance of a ball, over which its line comes and goes
constexpr float kGolden = 2.39996323f;    ///< [rad] the golden angle
constexpr float kWien = 14388.0f / 0.58f; ///< [K] second radiation constant over 580 nm
constexpr glm::vec3 kFrequencies{580.0f / 611.0f, 1.056f,
                                 1.25f}; ///< [1] of the primaries over that of 580 nm
constexpr uint32_t kPurpose = 21;        ///< of lumpHash()

float brightnessOf(const glm::vec3& light)
{
    return light.x + light.y + light.z;
}

/// A ball on a line.
struct Hit
{
    float middle, half, distance2; ///< [m], [m], [m2] of the line's way through it
    float crossSection, radius;
    glm::vec3 source;
    float albedo, temperature, thinning;
    std::array<glm::vec3, 2> carried;
};

/// Lines through one group.
class Lines
{
public:
    Lines(const base::FrameSnapshot& snapshot, size_t group)
        : group_(snapshot.group(group)), blobs_({&snapshot, nullptr}, group, 1.0f)
    {
        if (blobs_.isGiven())
            detail_ = blobs_.groupDetail({});
        balls_.reserve(group_.count());
        for (size_t i = 0; i < group_.count(); ++i) {
            balls_.push_back({blobSource(group_, i), 0.0f});
            balls_.back().weight = weightOf(i);
            total_ += double(weight(i));
        }
    }

    glm::vec3 intensity();

private:
    float at(size_t index, size_t ball) const { return group_.column(index)[ball]; }
    glm::vec3 position(size_t i) const
    {
        return {at(column::PositionX, i), at(column::PositionY, i), at(column::PositionZ, i)};
    }
    float random(size_t ball, uint32_t number) const
    {
        const uint64_t id = group_.ids()[ball];
        return float(lumpHash(uint32_t(id), uint32_t(id >> 32), number, kPurpose)) * 0x1.0p-24f;
    }
    /// [cd] A B of a ball, 0 for one that is not drawn.
    float weight(size_t i) const { return balls_[i].weight; }
    float weightOf(size_t i) const
    {
        const float section = at(column::CrossSection, i), radius = at(column::Radius, i);
        const float w = section > 0.0f && base::isFinite(section) && radius > 0.0f
                            ? blobArea(section, radius) * brightnessOf(balls_[i].source)
                            : 0.0f;
        return base::isFinite(w) && base::isFinite(glm::dot(position(i), position(i))) ? w : 0.0f;
    }
    /// Finds the balls on a line. @return [1/m2] D of (3)
    double find(const glm::vec3& foot, const glm::vec3& way);
    Hit hit(size_t ball) const;
    glm::vec3 radiance(float jitter) const;

    const base::SnapshotGroup& group_;
    BlobDetail blobs_;
    GroupDetail detail_;
    /// What all lines need of a ball: a black body is computed once, not again for each line that meets it.
    struct Ball
    {
        glm::vec3 source; ///< [cd/m2]
        float weight;     ///< [cd]
    };
    /// Memory that is kept from call to call, so that steady frames allocate nothing.
    static std::vector<Ball>& kept()
    {
        thread_local std::vector<Ball> balls;
        balls.clear();
        return balls;
    }
    std::vector<Ball>& balls_ = kept();
    double total_ = 0.0; ///< [cd] W
    glm::vec3 foot_{0.0f}, way_{0.0f};
    std::array<Hit, kMaxHits> hits_;
    size_t hitCount_ = 0;
};

Hit Lines::hit(size_t i) const
{
    Hit h{};
    h.crossSection = at(column::CrossSection, i);
    h.radius = at(column::Radius, i);
    h.source = balls_[i].source;
    h.albedo = (at(column::AlbedoR, i) + at(column::AlbedoG, i) + at(column::AlbedoB, i)) / 3.0f;
    h.temperature = at(column::Temperature, i);
    if (blobs_.isGiven()) {
        h.thinning = thinningOf(detail_, h.crossSection, h.radius);
        h.carried = blobs_.carried(i, i, false, position(i));
    }
    return h;
}

double Lines::find(const glm::vec3& foot, const glm::vec3& way)
{
    foot_ = foot;
    way_ = way;
    hitCount_ = 0;
    double density = 0.0;
    const std::span<const float> x = group_.column(column::PositionX), y = group_.column(column::PositionY),
                                 z = group_.column(column::PositionZ), r = group_.column(column::Radius);
    for (size_t i = 0; i < group_.count(); ++i) {
        const glm::vec3 away = glm::vec3(x[i], y[i], z[i]) - foot;
        const float middle = glm::dot(away, way), distance2 = glm::dot(away, away) - middle * middle;
        const float half2 = r[i] * r[i] - distance2;
        const float section = at(column::CrossSection, i);
        if (!(half2 > 0.0f && section > 0.0f && base::isFinite(section)))
            continue;
        density += double(weight(i) / (kPi * r[i] * r[i]));
        if (hitCount_ == kMaxHits)
            continue;
        Hit& h = hits_[hitCount_++];
        h = hit(i);
        h.middle = middle;
        h.half = std::sqrt(half2);
        h.distance2 = std::max(distance2, 0.0f);
    }
    return density / total_;
}

glm::vec3 Lines::radiance(float jitter) const
{
    float begin = 1e30f, end = -1e30f;
    for (const Hit& h : std::span(hits_).first(hitCount_)) {
        begin = std::min(begin, h.middle - h.half);
        end = std::max(end, h.middle + h.half);
    }
    const float step = (end - begin) / float(kSteps);
    glm::vec3 forth(0.0f), back(0.0f);
    float through = 1.0f, depth = 0.0f, plain = 0.0f;
    for (int n = 0; n < kSteps; ++n) {
        const float t = begin + (float(n) + jitter) * step;
        SmoothMedium sum{0.0f, {glm::vec3(0.0f), glm::vec3(0.0f)}, 0.0f};
        glm::vec3 emitted(0.0f);
        float scattered = 0.0f, heat = 0.0f;
        for (const Hit& h : std::span(hits_).first(hitCount_)) {
            const float along = t - h.middle;
            if (std::abs(along) >= h.half)
                continue;
            const float own =
                formula::fxKernelExtinction(h.crossSection, h.radius, h.distance2 + along * along);
            sum.extinction += own;
            sum.thinning += own * h.thinning;
            for (size_t g = 0; g < 2; ++g)
                sum.place[g] += own * h.carried[g];
            emitted += own * h.source;
            scattered += own * h.albedo;
            heat += own * brightnessOf(h.source) * h.temperature;
        }
        if (!(sum.extinction > 0.0f))
            continue;
        const float inverse = 1.0f / sum.extinction;
        glm::vec3 source = emitted * inverse;
        const float albedo = std::min(scattered * inverse, 0.99f);
        float extinction = sum.extinction;
        if (blobs_.isGiven() && detail_.numbers.isGiven()) {
            sum.thinning *= inverse;
            const glm::vec3 point = foot_ + t * way_;
            for (size_t g = 0; g < 2; ++g) {
                const FieldDetailNumbers::Generation& own = detail_.numbers.generations[g];
                sum.place[g] = own.length * (detail_.toCells[g] * point + detail_.first[g] +
                                             inverse * sum.place[g] - own.offset);
            }
            const MediumDetail detail = detailAt(detail_.numbers, sharedLumpTile(), sum,
                                                 detail_.numbers.length() / kLumpPixels, kOctaves);
            extinction *= detail.share;
            if (heat > 0.0f)
                source *= glm::pow(glm::vec3(detail.temperature),
                                   kFrequencies * (kWien * brightnessOf(emitted) / heat));
        }
        const float lost = std::sqrt(1.0f - albedo);
        const float tau = extinction * lost * step, left = std::exp(-tau);
        const glm::vec3 sent = source / lost * (1.0f - left); // (5)
        forth += through * sent;
        back = back * left + sent;
        through *= left;
        depth += tau;
        plain += tau * lost;
    }
    const float lost = depth > 0.0f ? plain / depth : 1.0f;
    return 0.5f * (forth + back) * (1.0f + (1.0f - through) * (1.0f - lost) / (1.0f + lost)); // (6)
}

glm::vec3 Lines::intensity()
{
    glm::dvec3 sum(0.0);
    double all = 0.0;
    for (size_t i = 0; i < group_.count(); ++i) {
        const float mean = kLines * float(double(weight(i)) / std::max(total_, 1e-30));
        const float count = std::max(std::ceil(mean), 1.0f);
        const float rare =
            glm::clamp((mean - random(i, 0)) / (kRamp * mean), 0.0f, 1.0f) / (1.0f - 0.5f * kRamp);
        const float share = mean >= 1.0f ? mean / count : rare;
        if (!(share > 0.0f))
            continue;
        for (uint32_t k = 0; k < uint32_t(count); ++k) {
            const float z = 1.0f - 2.0f * std::fmod((float(k) + 0.5f) / count + random(i, 1), 1.0f);
            const float turn = kGolden * float(k) + 2.0f * kPi * random(i, 2),
                        across = std::sqrt(1.0f - z * z);
            const glm::vec3 way(across * std::cos(turn), z, across * std::sin(turn));
            const glm::vec3 first = glm::normalize(
                glm::cross(std::abs(way.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), way));
            const glm::vec3 second = glm::cross(way, first);
            // multiples of the golden ratio spread evenly however many there are
            const float part = std::fmod(0.61803399f * (float(k) + 0.5f) + random(i, 3), 1.0f);
            const float angle = 2.0f * kPi * random(i, 4 + 2 * k);
            const float out = at(column::Radius, i) * std::sqrt(part);
            const double density =
                find(position(i) + out * (std::cos(angle) * first + std::sin(angle) * second), way);
            if (density > 0.0)
                sum += double(share) / density * glm::dvec3(radiance(random(i, 5 + 2 * k))); // (3)
            all += double(share);
        }
    }
    return all > 0.0 ? glm::vec3(sum / all) : glm::vec3(0.0f); // (4)
}

} // namespace

glm::vec3 blobSource(const base::SnapshotGroup& group, size_t i)
{
    const auto c = [&](size_t index) { return group.column(index)[i]; };
    const glm::vec3 albedo(c(column::AlbedoR), c(column::AlbedoG), c(column::AlbedoB));
    const glm::vec3 own(c(column::EmissionR), c(column::EmissionG), c(column::EmissionB));
    return (1.0f - albedo) * base::tintOf(group.constants()) * blackBodyLuminance(c(column::Temperature)) +
           own;
}

float blobArea(float crossSection, float radius)
{
    // Gauss's rule of four points
    constexpr float kPower[] = {0.0012703f, 0.0625628f, 0.3674275f, 0.8353538f}; // u^2.5
    constexpr float kWeight[] = {0.1739274f, 0.3260726f, 0.3260726f, 0.1739274f};
    const float disc = kPi * radius * radius;
    float seen = 0.0f;
    for (size_t k = 0; k < 4; ++k)
        seen -= kWeight[k] * std::expm1(-3.5f * kPower[k] * crossSection / disc);
    return disc * seen; // (1)
}

glm::vec3 blobIntensity(const base::FrameSnapshot& snapshot, size_t group)
{
    return Lines(snapshot, group).intensity();
}

} // namespace fx::render
