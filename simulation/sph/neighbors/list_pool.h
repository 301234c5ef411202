/// @file list_pool.h
/// Layout of neighbor lists, and a thread-safe block allocator for them.
#pragma once

#include "foundation/memory/column.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory_resource>

namespace fx::sim {

/// Mask of the slot in an entry of a list. An entry consists of a slot (lower 29 bits) and one bit for each
/// mirrored axis. A mirror bit marks the mirror image of the particle in a reflecting wall, the wall nearer
/// to the owner of the list.
constexpr uint32_t kPlaceMask = (1u << 29) - 1;
/// bit of an entry that is mirrored on axis x; kMirrorX << a is the bit of axis a
constexpr uint32_t kMirrorX = 1u << 29;

/// Lists are padded with the owner's slot to a multiple of this length. The length is also the number of
/// virtual lanes of every sum over neighbors, for any vector width of the processor.
constexpr uint32_t kLanes = 16;

/// The neighbor lists of all slots. The order of threads decides which lists do not fit into memory. The
/// neighbors do not depend on the order of threads, because a missing list is searched again.
class ListPool
{
public:
    static constexpr uint32_t kUnlisted = ~0u;

    /// Creates an empty pool.
    /// @param capacity number of slots
    /// @param entries number of entries of all lists together
    ListPool(std::pmr::memory_resource* memory, uint32_t capacity, size_t entries)
        : entries_(memory, entries / kLanes * kLanes), start_(memory, capacity), count_(memory, capacity)
    {}

    void clear()
    {
        used_ = 0;
        unlisted_ = 0;
        total_ = 0;
    }
    /// Index of the first entry of a list in units of kLanes; kUnlisted if there is no list.
    uint32_t start(uint32_t slot) const { return start_[slot]; }
    uint32_t count(uint32_t slot) const { return count_[slot]; }
    const uint32_t* entries(uint32_t start) const { return entries_.data() + size_t(start) * kLanes; }
    uint32_t unlisted() const { return unlisted_.load(std::memory_order_relaxed); }
    uint64_t total() const { return total_.load(std::memory_order_relaxed); }

private:
    friend class ListWriter;

    base::Column<uint32_t> entries_;
    base::Column<uint32_t> start_;
    base::Column<uint32_t> count_;
    std::atomic<uint64_t> used_{0}; ///< number of entries allocated to writers
    std::atomic<uint32_t> unlisted_{0};
    std::atomic<uint64_t> total_{0}; ///< number of entries in lists, without padding
};

/// Writes lists one after another. Each thread uses its own writer.
class ListWriter
{
public:
    explicit ListWriter(ListPool& pool) : pool_(pool) {}
    ListWriter(const ListWriter&) = delete;
    ListWriter& operator=(const ListWriter&) = delete;
    ~ListWriter()
    {
        giveBack();
        pool_.unlisted_.fetch_add(unlisted_, std::memory_order_relaxed);
        pool_.total_.fetch_add(total_, std::memory_order_relaxed);
    }

    /// Returns memory for `entries` more entries; null if memory is exhausted. All later calls then also
    /// return null.
    uint32_t* room(uint32_t entries)
    {
        if (end_ - next_ < entries && !refill(entries))
            return nullptr;
        return pool_.entries_.data() + next_;
    }
    bool exhausted() const { return exhausted_; }
    /// Ends the list of `slot`, whose `count` entries have been written to the memory returned by room(), and
    /// pads the list.
    void finish(uint32_t slot, uint32_t count)
    {
        uint32_t* const list = pool_.entries_.data() + next_;
        const uint32_t length = (count + kLanes - 1) / kLanes * kLanes;
        std::fill_n(list + count, kLanes, slot); // more than needed, but of a length that is known
        pool_.start_[slot] = uint32_t(next_ / kLanes);
        pool_.count_[slot] = count;
        next_ += length;
        total_ += count;
    }
    void leaveUnlisted(uint32_t slot)
    {
        pool_.start_[slot] = ListPool::kUnlisted;
        ++unlisted_;
    }

private:
    static constexpr uint64_t kBlock = 16384; ///< number of entries that a writer allocates at once

    bool refill(uint32_t entries)
    {
        giveBack();
        const uint64_t capacity = pool_.entries_.capacity();
        const uint64_t wanted = std::max<uint64_t>(kBlock, (entries + kLanes - 1) / kLanes * kLanes);
        next_ = std::min(pool_.used_.fetch_add(wanted, std::memory_order_acquire), capacity);
        end_ = std::min(next_ + wanted, capacity);
        exhausted_ = end_ - next_ < entries;
        return !exhausted_;
    }
    /// Returns the unused part of the block to the pool, unless another writer has taken the next block.
    /// Writers also write to places behind their last list, which lie in that part: they have done so before
    /// the next writer takes it.
    void giveBack()
    {
        uint64_t expected = end_;
        if (end_ > next_)
            pool_.used_.compare_exchange_strong(expected, next_, std::memory_order_release,
                                                std::memory_order_relaxed);
        end_ = next_;
    }

    ListPool& pool_;
    uint64_t next_ = 0;
    uint64_t end_ = 0;
    bool exhausted_ = false;
    uint32_t unlisted_ = 0;
    uint64_t total_ = 0;
};

} // namespace fx::sim
