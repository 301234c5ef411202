#include "rendering/reference/path/blob_depth_walk.h"

#include "rendering/reference/trace/ray_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr double kTolerance = 1e-12;
constexpr int kMaxSteps = 100;

/// (1)
double kernelTo(double u)
{
    const double u2 = u * u;
    return u * (1.0 - u2 * (2.0 / 3.0 - 0.2 * u2));
}

double limited(double u)
{
    return std::min(std::max(u, -1.0), 1.0);
}

/// The u between `low` and `high` at which kernelTo() is `k`.
double kernelInverse(double k, double low, double high)
{
    double u = std::clamp(k, low, high);
    for (int step = 0; step < kMaxSteps; ++step) {
        const double off = kernelTo(u) - k;
        if (std::abs(off) <= kTolerance)
            break;
        (off < 0.0 ? low : high) = u;
        const double q = 1.0 - u * u;
        const double newton = u - off / (q * q);
        u = newton > low && newton < high ? newton : 0.5 * (low + high);
    }
    return u;
}

double strength(const BlobPathMedium::Substance& substance)
{
    return substance.albedo.x + substance.albedo.y + substance.albedo.z;
}

} // namespace

double BlobDepthWalk::extinctionOf(const Chord& chord, double parameter)
{
    const double u = limited((parameter - chord.middle) * chord.inverseHalf);
    const double q = 1.0 - u * u;
    return chord.peak * q * q;
}

void BlobDepthWalk::start(const TraceRay& ray, double begin, double end)
{
    // A surface does not change with which density emissionDirection() draws the direction to what is behind
    // it.
    findHits(medium_.tree(), ray, begin, medium_.shines() ? std::numeric_limits<double>::infinity() : end,
             hits_);
    origin_ = ray.origin;
    chords_.resize(hits_.size());
    begin_ = end;
    end_ = begin;
    before_ = 0.0;
    double after = 0.0;
    for (size_t i = 0; i < hits_.size(); ++i) {
        const BlobPathMedium::Substance& substance = medium_.substance(hits_.place[i]);
        const double half = std::sqrt(hits_.chordSquare[i]);
        const double share = hits_.chordSquare[i] * substance.inverseRadius2;
        const double peak = substance.extinction * share * share;
        const Chord chord{hits_.nearest[i], 1.0 / half, peak, peak * half};
        begin_ = std::min(begin_, chord.middle - half);
        end_ = std::max(end_, chord.middle + half);
        before_ += chord.weight * kernelTo(limited((begin - chord.middle) * chord.inverseHalf));
        after += chord.weight * kernelTo(limited((end - chord.middle) * chord.inverseHalf));
        chords_[i] = chord;
    }
    begin_ = std::max(begin_, begin);
    end_ = std::min(end_, end);
    depth_ = std::max(0.0, after - before_);
    findEmission(begin, end);
}

void BlobDepthWalk::findEmission(double begin, double end)
{
    emitted_ = 0.0;
    emittedBy_.resize(medium_.shines() ? hits_.size() : 0);
    for (size_t i = 0; i < emittedBy_.size(); ++i) {
        const Chord& chord = chords_[i];
        const double depth = chord.weight * (kernelTo(limited((end - chord.middle) * chord.inverseHalf)) -
                                             kernelTo(limited((begin - chord.middle) * chord.inverseHalf)));
        emittedBy_[i] = std::max(0.0, depth) * medium_.power(hits_.place[i]);
        emitted_ += emittedBy_[i];
    }
    emissionBegin_ = begin;
    emissionEnd_ = end;
}

double BlobDepthWalk::emissionParameter(double u) const
{
    double chosen = u * emitted_;
    size_t i = 0;
    while (i + 1 < emittedBy_.size() && (chosen >= emittedBy_[i] || !(emittedBy_[i] > 0.0)))
        chosen -= emittedBy_[i++];
    while (i > 0 && !(emittedBy_[i] > 0.0))
        --i; // rounding led beyond the last that emits
    const Chord& chord = chords_[i];
    const double from = limited((emissionBegin_ - chord.middle) * chord.inverseHalf);
    const double to = limited((emissionEnd_ - chord.middle) * chord.inverseHalf);
    const double share = emittedBy_[i] > 0.0 ? std::clamp(chosen / emittedBy_[i], 0.0, 1.0) : 0.5;
    const double k = kernelTo(from) + share * (kernelTo(to) - kernelTo(from));
    return chord.middle + kernelInverse(k, from, to) / chord.inverseHalf;
}

double BlobDepthWalk::emissionDensity() const
{
    double density = 0.0;
    if (medium_.shines())
        for (size_t i = 0; i < hits_.size(); ++i)
            density += medium_.emissionDensity(hits_.place[i], origin_);
    return density * medium_.emissionChance(origin_);
}

double BlobDepthWalk::depthTo(double parameter) const
{
    double sum = 0.0;
    for (const Chord& chord : chords_)
        sum += chord.weight * kernelTo(limited((parameter - chord.middle) * chord.inverseHalf)); // (2)
    return std::clamp(sum - before_, 0.0, depth_);
}

double BlobDepthWalk::parameterAt(double depth) const
{
    double low = begin_, high = end_;
    double t = depth_ > 0.0 ? low + (high - low) * (depth / depth_) : low;
    const double wanted = before_ + depth;
    for (int step = 0; step < kMaxSteps; ++step) {
        double sum = -wanted, slope = 0.0;
        for (const Chord& chord : chords_) {
            const double u = limited((t - chord.middle) * chord.inverseHalf);
            const double u2 = u * u, q = 1.0 - u2;
            sum += chord.weight * (u * (1.0 - u2 * (2.0 / 3.0 - 0.2 * u2))); // (2)
            slope += chord.peak * q * q;                                     // (3)
        }
        if (std::abs(sum) <= kTolerance * (1.0 + depth))
            return t;
        (sum < 0.0 ? low : high) = t;
        const double newton = t - sum / slope; // (4)
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (next <= low || next >= high)
            return t;
        t = next;
    }
    return t;
}

MediumPoint BlobDepthWalk::at(double parameter, double choice) const
{
    MediumPoint point;
    double extinction = 0.0, scattered = 0.0;
    for (size_t i = 0; i < chords_.size(); ++i) {
        const BlobPathMedium::Substance& substance = medium_.substance(hits_.place[i]);
        const double own = extinctionOf(chords_[i], parameter);
        extinction += own;
        point.scattering += own * substance.albedo;
        point.emission += own * substance.source;
        scattered += own * strength(substance);
    }
    point.extinction = glm::dvec3(extinction);
    if (chords_.empty())
        return point;
    point.phase = medium_.substance(hits_.place[0]).phase;
    if (medium_.hasOnePhase() || !(scattered > 0.0))
        return point;
    double chosen = choice * scattered;
    for (size_t i = 0; i < chords_.size(); ++i) {
        const BlobPathMedium::Substance& substance = medium_.substance(hits_.place[i]);
        const double own = extinctionOf(chords_[i], parameter);
        const double share = own * strength(substance);
        if (chosen < share) {
            point.scattering = own * substance.albedo * (scattered / share);
            point.phase = substance.phase;
            break;
        }
        chosen -= share;
    }
    return point;
}

} // namespace fx::render
