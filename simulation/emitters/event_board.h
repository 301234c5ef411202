/// @file event_board.h
/// Where the emitters of one effect leave for each other, within one step, what their events ask for.
#pragma once

#include "foundation/memory/arena.h"
#include "simulation/emitters/event_rule.h"

#include <algorithm>
#include <span>

namespace fx::sim {

/// Lives as long as the scratch memory of the step. Threads: one at a time.
class EventBoard
{
public:
    EventBoard(base::Arena& scratch, size_t solvers)
        : scratch_(scratch), notes_(scratch.allocate<const Note*>(solvers))
    {
        std::fill(notes_.begin(), notes_.end(), nullptr);
    }

    /// @param births stay where they are until the step ends
    void post(uint32_t target, std::span<const EventBirth> births)
    {
        if (births.empty() || target >= notes_.size())
            return;
        Note* const note = scratch_.allocate<Note>(1).data();
        *note = {births, notes_[target]};
        notes_[target] = note;
    }

    /// All that was left for `target`, in the order in which it is answered.
    std::span<const EventBirth> read(uint32_t target)
    {
        size_t count = 0;
        for (const Note* note = notes_[target]; note; note = note->next)
            count += note->births.size();
        const std::span<EventBirth> all = scratch_.allocate<EventBirth>(count);
        auto end = all.begin();
        for (const Note* note = notes_[target]; note; note = note->next)
            end = std::copy(note->births.begin(), note->births.end(), end);
        std::make_heap(all.begin(), all.end(), comesBefore); // heap sort: no allocation
        std::sort_heap(all.begin(), all.end(), comesBefore);
        return all;
    }

private:
    struct Note
    {
        std::span<const EventBirth> births;
        const Note* next;
    };
    base::Arena& scratch_;
    std::span<const Note*> notes_;
};

} // namespace fx::sim
