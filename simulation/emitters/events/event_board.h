/// @file event_board.h
/// Requests for births that events of one emitter make in other emitters of the effect, within one step.
#pragma once

#include "foundation/memory/arena.h"
#include "foundation/tasks/work_budget.h"
#include "simulation/particles/event_rule.h"

#include <algorithm>
#include <span>

namespace fx::sim {

constexpr uint32_t kMinEventBirths =
    4096; ///< births by events that an emitter of any capacity tries in a step

/// Requests for births in one emitter.
struct EventRequests
{
    std::span<const EventBirth> births; ///< in the order in which they are answered, those that find room
    uint64_t asked = 0;                 ///< births, those included that do not
};

/// Keeps only as many requests for an emitter as its capacity allows: the first ones in processing order,
/// independent of the order of posting. Memory and time are proportional to the capacity. Its lifetime is
/// that of the step's scratch memory. Threads: one at a time.
class EventBoard
{
public:
    /// @param number     another one for each board of a world
    /// @param capacityOf called with the number of a solver: particles that can be alive in it
    template <class F>
    EventBoard(base::Arena& scratch, uint64_t number, size_t solvers, F&& capacityOf)
        : scratch_(&scratch), number_(number), notes_(scratch.allocate<Note>(solvers))
    {
        for (size_t i = 0; i < solvers; ++i)
            notes_[i] = {{}, 0, 0, 0, 0, std::max(capacityOf(i), kMinEventBirths)};
    }

    uint64_t number() const { return number_; }
    /// Strong guarantee.
    void post(uint32_t target, const EventBirth& birth)
    {
        if (target >= notes_.size() || birth.count == 0)
            return;
        Note& note = notes_[target];
        const bool isKept = note.wanted < note.room || !comesBefore(note.kept.front(), birth);
        if (isKept && note.size == note.kept.size())
            grow(note);
        note.asked += birth.count;
        if (!isKept)
            return;
        note.kept[note.size++] = birth;
        note.wanted += birth.count;
        std::push_heap(note.kept.begin(), note.end(), comesBefore);
        while (note.wanted - note.kept.front().count >= note.room) { // the others fill the room
            note.wanted -= note.kept.front().count;
            std::pop_heap(note.kept.begin(), note.end(), comesBefore);
            --note.size;
        }
    }

    /// Sorts the requests for `target` after all have been posted, within the work budget.
    /// @return whether they are sorted
    bool order(uint32_t target, base::WorkBudget& work)
    {
        Note& note = notes_[target];
        for (; note.ordered < note.size; ++note.ordered) {
            if (work.isSpent())
                return false;
            std::pop_heap(note.kept.begin(), note.end() - ptrdiff_t(note.ordered), comesBefore);
            work.spend(kOrdered);
        }
        return true;
    }
    /// After order().
    EventRequests read(uint32_t target) const
    {
        const Note& note = notes_[target];
        return {note.kept.first(note.size), note.asked};
    }

private:
    struct Note
    {
        std::span<EventBirth> kept; ///< the first `size`: a heap whose front is answered last
        size_t size;
        size_t ordered;  ///< number of requests at the end that are already sorted
        uint64_t wanted; ///< births of the kept requests
        uint64_t asked;  ///< births of all posted requests
        uint64_t room;   ///< largest number of attempted births

        std::span<EventBirth>::iterator end() const { return kept.begin() + ptrdiff_t(size); }
    };
    static constexpr uint64_t kOrdered = 2; ///< [unit] of base::WorkBudget, of each
    void grow(Note& note)
    {
        const std::span<EventBirth> larger =
            scratch_->allocate<EventBirth>(std::max<size_t>(2 * note.kept.size(), 64));
        std::copy(note.kept.begin(), note.kept.end(), larger.begin());
        note.kept = larger;
    }

    base::Arena* scratch_;
    uint64_t number_;
    std::span<Note> notes_;
};

} // namespace fx::sim
