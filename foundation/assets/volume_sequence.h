/// @file volume_sequence.h
/// Numbered volumes that are shown one after another. Their voxels come and go within a budget of memory.
///
/// The cells of all frames are known from the beginning, so that a simulation never waits for a disk. Voxels
/// are read by a thread of the sequence, which starts when a frame is first missing. The same thread makes
/// the coarser levels of frames that are drawn small. Threads: any.
#pragma once

#include "foundation/assets/volume_lattice.h"
#include "foundation/assets/volume_levels.h"
#include "foundation/assets/voxel_volume.h"
#include "foundation/result/status.h"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace fx::base {

constexpr uint32_t kMaxSequenceFrames = 4096;
/// [1] of sides of voxels of two frames: with it, a frame needs 3.4 times its bricks on the finer lattice.
constexpr double kMostSideRatio = 1.5;

class VolumeSequence
{
public:
    using Volume = std::shared_ptr<const VoxelVolume>;
    /// Reads the voxels of a frame. One thread at a time calls it for each call of wait(), and one for all
    /// others. The error names the file.
    using Read = std::function<Result<Volume>(uint32_t frame)>;
    /// Makes the coarser levels of a frame. The thread of the sequence calls it.
    using MakeCoarser = std::function<CoarserLevels(const VoxelVolume&)>;

    struct Frame
    {
        std::vector<VolumeCells> cells; ///< volumeCells() of the voxels
        uint64_t bytes = 0;             ///< [byte] VoxelVolume::bytes()
        uint64_t coarserBytes = 0;      ///< [byte] upper bound of its coarser levels
        /// Of its voxels. It has room for the bricks of the frames before and behind, see isNear().
        VolumeLattice lattice = {};
    };

    struct Def
    {
        bool hasVelocities = true; ///< false: a frame has none
        /// [byte] upper bound of the voxels of all frames that are held, with their coarser levels. Those of
        /// the two frames that are shown are held even if they do not fit. If those of three frames do not
        /// fit with the levels that are needed, the next frame is not read ahead.
        uint64_t memory = 0;
        std::vector<Frame> frames;
        std::vector<Volume> held; ///< of the first frames; together at most `memory`
        Read read;
        MakeCoarser makeCoarser; ///< null: there are no coarser levels
    };

    struct Counts
    {
        uint64_t reads = 0;    ///< frames that were read again
        uint64_t late = 0;     ///< calls of find() for a frame that was not there
        uint64_t failures = 0; ///< frames that could not be read again; they are not tried again
        uint64_t bytes = 0;    ///< [byte] of the frames and levels that are held or being made
        uint64_t peakBytes = 0;
    };

    explicit VolumeSequence(Def def);
    ~VolumeSequence(); ///< waits for the frame that is being read
    VolumeSequence(const VolumeSequence&) = delete;
    VolumeSequence& operator=(const VolumeSequence&) = delete;

    uint32_t count() const { return uint32_t(def_.frames.size()); }
    const std::vector<VolumeCells>& cells(uint32_t frame) const { return def_.frames[frame].cells; }
    uint64_t bytes(uint32_t frame) const { return def_.frames[frame].bytes; } ///< [byte] of the voxels
    const VolumeLattice& lattice(uint32_t frame) const { return def_.frames[frame].lattice; }
    bool hasOneLattice() const { return hasOneLattice_; }
    double largestSide() const { return largestSide_; } ///< [m] of a voxel
    /// Whether a frame is shown on the lattice of another: voxels may be larger than there, but not so much
    /// that too many bricks would be needed.
    static bool isNear(const VolumeLattice& lattice, const VolumeLattice& frame)
    {
        return frame.side <= kMostSideRatio * lattice.side;
    }
    bool hasVelocities() const { return def_.hasVelocities; }
    uint64_t memory() const { return def_.memory; }
    /// [byte] Memory below which no frame can be read ahead: that of the largest three successive frames.
    uint64_t leastMemory() const;
    static uint64_t leastMemory(const std::vector<Frame>& frames);

    /// The voxels of a frame, or null if they are not there yet or cannot be read. Never waits for a disk.
    Volume find(uint32_t frame);
    /// Starts to read `frame` and those that follow it, as many as the memory holds; after the last one
    /// follows the first one. Frames that were not asked for for the longest time make room.
    /// @param withCoarser whether their coarser levels are needed too
    void prefetch(uint32_t frame, bool withCoarser = false);
    /// The coarser levels of a frame, or null if they are not there. Never waits, unless waits() is true:
    /// then they are made by the thread of the sequence meanwhile, and null means that the frame cannot be
    /// read or that there are no coarser levels.
    CoarserLevels coarser(uint32_t frame);
    /// For pictures that must not depend on time. @param waits see coarser(); the default is false
    void setWaits(bool waits);
    bool waits() const; ///< false if there are no coarser levels
    /// The voxels of a frame, which are read on this thread if they are not there. @return errors of Read
    Result<Volume> wait(uint32_t frame);
    Counts counts() const;
    /// Number of frames that all sequences of the process have read. Pictures of the same moment may differ
    /// after it has changed.
    static uint64_t readsOfAll();

private:
    struct Slot
    {
        Volume volume;
        uint64_t lastUse = 0;
        bool isReading = false, isQueued = false;
        bool hasFailed = false; ///< the voxels cannot be read, or there is no memory for coarser levels
        CoarserLevels coarser;
        uint64_t coarserBytes = 0; ///< [byte] that are counted for `coarser`
        bool wantsCoarser = false, isMakingCoarser = false;

        /// Whether there is work for the thread.
        bool isIncomplete() const
        {
            return !hasFailed && (volume ? wantsCoarser && !coarser && !isMakingCoarser : !isReading);
        }
    };

    void startReader();
    void runReader();
    void makeCoarser(uint32_t frame, std::unique_lock<std::mutex>& lock);
    Result<Volume> readInto(uint32_t frame, std::unique_lock<std::mutex>& lock);
    void makeRoom(uint64_t bytes);

    Def def_; ///< constant after construction
    bool hasOneLattice_ = true;
    double largestSide_ = 0.0;
    mutable std::mutex mutex_; ///< guards everything below
    std::condition_variable changed_;
    std::vector<Slot> slots_;
    std::deque<uint32_t> queue_; ///< to be read
    Counts counts_;
    uint64_t uses_ = 0;
    uint32_t shown_ = 0; ///< frame of the last prefetch() or wait()
    bool isEnding_ = false, waits_ = false;
    std::thread reader_;
};

} // namespace fx::base
