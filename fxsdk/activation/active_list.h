/// @file active_list.h
/// The active instances in order of creation. An update visits only the active instances.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::activation {

/// Keeps three parallel arrays, sorted by the order of creation (serial). Results therefore do not depend on
/// the order in which instances become active.
class ActiveList
{
public:
    explicit ActiveList(std::pmr::memory_resource* memory) : serials_(memory), keys_(memory), slots_(memory)
    {}

    /// Reserves memory for `count` entries. Up to this number, insert() allocates nothing.
    void reserve(size_t count);
    /// Adds an entry.
    /// @param serial order of creation, unique
    /// @param key, slot values passed to callbacks
    void insert(uint64_t serial, uint32_t key, uint32_t slot);
    /// Removes an entry. The serial must be in the list.
    void remove(uint64_t serial);

    /// Removes every entry for which finished(key, slot) is true. The order of the remaining entries does not
    /// change.
    template <class F>
    void removeIf(F&& finished)
    {
        size_t kept = 0;
        for (size_t i = 0; i < serials_.size(); ++i) {
            if (finished(keys_[i], slots_[i]))
                continue;
            serials_[kept] = serials_[i];
            keys_[kept] = keys_[i];
            slots_[kept] = slots_[i];
            ++kept;
        }
        truncate(kept);
    }

    size_t size() const { return serials_.size(); }
    std::span<const uint32_t> keys() const { return keys_; }
    std::span<const uint32_t> slots() const { return slots_; }

private:
    size_t positionOf(uint64_t serial) const;
    void truncate(size_t size);

    std::pmr::vector<uint64_t> serials_;
    std::pmr::vector<uint32_t> keys_;
    std::pmr::vector<uint32_t> slots_;
};

} // namespace fx::activation
