/// @file fuzz_target.h
/// Interface of a fuzz target: a function that accepts any bytes, and the initial inputs (seeds).
///
/// With libFuzzer (option FXSDK_BUILD_FUZZERS, Clang), the program searches for inputs that cause failures.
/// With any other compiler, the program replays the seeds and the files of the corpus. See
/// tests/fuzz/README.md.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace fx::fuzz {

/// Runs one input, and aborts if a documented property is violated. Each target defines this function.
void runInput(std::span<const uint8_t> input);

/// Valid inputs that execute much of the code. The inputs are equal in every run. Each target defines this
/// function.
std::vector<std::string> seeds();

/// Ends the process with the message `promise` if `holds` is false. libFuzzer then stores the input.
void require(bool holds, const char* promise, std::string_view detail = {});

inline std::string_view textOf(std::span<const uint8_t> input)
{
    return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// Reads numbers from the front of an input. After the end of the input, every number is 0.
class InputReader
{
public:
    explicit InputReader(std::span<const uint8_t> input) : left_(input) {}

    bool isEmpty() const { return left_.empty(); }
    std::span<const uint8_t> rest() const { return left_; }

    template <class T>
    T value()
    {
        static_assert(std::is_trivially_copyable_v<T>);
        T result{};
        const size_t count = left_.size() < sizeof result ? left_.size() : sizeof result;
        if (count > 0)
            std::memcpy(&result, left_.data(), count);
        left_ = left_.subspan(count);
        return result;
    }
    uint8_t byte() { return value<uint8_t>(); }
    uint32_t below(uint32_t count) { return byte() % count; } ///< @param count 1..256
    /// True for one of `in` values of the next byte. For in > 1, the byte 0 gives false.
    bool one(uint32_t in) { return below(in) == in - 1; }
    /// Returns a reader of the next `count` bytes, and skips these bytes in this reader.
    InputReader part(size_t count)
    {
        const InputReader result(left_.first(std::min(count, left_.size())));
        left_ = left_.subspan(std::min(count, left_.size()));
        return result;
    }

private:
    std::span<const uint8_t> left_;
};

} // namespace fx::fuzz
