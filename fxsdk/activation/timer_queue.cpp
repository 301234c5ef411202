#include "fxsdk/activation/timer_queue.h"

#include <algorithm>
#include <utility>

namespace fx::activation {

namespace {

bool earlier(const Timer& a, const Timer& b)
{
    return a.start != b.start ? a.start < b.start : a.serial < b.serial;
}

} // namespace

void TimerQueue::reserve(uint32_t key, size_t count)
{
    if (slots_.size() <= key)
        slots_.resize(std::max(size_t(key) + 1, slots_.size() * 2));
    if (heap_.capacity() < count)
        heap_.reserve(std::max(count, heap_.capacity() * 2));
}

void TimerQueue::add(const Timer& timer)
{
    if (slots_.size() <= timer.key)
        slots_.resize(size_t(timer.key) + 1);
    heap_.push_back(timer);
    put(heap_.size() - 1, timer);
    rise(heap_.size() - 1);
}

void TimerQueue::remove(uint32_t key)
{
    const size_t at = slots_[key];
    const Timer last = heap_.back();
    heap_.pop_back();
    if (at == heap_.size())
        return; // it was the last
    put(at, last);
    rise(at);
    sink(slots_[last.key]);
}

void TimerQueue::put(size_t at, const Timer& timer)
{
    heap_[at] = timer;
    slots_[timer.key] = uint32_t(at);
}

void TimerQueue::rise(size_t at)
{
    const Timer moving = heap_[at];
    while (at > 0 && earlier(moving, heap_[(at - 1) / 2])) {
        put(at, heap_[(at - 1) / 2]);
        at = (at - 1) / 2;
    }
    put(at, moving);
}

void TimerQueue::sink(size_t at)
{
    const Timer moving = heap_[at];
    for (size_t child = 2 * at + 1; child < heap_.size(); child = 2 * at + 1) {
        if (child + 1 < heap_.size() && earlier(heap_[child + 1], heap_[child]))
            ++child;
        if (!earlier(heap_[child], moving))
            break;
        put(at, heap_[child]);
        at = child;
    }
    put(at, moving);
}

} // namespace fx::activation
