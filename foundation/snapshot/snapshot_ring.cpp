#include "foundation/snapshot/snapshot_ring.h"

namespace fx::base {

namespace {
constexpr size_t kUsualSlots = 4; // two published, one being written, one held by a frame in flight
}

SnapshotRing::SnapshotRing(const SnapshotSchema* schema, std::pmr::memory_resource* memory)
    : schema_(schema), memory_(memory)
{
    for (size_t i = 0; i < kUsualSlots; ++i)
        slots_.push_back({std::make_unique<FrameSnapshot>(schema_, memory_)});
}

void SnapshotRing::forgetReplaced()
{
    std::erase_if(slots_, [this](const Slot& slot) { return slot.isReplaced && !isInUse(slot); });
}

FrameSnapshot& SnapshotRing::beginWrite(Ticks tick, Ticks step)
{
    std::lock_guard lock(mutex_);
    writing_ = nullptr;
    for (Slot& slot : slots_)
        if (!slot.isReplaced && !isInUse(slot)) {
            writing_ = slot.snapshot.get();
            break;
        }
    if (!writing_) {
        slots_.push_back({std::make_unique<FrameSnapshot>(schema_, memory_)});
        writing_ = slots_.back().snapshot.get();
    }
    writing_->begin(tick, sequence_ + (staged_ ? 2 : 1), step);
    return *writing_;
}

void SnapshotRing::publish()
{
    std::lock_guard lock(mutex_);
    if (!writing_)
        return;
    previous_ = staged_ ? staged_ : newest_;
    sequence_ += staged_ ? 2 : 1;
    staged_ = nullptr;
    newest_ = writing_;
    writing_ = nullptr;
}

void SnapshotRing::stageOlder()
{
    std::lock_guard lock(mutex_);
    staged_ = writing_;
    writing_ = nullptr;
}

void SnapshotRing::forgetOlder()
{
    std::lock_guard lock(mutex_);
    previous_ = nullptr;
}

SnapshotPair SnapshotRing::acquire()
{
    std::lock_guard lock(mutex_);
    if (newest_)
        ++slotOf(newest_)->readers;
    if (previous_)
        ++slotOf(previous_)->readers;
    SnapshotPair pair;
    pair.newer = newest_;
    pair.older = previous_;
    return pair;
}

void SnapshotRing::release(const SnapshotPair& pair)
{
    std::lock_guard lock(mutex_);
    if (pair.newer)
        --slotOf(pair.newer)->readers;
    if (pair.older)
        --slotOf(pair.older)->readers;
}

SnapshotRing::Slot* SnapshotRing::slotOf(const FrameSnapshot* snapshot)
{
    for (Slot& slot : slots_)
        if (slot.snapshot.get() == snapshot)
            return &slot;
    return nullptr;
}

} // namespace fx::base
