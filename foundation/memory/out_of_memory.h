/// @file out_of_memory.h
/// A std::bad_alloc whose message states the purpose of the memory. The construction of the exception
/// allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <string_view>

namespace fx::base {

class OutOfMemory final : public std::bad_alloc
{
public:
    /// @param message text about the purpose of the memory; truncated to 511 bytes
    explicit OutOfMemory(std::string_view message) noexcept
    {
        const size_t size = std::min(message.size(), message_.size() - 1);
        std::copy_n(message.data(), size, message_.data());
    }
    const char* what() const noexcept override { return message_.data(); }

private:
    std::array<char, 512> message_{};
};

} // namespace fx::base
