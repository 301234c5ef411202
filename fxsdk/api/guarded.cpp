#include "fxsdk/api/guarded.h"

#include "fxsdk/api/text.h"

#include <algorithm>
#include <array>

namespace fx::api {

namespace {
constexpr size_t kMessageBytes = 2048;
thread_local std::array<char, kMessageBytes> lastMessage{};
} // namespace

void rememberError(std::string_view function, std::string_view message) noexcept
{
    char* at = lastMessage.data();
    const char* const end = at + kMessageBytes - 1;
    for (const std::string_view part : {function, std::string_view(": "), message}) {
        const std::string_view fitting = cutUtf8(part, size_t(end - at));
        at = std::copy(fitting.begin(), fitting.end(), at);
    }
    *at = '\0';
}

const char* lastError() noexcept
{
    return lastMessage.data();
}

void logLastError(const FxLog& log, FxResult code) noexcept
{
    if (!log.write)
        return;
    const std::array<char, kMessageBytes> copy = lastMessage; // the callback may call functions that fail
    try {
        log.write(log.user, FX_LOG_ERROR, code, copy.data());
    } catch (...) { // a host written in C++ may throw; it must not unwind through C
    }
    lastMessage = copy; // the message belongs to the call that returns `code`
}

} // namespace fx::api
