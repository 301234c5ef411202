/// @file id_table.h
/// A table of values with generational ids, and the 64-bit encoding of ids. An id becomes stale when its
/// value is removed.
#pragma once

#include "foundation/math/hash.h"
#include "simulation/state/state_reader.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

namespace fx::scene {

constexpr unsigned kIdPartBits = 24; ///< bits of the index, and bits of the generation
constexpr uint64_t kIdPartMask = (uint64_t(1) << kIdPartBits) - 1;

/// Identity of a value within one table: index (24 bits) and generation of the index (24 bits); 0: no value.
/// Equal sequences of calls give equal identities in every run, so identities may be hashed. Ids of the C
/// API differ from run to run (see IdCodec).
using LocalId = uint64_t;

constexpr uint32_t indexOf(LocalId id)
{
    return uint32_t(id & kIdPartMask);
}

/// A table of T. Free indices are reused in the order of their removal (first-in first-out), so that an
/// index stays unused for as long as possible. An index is retired when all its generations have been used,
/// so ids are unique.
///
/// An index takes a few bytes. Values are stored densely in a separate array. The length of the array is the
/// largest number of simultaneous values so far.
template <class T>
class IdTable
{
public:
    /// Creates an empty table.
    /// @param capacity maximum number of simultaneous values, at most 2^24 - 1
    /// @param lastUse  number of uses of an index before it is retired, 1..2^24 - 1
    IdTable(std::pmr::memory_resource* memory, uint32_t capacity, uint32_t lastUse = uint32_t(kIdPartMask))
        : slots_(memory), values_(memory), freePlaces_(memory), capacity_(capacity), lastUse_(lastUse)
    {}

    /// Adds a value. Strong exception guarantee. @return id of the value; 0 if the table is full
    LocalId add(T value)
    {
        if (count_ == capacity_ || (firstFree_ == kNone && slots_.size() == kIdPartMask))
            return 0;
        if (freePlaces_.empty())
            makePlace(); // may throw, like emplace_back(); the following code cannot throw
        if (firstFree_ == kNone) {
            slots_.emplace_back();
            firstFree_ = lastFree_ = uint32_t(slots_.size() - 1);
        }
        const uint32_t index = firstFree_;
        Slot& slot = slots_[index];
        firstFree_ = slot.link;
        take(slot, std::move(value));
        ++slot.use;
        return (uint64_t(slot.use) << kIdPartBits) | index;
    }

    /// Reserves memory for `count` values. Up to this number, add() allocates nothing. Strong guarantee.
    void reserve(size_t count)
    {
        slots_.reserve(count);
        values_.reserve(count);
        freePlaces_.reserve(count);
        while (values_.size() < count)
            makePlace();
    }

    /// Reverts the last add(). Later ids do not depend on the reverted call. No other value may have been
    /// added or removed since the add(). Allocates no memory.
    void cancel(LocalId id)
    {
        const uint32_t index = indexOf(id);
        Slot& slot = slots_[index];
        drop(slot);
        if (--slot.use == 0) { // the reverted add() has created the index
            slots_.pop_back();
            return;
        }
        slot.link = firstFree_;
        if (firstFree_ == kNone)
            lastFree_ = index;
        firstFree_ = index;
    }

    /// Returns the value of an id, or null if the id is stale. The pointer is valid until the next add() or
    /// remove().
    T* find(LocalId id)
    {
        const uint32_t index = indexOf(id);
        if (index >= slots_.size() || !slots_[index].used || slots_[index].use != id >> kIdPartBits)
            return nullptr;
        return &values_[slots_[index].link];
    }

    /// Removes a value. The id must name a value of this table. Allocates no memory.
    void remove(LocalId id)
    {
        const uint32_t index = indexOf(id);
        Slot& slot = slots_[index];
        drop(slot);
        slot.link = kNone;
        if (slot.use == lastUse_)
            return; // retired
        if (firstFree_ == kNone)
            firstFree_ = index;
        else
            slots_[lastFree_].link = index;
        lastFree_ = index;
    }

    /// Returns the value at `index`. The index must be in use.
    T& at(uint32_t index) { return values_[slots_[index].link]; }
    const T& at(uint32_t index) const { return values_[slots_[index].link]; }
    LocalId idAt(uint32_t index) const { return (uint64_t(slots_[index].use) << kIdPartBits) | index; }

    uint32_t count() const { return count_; }

    /// Calls f(index, value) for all values, by ascending index.
    template <class F>
    void forEach(F&& f) const
    {
        for (uint32_t index = 0; index < slots_.size(); ++index)
            if (slots_[index].used)
                f(index, values_[slots_[index].link]);
    }

    /// Writes the identities in use and the order in which indices will be reused. Calls saveValue(value) for
    /// each value.
    template <class F>
    void save(sim::StateWriter& writer, F&& saveValue) const
    {
        writer.value(uint32_t(slots_.size()));
        for (const Slot& slot : slots_) {
            writer.value(slot.use);
            writer.flag(slot.used);
            if (slot.used)
                saveValue(values_[slot.link]);
        }
        for (uint32_t index = firstFree_; index != kNone; index = slots_[index].link)
            writer.value(index);
        writer.value(kNone);
    }

    /// Restores identities into an empty table. restoreValue() returns the values. The number of values must
    /// not exceed the capacity. Memory grows with the number of bytes read and the number of values.
    template <class F>
    void restore(sim::StateReader& reader, F&& restoreValue)
    {
        constexpr size_t kMinBytes = sizeof(uint32_t) + sizeof(uint8_t); // of an identity
        const uint32_t size = reader.value<uint32_t>();
        reader.require(size <= kIdPartMask && size <= reader.left() / kMinBytes,
                       "the table of instances is too large");
        if (!reader.ok())
            return;
        for (uint32_t index = 0; index < size; ++index) {
            const uint32_t use =
                reader.value<uint32_t>(1, lastUse_, "an identity of the state is out of range");
            const bool isUsed = reader.flag();
            if (isUsed && count_ == capacity_)
                reader.fail({base::Code::Capacity, "the state has more instances than the scene allows"});
            if (!reader.ok())
                return;
            slots_.push_back({use});
            if (!isUsed)
                continue;
            T value = restoreValue();
            makePlace();
            take(slots_.back(), std::move(value));
        }
        restoreFreeList(reader);
    }

private:
    static constexpr uint32_t kNone = ~0u;
    struct Slot
    {
        uint32_t use = 0;      ///< generation: number of times the index has been used
        uint32_t link = kNone; ///< if used: position of the value in values_; if free: the next free index
        bool used = false;
    };

    /// Adds an unused element to the array of values. Strong exception guarantee.
    void makePlace()
    {
        if (freePlaces_.capacity() <= values_.size()) // drop() must not fail
            freePlaces_.reserve(std::max<size_t>(2 * values_.size(), 4));
        values_.emplace_back();
        freePlaces_.push_back(uint32_t(values_.size() - 1));
    }

    void take(Slot& slot, T value)
    {
        slot.link = freePlaces_.back();
        freePlaces_.pop_back();
        values_[slot.link] = std::move(value);
        slot.used = true;
        ++count_;
    }

    void drop(Slot& slot)
    {
        values_[slot.link] = T();
        freePlaces_.push_back(slot.link);
        slot.used = false;
        --count_;
    }

    void restoreFreeList(sim::StateReader& reader)
    {
        while (reader.ok()) {
            const uint32_t index = reader.value<uint32_t>();
            if (index == kNone)
                return;
            reader.require(index < slots_.size() && !slots_[index].used && slots_[index].use < lastUse_,
                           "an identity is not free");
            reader.require(!reader.ok() || (slots_[index].link == kNone && index != lastFree_),
                           "an identity is free twice");
            if (!reader.ok())
                return;
            if (firstFree_ == kNone)
                firstFree_ = index;
            else
                slots_[lastFree_].link = index;
            lastFree_ = index;
        }
    }

    std::pmr::vector<Slot> slots_; ///< slots; the position is the index
    std::pmr::vector<T> values_;   ///< values, in any order; Slot::link is an index in this array
    std::pmr::vector<uint32_t> freePlaces_;
    uint32_t capacity_;
    uint32_t lastUse_;
    uint32_t count_ = 0;
    uint32_t firstFree_ = kNone;
    uint32_t lastFree_ = kNone;
};

/// Converts local identities to ids of the C API and back. An id consists of index (24 bits), generation (24
/// bits), owner (8 bits) and type (8 bits). The owner bits and an offset of the generation differ from
/// object to object. Therefore an id of another owner is accepted with a probability of at most 2^-32.
class IdCodec
{
public:
    /// Creates the codec of one object.
    /// @param owner address of the object that the ids belong to
    explicit IdCodec(const void* owner)
        : salt_(base::hashWord(uint64_t(reinterpret_cast<uintptr_t>(owner)),
                               uint64_t(std::chrono::steady_clock::now().time_since_epoch().count())))
    {}

    uint64_t encode(LocalId id, uint8_t type) const
    {
        const uint64_t generation = ((id >> kIdPartBits) + salt_) & kIdPartMask;
        return (id & kIdPartMask) | (generation << kIdPartBits) | (owner() << 48) | (uint64_t(type) << 56);
    }

    /// Converts an id of the C API to a local identity. Returns 0 if `bits` is not an id of this owner and
    /// type.
    LocalId decode(uint64_t bits, uint8_t type) const
    {
        if (bits >> 56 != type || ((bits >> 48) & 0xFF) != owner())
            return 0;
        const uint64_t use = ((bits >> kIdPartBits) - salt_) & kIdPartMask;
        return use == 0 ? 0 : (use << kIdPartBits) | (bits & kIdPartMask);
    }

private:
    uint64_t owner() const { return salt_ >> 56; }
    /// hash of the owner's address: bits 0..23 are added to the generation, bits 56..63 are the owner byte
    uint64_t salt_;
};

} // namespace fx::scene
