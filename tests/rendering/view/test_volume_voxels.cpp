// Volumes that OpenGL draws from their voxels, against integrals through the same voxels.
#include "view_fixture.h"

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/frame/exposure.h"
#include "rendering/volumes/medium_volume.h"
#include "simulation/volume/volume_solver.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 48;
constexpr float kFieldOfView = 0.5f;
constexpr float kExposure = 8.0f; ///< [EV100]: voxels hold half floats of exposed light

class VolumeVoxelsTest : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        schema_.add(base::kVolumeKind);
        view_ =
            std::make_unique<render::ViewRenderer>(device_.get(), &schema_, std::pmr::get_default_resource());
        view_->setAssets(&assets_);
        render::ViewSettings& settings = view_->settings();
        settings.composition = render::Composition::Volume;
        settings.voxels = 128;
        settings.dazzle.enabled = false;
        settings.exposureEv100 = kExposure;
        settings.lighting.sunIlluminance = settings.lighting.skyLuminance = glm::vec3(0.0f);
        settings.slices.multiple = false;
        makeTargets(kSize, kSize);
        setPicture(std::vector<float>(size_t(kSize) * kSize * 4, 0.0f));
    }

    /// Two bricks along x whose medium, temperature, albedo and light differ from place to place. The medium
    /// fades towards the faces of the bricks.
    /// @param scatters whether it scatters, also the light of its own
    static base::VoxelVolume lumps(bool scatters = false)
    {
        base::VoxelVolume volume;
        volume.side = 0.1f;
        volume.origin = glm::vec3(-1.6f, -1.2f, -1.2f); // the middle of both bricks is the origin
        volume.bricks = {{1, 1, 1}, {2, 1, 1}};
        for (const glm::ivec3& brick : volume.bricks)
            for (int v = 0; v < 512; ++v) {
                const glm::vec3 p = glm::vec3(8 * brick + glm::ivec3(v % 8, v / 8 % 8, v / 64));
                const glm::vec3 fade =
                    glm::sin((p - 8.0f) * glm::vec3(1.0f / 15.0f, 1.0f / 7.0f, 1.0f / 7.0f) * 3.14159f);
                const float dense = std::max(fade.x * fade.y * fade.z, 0.0f) * (1.5f + std::sin(0.6f * p.x));
                volume.extinction.push_back(4.0f * dense);
                volume.temperature.push_back(1400.0f + 20.0f * p.y);
                volume.albedo.push_back(scatters ? glm::vec3(0.1f + 0.03f * p.x, 0.4f, 0.0f)
                                                 : glm::vec3(0.0f));
                volume.emission.push_back(dense * glm::vec3(0.0f, 30.0f * p.z, 800.0f));
            }
        return volume;
    }

    /// @param turned rotation of the effect  @param density of the preset
    base::FrameSnapshot publish(const base::VoxelVolume& voxels, const glm::quat& turned, float density)
    {
        def_.voxels = std::make_shared<const base::VoxelVolume>(voxels);
        def_.cells = base::volumeCells(voxels);
        def_.asset = *assets_.addVolume(def_.voxels, 5);
        def_.density = density;
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(0, ++sequence_);
        base::GroupInfo info;
        info.placement.rotation = turned;
        def_.create(schema_, {}, std::pmr::get_default_resource())->publish(info, snapshot);
        return snapshot;
    }

    render::CameraView camera(double distance) const
    {
        return render::perspectiveView({{0.0, 0.0, distance}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}},
                                       kFieldOfView, 1.0f, 0.1f);
    }

    /// RGBA of the integrals through the voxels along the rays of all pixels.
    static std::vector<double> integrals(const base::VoxelVolume& voxels, const glm::quat& turned,
                                         double density, double distance)
    {
        const render::MediumVolume volume(voxels);
        const glm::dmat3 back = glm::transpose(glm::dmat3(glm::mat3_cast(turned)));
        const double slope = std::tan(0.5 * double(kFieldOfView)), step = 0.02 * double(voxels.side);
        const auto exposure = double(render::exposureFromEv100(kExposure));
        std::vector<double> picture;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const glm::dvec3 ray = glm::normalize(glm::dvec3(
                    (2.0 * x + 1.0 - kSize) / kSize * slope, (2.0 * y + 1.0 - kSize) / kSize * slope, -1.0));
                double passed = 1.0;
                glm::dvec3 light(0.0);
                for (double t = distance - 1.6; t < distance + 1.6; t += step) {
                    const glm::dvec3 place = back * (glm::dvec3(0.0, 0.0, distance) + (t + 0.5 * step) * ray);
                    const auto sample = volume.at((place - glm::dvec3(voxels.origin)) / double(voxels.side));
                    const double passes = std::exp(-density * sample.extinction * step);
                    if (sample.extinction > 0.0)
                        light += passed * (1.0 - passes) / sample.extinction * sample.emitted * exposure;
                    passed *= passes;
                }
                picture.insert(picture.end(), {light.x, light.y, light.z, 1.0 - passed});
            }
        return picture;
    }

    /// The 99th percentile of the errors of each channel over its largest value.
    static void expectEqual(const Picture& picture, const std::vector<double>& wanted, double bound)
    {
        for (size_t channel = 0; channel < 4; ++channel) {
            std::vector<double> errors;
            double largest = 0.0;
            for (size_t i = channel; i < wanted.size(); i += 4) {
                errors.push_back(std::abs(double(picture.texels[i]) - wanted[i]));
                largest = std::max(largest, wanted[i]);
            }
            std::ranges::sort(errors);
            EXPECT_GT(largest, 0.0) << channel;
            EXPECT_LE(errors[errors.size() * 99 / 100], bound * largest) << "channel " << channel;
        }
    }

    base::AssetTable assets_{std::pmr::get_default_resource()};
    sim::VolumeDef def_;
};

} // namespace

TEST_F(VolumeVoxelsTest, areTheIntegralOfWhatTheyEmitAndAbsorb)
{
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    const Picture picture = render(publish(lumps(), upright, 1.0f), camera(5.0));
    expectEqual(picture, integrals(lumps(), upright, 1.0, 5.0), 0.01);
}

TEST_F(VolumeVoxelsTest, turnWithTheirInstance)
{
    const glm::quat turned = glm::angleAxis(0.7f, glm::normalize(glm::vec3(0.2f, 1.0f, -0.3f)));
    const Picture picture = render(publish(lumps(), turned, 0.5f), camera(5.0));
    expectEqual(picture, integrals(lumps(), turned, 0.5, 5.0), 0.06); // interpolated twice
}

TEST_F(VolumeVoxelsTest, farAwayHaveCoarserVoxelsOfTheSameMedium)
{
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    constexpr double kFar = 40.0; // a pixel is four voxels wide
    constexpr float kThin = 0.005f;
    const Picture picture = render(publish(lumps(true), upright, kThin), camera(kFar));
    const double pixel = 2.0 * std::tan(0.5 * double(kFieldOfView)) * kFar / kSize; // [m]
    const base::VoxelVolume voxels = lumps(true);
    const render::MediumVolume volume(voxels);
    glm::dvec4 wanted(0.0); // a thin medium covers its cross section, and nothing hides its light
    for (const glm::ivec3& brick : voxels.bricks)
        for (int v = 0; v < 512; ++v) {
            const auto sample = volume.at(glm::dvec3(8 * brick + glm::ivec3(v % 8, v / 8 % 8, v / 64)));
            wanted +=
                glm::dvec4(sample.emitted * double(render::exposureFromEv100(kExposure)), sample.extinction);
        }
    wanted *= double(kThin) * std::pow(double(voxels.side), 3.0) / (pixel * pixel);
    for (int channel = 0; channel < 4; ++channel) {
        double seen = 0.0;
        for (size_t i = size_t(channel); i < picture.texels.size(); i += 4)
            seen += double(picture.texels[i]);
        EXPECT_NEAR(seen, wanted[channel], 0.03 * wanted[channel]) << "channel " << channel;
    }
}
