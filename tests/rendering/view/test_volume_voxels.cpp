// Volumes that OpenGL draws from their voxels, against integrals through the same voxels.
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

using namespace fx;
using namespace fx::test;

namespace {

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
        def.side = frames[0].side;
        def.origin = frames[0].origin;
        def.memory = memory * frames[0].bytes();
        for (const base::VoxelVolume& frame : frames) {
            def.frames.push_back({base::volumeCells(frame), frame.bytes(),
                                  render::mostCoarserBytes(frame.bricks, !frame.velocity.empty())});
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

    /// The lumps, and the same two voxels farther along y and thinner, with the velocity of that.
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

} // namespace

TEST_F(VolumeVoxelsTest, areTheIntegralOfWhatTheyEmitAndAbsorb)
{
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    const Picture picture = render(publish(lumps(), upright, 1.0f), camera(5.0));
    expectEqual(picture, integrals(lumps(), upright, 1.0, 5.0), 0.01);
}

TEST_F(VolumeVoxelsTest, ofSootHideTheFireBehindThem)
{
    base::VoxelVolume voxels = lumps();
    for (size_t v = 0; v < voxels.extinction.size(); ++v)
        if (v % 512 / 64 >= 6) { // two layers before the eye
            voxels.temperature[v] = 900.0f + 100.0f * float(v % 512 / 8 % 8);
            voxels.emission[v] = glm::vec3(0.0f, 0.0f, 0.02f * voxels.emission[v].z);
        }
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    constexpr float kDense = 100.0f; // optical depths of up to 100 a voxel
    const Picture picture = render(publish(voxels, upright, kDense), camera(5.0));
    expectEqual(picture, integrals(voxels, upright, double(kDense), 5.0), 0.05);
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

TEST_F(VolumeVoxelsTest, aViewMakesNoCoarserVoxelsItself)
{
    const auto pictureOf = [&](const base::CoarserLevels& coarser, uint64_t hash) {
        base::FrameSnapshot snapshot = publish(lumps(), {1, 0, 0, 0}, 0.005f);
        // another asset of the same medium, with other coarser voxels
        base::VoxelVolume own = lumps();
        own.evenAlbedo = glm::vec3(0.01f * float(hash));
        const auto id =
            *assets_.addVolume(std::make_shared<const base::VoxelVolume>(std::move(own)), hash, coarser);
        snapshot.editGroup(1).editConstants()[base::volume_constant::Asset] = float(id);
        return renderAlone(snapshot, kFar);
    };
    base::VoxelVolume half = lumps();
    for (float& extinction : half.extinction)
        extinction *= 0.5f;
    const Picture whole = pictureOf(render::coarserLevels(lumps()), 10);
    const Picture thin = pictureOf(render::coarserLevels(half), 11);
    const Picture fine = pictureOf(nullptr, 12);
    ASSERT_GT(sumOf(whole, 3), 0.0);
    EXPECT_NEAR(sumOf(thin, 3) / sumOf(whole, 3), 0.5, 0.01) << "the voxels that came with the volume";
    EXPECT_NE(fine.texels, whole.texels);
    EXPECT_NEAR(sumOf(fine, 3) / sumOf(whole, 3), 1.0, 0.3) << "its own, of which rays miss some";
}

TEST_F(VolumeVoxelsTest, ofASequenceAreFineUntilItsThreadHasMadeCoarserOnes)
{
    std::vector<base::VoxelVolume> frames = movingLumps();
    for (base::VoxelVolume& frame : frames)
        frame.velocity.clear();
    const Picture wanted = renderAlone(publish(frames[1], {1, 0, 0, 0}, 1.0f), kFar);
    const base::Ticks tick = base::toTicks(kFrameSeconds);
    Picture early;
    {
        const std::scoped_lock stopped(disk_);
        early = renderAlone(publishBetween(frames, 3, tick), kFar);
    }
    EXPECT_NE(early.texels, wanted.texels);
    EXPECT_NEAR(sumOf(early, 3) / sumOf(wanted, 3), 1.0, 0.4) << "rays miss some voxels";
    for (int i = 0; i < 2000 && !played_.sequence->coarser(1); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(renderAlone(publishBetween(frames, 3, tick), kFar).texels, wanted.texels) << "bit for bit";
    const std::scoped_lock lock(disk_);
    EXPECT_FALSE(hasHalvedHere_);
}

TEST_F(VolumeVoxelsTest, ofAPictureThatWaitsAreCoarseAtOnce)
{
    std::vector<base::VoxelVolume> frames = movingLumps();
    const base::Ticks tick = base::toTicks(0.5 * kFrameSeconds);
    static_cast<void>(renderAlone(publishBetween(frames, 3, tick), kFar)); // has them made
    for (const uint32_t frame : {0u, 1u})
        for (int i = 0; i < 2000 && !played_.sequence->coarser(frame); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Picture later = renderAlone(publishBetween(frames, 3, tick), kFar);
    frames.push_back(frames.back()); // another sequence
    const base::FrameSnapshot snapshot = publishBetween(frames, 4, tick);
    played_.sequence->setWaits(true);
    EXPECT_EQ(renderAlone(snapshot, kFar).texels, later.texels);
    const std::scoped_lock lock(disk_);
    EXPECT_FALSE(hasHalvedHere_);
}

TEST_F(VolumeVoxelsTest, betweenTwoFramesAreTheMomentOfTheReference)
{
    const std::vector<base::VoxelVolume> frames = movingLumps();
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    for (const double part : {0.25, 0.5}) {
        const Picture picture = renderAlone(publishBetween(frames, 3, base::toTicks(part * kFrameSeconds)));
        const auto between = render::MediumVolume::between(
            render::MediumVolume(frames[0]), render::MediumVolume(frames[1]), {part, kFrameSeconds});
        expectEqual(picture, integrals(between, frames[0], upright, 1.0, 5.0), 0.01);
        const auto faded = render::MediumVolume::between(render::MediumVolume(frames[0]),
                                                         render::MediumVolume(frames[1]), {part, 0.0});
        const std::vector<double> other = integrals(faded, frames[0], upright, 1.0, 5.0);
        double difference = 0.0, largest = 0.0;
        for (size_t i = 3; i < other.size(); i += 4) {
            difference = std::max(difference, std::abs(other[i] - double(picture.texels[i])));
            largest = std::max(largest, other[i]);
        }
        EXPECT_GT(difference, 0.03 * largest) << "a cross-fade is another picture";
    }
}

TEST_F(VolumeVoxelsTest, ofALateFrameAreItsBallsUntilItIsRead)
{
    std::vector<base::VoxelVolume> frames = movingLumps();
    frames.insert(frames.end(), 4, frames[1]);
    const base::Ticks tick = base::toTicks(4.0 * kFrameSeconds);
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    const std::vector<double> wanted = integrals(frames[1], upright, 1.0, 5.0);
    std::vector<double> late(wanted.size());
    {
        const std::scoped_lock stopped(disk_);
        const Picture picture = renderAlone(publishBetween(frames, 3, tick));
        EXPECT_EQ(played_.sequence->counts().late, 1u);
        double opacity = 0.0, error = 0.0, all = 0.0;
        for (size_t i = 3; i < wanted.size(); i += 4) {
            opacity += double(picture.texels[i]);
            error += std::abs(double(picture.texels[i]) - wanted[i]);
            all += wanted[i];
        }
        EXPECT_NEAR(opacity, all, 0.5 * all) << "the medium is there";
        EXPECT_GT(error, 0.05 * all) << "but is blurred";
    }
    for (int i = 0; i < 2000 && !played_.sequence->find(4); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    expectEqual(renderAlone(publishBetween(frames, 3, tick)), wanted, 0.01);
}

TEST_F(VolumeVoxelsTest, withDetailAreTheIntegralOfTheErodedVoxels)
{
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    for (const auto& [dense, softening] : {std::pair(3.0f, 0.0f), std::pair(0.2f, 1.0f)}) {
        def_.detail.given = false;
        const Picture smooth = renderAlone(publish(lumps(), upright, dense));
        def_.detail = {.given = true, .billowSize = 0.7f, .crispness = 0.7f, .softening = softening};
        const base::FrameSnapshot snapshot = publish(lumps(), upright, dense);
        const Picture picture = renderAlone(snapshot);
        const Eroded medium = eroded(snapshot, std::make_shared<const render::MediumVolume>(lumps()), 5.0);
        const std::vector<double> wanted =
            integrals([&](const glm::dvec3& place) { return medium.at(place); }, 0.01, 5.0);
        expectEqual(picture, wanted, 0.04); // rays are sampled in lumps finer than voxels
        double change = 0.0, all = 0.0;
        for (size_t i = 3; i < wanted.size(); i += 4) {
            change += std::abs(double(smooth.texels[i]) - wanted[i]);
            all += double(smooth.texels[i]);
        }
        EXPECT_GT(change, 0.1 * all) << "billows are seen";
    }
}

TEST_F(VolumeVoxelsTest, detailOfASequenceErodesTheMomentBetweenFrames)
{
    const std::vector<base::VoxelVolume> frames = movingLumps();
    played_.detail = {.given = true, .billowSize = 0.7f};
    const base::FrameSnapshot snapshot = publishBetween(frames, 3, base::toTicks(0.5 * kFrameSeconds));
    const auto between = std::make_shared<const render::MediumVolume>(render::MediumVolume::between(
        render::MediumVolume(frames[0]), render::MediumVolume(frames[1]), {0.5, kFrameSeconds}));
    const Eroded medium = eroded(snapshot, between, 5.0);
    const auto mediumAt = [&](const glm::dvec3& place) { return medium.at(place); };
    expectEqual(renderAlone(snapshot), integrals(mediumAt, 0.01, 5.0), 0.04);
}

TEST_F(VolumeVoxelsTest, detailStaysWhereItIsInAnInstanceThatMoves)
{
    def_.detail = {.given = true};
    const base::FrameSnapshot here = publish(lumps(), {1, 0, 0, 0}, 3.0f);
    base::FrameSnapshot there = publish(lumps(), {1, 0, 0, 0}, 3.0f);
    const glm::dvec3 way(700.0, -31.0, 12.5);
    for (size_t g = 0; g < there.groupCount(); ++g)
        there.editGroup(g).editInfo().placement.position = way;
    const Picture before = renderAlone(here);
    setPicture(std::vector<float>(size_t(kSize) * kSize * 4, 0.0f));
    const Picture after =
        render(there, render::perspectiveView({way + glm::dvec3(0, 0, 5), way, {0.0f, 1.0f, 0.0f}},
                                              kFieldOfView, 1.0f, 0.1f));
    double difference = 0.0;
    for (size_t i = 3; i < before.texels.size(); i += 4)
        difference = std::max(difference, double(std::abs(before.texels[i] - after.texels[i])));
    EXPECT_LT(difference, 0.01);
}

TEST_F(VolumeVoxelsTest, aTintOfTheInstanceFiltersTheLightOfVoxels)
{
    const base::FrameSnapshot plain = publish(lumps(), {1, 0, 0, 0}, 1.0f);
    base::FrameSnapshot red = publish(lumps(), {1, 0, 0, 0}, 1.0f);
    for (const size_t shade : {base::blob_constant::ShadeG, base::blob_constant::ShadeB})
        red.editGroup(0).editConstants()[shade] = 1.0f;
    const std::vector<float> before = renderAlone(plain).texels, after = renderAlone(red).texels;
    float brightest = 0.0f, greenest = 0.0f;
    for (size_t i = 0; i < before.size(); i += 4) {
        EXPECT_NEAR(after[i], before[i], 1e-5f);
        EXPECT_EQ(after[i + 1], 0.0f);
        EXPECT_EQ(after[i + 2], 0.0f);
        brightest = std::max(brightest, before[i]);
        greenest = std::max(greenest, before[i + 1]);
    }
    EXPECT_GT(brightest, 0.01f);
    EXPECT_GT(greenest, 0.01f);
}
