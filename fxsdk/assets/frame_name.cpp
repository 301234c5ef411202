#include "fxsdk/assets/frame_name.h"

#include <algorithm>

namespace fx::asset {

namespace {

constexpr size_t kMostDigits = 9;

base::Status wrong(std::string_view pattern)
{
    return {base::Code::InvalidArgument,
            "\"" + std::string(pattern) + "\": expected one number of a frame, such as smoke.%04d.fxvolume"};
}

} // namespace

base::Result<std::string> frameName(std::string_view pattern, uint32_t number)
{
    const size_t at = pattern.find('%');
    if (at == std::string_view::npos || pattern.find('%', at + 1) != std::string_view::npos)
        return wrong(pattern);
    size_t end = at + 1, digits = 0;
    for (; end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9'; ++end)
        digits = 10 * digits + size_t(pattern[end] - '0');
    if (end >= pattern.size() || pattern[end] != 'd' || end > at + 3 || digits > kMostDigits)
        return wrong(pattern);
    std::string text = std::to_string(number);
    text.insert(0, digits - std::min(digits, text.size()), '0');
    return std::string(pattern.substr(0, at)) + text + std::string(pattern.substr(end + 1));
}

} // namespace fx::asset
