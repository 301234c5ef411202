/// @file id_table.h
/// Values named by ids that go stale when the value is removed, and what such an id looks like from outside.
#pragma once

#include "foundation/math/hash.h"
#include "simulation/state/state_reader.h"

#include <chrono>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

namespace fx::scene {

constexpr unsigned kIdPartBits = 24; ///< of index and of generation
constexpr uint64_t kIdPartMask = (uint64_t(1) << kIdPartBits) - 1;

/// Identity within one table: index (24 bits) | use of that index (24 bits), 0 for none. The same calls give
/// the same identities in every run, so they may enter hashes; ids of the C API do not (see IdCodec).
using LocalId = uint64_t;

constexpr uint32_t indexOf(LocalId id)
{
    return uint32_t(id & kIdPartMask);
}

/// A table of T. Removed indices are reused first-in first-out, so that an id goes stale as long ago as
/// possible; an index whose uses are spent is retired, so that no identity ever comes back.
template <class T>
class IdTable
{
public:
    /// @param capacity most values at a time, at most 2^24 - 1
    /// @param lastUse  uses of an index before it is retired, 1..2^24 - 1
    IdTable(std::pmr::memory_resource* memory, uint32_t capacity, uint32_t lastUse = uint32_t(kIdPartMask))
        : slots_(memory), capacity_(capacity), lastUse_(lastUse)
    {}

    /// Strong guarantee. @return 0 when the table is full
    LocalId add(T value)
    {
        if (count_ == capacity_ || (firstFree_ == kNone && slots_.size() == kIdPartMask))
            return 0;
        if (firstFree_ == kNone) {
            slots_.emplace_back(); // may throw; afterwards nothing does
            firstFree_ = lastFree_ = uint32_t(slots_.size() - 1);
        }
        const uint32_t index = firstFree_;
        Slot& slot = slots_[index];
        firstFree_ = slot.nextFree;
        slot.value = std::move(value);
        slot.used = true;
        ++slot.use;
        ++count_;
        return (uint64_t(slot.use) << kIdPartBits) | index;
    }

    /// Null when the id names nothing here. Valid until the next add() or remove().
    T* find(LocalId id)
    {
        const uint32_t index = indexOf(id);
        if (index >= slots_.size() || !slots_[index].used || slots_[index].use != id >> kIdPartBits)
            return nullptr;
        return &slots_[index].value;
    }

    /// The id must name something. Allocates nothing.
    void remove(LocalId id)
    {
        const uint32_t index = indexOf(id);
        Slot& slot = slots_[index];
        slot.value = T();
        slot.used = false;
        slot.nextFree = kNone;
        --count_;
        if (slot.use == lastUse_)
            return; // retired
        if (firstFree_ == kNone)
            firstFree_ = index;
        else
            slots_[lastFree_].nextFree = index;
        lastFree_ = index;
    }

    /// The value at `index`, which must be in use.
    T& at(uint32_t index) { return slots_[index].value; }
    const T& at(uint32_t index) const { return slots_[index].value; }
    LocalId idAt(uint32_t index) const { return (uint64_t(slots_[index].use) << kIdPartBits) | index; }

    uint32_t count() const { return count_; }

    /// Calls f(index, value) for all values by ascending index.
    template <class F>
    void forEach(F&& f) const
    {
        for (uint32_t index = 0; index < slots_.size(); ++index)
            if (slots_[index].used)
                f(index, slots_[index].value);
    }

    /// Writes which identities are in use and in which order indices will be given out again, and calls
    /// saveValue(value) for each value.
    template <class F>
    void save(sim::StateWriter& writer, F&& saveValue) const
    {
        writer.value(uint32_t(slots_.size()));
        for (const Slot& slot : slots_) {
            writer.value(slot.use);
            writer.flag(slot.used);
            if (slot.used)
                saveValue(slot.value);
        }
        for (uint32_t index = firstFree_; index != kNone; index = slots_[index].nextFree)
            writer.value(index);
        writer.value(kNone);
    }

    /// Fills an empty table with identities, values from restoreValue().
    template <class F>
    void restore(sim::StateReader& reader, F&& restoreValue)
    {
        const uint32_t size = reader.value<uint32_t>();
        reader.require(size <= kIdPartMask && size <= reader.left(), "the table of instances is too large");
        if (!reader.ok())
            return;
        slots_.resize(size);
        for (Slot& slot : slots_) {
            slot.use = reader.value<uint32_t>(0, lastUse_, "an identity of the state is out of range");
            slot.used = reader.flag();
            reader.require(!slot.used || slot.use > 0, "an identity of the state was never given out");
            if (!slot.used)
                continue;
            if (++count_ > capacity_)
                reader.fail({base::Code::Capacity, "the state has more instances than the scene allows"});
            if (!reader.ok())
                return;
            slot.value = restoreValue();
        }
        restoreFreeList(reader);
    }

private:
    static constexpr uint32_t kNone = ~0u;
    struct Slot
    {
        T value{};
        uint32_t use = 0; ///< number of times the index has been given out
        uint32_t nextFree = kNone;
        bool used = false;
    };

    void restoreFreeList(sim::StateReader& reader)
    {
        while (reader.ok()) {
            const uint32_t index = reader.value<uint32_t>();
            if (index == kNone)
                return;
            reader.require(index < slots_.size() && !slots_[index].used && slots_[index].use < lastUse_,
                           "an identity is not free");
            reader.require(!reader.ok() || (slots_[index].nextFree == kNone && index != lastFree_),
                           "an identity is free twice");
            if (!reader.ok())
                return;
            if (firstFree_ == kNone)
                firstFree_ = index;
            else
                slots_[lastFree_].nextFree = index;
            lastFree_ = index;
        }
    }

    std::pmr::vector<Slot> slots_;
    uint32_t capacity_;
    uint32_t lastUse_;
    uint32_t count_ = 0;
    uint32_t firstFree_ = kNone;
    uint32_t lastFree_ = kNone;
};

/// Turns local identities into ids of the C API and back: index 24 | generation 24 | owner 8 | type 8 bits.
/// Owner and the offset of the generation differ from object to object, so an id of another owner, or of an
/// owner that is gone, is mistaken for a valid one with a chance of 2^-32 at most.
class IdCodec
{
public:
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

    /// 0 when `bits` is not an id of this owner and type.
    LocalId decode(uint64_t bits, uint8_t type) const
    {
        if (bits >> 56 != type || ((bits >> 48) & 0xFF) != owner())
            return 0;
        const uint64_t use = ((bits >> kIdPartBits) - salt_) & kIdPartMask;
        return use == 0 ? 0 : (use << kIdPartBits) | (bits & kIdPartMask);
    }

private:
    uint64_t owner() const { return salt_ >> 56; }
    uint64_t salt_; ///< bits 0..23 offset the generation, bits 56..63 are the owner
};

} // namespace fx::scene
