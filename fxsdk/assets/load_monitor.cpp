#include "fxsdk/assets/load_monitor.h"

#include <algorithm>

namespace fx::asset {

void LoadMonitor::beginPart(std::string_view item, float begin, float end)
{
    end_ = end;
    step_ = kFileShare * (end - begin);
    show(item, begin);
}

void LoadMonitor::divide(uint32_t count)
{
    const std::scoped_lock lock(mutex_);
    step_ = (end_ - progress_.fraction) / float(std::max(count, 1u) + 1);
}

void LoadMonitor::beginFile(std::string_view name)
{
    check();
    float fraction = 0.0f;
    {
        const std::scoped_lock lock(mutex_);
        ++progress_.filesRead;
        fraction = std::min(progress_.fraction + step_, end_);
    }
    show(name, fraction);
}

void LoadMonitor::check() const
{
    if (isCanceled())
        throw LoadCanceled();
}

LoadMonitor::Progress LoadMonitor::progress() const
{
    const std::scoped_lock lock(mutex_);
    return progress_;
}

void LoadMonitor::show(std::string_view item, float fraction)
{
    check();
    const std::scoped_lock lock(mutex_);
    progress_.fraction = std::max(progress_.fraction, fraction);
    size_t length = std::min(item.size(), kItemBytes - 1);
    while (length > 0 && length < item.size() && (static_cast<unsigned char>(item[length]) & 0xC0) == 0x80)
        --length; // a letter is not cut
    const auto end = std::copy_n(item.begin(), length, progress_.item.begin());
    std::fill(end, progress_.item.end(), '\0');
}

} // namespace fx::asset
