/// @file display_rules.h
/// What the host states about drawing instances: the frames that show them, their layer and their order.
#pragma once

#include "fxsdk/scene/id_table.h"

#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace fx::scene {

constexpr uint32_t kVisibleToAll = ~0u;
constexpr int32_t kLowestLayer = -16, kHighestLayer = 15;

struct DisplayRule
{
    uint32_t mask = kVisibleToAll; ///< a frame shows the instance if its mask shares a bit
    int32_t layer = 0;             ///< layers are drawn one over the other, in ascending order
    int32_t sortKey = 0;           ///< order within a layer at equal depth

    bool isDefault() const { return mask == kVisibleToAll && layer == 0 && sortKey == 0; }
};

/// The rule of an instance; instances without an entry have the default rule.
struct InstanceRule
{
    LocalId instance;
    DisplayRule rule;
    /// Number of publications until the entry of a destroyed instance ends; 0: the instance exists.
    uint8_t publicationsLeft = 0;
};

/// Rules of the instances of one scene. Views show a destroyed instance until their snapshots no longer have
/// it, so that its rule lasts longer than the instance. Threads: any thread, unless a function says
/// otherwise.
class DisplayRules
{
public:
    explicit DisplayRules(std::pmr::memory_resource* memory) : rules_(memory) {}

    DisplayRule of(LocalId instance) const;
    // The functions that set have the strong guarantee.
    void set(LocalId instance, const DisplayRule& rule);
    void setMask(LocalId instance, uint32_t mask);
    void setOrder(LocalId instance, int32_t layer, int32_t sortKey);
    /// Makes room for one more entry, so that the next set() of a new instance cannot fail.
    void reserveOne();
    /// States that the instance is destroyed: its rule ends after the next publications. Never fails.
    /// [scene thread] @param most number of such entries that are kept
    void retire(LocalId instance, uint32_t most);
    /// States that the scene has published a step. [scene thread]
    void countPublication();
    /// Replaces all entries. @param rules ascending by instance
    void replace(std::pmr::vector<InstanceRule>& rules);
    /// Copies the entries, ascending by instance, if they have changed since they had the revision
    /// `ioRevision`, which becomes the present one. The first revision is 1.
    void copy(std::pmr::vector<InstanceRule>& out, uint64_t& ioRevision) const;

private:
    /// Views interpolate between two snapshots. One more may be in work when an instance is destroyed, and
    /// one more held by a view that has not read its rule yet.
    static constexpr uint8_t kKeptPublications = 4;

    std::pmr::vector<InstanceRule>::const_iterator find(LocalId instance) const;
    DisplayRule held(LocalId instance) const;
    void put(LocalId instance, const DisplayRule& rule);

    mutable std::mutex mutex_;             ///< guards the members below
    std::pmr::vector<InstanceRule> rules_; ///< ascending by instance
    uint64_t revision_ = 1;
    uint32_t retired_ = 0; ///< number of entries of destroyed instances; used by the scene thread only
};

} // namespace fx::scene
