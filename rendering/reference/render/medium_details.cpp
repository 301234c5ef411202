#include "rendering/reference/render/medium_details.h"

#include "rendering/optics/black_body.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::render {

namespace {

constexpr double kMinPixel = 1e-9; ///< [m]

} // namespace

PixelWidth::PixelWidth(const ReferenceCamera& camera, int height) : forward(camera.forward)
{
    const double pixel = 2.0 * camera.halfHeight / double(height);
    (camera.orthographic ? constant : perDepth) = pixel;
}

double PixelWidth::at(const glm::dvec3& point) const
{
    return std::max(perDepth * glm::dot(point, forward) + constant, kMinPixel);
}

DetailedMedium::DetailedMedium(const MediumDetails& details, const BallTree& tree, const glm::dvec3& eye,
                               const PixelWidth& pixel)
    : pixel_(pixel), octaves_(details.octaves)
{
    for (const MediumDetails::Group& group : details.groups)
        groups_.push_back({group.detail, group.origin - eye});
    if (!isGiven())
        return;
    balls_.reserve(tree.count());
    thermal_.reserve(tree.count());
    for (uint32_t place = 0; place < tree.count(); ++place) {
        balls_.push_back(details.balls[tree.ballAt(place)]);
        thermal_.push_back(blackBodyLuminance(balls_.back().temperature));
    }
}

double DetailedMedium::lumpSize(size_t group) const
{
    const GroupDetail& detail = groups_[group].detail;
    return double(detail.numbers.length()) * double(detail.scale);
}

MediumDetail DetailedMedium::at(size_t group, double extinction, const std::array<glm::dvec3, 2>& carried,
                                double thinning, const glm::dvec3& point) const
{
    const GroupDetail& detail = groups_[group].detail;
    const double scale = double(detail.scale);
    const glm::vec3 local(point - groups_[group].origin);
    SmoothMedium smooth;
    smooth.extinction = float(extinction * scale);
    smooth.thinning = float(thinning);
    for (size_t g = 0; g < 2; ++g) {
        const FieldDetailNumbers::Generation& own = detail.numbers.generations[g];
        const glm::vec3 cells = detail.toCells[g] * local + detail.first[g] + glm::vec3(carried[g]);
        smooth.place[g] = own.length * (cells - own.offset);
    }
    MediumDetail made =
        detailAt(detail.numbers, sharedLumpTile(), smooth, float(pixel_.at(point) / scale), octaves_);
    made.share *= detail.factor;
    return made;
}

double DetailedMedium::maxErodedExtinction(size_t group, double most) const
{
    const GroupDetail& detail = groups_[group].detail;
    const double scale = double(detail.scale);
    // more than a float holds is whole
    const float smooth = float(std::min(most * scale, 1e30));
    const double left = std::max(double(render::maxErodedExtinction(detail.numbers, smooth)) / scale,
                                 most * scale > 1e30 ? most : 0.0);
    return double(detail.factor) * left;
}

double DetailedMedium::mostGain(size_t group) const
{
    return double(groups_[group].detail.factor) * double(kMaxDetailGain) * (1.0 + 1e-5);
}

void DetailMix::clear()
{
    smooth_ = 0.0;
    sums_.resize(medium_.groupCount());
    for (Sum& sum : sums_) {
        sum.extinction = 0.0;
        sum.carried = {};
        sum.thinning = 0.0;
    }
}

void DetailMix::add(uint32_t place, double extinction)
{
    const int32_t group = medium_.groupOf(place);
    if (group < 0) {
        smooth_ += extinction;
        return;
    }
    const MediumDetails::Ball& ball = medium_.ball(place);
    Sum& sum = sums_[size_t(group)];
    sum.extinction += extinction;
    sum.thinning += extinction * double(ball.thinning);
    for (size_t g = 0; g < 2; ++g)
        sum.carried[g] += extinction * glm::dvec3(ball.carried[g]);
}

void DetailMix::finish(const glm::dvec3& point)
{
    for (size_t group = 0; group < sums_.size(); ++group) {
        Sum& sum = sums_[group];
        sum.detail = {0.0f, 1.0f, 0.0f};
        if (!(sum.extinction > 0.0))
            continue;
        for (glm::dvec3& carried : sum.carried)
            carried /= sum.extinction;
        sum.detail = medium_.at(group, sum.extinction, sum.carried, sum.thinning / sum.extinction, point);
    }
}

glm::dvec3 DetailMix::source(uint32_t place, const glm::dvec3& source, const glm::dvec3& albedo) const
{
    const float change = temperature(place);
    if (change == 1.0f)
        return source;
    const glm::dvec3 more = glm::dvec3(blackBodyLuminance(medium_.ball(place).temperature * change)) -
                            glm::dvec3(medium_.thermal(place));
    return glm::max(source + (1.0 - albedo) * more, glm::dvec3(0.0));
}

double DetailMix::maxErodedExtinction() const
{
    double sum = smooth_;
    for (size_t group = 0; group < sums_.size(); ++group)
        sum += medium_.maxErodedExtinction(group, sums_[group].extinction);
    return sum;
}

} // namespace fx::render
