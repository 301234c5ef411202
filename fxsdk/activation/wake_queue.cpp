#include "fxsdk/activation/wake_queue.h"

#include <algorithm>
#include <utility>

namespace fx::activation {

namespace {

bool earlier(const Sleeper& a, const Sleeper& b)
{
    return a.start != b.start ? a.start < b.start : a.serial < b.serial;
}

} // namespace

void WakeQueue::reserve(uint32_t key, size_t count)
{
    if (places_.size() <= key)
        places_.resize(std::max(size_t(key) + 1, places_.size() * 2));
    if (heap_.capacity() < count)
        heap_.reserve(std::max(count, heap_.capacity() * 2));
}

void WakeQueue::add(const Sleeper& sleeper)
{
    if (places_.size() <= sleeper.key)
        places_.resize(size_t(sleeper.key) + 1);
    heap_.push_back(sleeper);
    place(heap_.size() - 1, sleeper);
    rise(heap_.size() - 1);
}

void WakeQueue::remove(uint32_t key)
{
    const size_t at = places_[key];
    const Sleeper last = heap_.back();
    heap_.pop_back();
    if (at == heap_.size())
        return; // it was the last
    place(at, last);
    rise(at);
    sink(places_[last.key]);
}

void WakeQueue::place(size_t at, const Sleeper& sleeper)
{
    heap_[at] = sleeper;
    places_[sleeper.key] = uint32_t(at);
}

void WakeQueue::rise(size_t at)
{
    const Sleeper moving = heap_[at];
    while (at > 0 && earlier(moving, heap_[(at - 1) / 2])) {
        place(at, heap_[(at - 1) / 2]);
        at = (at - 1) / 2;
    }
    place(at, moving);
}

void WakeQueue::sink(size_t at)
{
    const Sleeper moving = heap_[at];
    for (size_t child = 2 * at + 1; child < heap_.size(); child = 2 * at + 1) {
        if (child + 1 < heap_.size() && earlier(heap_[child + 1], heap_[child]))
            ++child;
        if (!earlier(heap_[child], moving))
            break;
        place(at, heap_[child]);
        at = child;
    }
    place(at, moving);
}

} // namespace fx::activation
