#include "rendering/reference/path/blob_path_medium.h"

#include "rendering/reference/path/blob_depth_walk.h"
#include "rendering/reference/trace/ray_query.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace fx::render {

namespace {

constexpr double kMargin = 1.0 + 1e-12; ///< of majorants against rounding
constexpr double kMaxAnisotropy = 0.999;
constexpr double kFaint =
    0.1; ///< share of what other lights make of white smoke, below which glow is left to chance
constexpr double kGlowChance = 0.3;      ///< times the illuminance of the glow over that of other lights
constexpr double kMinProbability = 0.05; ///< of looking for glow

/// A ball whose chord contains the current segment.
struct MetBall
{
    double nearest, chord2; ///< [m], [m2]
    uint32_t place;
};

class BlobWalk final : public MediumWalk
{
public:
    explicit BlobWalk(const BlobPathMedium& medium)
        : medium_(medium), isDetailed_(medium.details().isGiven()), mix_(medium.details()),
          bounds_(medium.details())
    {}

    void start(const TraceRay& ray, double begin, double end) override
    {
        ray_ = ray;
        findHits(medium_.tree(), ray, begin, end, hits_);
        hits_.sort();
        met_.clear();
        entered_ = 0;
        at_ = begin;
        end_ = end;
    }

    bool next(MajorantSegment& out) override
    {
        while (at_ < end_) {
            std::erase_if(met_, [&](const MetBall& ball) { return exitOf(ball) <= at_; });
            if (met_.empty()) {
                if (entered_ == hits_.size())
                    return false;
                at_ = std::max(at_, hits_.enter[entered_]);
            }
            for (; entered_ < hits_.size() && hits_.enter[entered_] <= at_; ++entered_) {
                const MetBall ball{hits_.nearest[entered_], hits_.chordSquare[entered_],
                                   hits_.place[entered_]};
                if (exitOf(ball) > at_)
                    met_.push_back(ball);
            }
            double to = entered_ < hits_.size() ? std::min(hits_.enter[entered_], end_) : end_;
            for (const MetBall& ball : met_)
                to = std::min(to, exitOf(ball));
            if (met_.empty() || !(to > at_))
                continue;
            out = {at_, to, majorantOf(at_, to)};
            at_ = to;
            if (out.majorant > 0.0)
                return true;
        }
        return false;
    }

    MediumPoint at(double parameter, double choice) override
    {
        MediumPoint point;
        double scattered = 0.0;
        if (isDetailed_)
            look(parameter);
        for (const MetBall& ball : met_) {
            const BlobPathMedium::Substance& substance = medium_.substance(ball.place);
            const double extinction = leftOf(ball, substance, parameter);
            point.extinction += extinction;
            point.scattering += extinction * albedoOf(ball, substance);
            point.emission +=
                extinction * (isDetailed_ ? mix_.source(ball.place, substance.source, substance.albedo)
                                          : substance.source);
            scattered += extinction * strength(ball, substance);
        }
        if (met_.empty())
            return point;
        point.phase = medium_.substance(met_.front().place).phase;
        if (!medium_.hasOnePhase() && scattered > 0.0)
            choose(parameter, choice * scattered, scattered, point);
        return point;
    }

    bool opticalDepth(const TraceRay& ray, double begin, double end, glm::dvec3& out) override
    {
        if (isDetailed_)
            return false;
        findHits(medium_.tree(), ray, begin, end, depthHits_);
        double depth = 0.0;
        for (size_t i = 0; i < depthHits_.size(); ++i) {
            const BlobPathMedium::Substance& substance = medium_.substance(depthHits_.place[i]);
            const double half = std::sqrt(depthHits_.chordSquare[i]);
            const double from = std::clamp((begin - depthHits_.nearest[i]) / half, -1.0, 1.0);
            const double to = std::clamp((end - depthHits_.nearest[i]) / half, -1.0, 1.0);
            const double chord = depthHits_.chordSquare[i] * substance.inverseRadius2;
            depth += substance.extinction * chord * chord * half * (kernelTo(to) - kernelTo(from));
        }
        out = glm::dvec3(std::max(0.0, depth));
        return true;
    }

private:
    /// Integral of (1 - u^2)^2 from 0 to u.
    static double kernelTo(double u)
    {
        const double u2 = u * u;
        return u * (1.0 - u2 * (2.0 / 3.0 - 0.2 * u2));
    }
    static double exitOf(const MetBall& ball) { return ball.nearest + std::sqrt(ball.chord2); }
    /// At the place of the last look().
    glm::dvec3 albedoOf(const MetBall& ball, const BlobPathMedium::Substance& substance) const
    {
        return isDetailed_ ? mix_.albedo(ball.place, substance.albedo) : substance.albedo;
    }
    double strength(const MetBall& ball, const BlobPathMedium::Substance& substance) const
    {
        const glm::dvec3 albedo = albedoOf(ball, substance);
        return albedo.x + albedo.y + albedo.z;
    }
    static double extinctionOf(const MetBall& ball, const BlobPathMedium::Substance& substance,
                               double parameter)
    {
        const double along = parameter - ball.nearest;
        const double q = std::max(0.0, ball.chord2 - along * along) * substance.inverseRadius2;
        return substance.extinction * q * q; // (1)
    }
    /// With what detail leaves of it at the place of the last look().
    double leftOf(const MetBall& ball, const BlobPathMedium::Substance& substance, double parameter) const
    {
        const double extinction = extinctionOf(ball, substance, parameter);
        return isDetailed_ ? extinction * mix_.share(ball.place) : extinction;
    }
    void look(double parameter)
    {
        mix_.clear();
        for (const MetBall& ball : met_)
            mix_.add(ball.place, extinctionOf(ball, medium_.substance(ball.place), parameter));
        mix_.finish(ray_.origin + ray_.direction * parameter);
    }
    double majorantOf(double from, double to)
    {
        double sum = 0.0;
        bounds_.clear();
        for (const MetBall& ball : met_) {
            const double most =
                extinctionOf(ball, medium_.substance(ball.place), std::clamp(ball.nearest, from, to)); // (2)
            sum += most;                                                                               // (3)
            if (isDetailed_)
                bounds_.add(ball.place, most);
        }
        return kMargin * (isDetailed_ ? bounds_.maxErodedExtinction() : sum); // (4)
    }
    void choose(double parameter, double chosen, double scattered, MediumPoint& io) const
    {
        for (const MetBall& ball : met_) {
            const BlobPathMedium::Substance& substance = medium_.substance(ball.place);
            const double extinction = leftOf(ball, substance, parameter);
            const double share = extinction * strength(ball, substance);
            if (chosen < share) {
                io.scattering = extinction * albedoOf(ball, substance) * (scattered / share);
                io.phase = substance.phase;
                return;
            }
            chosen -= share;
        }
    }

    const BlobPathMedium& medium_;
    const bool isDetailed_;
    DetailMix mix_, bounds_;
    TraceRay ray_{};
    RayHits hits_, depthHits_;
    std::vector<MetBall> met_;
    size_t entered_ = 0; ///< of `hits_`, those that the ray has met so far
    double at_ = 0.0, end_ = 0.0;
};

/// [sr] of the directions that meet a ball; all of them from inside of it.
double solidAngleOf(const glm::dvec3& toCenter, double radius)
{
    const double sine2 = radius * radius / glm::dot(toCenter, toCenter);
    // without cancellation for what is far
    return sine2 < 1.0 ? 2.0 * std::numbers::pi * sine2 / (1.0 + std::sqrt(1.0 - sine2))
                       : 4.0 * std::numbers::pi;
}

} // namespace

BlobPathMedium::BlobPathMedium(std::span<const MediumBlob> blobs, const glm::dvec3& eye,
                               base::TaskRunner& tasks, double illuminance, const MediumDetails& details,
                               const PixelWidth& pixel)
{
    std::vector<TraceBall> balls;
    balls.reserve(blobs.size());
    for (const MediumBlob& blob : blobs)
        balls.push_back({blob.center, blob.radius});
    tree_.build(balls, eye, tasks);
    details_ = DetailedMedium(details, tree_, eye, pixel);
    substances_.resize(tree_.leaves().size() * BallTree::kWidth);
    for (uint32_t place = 0; place < tree_.count(); ++place) {
        const MediumBlob& blob = blobs[tree_.ballAt(place)];
        const double r = blob.radius;
        const double g = std::clamp(blob.anisotropy, -kMaxAnisotropy, kMaxAnisotropy);
        substances_[place] = {105.0 * blob.crossSection / (32.0 * std::numbers::pi * r * r * r),
                              1.0 / (r * r), blob.albedo, blob.source, PhaseFunction::henyeyGreenstein(g)};
        hasOnePhase_ &= substances_[place].phase == substances_[0].phase;
    }
    findGlow(blobs, illuminance);
}

void BlobPathMedium::findGlow(std::span<const MediumBlob> blobs, double illuminance)
{
    const double darkest = kFaint * illuminance / (4.0 * std::numbers::pi);
    double sum = 0.0, squares = 0.0;
    for (uint32_t place = 0; place < tree_.count(); ++place) {
        const glm::dvec3& source = substances_[place].source;
        const double intensity = std::max({source.x, source.y, source.z}) >= darkest
                                     ? blobs[tree_.ballAt(place)].crossSection * power(place)
                                     : 0.0;
        sum += intensity;
        squares += intensity * (glm::dot(center(place), center(place)) + radius(place) * radius(place));
        glowCenter_ += intensity * center(place);
        shines_.push_back(sum);
    }
    if (!(sum > 0.0)) {
        shines_.clear();
        return;
    }
    for (double& share : shines_)
        share /= sum;
    glowCenter_ /= sum;
    glowRadius2_ = std::max(0.0, squares / sum - glm::dot(glowCenter_, glowCenter_));
    glowIntensity_ = sum / (3.0 * illuminance); // infinite without other lights
}

double BlobPathMedium::emissionChance(const glm::dvec3& position) const
{
    if (!shines())
        return 0.0;
    const glm::dvec3 away = position - glowCenter_;
    return std::clamp(kGlowChance * glowIntensity_ / (glm::dot(away, away) + glowRadius2_), kMinProbability,
                      1.0);
}

std::unique_ptr<MediumWalk> BlobPathMedium::walk() const
{
    return std::make_unique<BlobWalk>(*this);
}

std::unique_ptr<DepthWalk> BlobPathMedium::depthWalk() const
{
    return details_.isGiven() ? nullptr : std::make_unique<BlobDepthWalk>(*this);
}

glm::dvec3 BlobPathMedium::emissionDirection(const glm::dvec3& position, const std::array<double, 3>& u) const
{
    const auto chosen = std::upper_bound(shines_.begin(), shines_.end() - 1, u[0]);
    const uint32_t place = uint32_t(chosen - shines_.begin());
    const glm::dvec3 toCenter = center(place) - position;
    const double solidAngle = solidAngleOf(toCenter, radius(place));
    const double cosine = 1.0 - u[1] * solidAngle / (2.0 * std::numbers::pi);
    const double distance = glm::length(toCenter);
    const glm::dvec3 axis = distance > 0.0 ? toCenter / distance : glm::dvec3(0.0, 1.0, 0.0);
    return PhaseFunction::around(axis, cosine, u[2]);
}

double BlobPathMedium::emissionDensity(uint32_t place, const glm::dvec3& position) const
{
    const double probability = shines_[place] - (place > 0 ? shines_[place - 1] : 0.0);
    return probability > 0.0 ? probability / solidAngleOf(center(place) - position, radius(place)) : 0.0;
}

double BlobPathMedium::majorant() const
{
    constexpr int kCells = 32; // along each axis
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (uint32_t place = 0; place < tree_.count(); ++place) {
        low = glm::min(low, center(place) - radius(place));
        high = glm::max(high, center(place) + radius(place));
    }
    const glm::dvec3 cell = (high - low) / double(kCells);
    std::vector<double> sums(tree_.count() > 0 ? kCells * kCells * kCells : 1, 0.0);
    for (uint32_t place = 0; place < tree_.count(); ++place) {
        const glm::dvec3 middle = center(place) - low;
        const glm::ivec3 first = glm::max(glm::ivec3((middle - radius(place)) / cell), 0);
        const glm::ivec3 last = glm::min(glm::ivec3((middle + radius(place)) / cell), kCells - 1);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const glm::dvec3 corner = glm::dvec3(x, y, z) * cell;
                    const glm::dvec3 away = middle - glm::clamp(middle, corner, corner + cell);
                    const double q = 1.0 - glm::dot(away, away) * substances_[place].inverseRadius2;
                    if (q > 0.0)
                        sums[size_t((z * kCells + y) * kCells + x)] += substances_[place].extinction * q * q;
                }
    }
    double gain = 1.0;
    for (size_t group = 0; group < details_.groupCount(); ++group)
        gain = std::max(gain, details_.mostGain(group));
    const double voxels = details_.isGiven() ? details_.largestOfVolumes() : 0.0;
    return (*std::max_element(sums.begin(), sums.end()) * gain + voxels) * (1.0 + 1e-9);
}

} // namespace fx::render
