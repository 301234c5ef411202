/// @file lumpy_cloud.h
/// A cloud of 600 balls in 40 lumps within 1.08 m of the origin, lit from one side or from inside: what
/// illumination networks are measured on, and path traced pictures of it.
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/network/scattering_network.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/render/reference_camera.h"

#include <functional>
#include <vector>

namespace fx::cli {

constexpr double kCloudHalf = 1.08;      ///< [m] of the box around the cloud
constexpr double kCloudLampRadius = 0.1; ///< [m] of the glow in the middle

/// Where the light of a cloud comes from, as its eye sees it. Sunlight has an illuminance of 1 and travels
/// along -z; the lamp in the middle has an intensity of 1.
enum class CloudLight
{
    Front,
    Side,
    Back,
    Inside
};

/// The medium, and fine grids of its extinction and of the optical depth of its light.
class LumpyCloud
{
public:
    /// @param depth [1] mean through the middle along z  @param fine cells of the grids along an axis
    /// @param spread [1] of the lumps: 1 at rest, less before an explosion
    LumpyCloud(double depth, CloudLight light, int fine, double spread = 1.0);

    /// Without albedo and phase.
    const std::vector<render::MediumBlob>& blobs() const { return blobs_; }
    CloudLight light() const { return light_; }
    const render::NetworkGrid& grid() const { return grid_; }
    double extinction(const glm::dvec3& position) const; ///< [1/m]
    double lightDepth(const glm::dvec3& position) const; ///< [1] between light and place
    double lineDepth(const glm::dvec3& position) const;  ///< [1] of the whole line of the light
    /// [lx] without medium. @param outTravel unit, the way of the light
    double irradiance(const glm::dvec3& position, glm::dvec3& outTravel) const;
    render::ReferenceCamera camera() const;

private:
    void fill();
    void findSunDepths();
    void findLampDepths();

    std::vector<render::MediumBlob> blobs_;
    CloudLight light_;
    render::NetworkGrid grid_;
    std::vector<float> extinction_, lightDepth_, lineDepth_;
};

/// A network around a cloud.
struct CloudNetwork
{
    int cells = 32; ///< along an axis
    render::NetworkSettings settings;
    double albedo = 0.9; ///< [1]
};

/// Gives a network the medium and the light of a cloud, each the mean over its cells.
base::Status give(const LumpyCloud& cloud, const CloudNetwork& form, render::ScatteringNetwork& outNetwork);

/// Two pictures of each of two albedos, rows from the top. Their noise is independent.
struct CloudTruth
{
    std::vector<double> light[2][2]; ///< [cd/m2] of a picture and an albedo
    std::vector<bool> isCovered;     ///< opacity of 0.3 and more
    double seconds = 0.0;
};

/// By paths of any length. @param size [pixel] of both sides  @param paths of a pixel of each picture
/// @param stop see RenderCallbacks
base::Result<CloudTruth> tracedCloud(const LumpyCloud& cloud, const double (&albedos)[2], double anisotropy,
                                     int size, uint32_t paths, const std::function<bool()>& stop);

/// [1] root mean square difference of a picture over the covered pixels, relative to their mean. The
/// product of the differences to both pictures has no noise on average.
double cloudError(const std::vector<double>& picture, const CloudTruth& truth, int albedo);

} // namespace fx::cli
