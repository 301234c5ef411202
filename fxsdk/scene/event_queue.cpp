#include "fxsdk/scene/event_queue.h"

#include <algorithm>
#include <tuple>

namespace fx::scene {

bool EventQueue::isBefore(const Entry& a, const Entry& b)
{
    return std::tuple(a.event.tick, a.serial, a.number) < std::tuple(b.event.tick, b.serial, b.number);
}

void EventQueue::add(const SceneEvent& event, uint64_t serial)
{
    const auto open = events_.begin() + ptrdiff_t(closed_);
    const Entry entry{event, serial, numbers_++};
    if (events_.size() < events_.capacity()) {
        events_.push_back(entry); // has room, so that `open` stays valid
        std::push_heap(open, events_.end(), isBefore);
        return;
    }
    ++lost_;
    if (open == events_.end() || !isBefore(entry, *open))
        return;
    std::pop_heap(open, events_.end(), isBefore);
    events_.back() = entry;
    std::push_heap(open, events_.end(), isBefore);
}

void EventQueue::closeStep()
{
    std::sort_heap(events_.begin() + ptrdiff_t(closed_), events_.end(), isBefore);
    closed_ = uint32_t(events_.size());
    numbers_ = 0;
}

void EventQueue::clear()
{
    events_.clear();
    closed_ = 0;
    numbers_ = 0;
}

} // namespace fx::scene
