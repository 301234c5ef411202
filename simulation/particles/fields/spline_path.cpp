#include "simulation/particles/fields/spline_path.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {
constexpr size_t kPieces = 32; // of a segment
}

SplinePath::SplinePath(std::span<const glm::vec3> points, bool isClosed)
{
    const auto n = ptrdiff_t(points.size());
    const auto point = [&](ptrdiff_t i) {
        if (isClosed)
            return glm::dvec3(points[size_t((i + n) % n)]);
        if (i < 0)
            return 2.0 * glm::dvec3(points[0]) - glm::dvec3(points[1]);
        if (i >= n)
            return 2.0 * glm::dvec3(points[size_t(n - 1)]) - glm::dvec3(points[size_t(n - 2)]);
        return glm::dvec3(points[size_t(i)]);
    };
    for (ptrdiff_t i = 0; i < (isClosed ? n : n - 1); ++i) {
        const glm::dvec3 p0 = point(i - 1), p1 = point(i), p2 = point(i + 1), p3 = point(i + 2);
        segments_.push_back({{p1, 0.5 * (p2 - p0), 0.5 * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3),
                              0.5 * (3.0 * (p1 - p2) + p3 - p0)}}); // (1)
    }
    length_.push_back(0.0);
    for (size_t segment = 0; segment < segments(); ++segment)
        for (size_t k = 0; k < kPieces; ++k)
            length_.push_back(length_.back() +
                              pieceLength(segment, double(k) / kPieces, double(k + 1) / kPieces));
}

double SplinePath::speed(size_t segment, double s) const
{
    const glm::dvec3* c = segments_[segment].c;
    return glm::length(c[1] + s * (2.0 * c[2] + s * (3.0 * c[3])));
}

double SplinePath::pieceLength(size_t segment, double from, double to) const
{
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const double offset = half * 0.5773502691896258;
    return half * (speed(segment, middle - offset) + speed(segment, middle + offset)); // (2)
}

SplinePath::Place SplinePath::at(float u) const
{
    const double wanted = std::clamp(double(u), 0.0, 1.0) * length();
    const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, wanted);
    const size_t piece = size_t(above - length_.begin()) - 1;
    const size_t segment = piece / kPieces;
    const double begin = double(piece % kPieces) / kPieces;
    const double full = length_[piece + 1] - length_[piece], part = wanted - length_[piece];
    double s = begin + (full > 0.0 ? part / full : 0.0) / kPieces;
    const double rate = speed(segment, s);
    if (rate > 0.0)
        s = std::clamp(s - (pieceLength(segment, begin, s) - part) / rate, begin,
                       begin + 1.0 / kPieces); // (3)

    const glm::dvec3* c = segments_[segment].c;
    const glm::dvec3 position = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
    const glm::dvec3 slope = c[1] + s * (2.0 * c[2] + s * (3.0 * c[3]));
    const double size = glm::length(slope);
    return {glm::vec3(position), size > 0.0 ? glm::vec3(slope / size) : glm::vec3(0.0f, 1.0f, 0.0f)};
}

} // namespace fx::sim
