/// @file volume_voxels_fixture.h
/// Volumes and sequences of volumes that a view draws from their voxels, and integrals through them.
#pragma once

#include "view_fixture.h"

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/frame/exposure.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/volumes/volume_levels.h"
#include "simulation/volume/sequence_solver.h"
#include "simulation/volume/volume_solver.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

namespace fx::test {

constexpr int kSize = 48;
constexpr float kFieldOfView = 0.5f;
constexpr double kFrameSeconds = 0.05;
constexpr double kFar = 40.0;     ///< [m] where a pixel is four voxels wide
constexpr float kExposure = 8.0f; ///< [EV100]: voxels hold half floats of exposed light

class VolumeVoxelsTest : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        schema_.add(base::kMaterialKind);
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
        def_.asset = *assets_.addVolume(def_.voxels, 5, render::coarserLevels(voxels));
        def_.density = density;
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(0, ++sequence_);
        base::GroupInfo info;
        info.placement.rotation = turned;
        def_.create(schema_, {}, std::pmr::get_default_resource())->publish(info, snapshot);
        return snapshot;
    }

    static base::VolumeLattice latticeOf(const base::VoxelVolume& volume)
    {
        return {glm::dvec3(volume.origin), double(volume.side)};
    }

    /// The medium of a snapshot as the reference renderer sees it, eroded by its detail.
    struct Eroded
    {
        render::DetailedMedium medium;
        glm::dvec3 eye;

        render::MediumVolume::Sample at(const glm::dvec3& place) const
        {
            return medium.volumeAt(0, place - eye);
        }
    };
    Eroded eroded(const base::FrameSnapshot& snapshot,
                  const std::shared_ptr<const render::MediumVolume>& volume, double distance) const
    {
        const render::MediumList list =
            render::mediumOf({&snapshot, nullptr}, 1.0, [&](const render::GroupVolume&) { return volume; });
        auto eyeCamera = render::ReferenceCamera::lookAt({0.0, 0.0, distance}, {}, {0.0, 1.0, 0.0});
        eyeCamera.halfHeight = std::tan(0.5 * double(kFieldOfView));
        render::MediumDetails details = list.details;
        details.balls.clear();
        return {{details, render::BallTree(), eyeCamera.eye, {eyeCamera, kSize}}, eyeCamera.eye};
    }

    /// A sequence at a time. @param memory for how many frames, of which the first ones are held
    base::FrameSnapshot publishBetween(const std::vector<base::VoxelVolume>& frames, uint32_t memory,
                                       base::Ticks tick)
    {
        base::VolumeSequence::Def def;
        def.memory = memory * frames[0].bytes();
        for (const base::VoxelVolume& frame : frames) {
            def.frames.push_back({base::volumeCells(frame), frame.bytes(),
                                  render::mostCoarserBytes(frame.bricks, !frame.velocity.empty()),
                                  latticeOf(frame)});
            if (def.held.size() < memory)
                def.held.push_back(std::make_shared<const base::VoxelVolume>(frame));
            def.hasVelocities = def.hasVelocities && !frame.velocity.empty();
        }
        def.read = [=, this](uint32_t frame) -> base::Result<base::VolumeSequence::Volume> {
            const std::scoped_lock lock(disk_);
            return std::make_shared<const base::VoxelVolume>(frames[frame]);
        };
        def.makeCoarser = [this](const base::VoxelVolume& voxels) {
            const std::scoped_lock lock(disk_);
            hasHalvedHere_ = hasHalvedHere_ || std::this_thread::get_id() == here_;
            return render::coarserLevels(voxels);
        };
        played_.setSequence(std::make_shared<base::VolumeSequence>(std::move(def)));
        played_.asset = *assets_.addSequence(played_.sequence, 6 + frames.size());
        played_.framesPerSecond = float(1.0 / kFrameSeconds);
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(tick, ++sequence_);
        const auto solver = played_.create(schema_, {}, std::pmr::get_default_resource());
        solver->seekable()->seek({}, tick);
        solver->publish({}, snapshot);
        return snapshot;
    }

    /// Before a black background.
    Picture renderAlone(const base::FrameSnapshot& snapshot, double distance = 5.0)
    {
        setPicture(std::vector<float>(size_t(kSize) * kSize * 4, 0.0f));
        return render(snapshot, camera(distance));
    }

    static double sumOf(const Picture& picture, size_t channel)
    {
        double sum = 0.0;
        for (size_t i = channel; i < picture.texels.size(); i += 4)
            sum += double(picture.texels[i]);
        return sum;
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
        return integrals(render::MediumVolume(voxels), voxels, turned, density, distance);
    }
    static std::vector<double> integrals(const render::MediumVolume& volume, const base::VoxelVolume& voxels,
                                         const glm::quat& turned, double density, double distance)
    {
        const glm::dmat3 back = glm::transpose(glm::dmat3(glm::mat3_cast(turned)));
        return integrals(
            [&](const glm::dvec3& place) {
                auto sample = volume.at((back * place - glm::dvec3(voxels.origin)) / double(voxels.side));
                sample.extinction *= density;
                sample.emitted *= density;
                return sample;
            },
            0.02 * double(voxels.side), distance);
    }
    /// @param mediumAt of a place [m]  @param step [m]
    template <class MediumAt>
    static std::vector<double> integrals(const MediumAt& mediumAt, double step, double distance)
    {
        const double slope = std::tan(0.5 * double(kFieldOfView));
        const auto exposure = double(render::exposureFromEv100(kExposure));
        std::vector<double> picture;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const glm::dvec3 ray = glm::normalize(glm::dvec3(
                    (2.0 * x + 1.0 - kSize) / kSize * slope, (2.0 * y + 1.0 - kSize) / kSize * slope, -1.0));
                double passed = 1.0;
                glm::dvec3 light(0.0);
                for (double t = distance - 1.6; t < distance + 1.6; t += step) {
                    const render::MediumVolume::Sample sample =
                        mediumAt(glm::dvec3(0.0, 0.0, distance) + (t + 0.5 * step) * ray);
                    const double passes = std::exp(-sample.extinction * step);
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
            EXPECT_LE(errors[errors.size() * 99 / 100] / largest, bound) << "channel " << channel;
        }
    }

    /// The lumps, and the same two voxels farther along y and thinner, with the velocity of that. They get
    /// brighter and darker again.
    static std::vector<base::VoxelVolume> movingLumps()
    {
        base::VoxelVolume first = lumps(), second = first;
        const glm::vec3 velocity(0.0f, 2.0f * first.side / float(kFrameSeconds), 0.0f);
        first.velocity.assign(first.extinction.size(), velocity);
        second.velocity = first.velocity;
        for (size_t v = 0; v < second.extinction.size(); ++v) {
            const bool isThere = v % 512 / 8 % 8 >= 2;
            const size_t from = isThere ? v - 16 : v;
            second.extinction[v] = isThere ? 0.5f * first.extinction[from] : 0.0f;
            second.emission[v] = isThere ? 2.0f * first.emission[from] : glm::vec3(0.0f);
            second.albedo[v] = first.albedo[from];
            second.temperature[v] = 1500.0f;
            first.emissionRate.push_back(40.0f + 3.0f * float(v % 8));
            second.emissionRate.push_back(isThere ? -2.0f * first.emissionRate[from] : 0.0f);
        }
        return {first, second, first};
    }

    std::mutex disk_; ///< held: nothing can be read and no coarser voxels made
    const std::thread::id here_ = std::this_thread::get_id(); ///< [GL thread]
    bool hasHalvedHere_ = false;                              ///< guarded by disk_
    base::AssetTable assets_{std::pmr::get_default_resource()};
    sim::VolumeDef def_;
    sim::SequenceDef played_;
};

} // namespace fx::test
