#include "foundation/snapshot/late_groups.h"

#include <algorithm>
#include <bit>

namespace fx::base {

namespace {

/// Room for at least `count` rows, at most a quarter more, so that growing groups rarely allocate.
size_t capacityFor(size_t count)
{
    const size_t unit = std::max<size_t>(std::bit_ceil(count) / 8, 1);
    return (count + unit - 1) / unit * unit;
}

} // namespace

void LateGroups::add(size_t place, LateRows rows)
{
    if (count_ == entries_.size())
        entries_.push_back(std::make_unique<Entry>(memory_));
    Entry& entry = *entries_[count_++];
    entry.rows = rows;
    entry.place = place;
    entry.isDone.store(false, std::memory_order_relaxed); // publication orders it
}

const SnapshotGroup& LateGroups::group(const FrameSnapshot& snapshot, size_t place)
{
    const auto end = entries_.begin() + std::ptrdiff_t(count_);
    Entry& entry = **std::lower_bound(entries_.begin(), end, place,
                                      [](const auto& one, size_t wanted) { return one->place < wanted; });
    if (entry.isDone.load(std::memory_order_acquire))
        return entry.group;
    const std::lock_guard lock(mutex_);
    if (entry.isDone.load(std::memory_order_relaxed))
        return entry.group;
    const SnapshotGroup& described = snapshot.added(place);
    const GroupInfo& info = described.info();
    const size_t capacity = capacityFor(info.count);
    if (!entry.group.prepareAgain(info.kind, capacity, kAllColumns, false))
        entry.group.prepare(snapshot.schema(), info.kind, capacity);
    entry.group.editInfo() = info;
    entry.group.editInfo().isLate = false; // it has its rows
    std::ranges::copy(described.constants(), entry.group.editConstants().begin());
    entry.rows(snapshot, place, entry.group);
    entry.isDone.store(true, std::memory_order_release);
    return entry.group;
}

} // namespace fx::base
