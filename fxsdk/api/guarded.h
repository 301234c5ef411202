/// @file guarded.h
/// The only exception boundary of the C API. The boundary converts a status or an exception to a result code
/// and the error message of the thread.
#pragma once

#include "foundation/memory/out_of_memory.h"
#include "foundation/result/status.h"
#include "fxsdk/fx_context.h"

#include <exception>
#include <new>
#include <string_view>

namespace fx::api {

constexpr FxResult toResult(base::Code code)
{
    return FxResult(int(code));
}

/// Stores "function: message", truncated to 2 KiB, for fxGetLastErrorMessage() on this thread; does not
/// allocate.
void rememberError(std::string_view function, std::string_view message) noexcept;
const char* lastError() noexcept;

/// Writes the error stored by rememberError() to the host's log, if the host has one.
void logLastError(const FxLog& log, FxResult code) noexcept;

/// Runs the body of a C function. Returns a result code; no exception leaves the function.
/// @param log  log to which failures are written in addition; may be null
/// @param body callable that returns base::Status
template <class F>
FxResult guarded(const char* function, const FxLog* log, F&& body) noexcept
{
    FxResult result = FX_OK;
    try {
        const base::Status status = body();
        if (status.ok())
            return FX_OK;
        result = toResult(status.code());
        rememberError(function, status.message());
    } catch (const base::OutOfMemory& exception) {
        result = FX_ERROR_OUT_OF_MEMORY;
        rememberError(function, exception.what());
    } catch (const std::bad_alloc&) {
        result = FX_ERROR_OUT_OF_MEMORY;
        rememberError(function, "the allocator returned null");
    } catch (const std::exception& exception) {
        result = FX_ERROR_INTERNAL;
        rememberError(function, exception.what());
    } catch (...) {
        result = FX_ERROR_INTERNAL;
        rememberError(function, "an exception of unknown type");
    }
    if (log)
        logLastError(*log, result);
    return result;
}

} // namespace fx::api
