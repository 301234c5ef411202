#include "benchmarks/scenes/slice_forms.h"

#include "foundation/random/philox.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fx::cli {

namespace {

using render::MediumCaster;
using render::SliceMapping;
using render::SliceRay;
using render::SliceStack;

constexpr double kBeforeAll = 1e3; // [m] on the way to parallel light
constexpr double kPi = std::numbers::pi;

std::array<float, 4> numbers(uint64_t index, base::RandomPurpose purpose)
{
    return base::randomUnit4(41, 0, index, purpose);
}

/// Point `i` of a sequence in the unit ball; nothing where it falls outside.
bool pointInBall(uint32_t i, base::RandomPurpose purpose, glm::vec3& outPoint)
{
    const auto u = numbers(i, purpose);
    outPoint = glm::vec3(2.0f * u[0] - 1.0f, 2.0f * u[1] - 1.0f, 2.0f * u[2] - 1.0f);
    return glm::dot(outPoint, outPoint) <= 1.0f;
}

/// Even directions.
glm::dvec3 direction(int i, int count)
{
    const double z = 1.0 - 2.0 * (i + 0.5) / count, across = std::sqrt(1.0 - z * z);
    const double turn = kPi * (3.0 - std::sqrt(5.0)) * i;
    return {across * std::cos(turn), across * std::sin(turn), z};
}

/// Where a ray meets a ball.
struct Chord
{
    float h;      ///< [m] from the center to the ray
    float middle; ///< [m] along the ray
    float half;   ///< [m] < 0: it misses
};

Chord chordOf(const SliceRay& ray, const MediumCaster& caster)
{
    const glm::vec3 d = caster.center - ray.start;
    const float middle = glm::dot(d, ray.direction);
    const float h = glm::length(d - middle * ray.direction);
    const float square = (caster.radius - h) * (caster.radius + h);
    return {h, middle, square > 0.0f ? std::sqrt(square) : -1.0f};
}

float depthBetween(const MediumCaster& caster, const Chord& chord, float from, float to)
{
    return formula::fxKernelOpticalDepth(caster.crossSection, caster.radius, chord.h, chord.middle, from, to);
}

float rayBegin(const SliceStack& stack)
{
    return stack.mapping == SliceMapping::Parallel ? -1e30f : stack.begin;
}

void fillPlanes(const SliceStack& stack, const SliceRay& ray, std::span<const MediumCaster> casters,
                SliceColumn& io)
{
    const int last = int(io.values.size()) - 1;
    const float begin = rayBegin(stack);
    for (const MediumCaster& caster : casters) {
        const Chord chord = chordOf(ray, caster);
        if (chord.half < 0.0f)
            continue;
        const auto planeAfter = [&](float t) {
            return std::clamp(int(std::floor((t - io.first) / io.step)) + 1, 0, last);
        };
        for (int k = planeAfter(chord.middle - chord.half); k <= planeAfter(chord.middle + chord.half); ++k)
            io.values[size_t(k)] += depthBetween(
                caster, chord, k > 0 ? std::max(io.first + float(k - 1) * io.step, begin) : begin,
                io.first + float(k) * io.step);
    }
    for (size_t k = 1; k < io.values.size(); ++k)
        io.values[k] += io.values[k - 1];
}

/// First and last depth of the medium.
void placeDeepPlanes(const SliceStack& stack, const SliceRay& ray, std::span<const MediumCaster> casters,
                     SliceColumn& io)
{
    float first = 1e30f, last = -1e30f;
    for (const MediumCaster& caster : casters)
        if (const Chord chord = chordOf(ray, caster); chord.half >= 0.0f) {
            first = std::min(first, chord.middle - chord.half);
            last = std::max(last, chord.middle + chord.half);
        }
    io.first = std::max(first, stack.mapping == SliceMapping::Parallel ? first : stack.begin);
    io.step = std::max((last - io.first) / float(io.values.size() - 1), 1e-6f);
}

/// [1] integral over -1..1 of (1 - u^2)^2 cos(x u), relative to that of x = 0.
double kernelCosine(double x)
{
    if (std::abs(x) < 0.3)
        return 1.0 - x * x / 14.0 + x * x * x * x / 504.0;
    return 15.0 * ((3.0 - x * x) * std::sin(x) - 3.0 * x * std::cos(x)) / (x * x * x * x * x);
}

/// Coefficients of the density on the ray: mean, then pairs of cosine and sine.
void fillFourier(const SliceStack& stack, const SliceRay& ray, std::span<const MediumCaster> casters,
                 SliceColumn& io)
{
    std::vector<double> sums(io.values.size(), 0.0);
    const float begin = rayBegin(stack);
    const auto add = [&](double depth, double at, double spread) {
        sums[0] += 2.0 * depth;
        for (size_t k = 1; 2 * k < sums.size(); ++k) {
            const double turn = 2.0 * kPi * double(k) / double(io.step);
            const double part = 2.0 * depth * kernelCosine(turn * spread);
            sums[2 * k - 1] += part * std::cos(turn * at);
            sums[2 * k] += part * std::sin(turn * at);
        }
    };
    for (const MediumCaster& caster : casters) {
        const Chord chord = chordOf(ray, caster);
        if (chord.half < 0.0f)
            continue;
        if (chord.middle - chord.half >= begin) {
            add(double(depthBetween(caster, chord, begin, 1e30f)), double(chord.middle - io.first),
                double(chord.half));
            continue;
        }
        constexpr int kPieces = 24; // a ball that the light is in: thin pieces
        for (int i = 0; i < kPieces; ++i) {
            const float piece = (chord.middle + chord.half - begin) / kPieces;
            const float from = begin + float(i) * piece;
            if (piece > 0.0f)
                add(double(depthBetween(caster, chord, from, from + piece)),
                    double(from + 0.5f * piece - io.first), 0.0);
        }
    }
    for (size_t i = 0; i < sums.size(); ++i)
        io.values[i] = float(sums[i]);
}

float fourierDepth(const SliceColumn& column, float distance)
{
    const double z = std::clamp(double(distance - column.first) / double(column.step), 0.0, 1.0);
    double depth = 0.5 * double(column.values[0]) * z;
    for (size_t k = 1; 2 * k < column.values.size(); ++k) {
        const double turn = 2.0 * kPi * double(k);
        depth += double(column.values[2 * k - 1]) / turn * std::sin(turn * z) +
                 double(column.values[2 * k]) / turn * (1.0 - std::cos(turn * z));
    }
    return float(std::max(depth, 0.0));
}

} // namespace

std::vector<MediumCaster> lightCloud(uint32_t count, double depth)
{
    std::vector<MediumCaster> casters;
    for (uint32_t i = 0; casters.size() < count; ++i) {
        const float size = numbers(i, base::RandomPurpose::Attributes)[0];
        glm::vec3 place;
        if (pointInBall(i, base::RandomPurpose::Position, place))
            casters.push_back({place, 0.25f + 0.2f * size, 1.0f});
    }
    const double mean = meanDiameter(casters);
    for (MediumCaster& caster : casters)
        caster.crossSection = float(depth / mean);
    return casters;
}

double meanDiameter(std::span<const MediumCaster> casters)
{
    constexpr int kDirections = 64;
    const render::BlobMedium medium = mediumOf(casters);
    double mean = 0.0;
    for (int i = 0; i < kDirections; ++i) {
        const glm::dvec3 d = direction(i, kDirections);
        mean += medium.opticalDepth({-2.0 * d, d}, 0.0, 4.0) / kDirections;
    }
    return mean;
}

std::vector<glm::vec3> pointsWithin(std::span<const MediumCaster> casters, uint32_t count)
{
    std::vector<glm::vec3> points;
    for (uint32_t i = 0; points.size() < count; ++i) {
        const MediumCaster& caster = casters[i % casters.size()];
        glm::vec3 place;
        if (pointInBall(i, base::RandomPurpose::Noise, place))
            points.push_back(caster.center + caster.radius * place);
    }
    return points;
}

render::BlobMedium mediumOf(std::span<const MediumCaster> casters)
{
    std::vector<render::Blob> blobs;
    for (const MediumCaster& caster : casters)
        blobs.push_back(
            {glm::dvec3(caster.center), double(caster.radius), double(caster.crossSection), glm::dvec3(0.0)});
    return render::BlobMedium(std::move(blobs));
}

double shadowRayDepth(const render::BlobMedium& medium, const SliceStack& stack, const glm::vec3& point)
{
    if (stack.mapping == SliceMapping::Parallel) {
        const glm::dvec3 along(stack.along);
        return medium.opticalDepth({glm::dvec3(point) - kBeforeAll * along, along}, 0.0, kBeforeAll);
    }
    const glm::dvec3 d = glm::dvec3(point) - glm::dvec3(stack.origin);
    const double length = glm::length(d);
    if (!(length > double(stack.begin)))
        return 0.0;
    return medium.opticalDepth({glm::dvec3(stack.origin), d / length}, double(stack.begin), length);
}

SliceColumn makeColumn(const SliceForm& form, const SliceStack& stack, const SliceRay& ray,
                       std::span<const MediumCaster> casters)
{
    SliceColumn column;
    column.values.assign(size_t(form.values), 0.0f);
    column.first = stack.first;
    if (form.kind == SliceForm::Kind::Fourier) {
        column.step = stack.spacing * float(stack.resolution.planes - 1);
        fillFourier(stack, ray, casters, column);
        return column;
    }
    column.step = stack.spacing;
    if (form.kind == SliceForm::Kind::Deep)
        placeDeepPlanes(stack, ray, casters, column);
    fillPlanes(stack, ray, casters, column);
    return column;
}

float columnDepth(const SliceForm& form, const SliceColumn& column, float distance)
{
    if (form.kind == SliceForm::Kind::Fourier)
        return fourierDepth(column, distance);
    const int last = int(column.values.size()) - 1;
    const float plane = std::clamp((distance - column.first) / column.step, 0.0f, float(last));
    const int lower = std::min(int(plane), last - 1);
    return glm::mix(column.values[size_t(lower)], column.values[size_t(lower) + 1], plane - float(lower));
}

float SliceField::columnAt(int x, int y, float distance)
{
    const uint64_t key = uint64_t(uint32_t(x)) << 32 | uint64_t(uint32_t(y));
    auto found = columns_.find(key);
    if (found == columns_.end()) {
        const SliceRay ray = render::sliceRay(stack_, float(x) + 0.5f, float(y) + 0.5f);
        found = columns_.emplace(key, makeColumn(form_, stack_, ray, casters_)).first;
    }
    return columnDepth(form_, found->second, distance);
}

double SliceField::depthAt(const glm::vec3& point)
{
    const render::SlicePlace place = stack_.placeOf(point);
    const float x = place.x - 0.5f, y = place.y - 0.5f,
                distance = stack_.first + place.plane * stack_.spacing;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const float fx = x - float(x0), fy = y - float(y0);
    return double(glm::mix(glm::mix(columnAt(x0, y0, distance), columnAt(x0 + 1, y0, distance), fx),
                           glm::mix(columnAt(x0, y0 + 1, distance), columnAt(x0 + 1, y0 + 1, distance), fx),
                           fy));
}

} // namespace fx::cli
