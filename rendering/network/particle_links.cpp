#include "rendering/network/particle_links.h"

#include "foundation/math/elementary.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fx::render {

namespace {

constexpr double kLeastDepth = 1e-30; // [1] of a link

/// Where a line meets a particle.
struct Chord
{
    uint32_t line;
    double middle, half; // [m] along the line
    double depth;        // [1] before (1)
};

/// A link before links are sorted.
struct Found
{
    uint32_t line, particle;
    double place; // along the line: number of the segment, or [m]
    double depth;
};

/// Two unit vectors perpendicular to an axis and to each other.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& axis)
{
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, other));
    return {u, glm::cross(axis, u)};
}

std::vector<Chord> chordsOf(const NetworkParticle& particle, const glm::dvec3& place,
                            const ParticleBundle::Space& space)
{
    const double spacing = 2.0 * space.half / space.lines, r = particle.radius;
    const auto number = [&](double at) { return (at + space.half) / spacing - 0.5; }; // of the line there
    const auto nearest = [&](double at) {
        return std::clamp(int(std::lround(number(at))), 0, space.lines - 1);
    };
    std::vector<Chord> chords;
    double sum = 0.0;
    for (int y = std::max(int(std::ceil(number(place.y - r))), 0); y <= number(place.y + r); ++y)
        for (int x = std::max(int(std::ceil(number(place.x - r))), 0); x <= number(place.x + r); ++x) {
            const double dx = (x + 0.5) * spacing - space.half - place.x;
            const double dy = (y + 0.5) * spacing - space.half - place.y;
            const double h = std::sqrt(dx * dx + dy * dy);
            const double depth = formula64::fxKernelOpticalDepth(particle.crossSection, r, h, 0.0, -r, r);
            if (!(depth > 0.0) || x >= space.lines || y >= space.lines)
                continue;
            chords.push_back({uint32_t(y * space.lines + x), place.z, std::sqrt((r - h) * (r + h)), depth});
            sum += depth;
        }
    if (chords.empty()) {
        chords.push_back({uint32_t(nearest(place.y) * space.lines + nearest(place.x)), place.z, r, 1.0});
        sum = 1.0;
    }
    for (Chord& chord : chords)
        chord.depth *= particle.crossSection / (sum * space.area()); // (1)
    return chords;
}

/// Divides the depth of a chord among the segments of its line.
void addSegments(const Chord& chord, uint32_t particle, double length, std::vector<Found>& io)
{
    const double first = std::floor((chord.middle - chord.half) / length);
    const double last = std::floor((chord.middle + chord.half) / length);
    double passed = 0.0;
    for (double k = first; k <= last; ++k) {
        const double u = std::clamp(((k + 1.0) * length - chord.middle) / chord.half, -1.0, 1.0);
        const double next = formula64::fxKernelPassed(u);
        if (next > passed)
            io.push_back({chord.line, particle, k, chord.depth * (next - passed)});
        passed = std::max(next, passed);
    }
}

} // namespace

ParticleBundle::ParticleBundle(std::span<const NetworkParticle> particles, const glm::dvec3& axis,
                               const Space& space)
    : area_(space.area())
{
    static_assert(kBytesOfLink >= sizeof(Found) + sizeof(Link) + sizeof(Segment) + sizeof(uint32_t));
    const auto [u, v] = across(axis);
    std::vector<Found> found;
    for (uint32_t p = 0; p < particles.size(); ++p) {
        const glm::dvec3 offset = particles[p].center - space.center;
        const glm::dvec3 place(glm::dot(offset, u), glm::dot(offset, v), glm::dot(offset, axis));
        for (const Chord& chord : chordsOf(particles[p], place, space))
            if (space.segment > 0.0)
                addSegments(chord, p, space.segment, found);
            else
                found.push_back({chord.line, p, chord.middle, chord.depth}); // (4)
    }
    std::erase_if(found, [](const Found& f) { return f.depth < kLeastDepth; });
    std::ranges::sort(found, {}, [](const Found& f) { return std::tuple(f.line, f.place, f.particle); });
    links_.reserve(found.size());
    for (size_t i = 0; i < found.size();) {
        const size_t first = i;
        double depth = 0.0;
        do {
            links_.push_back({found[i].particle, float(found[i].depth)});
            depth += double(links_.back().depth);
            ++i;
        } while (space.segment > 0.0 && i < found.size() && found[i].line == found[first].line &&
                 found[i].place == found[first].place);
        segments_.push_back(
            {depth, formula64::fxNetworkTaken(depth, base::naturalExp(-depth)), uint32_t(links_.size())});
        if (i == found.size() || found[i].line != found[first].line)
            lineEnds_.push_back(uint32_t(segments_.size()));
    }
    segments_.shrink_to_fit();
    lineEnds_.shrink_to_fit();
}

double ParticleBundle::throughSegment(size_t segment, double radiance, std::span<const float> source,
                                      std::span<double> ioMet) const
{
    const Segment& s = segments_[segment];
    const size_t first = segment > 0 ? segments_[segment - 1].end : 0;
    double emitted = 0.0;
    for (size_t i = first; i < s.end; ++i)
        emitted += double(links_[i].depth) * double(source[links_[i].particle]);
    const double gain = s.taken * (emitted / s.depth - radiance);       // (2)
    const double met = std::max(emitted - gain, 0.0) * area_ / s.depth; // (3)
    for (size_t i = first; i < s.end; ++i)
        ioMet[links_[i].particle] += met * double(links_[i].depth);
    return radiance + gain;
}

ParticleBundle::Ends ParticleBundle::follow(bool forward, std::span<const float> source, double entering,
                                            std::span<double> ioMet) const
{
    Ends ends;
    size_t first = 0;
    for (const uint32_t end : lineEnds_) {
        double radiance = entering;
        if (forward)
            for (size_t s = first; s < end; ++s)
                radiance = throughSegment(s, radiance, source, ioMet);
        else
            for (size_t s = end; s-- > first;)
                radiance = throughSegment(s, radiance, source, ioMet);
        first = end;
        ends.leaving += area_ * radiance;
    }
    ends.entering = area_ * entering * double(lineEnds_.size());
    return ends;
}

size_t ParticleBundle::bytes() const
{
    return lineEnds_.size() * sizeof(uint32_t) + segments_.size() * sizeof(Segment) +
           links_.size() * sizeof(Link);
}

} // namespace fx::render
