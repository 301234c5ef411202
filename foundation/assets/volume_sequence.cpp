#include "foundation/assets/volume_sequence.h"

#include <algorithm>
#include <atomic>
#include <new>

namespace fx::base {

namespace {

std::atomic<uint64_t> readsOfProcess{0};

/// Calls f(), on a thread that no exception may leave.
template <class T, class F>
Result<T> unlessOutOfMemory(F&& f)
{
    try {
        return f();
    } catch (const std::bad_alloc&) {
        return Status(Code::OutOfMemory, "there is no memory for a frame of a volume");
    }
}

} // namespace

uint64_t VolumeSequence::readsOfAll()
{
    return readsOfProcess.load(std::memory_order_acquire);
}

VolumeSequence::VolumeSequence(Def def) : def_(std::move(def)), slots_(def_.frames.size())
{
    for (size_t i = 0; i < std::min(def_.held.size(), slots_.size()); ++i) {
        slots_[i].volume = def_.held[i];
        counts_.bytes += def_.held[i] ? def_.frames[i].bytes : 0;
    }
    counts_.peakBytes = counts_.bytes;
    def_.held = {};
    for (uint32_t i = 0; i < count(); ++i) {
        hasOneLattice_ = hasOneLattice_ && lattice(i) == lattice(0);
        largestSide_ = std::max(largestSide_, lattice(i).side);
    }
}

VolumeSequence::~VolumeSequence()
{
    {
        const std::scoped_lock lock(mutex_);
        isEnding_ = true;
    }
    changed_.notify_all();
    if (reader_.joinable())
        reader_.join();
}

uint64_t VolumeSequence::leastMemory(const std::vector<Frame>& frames)
{
    uint64_t most = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
        uint64_t sum = 0;
        for (size_t k = 0; k < std::min(frames.size(), size_t(3)); ++k)
            sum += frames[(i + k) % frames.size()].bytes;
        most = std::max(most, sum);
    }
    return most;
}

uint64_t VolumeSequence::leastMemory() const
{
    return leastMemory(def_.frames);
}

VolumeSequence::Volume VolumeSequence::find(uint32_t frame)
{
    const std::scoped_lock lock(mutex_);
    Slot& slot = slots_[frame];
    slot.lastUse = ++uses_;
    counts_.late += slot.volume ? 0 : 1;
    return slot.volume;
}

void VolumeSequence::prefetch(uint32_t frame, bool withCoarser)
{
    {
        const std::scoped_lock lock(mutex_);
        uint64_t bytes = 0, ofLevels = 0;
        shown_ = frame;
        for (uint32_t k = 0; k < count(); ++k) {
            const uint32_t wanted = (frame + k) % count();
            Slot& slot = slots_[wanted];
            const bool isCoarserWanted = withCoarser && def_.makeCoarser;
            bytes += def_.frames[wanted].bytes;
            ofLevels += isCoarserWanted ? def_.frames[wanted].coarserBytes : slot.coarserBytes;
            if (k > 1 && bytes + ofLevels > def_.memory)
                break;
            slot.lastUse = uses_ + count() - k; // the next one is needed most
            slot.wantsCoarser = slot.wantsCoarser || isCoarserWanted;
            if (slot.isQueued || !slot.isIncomplete())
                continue;
            slot.isQueued = true;
            if (k < 2)
                queue_.push_front(wanted); // shown now
            else
                queue_.push_back(wanted);
        }
        uses_ += count();
        if (queue_.empty())
            return;
        startReader();
    }
    changed_.notify_all();
}

/// The caller holds the lock.
void VolumeSequence::startReader()
{
    if (!reader_.joinable())
        reader_ = std::thread([this] { runReader(); });
}

CoarserLevels VolumeSequence::coarser(uint32_t frame)
{
    std::unique_lock lock(mutex_);
    Slot& slot = slots_[frame];
    while (waits_ && def_.makeCoarser && !slot.coarser && !slot.hasFailed) {
        slot.wantsCoarser = true;
        if (!slot.isQueued && slot.isIncomplete()) {
            slot.isQueued = true;
            queue_.push_front(frame);
            startReader();
            changed_.notify_all();
        }
        changed_.wait(lock);
    }
    return slot.coarser;
}

void VolumeSequence::setWaits(bool waits)
{
    const std::scoped_lock lock(mutex_);
    waits_ = waits;
}

bool VolumeSequence::waits() const
{
    const std::scoped_lock lock(mutex_);
    return waits_ && def_.makeCoarser;
}

Result<VolumeSequence::Volume> VolumeSequence::wait(uint32_t frame)
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !slots_[frame].isReading; });
    slots_[frame].lastUse = ++uses_;
    shown_ = frame;
    if (slots_[frame].volume)
        return slots_[frame].volume;
    return readInto(frame, lock);
}

VolumeSequence::Counts VolumeSequence::counts() const
{
    const std::scoped_lock lock(mutex_);
    return counts_;
}

/// The least recently used frames go, but for those that are shown. The caller holds the lock.
void VolumeSequence::makeRoom(uint64_t bytes)
{
    const auto isShown = [&](size_t i) { return i == shown_ || i == (shown_ + 1) % count(); };
    while (counts_.bytes + bytes > def_.memory) {
        size_t oldest = slots_.size();
        for (size_t i = 0; i < slots_.size(); ++i)
            if (slots_[i].volume && !slots_[i].isMakingCoarser && !isShown(i) &&
                (oldest == slots_.size() || slots_[i].lastUse < slots_[oldest].lastUse))
                oldest = i;
        if (oldest == slots_.size())
            return; // the rest is shown or being read
        Slot& slot = slots_[oldest];
        counts_.bytes -= def_.frames[oldest].bytes + slot.coarserBytes;
        slot.volume = nullptr;
        slot.coarser = nullptr;
        slot.coarserBytes = 0;
        slot.wantsCoarser = false;
    }
}

/// Room is made before the frame is read, so that the frame that is being read is within the budget.
Result<VolumeSequence::Volume> VolumeSequence::readInto(uint32_t frame, std::unique_lock<std::mutex>& lock)
{
    Slot& slot = slots_[frame];
    const uint64_t bytes = def_.frames[frame].bytes;
    makeRoom(bytes);
    slot.isReading = true;
    counts_.bytes += bytes;
    counts_.peakBytes = std::max(counts_.peakBytes, counts_.bytes);
    lock.unlock();
    Result<Volume> read = unlessOutOfMemory<Volume>([&] { return def_.read(frame); });
    lock.lock();
    slot.isReading = false;
    if (read) {
        ++counts_.reads;
        slot.hasFailed = false;
        slot.volume = *read;
        readsOfProcess.fetch_add(1, std::memory_order_release);
    } else {
        counts_.failures += slot.hasFailed ? 0 : 1;
        slot.hasFailed = true;
        counts_.bytes -= bytes;
    }
    changed_.notify_all();
    return read;
}

/// Room is made for the upper bound, which the levels do not exceed.
void VolumeSequence::makeCoarser(uint32_t frame, std::unique_lock<std::mutex>& lock)
{
    Slot& slot = slots_[frame];
    const Volume volume = slot.volume;
    slot.isMakingCoarser = true;
    makeRoom(def_.frames[frame].coarserBytes);
    slot.coarserBytes = def_.frames[frame].coarserBytes;
    counts_.bytes += slot.coarserBytes;
    counts_.peakBytes = std::max(counts_.peakBytes, counts_.bytes);
    lock.unlock();
    const Result<CoarserLevels> made =
        unlessOutOfMemory<CoarserLevels>([&] { return Result<CoarserLevels>(def_.makeCoarser(*volume)); });
    lock.lock();
    slot.isMakingCoarser = false;
    counts_.bytes -= slot.coarserBytes;
    slot.hasFailed = !made;
    slot.coarser = made ? *made : nullptr;
    slot.coarserBytes = made ? slot.coarser->bytes() : 0;
    counts_.bytes += slot.coarserBytes;
    readsOfProcess.fetch_add(1, std::memory_order_release);
    changed_.notify_all();
}

void VolumeSequence::runReader()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return isEnding_ || !queue_.empty(); });
        if (isEnding_)
            return;
        const uint32_t frame = queue_.front();
        queue_.pop_front();
        Slot& slot = slots_[frame];
        slot.isQueued = false;
        if (!slot.volume && !slot.isReading && !slot.hasFailed)
            static_cast<void>(readInto(frame, lock));
        if (slot.volume && slot.isIncomplete() && !isEnding_)
            makeCoarser(frame, lock);
    }
}

} // namespace fx::base
