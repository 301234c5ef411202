/// @file fuzz_target.h
/// One fuzz target: a function that takes any bytes, and the seeds that it starts from.
///
/// With libFuzzer (option FXSDK_BUILD_FUZZERS, Clang) a target searches for inputs that break it. With any
/// other compiler it is a program that replays its seeds and the files of its corpus; see
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

/// Runs one input. Defined by each target. Aborts if a documented property is violated.
void runInput(std::span<const uint8_t> input);

/// Inputs that reach deep into the code. Defined by each target; the same in every run.
std::vector<std::string> seeds();

/// Ends the process with the message `promise` when `holds` is false, so that libFuzzer keeps the input.
void require(bool holds, const char* promise, std::string_view detail = {});

inline std::string_view textOf(std::span<const uint8_t> input)
{
    return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// Reads numbers from the front of an input. Past the end every number is 0.
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
    /// true for one in `in` values of the next byte, never for 0
    bool one(uint32_t in) { return below(in) == in - 1; }
    /// Splits off the next `count` bytes as an input of their own. However many of them are read, the bytes
    /// that follow are not shifted.
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
