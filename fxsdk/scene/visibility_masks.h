/// @file visibility_masks.h
/// Masks that select the frames in which instances are seen.
#pragma once

#include "fxsdk/scene/id_table.h"

#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace fx::scene {

constexpr uint32_t kVisibleToAll = ~0u;

/// The mask of an instance; instances without an entry have the mask kVisibleToAll.
struct VisibilityMask
{
    LocalId instance;
    uint32_t mask;
};

/// Masks of the instances of one scene. Threads: any thread.
class VisibilityMasks
{
public:
    explicit VisibilityMasks(std::pmr::memory_resource* memory) : masks_(memory) {}

    uint32_t of(LocalId instance) const;
    /// Strong guarantee.
    void set(LocalId instance, uint32_t mask);
    /// Makes room for one more entry, so that the next set() of a new instance cannot fail.
    void reserveOne();
    void remove(LocalId instance) { set(instance, kVisibleToAll); } ///< never fails
    /// Replaces all entries. @param masks ascending by instance
    void replace(std::pmr::vector<VisibilityMask>& masks);
    /// Copies the entries, ascending by instance, if they have changed since they had the revision
    /// `ioRevision`, which becomes the present one. The first revision is 1.
    void copy(std::pmr::vector<VisibilityMask>& out, uint64_t& ioRevision) const;

private:
    std::pmr::vector<VisibilityMask>::const_iterator find(LocalId instance) const;

    mutable std::mutex mutex_;               ///< guards the members below
    std::pmr::vector<VisibilityMask> masks_; ///< ascending by instance
    uint64_t revision_ = 1;
};

} // namespace fx::scene
