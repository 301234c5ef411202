#include "foundation/assets/volume_sequence.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <new>
#include <set>
#include <thread>

using namespace fx;
using base::VolumeSequence;

namespace {

constexpr uint32_t kFrames = 10;

VolumeSequence::Volume volumeOf(uint32_t frame)
{
    base::VoxelVolume volume;
    volume.bricks = {{1, 1, 1}};
    volume.extinction.assign(base::kVolumeBrickVoxels, float(frame + 1));
    return std::make_shared<const base::VoxelVolume>(std::move(volume));
}

constexpr uint64_t kSlack = 64; ///< [byte] of upper bounds of levels

/// Stands for the coarser levels of a volume: one level, which has the extinction as its light.
base::CoarserLevels levelsOf(const base::VoxelVolume& volume)
{
    base::VolumeLevels levels{{{base::BrickIndex({}), 1, volume.extinction[0], {}}}};
    levels.coarser[0].voxels.resize(volume.extinction.size() / 8);
    return std::make_shared<const base::VolumeLevels>(std::move(levels));
}

/// A disk whose reading can be stopped, and which can lose a file.
struct Disk
{
    std::mutex mutex;
    std::atomic<int> reads{0};
    std::atomic<int> lost{-1};

    VolumeSequence::Def def(uint32_t memoryFrames, uint32_t held)
    {
        VolumeSequence::Def def;
        def.memory = memoryFrames * volumeOf(0)->bytes();
        for (uint32_t i = 0; i < kFrames; ++i)
            def.frames.push_back({base::volumeCells(*volumeOf(i)), volumeOf(i)->bytes()});
        for (uint32_t i = 0; i < held; ++i)
            def.held.push_back(volumeOf(i));
        def.read = [this](uint32_t frame) -> base::Result<VolumeSequence::Volume> {
            const std::scoped_lock lock(mutex);
            ++reads;
            if (int(frame) == lost)
                return base::Status(base::Code::NotFound, "frame " + std::to_string(frame) + " is lost");
            return volumeOf(frame);
        };
        return def;
    }

    /// @param made is called where levels are made
    VolumeSequence::Def withLevels(uint32_t memoryFrames, std::function<void()> made)
    {
        VolumeSequence::Def own = def(memoryFrames, 0);
        for (VolumeSequence::Frame& frame : own.frames)
            frame.coarserBytes = levelsOf(*volumeOf(0))->bytes() + kSlack / 2;
        own.makeCoarser = [=](const base::VoxelVolume& volume) {
            made();
            return levelsOf(volume);
        };
        return own;
    }
};

/// Whether a frame comes by itself.
bool comes(VolumeSequence& sequence, uint32_t frame)
{
    for (int i = 0; i < 2000; ++i) {
        if (const auto found = sequence.find(frame))
            return found->extinction[0] == float(frame + 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

bool levelsCome(VolumeSequence& sequence, uint32_t frame)
{
    for (int i = 0; i < 2000; ++i) {
        if (const base::CoarserLevels found = sequence.coarser(frame))
            return found->coarser[0].brightest == float(frame + 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

} // namespace

TEST(VolumeSequence, showsWhatIsHeldWithoutReading)
{
    Disk disk;
    VolumeSequence sequence(disk.def(kFrames, kFrames));
    for (uint32_t i = 0; i < kFrames; ++i) {
        sequence.prefetch(i);
        ASSERT_TRUE(sequence.find(i));
    }
    EXPECT_EQ(disk.reads, 0);
    EXPECT_EQ(sequence.counts().late, 0u);
    EXPECT_EQ(sequence.counts().bytes, kFrames * volumeOf(0)->bytes());
}

TEST(VolumeSequence, aLateFrameIsCountedAndNobodyWaitsForIt)
{
    Disk disk;
    VolumeSequence sequence(disk.def(4, 4));
    {
        const std::scoped_lock stopped(
            disk.mutex); // were find() or prefetch() to read, they would wait forever
        sequence.prefetch(6);
        EXPECT_FALSE(sequence.find(6));
        EXPECT_FALSE(sequence.find(7));
        EXPECT_EQ(sequence.counts().late, 2u);
    }
    EXPECT_TRUE(comes(sequence, 6));
    EXPECT_TRUE(comes(sequence, 7));
}

TEST(VolumeSequence, playsWithinItsMemoryAndReadsEachFrameOnce)
{
    Disk disk;
    VolumeSequence sequence(disk.def(4, 4));
    for (uint32_t i = 0; i < kFrames; ++i) {
        sequence.prefetch(i);
        ASSERT_TRUE(comes(sequence, i)) << i;
        ASSERT_TRUE(comes(sequence, (i + 1) % kFrames)) << i;
    }
    const VolumeSequence::Counts counts = sequence.counts();
    EXPECT_LE(counts.peakBytes, 4 * volumeOf(0)->bytes());
    EXPECT_GE(disk.reads, int(kFrames - 4));
    EXPECT_LE(disk.reads, int(kFrames + 3)) << "those of the end, and the first ones ahead of a loop";
}

TEST(VolumeSequence, waitingReadsAtOnceAndGivesTheSameVolume)
{
    Disk disk;
    VolumeSequence sequence(disk.def(3, 0));
    for (const uint32_t frame : {9u, 2u, 5u, 9u, 0u}) {
        const auto read = sequence.wait(frame);
        ASSERT_TRUE(read.ok());
        EXPECT_EQ(**read, *volumeOf(frame));
        EXPECT_EQ(sequence.find(frame), *read);
    }
    EXPECT_EQ(sequence.counts().late, 0u);
    EXPECT_LE(sequence.counts().peakBytes, 3 * volumeOf(0)->bytes());
}

TEST(VolumeSequence, aLostFrameIsAnErrorOnceAndOthersArePlayed)
{
    Disk disk;
    VolumeSequence sequence(disk.def(3, 0));
    disk.lost = 5;
    EXPECT_EQ(sequence.wait(5).status().message(), "frame 5 is lost");
    const int reads = disk.reads;
    for (int i = 0; i < 20; ++i)
        sequence.prefetch(4);
    EXPECT_TRUE(comes(sequence, 4));
    EXPECT_TRUE(comes(sequence, 6));
    EXPECT_FALSE(sequence.find(5));
    EXPECT_EQ(disk.reads, reads + 2) << "the lost one is not tried again and again";
    EXPECT_EQ(sequence.counts().failures, 1u);
}

TEST(VolumeSequence, itsThreadMakesCoarserLevelsWithinTheMemory)
{
    Disk disk;
    std::mutex mutex;
    std::set<std::thread::id> makers;
    VolumeSequence sequence(disk.withLevels(8, [&] {
        const std::scoped_lock lock(mutex);
        makers.insert(std::this_thread::get_id());
    }));
    sequence.prefetch(0);
    ASSERT_TRUE(comes(sequence, 1));
    EXPECT_FALSE(sequence.coarser(0)) << "nobody has asked for them";
    for (uint32_t i = 0; i < kFrames; ++i) {
        sequence.prefetch(i, true);
        ASSERT_TRUE(comes(sequence, i)) << i;
        ASSERT_TRUE(levelsCome(sequence, i)) << i;
        ASSERT_TRUE(levelsCome(sequence, (i + 1) % kFrames)) << i;
    }
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(makers.size(), 1u);
    EXPECT_FALSE(makers.contains(std::this_thread::get_id()));
    EXPECT_LE(sequence.counts().peakBytes, 8 * volumeOf(0)->bytes());
    const uint64_t ofOne = volumeOf(0)->bytes() + levelsOf(*volumeOf(0))->bytes();
    EXPECT_GE(sequence.counts().bytes, 2 * ofOne) << "levels count";
}

TEST(VolumeSequence, coarserLevelsOfTheFramesShownAreHeldWhateverTheMemory)
{
    Disk disk;
    VolumeSequence sequence(disk.withLevels(3, [] {}));
    for (uint32_t i = 0; i < kFrames; ++i)
        for (int again = 0; again < 2; ++again) { // also when the frames after them are read
            sequence.prefetch(i, true);
            ASSERT_TRUE(levelsCome(sequence, i)) << i;
            ASSERT_TRUE(levelsCome(sequence, (i + 1) % kFrames)) << i;
            ASSERT_TRUE(sequence.coarser(i)) << i;
        }
    EXPECT_LE(sequence.counts().peakBytes,
              3 * volumeOf(0)->bytes() + 2 * levelsOf(*volumeOf(0))->bytes() + kSlack);
}

TEST(VolumeSequence, framesThatAreShownAreReadOnceWhereLevelsAreLargerThanVoxels)
{
    Disk disk;
    VolumeSequence::Def def = disk.withLevels(3, [] {});
    for (VolumeSequence::Frame& frame : def.frames)
        frame.coarserBytes = 2 * frame.bytes;
    VolumeSequence sequence(std::move(def));
    for (int picture = 0; picture < 12; ++picture) { // of the same moment
        sequence.prefetch(0, true);
        ASSERT_TRUE(levelsCome(sequence, 0));
        ASSERT_TRUE(levelsCome(sequence, 1));
    }
    EXPECT_EQ(disk.reads, 2);
}

TEST(VolumeSequence, withoutMemoryForLevelsThereAreNoneAndVoxelsStay)
{
    Disk disk;
    VolumeSequence sequence(disk.withLevels(8, [] { throw std::bad_alloc(); }));
    sequence.setWaits(true);
    EXPECT_FALSE(sequence.coarser(3));
    EXPECT_TRUE(sequence.find(3));
    EXPECT_EQ(sequence.counts().bytes, volumeOf(0)->bytes());
}

TEST(VolumeSequence, aFrameThatIsFoundAgainHasLevels)
{
    Disk disk;
    disk.lost = 4;
    VolumeSequence sequence(disk.withLevels(8, [] {}));
    sequence.setWaits(true);
    EXPECT_FALSE(sequence.coarser(4));
    disk.lost = -1;
    ASSERT_TRUE(sequence.wait(4));
    EXPECT_TRUE(sequence.coarser(4));
}

TEST(VolumeSequence, aPictureThatWaitsHasItsCoarserLevelsAtOnce)
{
    Disk disk;
    std::atomic<int> made{0};
    VolumeSequence sequence(disk.withLevels(8, [&] { ++made; }));
    sequence.setWaits(true);
    for (const uint32_t frame : {9u, 2u, 9u, 3u}) {
        const base::CoarserLevels levels = sequence.coarser(frame);
        ASSERT_TRUE(levels);
        EXPECT_EQ(levels->coarser[0].brightest, float(frame + 1));
    }
    EXPECT_EQ(made, 3) << "those of frame 9 are still there";
    disk.lost = 5;
    EXPECT_FALSE(sequence.coarser(5)) << "and no wait without end";
}

TEST(VolumeSequence, endsWhileItReads)
{
    Disk disk;
    for (int i = 0; i < 50; ++i) {
        VolumeSequence sequence(disk.def(5, 0));
        sequence.prefetch(uint32_t(i) % kFrames);
    }
    for (int i = 0; i < 50; ++i) {
        VolumeSequence sequence(disk.withLevels(8, [] {}));
        sequence.prefetch(uint32_t(i) % kFrames, true);
    }
}

TEST(VolumeSequence, needsMemoryForThreeFrames)
{
    Disk disk;
    EXPECT_EQ(VolumeSequence(disk.def(3, 0)).leastMemory(), 3 * volumeOf(0)->bytes());
}
