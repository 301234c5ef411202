#include "benchmarks/scenes/lumpy_cloud.h"

#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/chance.h"
#include "foundation/math/elementary.h"
#include "rendering/network/cell_interpolation.h"
#include "rendering/network/network_basis.h"
#include "rendering/reference/path/path_renderer.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

namespace fx::cli {

namespace {

constexpr double kCovered = 0.3;  // [1] opacity
constexpr double kDistance = 5.0; // [m] of the eye

/// Along an axis of a fine grid, the cells that a ball may reach.
std::pair<int, int> reached(const render::NetworkGrid& grid, double center, double radius, int axis)
{
    const auto cell = [&](double at) {
        return std::clamp(int(std::floor((at - grid.corner[axis]) / grid.side)), 0, grid.cells[axis] - 1);
    };
    return {cell(center - radius), cell(center + radius)};
}

/// Calls use(index, squared distance [m2] from the ball's center) for each cell of a grid that a ball may
/// reach.
template <class Use>
void forCellsOf(const render::NetworkGrid& grid, const render::MediumBlob& blob, const Use& use)
{
    const auto [x0, x1] = reached(grid, blob.center.x, blob.radius, 0);
    const auto [y0, y1] = reached(grid, blob.center.y, blob.radius, 1);
    const auto [z0, z1] = reached(grid, blob.center.z, blob.radius, 2);
    for (int z = z0; z <= z1; ++z)
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const glm::dvec3 offset = grid.middle({x, y, z}) - blob.center;
                use(grid.index({x, y, z}), glm::dot(offset, offset));
            }
}

} // namespace

LumpyCloud::LumpyCloud(double depth, CloudLight light, int fine, double spread) : light_(light)
{
    grid_ = {glm::dvec3(-kCloudHalf), 2.0 * kCloudHalf / fine, glm::ivec3(fine)};
    bench::Chance chance(1);
    for (int lump = 0; lump < 40; ++lump) {
        glm::dvec3 center;
        do {
            center = chance.inCube();
        } while (glm::length(center) > 1.0);
        for (int i = 0; i < 15; ++i) {
            const auto triangle = [&] { return chance() + chance() - 1.0; };
            const glm::dvec3 offset(triangle(), triangle(), triangle());
            render::MediumBlob blob;
            blob.center = spread * 0.62 * center + 0.22 * offset;
            blob.radius = chance.between(0.07, 0.2);
            blob.crossSection = chance.between(0.5, 1.5) * std::pow(blob.radius, 3.0); // even densities
            blobs_.push_back(blob);
        }
    }
    fill();
    double sum = 0.0; // of the depths of the columns near the middle
    int columns = 0;
    for (int y = 0; y < fine; ++y)
        for (int x = 0; x < fine; ++x) {
            const glm::dvec3 p = grid_.middle({x, y, 0});
            if (p.x * p.x + p.y * p.y > 0.16)
                continue;
            ++columns;
            for (int z = 0; z < fine; ++z)
                sum += double(cells_[grid_.index({x, y, z})][0]) * grid_.side;
        }
    const double scale = depth * columns / sum;
    for (render::MediumBlob& blob : blobs_)
        blob.crossSection *= scale;
    for (Cell& cell : cells_)
        cell[0] *= float(scale);
    if (light_ == CloudLight::Inside)
        findLampDepths();
    else
        findSunDepths();
}

void LumpyCloud::fill()
{
    cells_.assign(grid_.count(), {});
    for (const render::MediumBlob& blob : blobs_) {
        const double r2 = blob.radius * blob.radius, e = grid_.side * grid_.side / r2;
        const double peak = 105.0 * blob.crossSection / (32.0 * std::numbers::pi * r2 * blob.radius);
        forCellsOf(grid_, blob, [&](size_t cell, double distance2) {
            if (distance2 < r2)
                cells_[cell][0] += float(peak * formula64::fxVoxelKernel(distance2 / r2, std::min(e, 0.25)));
        });
    }
    for (Cell& cell : cells_)
        cell[0] = std::max(cell[0], 0.0f);
}

/// Sunlight travels along -z: slice after slice, with the depth of each column.
void LumpyCloud::findSunDepths()
{
    const size_t slice = size_t(grid_.cells.x) * size_t(grid_.cells.y);
    const float half = 0.5f * float(grid_.side);
    std::vector<float> depths(slice, 0.0f);
    for (size_t z = size_t(grid_.cells.z); z-- > 0;)
        for (size_t i = 0; i < slice; ++i) {
            Cell& cell = cells_[z * slice + i];
            cell[1] = depths[i] + half * cell[0];
            depths[i] = cell[1] + half * cell[0];
        }
    for (size_t i = 0; i < cells_.size(); ++i)
        cells_[i][2] = depths[i % slice];
}

void LumpyCloud::findLampDepths()
{
    const double step = 0.75 * grid_.side;
    for (size_t i = 0; i < grid_.count(); ++i) {
        const int n = grid_.cells.x;
        const glm::dvec3 place = grid_.middle({int(i) % n, int(i) / n % n, int(i) / (n * n)});
        const double distance = glm::length(place);
        const glm::dvec3 way = place / distance;
        double depth = 0.0;
        bool isBehind = false;
        for (double at = kCloudLampRadius + 0.5 * step; at < 1.9; at += step) {
            const bool isPast = at - 0.5 * step >= distance;
            if (isPast && !isBehind)
                cells_[i][1] = float(depth);
            isBehind = isPast;
            const glm::dvec3 p = at * way;
            if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kCloudHalf)
                break;
            depth += step * double(this->at(p).extinction);
        }
        if (!isBehind)
            cells_[i][1] = float(depth);
        cells_[i][2] = float(depth);
    }
}

CloudPoint LumpyCloud::at(const glm::dvec3& position) const
{
    const auto values = render::interpolatedCells<4>(cells_.data()->data(), grid_, position);
    return {values[0], values[1], values[2]};
}

double LumpyCloud::irradiance(const glm::dvec3& position, glm::dvec3& outTravel) const
{
    outTravel = {0.0, 0.0, -1.0};
    if (light_ != CloudLight::Inside)
        return 1.0;
    const double distance = glm::length(position);
    if (distance > 0.0)
        outTravel = position / distance;
    return 1.0 / (distance * distance + kCloudLampRadius * kCloudLampRadius);
}

render::ReferenceCamera LumpyCloud::camera() const
{
    const glm::dvec3 eye = light_ == CloudLight::Front  ? glm::dvec3(0.0, 0.0, kDistance)
                           : light_ == CloudLight::Back ? glm::dvec3(0.0, 0.0, -kDistance)
                                                        : glm::dvec3(kDistance, 0.0, 0.0);
    auto camera = render::ReferenceCamera::lookAt(eye, glm::dvec3(0.0), {0.0, 1.0, 0.0});
    camera.halfHeight = 0.23;
    camera.nearDistance = 1e-3;
    return camera;
}

base::Status give(const LumpyCloud& cloud, const CloudNetwork& form, render::ScatteringNetwork& outNetwork)
{
    const render::NetworkGrid grid{glm::dvec3(-kCloudHalf), 2.0 * kCloudHalf / form.cells,
                                   glm::ivec3(form.cells)};
    const int samples = std::max(2, cloud.grid().cells.x / (form.cells + 8));
    const render::NetworkPhase phase = render::networkPhase(form.settings.anisotropy, form.settings.moments);
    const double share = phase.extinctionShare(form.albedo), each = 1.0 / double(samples * samples * samples);
    std::vector<float> extinction(grid.count());
    std::vector<std::array<double, render::kMaxNetworkMoments>> direct(grid.count());
    for (size_t cell = 0; cell < grid.count(); ++cell) {
        const int n = form.cells;
        const glm::dvec3 corner(int(cell) % n, int(cell) / n % n, int(cell) / (n * n));
        double sum = 0.0;
        std::array<double, render::kMaxNetworkMoments> moments{};
        for (int i = 0; i < samples * samples * samples; ++i) {
            const glm::dvec3 offset(i % samples + 0.5, i / samples % samples + 0.5,
                                    i / (samples * samples) + 0.5);
            const glm::dvec3 place = grid.corner + grid.side * (corner + offset / double(samples));
            const CloudPoint point = cloud.at(place);
            const double here = double(point.extinction);
            if (!(here > 0.0))
                continue;
            glm::dvec3 travel;
            const double light =
                cloud.irradiance(place, travel) * base::naturalExp(-share * double(point.lightDepth));
            const auto y = render::harmonics(travel);
            for (size_t k = 0; k < moments.size(); ++k)
                moments[k] += here * light * y[k];
            sum += here;
        }
        extinction[cell] = float(sum * each);
        for (size_t k = 0; sum > 0.0 && k < moments.size(); ++k)
            direct[cell][k] = moments[k] / sum;
    }
    const std::vector<float> albedo(grid.count(), float(form.albedo));
    if (base::Status status = outNetwork.setMedium({grid, extinction, albedo, {}}, form.settings); !status)
        return status;
    for (size_t cell = 0; cell < grid.count(); ++cell)
        outNetwork.addDirect(cell, direct[cell]);
    return {};
}

base::Status give(const LumpyCloud& cloud, const render::ParticleNetworkSettings& settings, double albedo,
                  render::ParticleNetwork& outNetwork, base::TaskRunner& tasks)
{
    constexpr int kSamples = 6; // along each axis of a ball
    std::vector<render::NetworkParticle> particles;
    for (const render::MediumBlob& blob : cloud.blobs())
        particles.push_back({blob.center, blob.radius, blob.crossSection, albedo, 0.0});
    if (base::Status status = outNetwork.build(particles, settings, tasks); !status)
        return status;
    for (size_t p = 0; p < particles.size(); ++p) {
        double sum = 0.0, light = 0.0;
        glm::dvec3 flow(0.0); // of the light
        for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
            const glm::dvec3 cell(i % kSamples, i / kSamples % kSamples, i / (kSamples * kSamples));
            const glm::dvec3 offset = particles[p].radius * (2.0 * (cell + 0.5) / double(kSamples) - 1.0);
            const double weight =
                formula64::fxKernelExtinction(1.0, particles[p].radius, glm::dot(offset, offset));
            if (!(weight > 0.0))
                continue;
            const glm::dvec3 place = particles[p].center + offset;
            glm::dvec3 travel;
            const double here =
                weight * cloud.irradiance(place, travel) * std::exp(-double(cloud.at(place).lightDepth));
            sum += weight;
            light += here;
            flow += here * travel;
        }
        if (glm::length(flow) > 0.0)
            outNetwork.addDirect(p, glm::normalize(flow), light / sum);
    }
    return {};
}

BallLight::BallLight(const LumpyCloud& cloud, std::span<const double> light)
    : grid_(cloud.grid()), light_(grid_.count(), 0.0f), extinction_(grid_.count(), 0.0f)
{
    for (size_t ball = 0; ball < cloud.blobs().size(); ++ball) {
        const render::MediumBlob& blob = cloud.blobs()[ball];
        forCellsOf(grid_, blob, [&](size_t cell, double distance2) {
            const double here = formula64::fxKernelExtinction(blob.crossSection, blob.radius, distance2);
            light_[cell] += float(here * light[ball]);
            extinction_[cell] += float(here);
        });
    }
}

double BallLight::at(const glm::dvec3& position) const
{
    const double here = render::interpolated(extinction_.data(), grid_, position);
    return here > 0.0 ? render::interpolated(light_.data(), grid_, position) / here : 0.0;
}

base::Result<CloudTruth> tracedCloud(const LumpyCloud& cloud, const double (&albedos)[2], double anisotropy,
                                     int size, uint32_t paths, const std::function<bool()>& stop)
{
    const auto start = std::chrono::steady_clock::now();
    const double startProcessor = processSeconds();
    render::ReferenceScene scene;
    scene.blobs = cloud.blobs();
    for (render::MediumBlob& blob : scene.blobs) {
        blob.albedo = {albedos[0], albedos[1], albedos[1]};
        blob.anisotropy = anisotropy;
    }
    scene.opaque.isEmpty = true;
    scene.opaque.lighting.groundAlbedo = 0.0f;
    scene.opaque.lighting.sunDirection = {0.0f, 0.0f, 1.0f};
    if (cloud.light() == CloudLight::Inside)
        scene.opaque.particleLights.push_back({glm::dvec3(0.0), glm::vec3(1.0f), float(kCloudLampRadius)});
    else
        scene.opaque.lighting.sunIlluminance = glm::vec3(1.0f);
    scene.camera = cloud.camera();
    const auto tasks = base::makeTbbRunner();
    CloudTruth truth;
    for (uint32_t picture = 0; picture < 2; ++picture) {
        render::PathPictureSettings settings;
        settings.width = settings.height = size;
        settings.samples = paths;
        settings.sunRadius = 0.0;
        settings.seed = picture + 1;
        render::PathRenderer renderer;
        if (base::Status status = renderer.build(scene, settings, *tasks); !status)
            return status;
        if (base::Status status = renderer.render(nullptr, {{}, stop}); !status)
            return status;
        truth.isCovered.clear();
        for (const float opacity : renderer.pixels(render::path_channel::Color + 3))
            truth.isCovered.push_back(double(opacity) > kCovered);
        for (uint32_t c = 0; c < 2; ++c) {
            const std::vector<float>& light = renderer.pixels(render::path_channel::Color + c);
            truth.light[picture][c].assign(light.begin(), light.end());
        }
    }
    truth.processorSeconds = processSeconds() - startProcessor;
    truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return truth;
}

double cloudError(const std::vector<double>& picture, const CloudTruth& truth, int albedo)
{
    double squares = 0.0, mean = 0.0, count = 0.0;
    for (size_t i = 0; i < picture.size(); ++i) {
        if (!truth.isCovered[i])
            continue;
        const double first = truth.light[0][albedo][i], second = truth.light[1][albedo][i];
        squares += (picture[i] - first) * (picture[i] - second);
        mean += 0.5 * (first + second);
        count += 1.0;
    }
    return std::sqrt(std::max(squares / count, 0.0)) / (mean / count);
}

double pathSeconds(const CloudTruth& truth, int albedo, double error)
{
    double noise = 0.0, mean = 0.0, count = 0.0; // noise: variance of a picture
    for (size_t i = 0; i < truth.isCovered.size(); ++i) {
        if (!truth.isCovered[i])
            continue;
        const double first = truth.light[0][albedo][i], second = truth.light[1][albedo][i];
        noise += 0.5 * (first - second) * (first - second);
        mean += 0.5 * (first + second);
        count += 1.0;
    }
    if (!(mean > 0.0))
        return 0.0;
    noise *= count / (mean * mean);
    const double told = std::max(error * error, 2.0 * noise / std::sqrt(count));
    constexpr double kPictures = 2.0, kAlbedos = 2.0;
    return truth.processorSeconds / (kPictures * kAlbedos) * noise / std::max(told, 1e-30);
}

} // namespace fx::cli
