// The functions of fx_livelink.h.
#include "fxsdk/fx_livelink.h"

#include "fxsdk/livelink/server/link_server.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <unistd.h>
#include <utility>

struct FxLiveLink
{
    fx::link::LinkServer server;
};

namespace {

using fx::base::Code;
using fx::base::Status;

constexpr size_t kErrorBytes = 1024;
constexpr uint32_t kLeastBytes = 4096;
constexpr size_t kLeastToken = 16, kLongestToken = 256;
thread_local char lastError[kErrorBytes] = "";

void rememberError(const char* function, const char* message)
{
    size_t length = 0;
    for (const char* part : {function, ": ", message})
        for (; *part && length + 1 < kErrorBytes; ++part)
            lastError[length++] = *part;
    lastError[length] = '\0';
}

/// Runs the body of a C function.
template <class F>
FxResult guarded(const char* function, F&& body) noexcept
{
    try {
        const Status status = body();
        if (!status)
            rememberError(function, status.message().c_str());
        return FxResult(int(status.code()));
    } catch (const std::bad_alloc&) {
        rememberError(function, "memory is exhausted");
        return FX_ERROR_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        rememberError(function, error.what());
    } catch (...) {
        rememberError(function, "an exception of unknown type");
    }
    return FX_ERROR_INTERNAL;
}

Status invalid(const std::string& what)
{
    return {Code::InvalidArgument, what};
}

/// Completes a definition of an older header.
Status readDef(const FxLiveLinkDef* given, FxLiveLinkDef& out)
{
    if (!given)
        return invalid("def is null");
    uint32_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (size < 2 * sizeof(uint32_t) || size > sizeof out)
        return {Code::Version, "def.structSize is " + std::to_string(size) +
                                   "; fill the struct with fxDefaultLiveLinkDef()"};
    out = fxDefaultLiveLinkDef();
    std::memcpy(&out, given, size);
    return {};
}

Status checkDef(const FxLiveLinkDef& def)
{
    if (!def.name || !fx::link::isGameName(def.name))
        return invalid("def.name must have 1 to 64 letters, digits, '-', '_' and '.'");
    if ((def.flags & ~uint32_t(FX_LIVELINK_TCP | FX_LIVELINK_LOAD_ON_UPDATE)) != 0)
        return invalid("def.flags has bits that are no FxLiveLinkFlag");
    const bool isTcp = (def.flags & FX_LIVELINK_TCP) != 0;
    if (isTcp && !def.token)
        return invalid("def.token is null; TCP needs a token, because other users can connect");
    if (def.token && (std::strlen(def.token) < kLeastToken || std::strlen(def.token) > kLongestToken))
        return invalid("def.token must have 16 to 256 bytes");
    if (def.port > 65535)
        return invalid("def.port is above 65535");
    if (def.maxMessageBytes < kLeastBytes || def.maxMessageBytes > fx::link::kLargestMessage)
        return invalid("def.maxMessageBytes is not within 4096 and 2^26");
    if (def.bytesPerUpdate < kLeastBytes || def.bytesPerUpdate > fx::link::kLargestMessage)
        return invalid("def.bytesPerUpdate is not within 4096 and 2^26");
    if (def.messagesPerUpdate < 1 || def.messagesPerUpdate > 1000)
        return invalid("def.messagesPerUpdate is not within 1 and 1000");
    if (def.reserved != 0)
        return invalid("def.reserved is not 0");
    return {};
}

/// Address of a definition. Makes the default folder.
fx::base::Result<fx::link::Address> addressOf(const FxLiveLinkDef& def)
{
    if ((def.flags & FX_LIVELINK_TCP) != 0)
        return fx::link::Address{"", uint16_t(def.port)};
    if (def.socketPath)
        return def.socketPath[0] == '\0'
                   ? fx::base::Result<fx::link::Address>(invalid("def.socketPath is empty"))
                   : fx::link::Address{def.socketPath, 0};
    const std::string folder = fx::link::linkFolder();
    if (Status status = fx::link::makePrivateFolder(folder); !status)
        return status;
    return fx::link::Address{folder + "/" + def.name + "-" + std::to_string(getpid()) + ".sock", 0};
}

fx::link::ServerOptions optionsOf(const FxLiveLinkDef& def)
{
    fx::link::ServerOptions options;
    options.name = def.name;
    options.token = def.token ? def.token : "";
    options.loadsOnUpdate = (def.flags & FX_LIVELINK_LOAD_ON_UPDATE) != 0;
    options.maxMessageBytes = def.maxMessageBytes;
    options.bytesPerUpdate = def.bytesPerUpdate;
    options.messagesPerUpdate = def.messagesPerUpdate;
    return options;
}

} // namespace

FxResult fxCreateLiveLink(FxContext* context, const FxLiveLinkDef* def, FxLiveLink** outLink)
{
    return guarded("fxCreateLiveLink", [&]() -> Status {
        if (!context || !outLink)
            return invalid(context ? "outLink is null" : "context is null");
        FxLiveLinkDef known;
        if (Status status = readDef(def, known); !status)
            return status;
        if (Status status = checkDef(known); !status)
            return status;
        fx::base::Result<fx::link::Address> address = addressOf(known);
        if (!address)
            return address.status();
        fx::base::Result<fx::link::Socket> listener = fx::link::Socket::listen(*address);
        if (!listener)
            return listener.status().code() == Code::InvalidArgument
                       ? listener.status()
                       : Status(Code::Io, listener.status().message());
        *outLink = new FxLiveLink{{context, optionsOf(known), std::move(*listener), std::move(*address)}};
        return {};
    });
}

void fxDestroyLiveLink(FxLiveLink* link)
{
    delete link;
}

FxResult fxLiveLink_Update(FxLiveLink* link, FxScene* const* scenes, uint32_t count)
{
    return guarded("fxLiveLink_Update", [&]() -> Status {
        if (!link || (!scenes && count > 0))
            return invalid(link ? "scenes is null" : "link is null");
        for (uint32_t i = 0; i < count; ++i)
            if (!scenes[i])
                return invalid("scenes[" + std::to_string(i) + "] is null");
        try {
            link->server.update({scenes, count});
        } catch (...) {
            link->server.closeClient();
            throw;
        }
        return {};
    });
}

FxResult fxLiveLink_GetAddress(FxLiveLink* link, char* buffer, size_t capacity, size_t* outSize)
{
    return guarded("fxLiveLink_GetAddress", [&]() -> Status {
        if (!link || !outSize)
            return invalid(link ? "outSize is null" : "link is null");
        const std::string text = fx::link::toString(link->server.address());
        if (buffer && capacity < text.size() + 1)
            return {Code::Capacity, "the address takes " + std::to_string(text.size() + 1) + " bytes"};
        if (buffer)
            std::copy_n(text.c_str(), text.size() + 1, buffer);
        *outSize = text.size() + 1;
        return {};
    });
}

FxResult fxLiveLink_GetStatistics(FxLiveLink* link, FxLiveLinkStatistics* ioStatistics)
{
    return guarded("fxLiveLink_GetStatistics", [&]() -> Status {
        if (!link || !ioStatistics)
            return invalid(link ? "ioStatistics is null" : "link is null");
        const uint32_t size = ioStatistics->structSize;
        if (size < 2 * sizeof(uint32_t) || size > sizeof *ioStatistics)
            return {Code::Version, "ioStatistics.structSize is " + std::to_string(size)};
        FxLiveLinkStatistics filled = link->server.statistics();
        filled.structSize = size;
        std::memcpy(ioStatistics, &filled, size);
        return {};
    });
}

const char* fxGetLiveLinkErrorMessage(void)
{
    return lastError;
}
