// How a world is saved, restored and hashed.
#include "simulation/world/world.h"

#include <algorithm>
#include <utility>

namespace fx::sim {

namespace {

void saveTold(const Run& run, StateWriter& writer)
{
    if (run.effect->hostEvents.empty())
        return;
    writer.value(uint32_t(run.told.size()));
    for (const Run::Told& told : run.told) {
        writer.value(told.tick);
        writer.value(told.event.event);
        writer.value(told.event.count);
    }
}

} // namespace

uint64_t World::hash(std::span<const Slot> slots) const
{
    std::vector<uint64_t> hashes(runs_.size());
    std::vector<bool> known(runs_.size());
    StateHasher all;
    for (const Slot slot : slots) {
        const RunIndex index = instances_[slot].run;
        if (!known[index]) {
            StateHasher hasher;
            runs_.at(index).save(hasher);
            saveTold(runs_.at(index), hasher);
            hashes[index] = hasher.hash();
            known[index] = true;
        }
        all.value(hashes[index]);
    }
    return all.hash();
}

void World::save(std::span<const Slot> slots, StateWriter& writer) const
{
    std::vector<uint32_t> firstUse(runs_.size(), ~0u); // by run: place of its first user
    for (uint32_t place = 0; place < slots.size(); ++place) {
        const RunIndex index = instances_[slots[place]].run;
        const Run& run = runs_.at(index);
        const bool isFirst = firstUse[index] == ~0u;
        if (isFirst)
            firstUse[index] = place;
        writer.value(firstUse[index]);
        if (!isFirst)
            continue;
        writer.flag(run.fresh);
        run.save(writer);
        saveTold(run, writer);
    }
}

void World::restore(std::span<const Entry> entries, StateReader& reader, std::span<Slot> outSlots)
{
    instances_.reserve(entries.size());
    free_.reserve(entries.size());
    for (uint32_t place = 0; place < entries.size() && reader.ok(); ++place) {
        const uint32_t first = reader.value<uint32_t>(0, place, "an instance of the state has no simulation");
        if (!reader.ok())
            return;
        const RunIndex run = first == place
                                 ? restoreRun(entries[place], reader)
                                 : joinRun(instances_[outSlots[first]].run, entries[place], reader);
        if (run != kNoRun)
            outSlots[place] = takeSlot(entries[place].start, run);
    }
}

RunIndex World::restoreRun(const Entry& first, StateReader& reader)
{
    const bool fresh = reader.flag();
    if (!reader.ok())
        return kNoRun;
    const RunIndex index = runs_.create(first.effect, conditionsOf(*first.effect, first.start));
    Run& run = runs_.at(index);
    run.users = 1;
    run.fresh = fresh;
    run.restore(reader);
    restoreTold(run, reader);
    runs_.welcome(index);
    return index;
}

/// @return kNoRun after a failure
RunIndex World::joinRun(RunIndex index, const Entry& entry, StateReader& reader)
{
    const Run& run = runs_.at(index);
    const RunConditions conditions = conditionsOf(*entry.effect, entry.start);
    // They may have shared one as long as nothing was in their way that only is at one of the places.
    RunConditions elsewhere = conditions;
    if (conditions.hasContact && !entry.effect->heedsPlacement())
        elsewhere.placement = run.conditions.placement;
    reader.require(run.effect == entry.effect && run.conditions.equals(elsewhere),
                   "instances of the state share a simulation although they differ");
    if (!reader.ok())
        return kNoRun;
    if (!run.conditions.equals(conditions)) {
        const RunIndex own = runs_.copy(index);
        runs_.at(own).conditions = conditions;
        return own;
    }
    if (!share_)
        return runs_.copy(index);
    ++runs_.at(index).users;
    return index;
}

void World::swap(World& other) noexcept
{
    dropStep();
    dropPublication();
    waiting_.clear();
    wanted_.clear();
    leaving_.clear();
    endPools();
    other.endPools();
    runs_.swap(other.runs_);
    std::swap(instances_, other.instances_);
    std::swap(free_, other.free_);
    std::swap(stepNumber_, other.stepNumber_);
    std::swap(now_, other.now_);
}

} // namespace fx::sim
