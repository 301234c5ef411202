#include "rendering/network/particle_network.h"

#include "foundation/math/bits.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace fx::render {

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;
constexpr int kMostDirections = 512;
constexpr double kMostSegments = 256.0;         // of the length of a line
constexpr double kMaxScattered = 1.0 - 0x1p-20; // symbol q
constexpr double kRounding = 0x1p-22;           // [1] of the light of an iteration
constexpr double kPhaseTolerance = 1e-9;        // (1)
constexpr int kPhaseSteps = 1000;
constexpr uint32_t kBlock = 64; // particles whose light is scattered at once

base::Status refused(const std::string& what)
{
    return {base::Code::InvalidArgument, what};
}

bool areLights(std::span<const float> values)
{
    return std::ranges::all_of(values, [](float v) { return base::isFinite(v) && v >= 0.0f; });
}

bool isMedium(const NetworkParticle& p)
{
    const auto isLength = [](double v) { return v > 0.0 && v <= 1e9; };
    const auto isNear = [](double v) { return std::abs(v) <= 1e9; };
    return isNear(p.center.x) && isNear(p.center.y) && isNear(p.center.z) && isLength(p.radius) &&
           isLength(p.crossSection / p.radius / p.radius) && p.albedo >= 0.0 && p.albedo <= 1.0 &&
           p.emission >= 0.0 && p.emission <= 1e30;
}

base::Status check(std::span<const NetworkParticle> particles, const ParticleNetworkSettings& settings)
{
    if (particles.size() > ParticleNetwork::kMaxParticles)
        return {base::Code::TooLarge, "a particle network has at most " +
                                          std::to_string(ParticleNetwork::kMaxParticles) +
                                          " particles; use a network of cells"};
    const int d = settings.directions;
    if (d < 6 || d > kMostDirections || d % 2 != 0)
        return refused("a particle network has an even number of 6..512 directions");
    if (settings.lines < 4 || settings.lines > 512)
        return refused("a bundle of lines has 4..512 lines along each axis");
    if (settings.segment != 0.0 && !(settings.segment >= 0.1 && settings.segment <= 10.0))
        return refused("the segments of a line must have 0.1..10 mean radii, or 0 for whole particles");
    if (!(std::abs(settings.anisotropy) <= 0.9))
        return refused("the mean cosine of a particle network must be -0.9..0.9");
    for (size_t i = 0; i < particles.size(); ++i)
        if (!isMedium(particles[i]))
            return refused("particle " + std::to_string(i) +
                           " of the network needs a center within 1e9 m, a radius above 0 and up to 1e9 m, a "
                           "cross section above 0 and up to 1e9 squared radii, an albedo of 0..1 and an "
                           "emission of 0..1e30");
    return {};
}

ParticleBundle::Space spaceOf(std::span<const NetworkParticle> particles,
                              const ParticleNetworkSettings& settings)
{
    ParticleBundle::Space space;
    space.lines = settings.lines;
    if (particles.empty())
        return space;
    glm::dvec3 low = particles[0].center, high = low;
    double radii = 0.0;
    for (const NetworkParticle& p : particles) {
        low = glm::min(low, p.center - p.radius);
        high = glm::max(high, p.center + p.radius);
        radii += p.radius;
    }
    space.center = 0.5 * (low + high);
    space.half = 0.0;
    for (const NetworkParticle& p : particles)
        space.half = std::max(space.half, glm::length(p.center - space.center) + p.radius);
    if (settings.segment > 0.0)
        space.segment =
            std::max(settings.segment * radii / double(particles.size()), 2.0 * space.half / kMostSegments);
    return space;
}

/// Upper bound of the number of links of a bundle.
double mostLinks(std::span<const NetworkParticle> particles, const ParticleBundle::Space& space)
{
    double links = 0.0;
    for (const NetworkParticle& p : particles) {
        const double across = p.radius * space.lines / space.half + 1.0;
        links += across * across * (space.segment > 0.0 ? 2.0 * p.radius / space.segment + 2.0 : 1.0);
    }
    return links;
}

/// Half of a Fibonacci lattice of the sphere, each direction with its opposite.
std::vector<glm::dvec3> latticeDirections(int count)
{
    constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896964);
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < count / 2; ++i) {
        const double z = (2.0 * i + 1.0) / count, across = std::sqrt(1.0 - z * z), angle = i * kGoldenAngle;
        directions.push_back({across * std::cos(angle), across * std::sin(angle), z});
        directions.push_back(-directions.back());
    }
    return directions;
}

} // namespace

double ParticleNetwork::mostBytes(std::span<const NetworkParticle> particles,
                                  const ParticleNetworkSettings& settings)
{
    // Each direction of a particle: first, met and scattered light, and what iterations remember of it.
    constexpr double kBytesOfLight = 64.0;
    constexpr double kBytesOfPhase = 12.0; // each pair of directions, in both precisions
    const double directions = settings.directions;
    return mostLinks(particles, spaceOf(particles, settings)) * 0.5 * directions *
               double(ParticleBundle::kBytesOfLink) +
           directions * (kBytesOfLight * double(particles.size()) + kBytesOfPhase * directions);
}

base::Status ParticleNetwork::build(std::span<const NetworkParticle> particles,
                                    const ParticleNetworkSettings& settings, base::TaskRunner& tasks)
{
    if (base::Status status = check(particles, settings); !status)
        return status;
    const double bytes = mostBytes(particles, settings), mebibyte = 0x1p20;
    if (bytes > kMaxBytes)
        return {base::Code::TooLarge, "the particle network takes up to " +
                                          std::to_string(int64_t(bytes / mebibyte)) + " MiB, more than " +
                                          std::to_string(int64_t(kMaxBytes / mebibyte)) +
                                          "; use fewer lines or directions, or longer segments"};
    const ParticleBundle::Space space = spaceOf(particles, settings);
    particles_.assign(particles.begin(), particles.end());
    anisotropy_ = settings.anisotropy;
    directions_ = latticeDirections(settings.directions);
    bundles_.assign(directions_.size() / 2, {});
    tasks.parallelFor(uint32_t(bundles_.size()), 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t b = begin; b < end; ++b)
            bundles_[b] = ParticleBundle(particles_, directions_[2 * size_t(b)], space);
    });
    normalizePhase();
    crossSections_.clear();
    for (const NetworkParticle& p : particles_)
        crossSections_.push_back(float(p.crossSection));
    environment_.assign(directions_.size(), 0.0f);
    light_.assign(directions_.size() * count(), 0.0f);
    met_.assign(light_.size(), 0.0);
    clearDirect();
    return {};
}

double ParticleNetwork::weight() const
{
    return kSphere / double(directions_.size());
}

void ParticleNetwork::normalizePhase()
{
    const size_t n = directions_.size();
    std::vector<double> phase(n * n), sums(n);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j)
            phase[i * n + j] = weight() * formula64::fxHenyeyGreenstein(
                                              glm::dot(directions_[i], directions_[j]), anisotropy_);
    factors_.assign(n, 1.0);
    for (int step = 0; step < kPhaseSteps; ++step) {
        double worst = 0.0;
        for (size_t i = 0; i < n; ++i) {
            sums[i] = 0.0;
            for (size_t j = 0; j < n; ++j)
                sums[i] += phase[i * n + j] * factors_[j];
            worst = std::max(worst, std::abs(factors_[i] * sums[i] - 1.0));
        }
        if (worst < kPhaseTolerance)
            break;
        for (size_t i = 0; i < n; ++i)
            factors_[i] = std::sqrt(factors_[i] / sums[i]); // (1)
    }
    phase_.resize(n * n);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j)
            phase_[i * n + j] = float(factors_[i] * factors_[j] * phase[i * n + j]);
}

base::Status ParticleNetwork::setEnvironment(std::span<const float> radiance)
{
    if (radiance.size() != directions_.size() || !areLights(radiance))
        return refused("the environment has a radiance of at least 0 for each direction of the network");
    environment_.assign(radiance.begin(), radiance.end());
    isNew_ = true;
    return {};
}

void ParticleNetwork::clearDirect()
{
    direct_.assign(directions_.size() * count(), 0.0f);
    isNew_ = true;
}

void ParticleNetwork::addDirect(size_t particle, const glm::dvec3& travel, double irradiance)
{
    std::vector<double> row;
    double sum = 0.0;
    for (size_t d = 0; d < directions_.size(); ++d) {
        row.push_back(factors_[d] *
                      formula64::fxHenyeyGreenstein(glm::dot(directions_[d], travel), anisotropy_));
        sum += weight() * row.back(); // (5)
    }
    for (size_t d = 0; d < directions_.size(); ++d)
        direct_[d * count() + particle] += float(particles_[particle].albedo * irradiance * row[d] / sum);
    isNew_ = true;
}

void ParticleNetwork::follow(const std::vector<float>& light, std::vector<double>& outMet,
                             std::vector<ParticleBundle::Ends>& outEnds, base::TaskRunner& tasks) const
{
    outMet.assign(light.size(), 0.0);
    outEnds.assign(directions_.size(), {});
    tasks.parallelFor(uint32_t(directions_.size()), 1, [&](uint32_t begin, uint32_t end) {
        std::vector<float> source(count());
        for (size_t d = begin; d < end; ++d) {
            const size_t first = d * count();
            for (size_t p = 0; p < count(); ++p)
                source[p] = light[first + p] + direct_[first + p] + float(particles_[p].emission); // (2)
            outEnds[d] = bundles_[d / 2].follow(d % 2 == 0, source, double(environment_[d]),
                                                std::span(outMet).subspan(first, count()));
        }
    });
}

void ParticleNetwork::scatter(const std::vector<double>& met, std::vector<float>& outLight,
                              base::TaskRunner& tasks) const
{
    outLight.resize(met.size());
    const size_t n = directions_.size();
    tasks.parallelFor(uint32_t(count()), kBlock, [&](uint32_t begin, uint32_t end) {
        std::vector<double> sums(end - begin);
        for (size_t d = 0; d < n; ++d) {
            std::ranges::fill(sums, 0.0);
            for (size_t from = 0; from < n; ++from) {
                const double share = double(phase_[d * n + from]);
                const double* meeting = met.data() + from * count() + begin;
                for (size_t p = 0; p < sums.size(); ++p)
                    sums[p] += share * meeting[p];
            }
            for (size_t p = 0; p < sums.size(); ++p) {
                const NetworkParticle& particle = particles_[begin + p];
                outLight[d * count() + begin + p] =
                    float(particle.albedo / particle.crossSection * sums[p]); // (2)
            }
        }
    });
}

SweepReport ParticleNetwork::iterate(const SweepRules& rules, base::TaskRunner& tasks)
{
    if (isNew_) {
        mixing_.clear();
        last_ = {0, 1.0, 1.0, false};
    }
    isNew_ = false;
    last_.sweeps = 0;
    last_.isConverged = last_.change <= rules.tolerance;
    std::vector<float> swept, next;
    std::vector<ParticleBundle::Ends> ends;
    while (last_.sweeps < rules.sweeps && !last_.isConverged) {
        if (rules.acceleration > 0 && mixing_.isReady()) {
            swept = light_;
            mixing_.mix(light_);
            for (size_t i = 0; i < light_.size(); ++i)
                light_[i] = light_[i] < 0.0f ? swept[i] : light_[i];
        }
        follow(light_, met_, ends, tasks);
        scatter(met_, next, tasks);
        storeChange(light_, next);
        if (!crossSections_.empty())
            mixing_.remember(light_, next, crossSections_, rules.acceleration);
        light_.swap(next);
        ++last_.sweeps;
        last_.isConverged = last_.change <= rules.tolerance;
    }
    return last_;
}

void ParticleNetwork::storeChange(const std::vector<float>& before, const std::vector<float>& after)
{
    double change = 0.0, scattered = 0.0, largest = 0.0;
    for (const NetworkParticle& p : particles_)
        largest = std::max(largest, p.albedo);
    for (size_t i = 0; i < after.size(); ++i) {
        const double sigma = particles_[i % count()].crossSection; // (3)
        change += sigma * std::abs(double(after[i]) - double(before[i]));
        scattered += sigma * (double(after[i]) + double(direct_[i]));
    }
    const double q = std::min(largest, kMaxScattered);
    last_.change = scattered > 0.0 ? change / scattered : 0.0;
    last_.bound = (last_.change + kRounding) * q / (1.0 - q); // (4)
}

NetworkEnergy ParticleNetwork::energy(base::TaskRunner& tasks) const
{
    std::vector<double> met;
    std::vector<ParticleBundle::Ends> ends;
    follow(light_, met, ends, tasks);
    NetworkEnergy energy;
    for (size_t d = 0; d < directions_.size(); ++d) {
        energy.emitted += weight() * ends[d].entering;
        energy.escaped += weight() * ends[d].leaving;
        for (size_t p = 0; p < count(); ++p) {
            const NetworkParticle& particle = particles_[p];
            const double first = double(direct_[d * count() + p]) + particle.emission;
            energy.emitted += weight() * particle.crossSection * first;
            energy.absorbed += weight() * (1.0 - particle.albedo) * met[d * count() + p];
        }
    }
    return energy;
}

double ParticleNetwork::scattered(size_t particle, const glm::dvec3& direction) const
{
    double sum = 0.0, all = 0.0;
    for (size_t d = 0; d < directions_.size(); ++d) {
        const double share =
            factors_[d] * formula64::fxHenyeyGreenstein(glm::dot(directions_[d], direction), anisotropy_);
        sum += share * met_[d * count() + particle];
        all += share;
    }
    const NetworkParticle& p = particles_[particle];
    return p.albedo / p.crossSection * sum / all; // (5)
}

double ParticleNetwork::meanRadiance(size_t particle) const
{
    double sum = 0.0;
    for (size_t d = 0; d < directions_.size(); ++d)
        sum += met_[d * count() + particle];
    return sum / (particles_[particle].crossSection * double(directions_.size()));
}

size_t ParticleNetwork::links() const
{
    size_t sum = 0;
    for (const ParticleBundle& bundle : bundles_)
        sum += bundle.links();
    return sum;
}

size_t ParticleNetwork::bytes() const
{
    size_t sum = 0;
    for (const ParticleBundle& bundle : bundles_)
        sum += bundle.bytes();
    return sum;
}

} // namespace fx::render
