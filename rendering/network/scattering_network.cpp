#include "rendering/network/scattering_network.h"

#include "foundation/math/bits.h"
#include "foundation/math/elementary.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace fx::render {

namespace {

constexpr int kMaxCells = 256;                  // along an axis
constexpr double kMaxScattered = 1.0 - 0x1p-20; // (5)
constexpr double kRounding = 0x1p-22;           // [1] of the light of a sweep
const double kRootSphere = std::sqrt(4.0 * std::numbers::pi);

base::Status refused(const std::string& what)
{
    return {base::Code::InvalidArgument, what};
}

bool areWithin(std::span<const float> values, float most)
{
    return std::ranges::all_of(values, [&](float v) { return base::isFinite(v) && v >= 0.0f && v <= most; });
}

base::Status check(const NetworkMedium& medium, const NetworkSettings& settings)
{
    const int d = settings.directions, m = settings.moments;
    if ((d != 6 && d != 14 && d != 26) || (m != 4 && m != 9) || (d == 6 && m == 9))
        return refused("a network has 6, 14 or 26 directions and 4 or 9 moments, 4 with 6 directions");
    if (!(settings.anisotropy >= -1.0 && settings.anisotropy <= 1.0))
        return refused("the mean cosine must be -1..1");
    for (int a = 0; a < 3; ++a)
        if (medium.grid.cells[a] < 1 || medium.grid.cells[a] > kMaxCells)
            return refused("a network has 1..256 cells along each axis");
    if (!base::isFinite(medium.grid.side) || !(medium.grid.side > 0.0))
        return refused("the side of a cell must be finite and above 0");
    const size_t n = medium.grid.count();
    if (medium.extinction.size() != n || medium.albedo.size() != n ||
        (!medium.emission.empty() && medium.emission.size() != n))
        return refused("a network takes one value for each cell");
    constexpr float kLargest = std::numeric_limits<float>::max();
    if (!areWithin(medium.extinction, kLargest) || !areWithin(medium.emission, kLargest))
        return refused("extinction and emission must be finite and at least 0");
    if (!areWithin(medium.albedo, 1.0f))
        return refused("the albedo must be 0..1");
    return {};
}

} // namespace

base::Status ScatteringNetwork::setMedium(const NetworkMedium& medium, const NetworkSettings& settings)
{
    if (base::Status status = check(medium, settings); !status)
        return status;
    grid_ = medium.grid;
    moments_ = settings.moments;
    phase_ = networkPhase(settings.anisotropy, moments_);
    directions_ = neighborDirections(settings.directions);
    harmonics_.resize(directions_.size());
    for (size_t d = 0; d < directions_.size(); ++d) {
        const auto values = harmonics(glm::normalize(glm::dvec3(directions_[d].step)));
        std::ranges::transform(values, harmonics_[d].begin(), [](double v) { return float(v); });
    }
    extinction_.resize(count());
    scattering_.resize(count());
    emission_.resize(count());
    for (int way = 0; way < 3; ++way) {
        taken_[size_t(way)].resize(count());
        mean_[size_t(way)].resize(count());
    }
    contraction_ = 0.0;
    for (size_t i = 0; i < count(); ++i) {
        const double albedo = double(medium.albedo[i]), share = phase_.extinctionShare(albedo);
        extinction_[i] = float(double(medium.extinction[i]) * share);
        scattering_[i] = float(phase_.albedo(albedo));
        emission_[i] =
            medium.emission.empty() || !(share > 0.0) ? 0.0f : float(double(medium.emission[i]) / share);
        if (extinction_[i] > 0.0f)
            contraction_ = std::max(contraction_, double(scattering_[i]));
        for (int way = 0; way < 3; ++way) {
            const double tau = double(extinction_[i]) * grid_.side * std::sqrt(way + 1.0);
            const double passing = base::naturalExp(-tau);
            taken_[size_t(way)][i] = float(formula64::fxNetworkTaken(tau, passing));
            mean_[size_t(way)][i] = float(formula64::fxNetworkMean(tau, passing));
        }
    }
    contraction_ = std::min(contraction_, kMaxScattered); // (5)
    direct_.assign(count() * size_t(moments_), 0.0f);
    environment_.assign(directions_.size(), 0.0f);
    isNew_ = true;
    return {};
}

base::Status ScatteringNetwork::setEnvironment(std::span<const float> radiance)
{
    if (radiance.size() != directions_.size() || !areWithin(radiance, std::numeric_limits<float>::max()))
        return refused("the environment has a radiance of at least 0 for each direction of the network");
    environment_.assign(radiance.begin(), radiance.end());
    isNew_ = true;
    return {};
}

void ScatteringNetwork::addDirect(size_t cell, const std::array<double, kMaxNetworkMoments>& moments)
{
    for (size_t k = 0; k < size_t(moments_); ++k)
        direct_[k * count() + cell] += float(moments[k]);
    isNew_ = true;
}

SweepReport ScatteringNetwork::sweep(const SweepRules& rules, NetworkState& io, base::TaskRunner& tasks)
{
    if (io.grid != grid_ || io.moments != moments_)
        io = resampled(io, grid_, moments_);
    if (isNew_ || !mixing_.continues(io.light)) {
        mixing_.clear();
        last_ = {0, 1.0, 1.0, false};
    }
    isNew_ = false;
    last_.sweeps = 0;
    last_.isConverged = last_.change <= rules.tolerance;
    std::vector<float> swept;
    while (last_.sweeps < rules.sweeps && !last_.isConverged) {
        if (rules.acceleration > 0 && mixing_.isReady()) {
            swept = io.light;
            mixing_.mix(io.light);
            keepPositive(swept, io.light);
        }
        sweepOnce(io.light, tasks);
        storeChange(io.light, next_);
        mixing_.remember(io.light, next_, extinction_, rules.acceleration);
        io.light.swap(next_);
        ++last_.sweeps;
        last_.isConverged = last_.change <= rules.tolerance;
    }
    return last_;
}

void ScatteringNetwork::sweepOnce(const std::vector<float>& light, base::TaskRunner& tasks)
{
    findSources(light, tasks);
    if (moments_ == 4)
        followLines<4>(tasks);
    else
        followLines<9>(tasks);
    sumMoments(tasks);
}

/// Cells whose mix has a negative source keep what the sweep gave them.
void ScatteringNetwork::keepPositive(const std::vector<float>& swept, std::vector<float>& ioMixed) const
{
    for (size_t i = 0; i < count(); ++i) {
        float least = 0.0f;
        for (const auto& y : harmonics_) {
            float source = 0.0f;
            for (int k = 0; k < moments_; ++k)
                source += float(phase_.factors[size_t(harmonicBand(k))]) * y[size_t(k)] *
                          ioMixed[size_t(k) * count() + i];
            least = std::min(least, source);
        }
        if (!(least < 0.0f))
            continue;
        for (size_t k = 0; k < size_t(moments_); ++k)
            ioMixed[k * count() + i] = swept[k * count() + i];
    }
}

void ScatteringNetwork::storeChange(const std::vector<float>& before, const std::vector<float>& after)
{
    double change = 0.0, scattered = 0.0;
    for (size_t i = 0; i < count(); ++i) {
        double squares = 0.0;
        for (int k = 0; k < moments_; ++k) {
            const size_t at = size_t(k) * count() + i;
            const double moment =
                phase_.factors[size_t(harmonicBand(k))] * (double(after[at]) - double(before[at]));
            squares += moment * moment;
        }
        const double weight = double(extinction_[i]) * double(scattering_[i]);
        change += weight * std::sqrt(squares); // (7)
        scattered += weight * (double(after[i]) + double(direct_[i]));
    }
    last_.change = scattered > 0.0 ? change / scattered : 0.0;
    last_.bound = (last_.change + kRounding) * contraction_ / (1.0 - contraction_); // (6)
}

NetworkEnergy ScatteringNetwork::energy(const NetworkState& state, base::TaskRunner& tasks)
{
    sweepOnce(resampled(state, grid_, moments_).light, tasks);
    NetworkEnergy energy;
    const double side2 = grid_.side * grid_.side;
    for (size_t i = 0; i < count(); ++i) {
        const double power = double(extinction_[i]) * side2 * grid_.side * kRootSphere;
        energy.emitted +=
            power * (kRootSphere * double(emission_[i]) + double(scattering_[i]) * double(direct_[i]));
        energy.absorbed += power * (1.0 - double(scattering_[i])) * double(next_[i]);
    }
    for (size_t d = 0; d < directions_.size(); ++d) {
        const double section =
            directions_[d].weight * side2 / std::sqrt(double(directions_[d].squares)); // (4)
        energy.emitted += section * ends_[d].entering;
        energy.escaped += section * ends_[d].leaving;
    }
    return energy;
}

double ScatteringNetwork::opticalDepth(const glm::dvec3& from, const glm::dvec3& direction,
                                       double length) const
{
    const glm::dvec3 start = (from - grid_.corner) / grid_.side;
    const double end = length / grid_.side;
    double begin = 0.0, leave = end;
    for (int a = 0; a < 3; ++a) { // the part within the grid
        if (direction[a] == 0.0) {
            if (start[a] < 0.0 || start[a] >= double(grid_.cells[a]))
                return 0.0;
            continue;
        }
        const double first = -start[a] / direction[a],
                     last = (double(grid_.cells[a]) - start[a]) / direction[a];
        begin = std::max(begin, std::min(first, last));
        leave = std::min(leave, std::max(first, last));
    }
    if (!(begin < leave))
        return 0.0;
    glm::ivec3 cell;
    glm::dvec3 next, spacing;
    for (int a = 0; a < 3; ++a) {
        cell[a] = std::clamp(int(std::floor(start[a] + begin * direction[a])), 0, grid_.cells[a] - 1);
        spacing[a] =
            direction[a] == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / std::abs(direction[a]);
        next[a] = direction[a] == 0.0
                      ? std::numeric_limits<double>::infinity()
                      : (double(cell[a] + (direction[a] > 0.0 ? 1 : 0)) - start[a]) / direction[a];
    }
    double depth = 0.0, at = begin;
    while (at < leave) {
        const int a = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        const double to = std::min(next[a], leave);
        depth += std::max(to - at, 0.0) * double(extinction_[grid_.index(cell)]);
        at = std::max(to, at);
        cell[a] += direction[a] > 0.0 ? 1 : -1;
        if (cell[a] < 0 || cell[a] >= grid_.cells[a])
            break;
        next[a] += spacing[a];
    }
    return depth * grid_.side;
}

} // namespace fx::render
