#include "rendering/reference/render/medium_details.h"

#include "rendering/optics/black_body.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::render {

namespace {

constexpr double kMinPixel = 1e-9;     ///< [m]
constexpr double kVoxelsPerLump = 4.0; ///< of a volume: what varies as much as a lump of this size

} // namespace

void removeNoise(MediumDetails& io)
{
    std::vector<int32_t> kept(io.groups.size(), -1);
    std::vector<MediumDetails::Group> volumes;
    for (size_t group = 0; group < io.groups.size(); ++group)
        if (io.groups[group].volume) {
            kept[group] = int32_t(volumes.size());
            volumes.push_back(std::move(io.groups[group]));
            volumes.back().detail = {};
        }
    io.groups = std::move(volumes);
    for (MediumDetails::Ball& ball : io.balls)
        ball.group = ball.group < 0 ? -1 : kept[size_t(ball.group)];
    if (io.groups.empty())
        io.balls.clear();
}

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
        groups_.push_back({group.detail, group.origin - eye, group.volume, group.place});
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
    const double lump = double(detail.numbers.length()) * double(detail.scale);
    const double voxels = kVoxelsPerLump * groups_[group].place.side;
    return !isVolume(group) ? lump : hasNoise(group) ? std::min(lump, voxels) : voxels;
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

MediumVolume::Sample DetailedMedium::volumeAt(size_t group, const glm::dvec3& point) const
{
    const Group& own = groups_[group];
    const glm::dvec3 voxel = own.place.voxelAt(point - own.origin);
    MediumVolume::Sample sample = own.volume->at(voxel);
    double share = own.place.density;
    if (hasNoise(group) && sample.extinction > 0.0)
        share *= double(at(group, share * sample.extinction, {}, volumeThinning(group, voxel), point).share);
    sample.extinction *= share;
    sample.emitted *= share * glm::dvec3(own.place.tint);
    sample.scattered *= share * glm::dvec3(own.place.tint);
    return sample;
}

/// [1] Symbol v of formula field-detail: the mean of that of voxels by their extinction, as OpenGL
/// interpolates it.
double DetailedMedium::volumeThinning(size_t group, const glm::dvec3& voxel) const
{
    const Group& own = groups_[group];
    const FieldDetailNumbers& numbers = own.detail.numbers;
    const double perExtinction = own.place.density * double(numbers.length()) * double(own.detail.scale);
    const MediumVolume::Corners corners = own.volume->cornersAt(voxel);
    double sum = 0.0, weight = 0.0;
    for (size_t k = 0; k < corners.weight.size(); ++k) {
        const double extinction = corners.weight[k] * corners.extinction[k];
        const double depth = perExtinction * corners.extinction[k];
        weight += extinction;
        sum += extinction *
               formula64::fxDetailThinning(depth, double(numbers.thinnest), double(numbers.densest));
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

double DetailedMedium::largestOfVolumes() const
{
    double sum = 0.0;
    for (size_t g = 0; g < groups_.size(); ++g) {
        const Group& group = groups_[g];
        const double largest = group.volume ? double(group.volume->largest()) * group.place.density : 0.0;
        sum += hasNoise(g) && group.volume ? maxErodedExtinction(g, largest) : largest;
    }
    return sum;
}

double DetailedMedium::mostGain(size_t group) const
{
    if (isVolume(group))
        return 1.0; // largestOfVolumes() bounds it
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
        sum.largest = 0.0;
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
    if (medium_.isVolume(size_t(group))) {
        sum.largest = std::max(sum.largest, double(ball.largest));
        return;
    }
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
        if (medium_.isVolume(group)) {
            finishVolume(group, point);
            continue;
        }
        for (glm::dvec3& carried : sum.carried)
            carried /= sum.extinction;
        sum.detail = medium_.at(group, sum.extinction, sum.carried, sum.thinning / sum.extinction, point);
    }
}

glm::dvec3 DetailMix::source(uint32_t place, const glm::dvec3& source, const glm::dvec3& albedo) const
{
    if (const Sum* const volume = volumeOf(place))
        return volume->source;
    const float change = temperature(place);
    if (change == 1.0f)
        return source;
    const glm::dvec3 more = glm::dvec3(blackBodyLuminance(medium_.ball(place).temperature * change)) -
                            glm::dvec3(medium_.thermal(place));
    const glm::dvec3 tint(medium_.tint(size_t(medium_.groupOf(place))));
    return glm::max(source + (1.0 - albedo) * tint * more, glm::dvec3(0.0));
}

const DetailMix::Sum* DetailMix::volumeOf(uint32_t place) const
{
    const int32_t group = medium_.groupOf(place);
    return group >= 0 && medium_.isVolume(size_t(group)) ? &sums_[size_t(group)] : nullptr;
}

glm::dvec3 DetailMix::albedo(uint32_t place, const glm::dvec3& albedo) const
{
    const Sum* const volume = volumeOf(place);
    return volume ? volume->albedo : albedo;
}

/// The balls share the medium of the voxels in proportion to their own extinction.
void DetailMix::finishVolume(size_t group, const glm::dvec3& point)
{
    Sum& sum = sums_[group];
    const MediumVolume::Sample sample = medium_.volumeAt(group, point);
    sum.detail.share = float(sample.extinction / sum.extinction);
    const double perExtinction = sample.extinction > 0.0 ? 1.0 / sample.extinction : 0.0;
    sum.source = sample.emitted * perExtinction;
    sum.albedo = sample.scattered * perExtinction;
}

double DetailMix::maxErodedExtinction() const
{
    double sum = smooth_;
    for (size_t group = 0; group < sums_.size(); ++group) {
        const bool isVolume = medium_.isVolume(group);
        const double most = isVolume ? sums_[group].largest : sums_[group].extinction;
        sum += isVolume && !medium_.hasNoise(group) ? most : medium_.maxErodedExtinction(group, most);
    }
    return sum;
}

} // namespace fx::render
