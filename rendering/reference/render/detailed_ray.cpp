#include "rendering/reference/render/detailed_ray.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr int kDeepest = 20;               ///< halvings of a first piece
constexpr double kMinTransmittance = 1e-3; ///< [1] transmittance, for the error of the optical depth
constexpr double kThickest = 0.5;          ///< [1] optical depth of half a piece
constexpr double kDark = 1e-9;             ///< [1] transmittance behind which nothing is seen
constexpr double kPerLump = 8.0;           ///< first pieces of the length of a lump
constexpr double kSlight = 0.01;           ///< of the tolerance: blobs of less optical depth need no piece
constexpr double kMaxPieces = 4096.0;      ///< first ones

double simpson(double a, double m, double b, double length)
{
    return length / 6.0 * (a + 4.0 * m + b); // (1)
}

double largest(const glm::dvec3& v)
{
    return std::max({v.x, v.y, v.z});
}

} // namespace

void DetailedRay::Sent::add(const Sent& other, double weight)
{
    light += weight * other.light;
    coverage += weight * other.coverage;
    for (size_t layer = 0; layer < scattered.size(); ++layer)
        scattered[layer] += weight * other.scattered[layer];
    moment += weight * other.moment;
    seen += weight * other.seen;
}

DetailedRay::DetailedRay(const MediumView& medium, Wanted wanted, double tolerance)
    : medium_(medium), wanted_(wanted), tolerance_(tolerance), mix_(medium.details())
{}

void DetailedRay::look(double parameter)
{
    mix_.clear();
    for (size_t i = 0; i < chords_.size(); ++i)
        if (const double extinction = chords_[i].extinction(parameter); extinction > 0.0)
            mix_.add(hits_->place[i], extinction);
    mix_.finish(ray_.origin + ray_.direction * parameter);
}

DetailedRay::Sample DetailedRay::at(double t)
{
    look(t);
    Sample sample;
    sample.t = t;
    for (size_t i = 0; i < chords_.size(); ++i) {
        const uint32_t place = hits_->place[i];
        const double extinction = chords_[i].extinction(t) * mix_.share(place);
        if (!(extinction > 0.0))
            continue;
        sample.extinction += extinction;
        if (wanted_ == Wanted::Depth)
            continue;
        const auto& source = medium_.blob(place).source;
        const MediumView::Scattering& scattering = medium_.scattering(place);
        const auto& coverage = medium_.coverage(place);
        sample.sent.light +=
            extinction * mix_.source(place, {source[0], source[1], source[2]}, glm::dvec3(scattering.albedo));
        sample.sent.coverage += extinction * glm::dvec3(coverage[0], coverage[1], coverage[2]);
        if (medium_.scatters(scattering.layer))
            sample.sent.scattered[size_t(scattering.layer)] +=
                extinction * glm::dvec3(medium_.scattered(place));
    }
    sample.sent.seen = sample.extinction;
    sample.sent.moment = sample.extinction * t;
    return sample;
}

DetailedRay::Span DetailedRay::extent(double begin, double end) const
{
    const double none = std::numeric_limits<double>::infinity();
    Span span{none, -none};
    for (const BlobChord& chord : chords_) {
        span.begin = std::min(span.begin, chord.nearest - chord.half);
        span.end = std::max(span.end, chord.nearest + chord.half);
    }
    return {std::max(span.begin, begin), std::min(span.end, end)};
}

/// Length of the first piece that begins at t.
double DetailedRay::step(double t, double end) const
{
    double step = end - t;
    const double least = step / kMaxPieces;
    for (size_t i = 0; i < chords_.size(); ++i) {
        const BlobChord& chord = chords_[i];
        const double enter = chord.nearest - chord.half;
        if (!(chord.peak * chord.half > kSlight * tolerance_) || chord.nearest + chord.half <= t)
            continue;
        double longest = chord.half;
        if (const int32_t group = medium_.details().groupOf(hits_->place[i]); group >= 0)
            longest = std::min(longest, medium_.details().lumpSize(size_t(group)) / kPerLump);
        if (enter <= t)
            step = std::min(step, longest);
        else if (enter < t + step && longest < step)
            step = std::max(enter - t, std::min(longest, step));
    }
    return std::max(step, least);
}

void DetailedRay::trace(const TraceRay& ray, const RayHits& hits, double begin, double end)
{
    ray_ = ray;
    hits_ = &hits;
    chords_.clear();
    for (size_t i = 0; i < hits.size(); ++i)
        chords_.emplace_back(medium_.blob(hits.place[i]), hits, i);
    samples_.clear();
    pieces_.clear();
    depth_ = brightest_ = 0.0;
    sent_ = {};
    const Span span = extent(begin, end);
    if (!(span.end > span.begin))
        return;
    perLength_ = 1.0 / (span.end - span.begin);
    samples_.push_back(at(span.begin));
    double depth = 0.0;
    while (samples_.back().t < span.end) {
        const double t = samples_.back().t;
        const double next = t + step(t, span.end);
        if (!(next > t))
            break;
        const double to = next < span.end ? next : span.end;
        samples_.push_back(at(0.5 * (t + to)));
        samples_.push_back(at(to));
        const Sample* const last = samples_.data() + samples_.size() - 3;
        const glm::dvec3 light =
            (to - t) / 6.0 * (last[0].sent.light + 4.0 * last[1].sent.light + last[2].sent.light);
        brightest_ += std::exp(-depth) * largest(light);
        depth += simpson(last[0].extinction, last[1].extinction, last[2].extinction, to - t);
    }
    for (size_t i = 0; i + 2 < samples_.size(); i += 2)
        refine(samples_[i], samples_[i + 1], samples_[i + 2], 0);
}

void DetailedRay::refine(const Sample& a, const Sample& m, const Sample& b, int level)
{
    const Sample p = at(0.5 * (a.t + m.t)), q = at(0.5 * (m.t + b.t));
    const double length = b.t - a.t, half = 0.5 * length;
    const double first = simpson(a.extinction, p.extinction, m.extinction, half);
    const double second = simpson(m.extinction, q.extinction, b.extinction, half);
    const double whole = simpson(a.extinction, m.extinction, b.extinction, length);
    // halves minus whole, by the weights of the five samples
    const glm::dvec3 light =
        length / 12.0 *
        glm::abs(4.0 * (p.sent.light + q.sent.light) - a.sent.light - b.sent.light - 6.0 * m.sent.light);
    const double passing = std::exp(-depth_), allowed = tolerance_ * std::sqrt(length * perLength_);
    const bool isExact =
        std::abs(first + second - whole) * std::max(passing, kMinTransmittance) <= allowed &&
        passing * largest(light) <= allowed * brightest_ &&                                    // (2)
        (std::max(first, second) <= kThickest || passing < kDark || wanted_ == Wanted::Depth); // (3)
    if (isExact || level == kDeepest) {
        close(a, p, m);
        close(m, q, b);
        return;
    }
    refine(a, p, m, level + 1);
    refine(m, q, b, level + 1);
}

void DetailedRay::close(const Sample& a, const Sample& m, const Sample& b)
{
    const double length = b.t - a.t;
    const double own = simpson(a.extinction, m.extinction, b.extinction, length);
    const double half =
        std::clamp(length / 24.0 * (5.0 * a.extinction + 8.0 * m.extinction - b.extinction), 0.0, own); // (4)
    pieces_.push_back({a.t, b.t, a.extinction, m.extinction, b.extinction, depth_});
    if (wanted_ == Wanted::Light) {
        sent_.add(a.sent, length / 6.0 * std::exp(-depth_));
        sent_.add(m.sent, length / 1.5 * std::exp(-depth_ - half));
        sent_.add(b.sent, length / 6.0 * std::exp(-depth_ - own));
    }
    depth_ += own;
}

double DetailedRay::distance() const
{
    return sent_.seen > 0.0 ? sent_.moment / sent_.seen : std::numeric_limits<double>::infinity();
}

double DetailedRay::depthTo(double t) const
{
    if (pieces_.empty() || t <= pieces_.front().begin)
        return 0.0;
    if (t >= pieces_.back().end)
        return depth_;
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                        [](double at, const Piece& piece) { return at < piece.begin; });
    const Piece& p = *(after - 1);
    const double length = p.end - p.begin, x = (t - p.begin) / length;
    const double slope = 4.0 * p.mid - 3.0 * p.first - p.last, bend = 2.0 * (p.first + p.last) - 4.0 * p.mid;
    const double own = length * x * (p.first + x * (0.5 * slope + x * bend / 3.0)); // (4)
    return p.before + std::max(own, 0.0);
}

} // namespace fx::render
