#include "fxsdk/scene/visibility_masks.h"

#include <algorithm>

namespace fx::scene {

std::pmr::vector<VisibilityMask>::const_iterator VisibilityMasks::find(LocalId instance) const
{
    return std::lower_bound(masks_.begin(), masks_.end(), instance,
                            [](const VisibilityMask& one, LocalId id) { return one.instance < id; });
}

uint32_t VisibilityMasks::of(LocalId instance) const
{
    const std::lock_guard lock(mutex_);
    const auto at = find(instance);
    return at != masks_.end() && at->instance == instance ? at->mask : kVisibleToAll;
}

void VisibilityMasks::set(LocalId instance, uint32_t mask)
{
    const std::lock_guard lock(mutex_);
    const auto at = find(instance);
    const bool isKnown = at != masks_.end() && at->instance == instance;
    if (!isKnown && mask == kVisibleToAll)
        return;
    if (!isKnown)
        masks_.insert(at, {instance, mask});
    else if (mask == kVisibleToAll)
        masks_.erase(at);
    else
        masks_[size_t(at - masks_.begin())].mask = mask;
    ++revision_;
}

void VisibilityMasks::reserveOne()
{
    const std::lock_guard lock(mutex_);
    if (masks_.size() == masks_.capacity())
        masks_.reserve(2 * masks_.size() + 1);
}

void VisibilityMasks::replace(std::pmr::vector<VisibilityMask>& masks)
{
    const std::lock_guard lock(mutex_);
    masks_.swap(masks);
    ++revision_;
}

void VisibilityMasks::copy(std::pmr::vector<VisibilityMask>& out, uint64_t& ioRevision) const
{
    const std::lock_guard lock(mutex_);
    if (ioRevision == revision_)
        return;
    out.assign(masks_.begin(), masks_.end());
    ioRevision = revision_;
}

} // namespace fx::scene
