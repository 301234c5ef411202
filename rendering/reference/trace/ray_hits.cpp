#include "rendering/reference/trace/ray_hits.h"

#include <algorithm>

namespace fx::render {

void RayHits::grow(size_t capacity)
{
    capacity = std::max(capacity, 2 * place.size());
    enter.resize(capacity);
    nearest.resize(capacity);
    chordSquare.resize(capacity);
    place.resize(capacity);
}

void RayHits::sort()
{
    entries_.resize(size_);
    for (size_t i = 0; i < size_; ++i)
        entries_[i] = {enter[i], nearest[i], chordSquare[i], place[i]};
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.enter < b.enter || (a.enter == b.enter && a.place < b.place);
    });
    for (size_t i = 0; i < size_; ++i) {
        enter[i] = entries_[i].enter;
        nearest[i] = entries_[i].nearest;
        chordSquare[i] = entries_[i].chordSquare;
        place[i] = entries_[i].place;
    }
}

} // namespace fx::render
