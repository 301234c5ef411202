/// @file lumpy_cloud.h
/// A cloud of 600 balls in 40 lumps within 1.08 m of the origin, and path-traced pictures of the cloud. The
/// light comes from one side or from inside. The cloud is used in measurements of illumination networks.
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/network/particle_network.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/render/reference_camera.h"

#include <array>
#include <functional>
#include <vector>

namespace fx::cli {

constexpr double kCloudHalf = 1.08;      ///< [m] half of the side of the box around the cloud
constexpr double kCloudLampRadius = 0.1; ///< [m] radius of the lamp in the center

/// Direction of the light of a cloud, as seen from the eye. Sunlight has an illuminance of 1 and travels
/// along -z; the lamp in the center has an intensity of 1.
enum class CloudLight
{
    Front,
    Side,
    Back,
    Inside
};

/// What a fine grid has at a point, interpolated between the centers of its cells.
struct CloudPoint
{
    float extinction = 0.0f; ///< [1/m]
    float lightDepth = 0.0f; ///< [1] optical depth between the light and the point
    float lineDepth = 0.0f;  ///< [1] optical depth of the whole ray of the light through the point
};

/// The medium, and a fine grid of its extinction and of the optical depth of its light.
class LumpyCloud
{
public:
    /// Creates the cloud.
    /// @param depth [1] mean optical depth through the center along z
    /// @param fine number of cells of the grids along an axis
    /// @param spread [1] scale of the distances of the lumps from the center: 1 at rest, less before an
    ///          explosion
    LumpyCloud(double depth, CloudLight light, int fine, double spread = 1.0);

    /// The blobs; albedo and phase are not set.
    const std::vector<render::MediumBlob>& blobs() const { return blobs_; }
    CloudLight light() const { return light_; }
    const render::NetworkGrid& grid() const { return grid_; }
    CloudPoint at(const glm::dvec3& position) const;
    /// [lx] Irradiance without the medium. @param outTravel unit vector along which the light travels
    double irradiance(const glm::dvec3& position, glm::dvec3& outTravel) const;
    render::ReferenceCamera camera() const;

private:
    /// Values of a cell: those of CloudPoint, and one that is not used.
    using Cell = std::array<float, 4>;

    void fill();
    void findSunDepths();
    void findLampDepths();

    std::vector<render::MediumBlob> blobs_;
    CloudLight light_;
    render::NetworkGrid grid_;
    std::vector<Cell> cells_;
};

/// Parameters of a network around a cloud.
struct CloudNetwork
{
    int cells = 32; ///< number of cells along an axis
    render::NetworkSettings settings;
    double albedo = 0.9; ///< [1]
};

/// Sets the medium and the light of a network to the medium and the light of a cloud, averaged over each
/// cell.
base::Status give(const LumpyCloud& cloud, const CloudNetwork& form, render::ScatteringNetwork& outNetwork);

/// Builds a network of the balls of a cloud, lit by the light of the cloud.
base::Status give(const LumpyCloud& cloud, const render::ParticleNetworkSettings& settings, double albedo,
                  render::ParticleNetwork& outNetwork, base::TaskRunner& tasks);

/// Light of the balls of a cloud at any place: the mean over the balls there, weighted by their extinction.
class BallLight
{
public:
    /// @param light [cd/m2] per optical depth, for each ball of the cloud
    BallLight(const LumpyCloud& cloud, std::span<const double> light);
    double at(const glm::dvec3& position) const; ///< [cd/m2] per optical depth

private:
    render::NetworkGrid grid_;
    std::vector<float> light_, extinction_; ///< sums over balls
};

/// Two pictures with independent noise for each of two albedos, rows from the top.
struct CloudTruth
{
    std::vector<double> light[2][2]; ///< [cd/m2] light[picture][albedo]
    std::vector<bool> isCovered;     ///< pixels with an opacity of at least 0.3
    double seconds = 0.0;            ///< [s] of both pictures
    double processorSeconds = 0.0;   ///< [s] processor time of all threads, for both pictures
};

/// Computes path-traced pictures. @param size [pixel] of both sides @param paths per pixel of each picture
/// @param stop see RenderCallbacks
base::Result<CloudTruth> tracedCloud(const LumpyCloud& cloud, const double (&albedos)[2], double anisotropy,
                                     int size, uint32_t paths, const std::function<bool()>& stop);

/// [1] Root mean square error of a picture over the covered pixels, relative to the mean of the true pictures
/// in these pixels. The error is computed from the product of the differences from both true pictures. The
/// noise of this product is zero on average.
double cloudError(const std::vector<double>& picture, const CloudTruth& truth, int albedo);

/// [s] Processor time in which the path tracer has a picture of one albedo with the given error. Its variance
/// is inversely proportional to its time. A path carries light of both albedos, so half of its time counts.
/// An error below two standard deviations of what cloudError() can tell counts as these, so that the time is
/// rather too short than too long. @param error [1] see cloudError()
double pathSeconds(const CloudTruth& truth, int albedo, double error);

} // namespace fx::cli
