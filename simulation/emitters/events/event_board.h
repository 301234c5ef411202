/// @file event_board.h
/// Collects requests for births that events of one emitter cause in other emitters of the effect, in one
/// step.
#pragma once

#include "foundation/memory/arena.h"
#include "foundation/tasks/work_budget.h"
#include "simulation/particles/event_rule.h"

#include <algorithm>
#include <span>

namespace fx::sim {

/// An emitter attempts at most max(capacity, kMinEventBirths) births caused by events in a step.
constexpr uint32_t kMinEventBirths = 4096;

/// Requests for births in one emitter.
struct EventRequests
{
    /// requested births in the order of processing, without births that exceed the capacity
    std::span<const EventBirth> births;
    uint64_t asked = 0; ///< number of all requested births
};

/// Stores for each emitter the first requests in processing order, as many as the emitter's capacity allows.
/// The stored requests do not depend on the order of posting. Memory and time are proportional to the
/// capacity. The board uses the scratch memory of the step. Threads: one at a time.
class EventBoard
{
public:
    /// Creates a board for one step.
    /// @param number     unique number of the board in its world
    /// @param capacityOf called with the index of a solver; returns the capacity of the solver
    template <class F>
    EventBoard(base::Arena& scratch, uint64_t number, size_t solvers, F&& capacityOf)
        : scratch_(&scratch), number_(number), notes_(scratch.allocate<Note>(solvers))
    {
        for (size_t i = 0; i < solvers; ++i)
            notes_[i] = {{}, 0, 0, 0, 0, std::max(capacityOf(i), kMinEventBirths)};
    }

    uint64_t number() const { return number_; }
    /// Adds a request. Strong guarantee.
    void post(uint32_t target, const EventBirth& birth)
    {
        if (target >= notes_.size() || birth.count == 0) // kNoTarget is no solver
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

    /// Sorts the requests for `target` within the work budget. All requests must have been posted.
    /// @return true if all requests for `target` are sorted
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
    /// The sorted requests for `target`. order() must have returned true.
    EventRequests read(uint32_t target) const
    {
        const Note& note = notes_[target];
        return {note.kept.first(note.size), note.asked};
    }

private:
    struct Note
    {
        std::span<EventBirth> kept; ///< the first `size` elements are a heap, whose front is processed last
        size_t size;
        size_t ordered;  ///< number of requests at the end that are already sorted
        uint64_t wanted; ///< number of births of the stored requests
        uint64_t asked;  ///< number of births of all posted requests
        uint64_t room;   ///< maximum number of attempted births

        std::span<EventBirth>::iterator end() const { return kept.begin() + ptrdiff_t(size); }
    };
    static constexpr uint64_t kOrdered = 2; ///< [unit of base::WorkBudget] work of sorting one request
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
