#include "fxsdk/activation/active_list.h"

#include <algorithm>

namespace fx::activation {

void ActiveList::reserve(size_t count)
{
    if (count <= slots_.capacity())
        return;
    const size_t roomy = std::max(count, 2 * slots_.capacity());
    serials_.reserve(roomy);
    keys_.reserve(roomy);
    slots_.reserve(roomy); // last: its capacity says whether all three have room
}

void ActiveList::insert(uint64_t serial, uint32_t key, uint32_t slot)
{
    reserve(serials_.size() + 1);
    const auto at = std::ptrdiff_t(positionOf(serial));
    serials_.insert(serials_.begin() + at, serial);
    keys_.insert(keys_.begin() + at, key);
    slots_.insert(slots_.begin() + at, slot);
}

void ActiveList::remove(uint64_t serial)
{
    const auto at = std::ptrdiff_t(positionOf(serial));
    serials_.erase(serials_.begin() + at);
    keys_.erase(keys_.begin() + at);
    slots_.erase(slots_.begin() + at);
}

size_t ActiveList::positionOf(uint64_t serial) const
{
    return size_t(std::lower_bound(serials_.begin(), serials_.end(), serial) - serials_.begin());
}

void ActiveList::truncate(size_t size)
{
    serials_.resize(size);
    keys_.resize(size);
    slots_.resize(size);
}

} // namespace fx::activation
