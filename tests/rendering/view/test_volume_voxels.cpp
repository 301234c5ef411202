// Volumes that OpenGL draws from their voxels, against integrals through the same voxels.
#include "volume_voxels_fixture.h"

#include <chrono>
#include <thread>

using namespace fx;
using namespace fx::test;

TEST_F(VolumeVoxelsTest, areTheIntegralOfWhatTheyEmitAndAbsorb)
{
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    const Picture picture = render(publish(lumps(), upright, 1.0f), camera(5.0));
    expectEqual(picture, integrals(lumps(), upright, 1.0, 5.0), 0.01);
}

TEST_F(VolumeVoxelsTest, mayBeMoreThanABufferHolds)
{
    GLint buffer = 0; // [byte]
    device_->gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &buffer);
    if (buffer > 1 << 28)
        GTEST_SKIP() << "the driver's buffers hold more voxels than a test has memory for";
    const base::VoxelVolume seen = lumps();
    const size_t bytes = base::kVolumeBrickVoxels * sizeof(render::MediumVolume::Packed);
    const size_t empty = size_t(buffer) / bytes + 300; // bricks beside the view; amid a layer of the texture
    base::VoxelVolume voxels;
    voxels.side = seen.side;
    for (int i = 0; voxels.bricks.size() < empty; ++i)
        voxels.bricks.push_back({40 + i % 26, 1 + i / 26 % 26, 1 + i / (26 * 26)});
    const glm::ivec3 farther(0, 0, voxels.bricks.back().z);
    for (const glm::ivec3& brick : seen.bricks)
        voxels.bricks.push_back(brick + farther);
    voxels.origin = seen.origin - seen.side * float(base::kVolumeBrickSide) * glm::vec3(farther);
    const auto behindEmpty = [&](const auto& values) {
        std::remove_cvref_t<decltype(values)> all(empty * base::kVolumeBrickVoxels);
        all.insert(all.end(), values.begin(), values.end());
        return all;
    };
    voxels.extinction = behindEmpty(seen.extinction);
    voxels.temperature = behindEmpty(seen.temperature);
    voxels.albedo = behindEmpty(seen.albedo);
    voxels.emission = behindEmpty(seen.emission);
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    const Picture picture = render(publish(voxels, upright, 1.0f), camera(5.0));
    expectEqual(picture, integrals(seen, upright, 1.0, 5.0), 0.01);
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
        std::vector<base::VoxelVolume> even = frames;
        for (base::VoxelVolume& frame : even)
            frame.emissionRate.clear();
        even.push_back(even.back()); // another sequence
        const Picture dark = renderAlone(publishBetween(even, 3, base::toTicks(part * kFrameSeconds)));
        EXPECT_LT(sumOf(dark, 2), 0.9 * sumOf(picture, 2)) << "without rates it does not get brighter";
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
