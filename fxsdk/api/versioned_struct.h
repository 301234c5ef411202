/// @file versioned_struct.h
/// Compatibility with older and newer callers by the member structSize of C structs.
#pragma once

#include "foundation/result/status.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace fx::api {

constexpr uint32_t kLargestStruct = 4096; ///< [byte] largest valid structSize

/// Ok if `size` may be the structSize of some version of T.
template <class T>
base::Status checkStructSize(uint32_t size, const char* name)
{
    static_assert(std::is_trivially_copyable_v<T>);
    if (size >= 2 * sizeof(uint32_t) && size <= kLargestStruct && size % alignof(T) == 0)
        return {};
    return {base::Code::Version, std::string(name) + ".structSize is " + std::to_string(size) +
                                     ", this library knows " + std::to_string(sizeof(T)) +
                                     "; fill the struct with its default function"};
}

/// Copies `defaults` to `out`, and then replaces the defaults by the caller's members. Members unknown to
/// this library must be zero.
template <class T>
base::Status readStruct(const T* given, const char* name, const T& defaults, T& out)
{
    if (!given)
        return {base::Code::InvalidArgument, std::string(name) + " is null"};
    uint32_t size;
    std::memcpy(&size, given, sizeof size);
    if (base::Status status = checkStructSize<T>(size, name); !status)
        return status;
    const auto* bytes = reinterpret_cast<const unsigned char*>(given);
    for (size_t i = sizeof(T); i < size; ++i)
        if (bytes[i] != 0)
            return {base::Code::Version, std::string(name) + " sets members that this library does not know"};
    out = defaults;
    std::memcpy(&out, given, std::min<size_t>(size, sizeof(T)));
    return {};
}

/// Copies to `io` the members of `filled` that the caller's version of T has. Sets members unknown to this
/// library to zero. structSize does not change.
template <class T>
base::Status writeStruct(const T& filled, T* io, const char* name)
{
    if (!io)
        return {base::Code::InvalidArgument, std::string(name) + " is null"};
    uint32_t size;
    std::memcpy(&size, io, sizeof size);
    if (base::Status status = checkStructSize<T>(size, name); !status)
        return status;
    auto* bytes = reinterpret_cast<unsigned char*>(io);
    const auto* source = reinterpret_cast<const unsigned char*>(&filled);
    const size_t known = std::min<size_t>(size, sizeof(T));
    std::memcpy(bytes + sizeof size, source + sizeof size, known - sizeof size);
    std::memset(bytes + known, 0, size - known);
    return {};
}

} // namespace fx::api
