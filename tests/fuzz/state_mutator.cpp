// Changes inputs of libFuzzer that consist of numbers of 1, 2, 4 and 8 bytes: counts, ids, times and floats
// at limits, and ranges that are taken away, repeated or exchanged.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);

namespace {

using Random = std::minstd_rand;

size_t below(Random& random, size_t count)
{
    return size_t(random()) % count;
}

template <class T>
void write(std::vector<uint8_t>& bytes, size_t at, T value)
{
    std::memcpy(&bytes[at], &value, std::min(sizeof value, bytes.size() - at));
}

/// Puts a limit of arithmetic or a count of about the size of the input to a place.
void changeNumber(std::vector<uint8_t>& bytes, Random& random)
{
    constexpr std::array<float, 6> kFloats{0.0f,
                                           -1.0f,
                                           1e30f,
                                           std::numeric_limits<float>::infinity(),
                                           std::numeric_limits<float>::quiet_NaN(),
                                           std::numeric_limits<float>::denorm_min()};
    const std::array<uint64_t, 9> counts{0,          1,         2,          255,         65535,
                                         UINT32_MAX, INT64_MAX, UINT64_MAX, bytes.size()};
    const size_t at = below(random, bytes.size());
    const uint64_t count = counts[below(random, counts.size())];
    switch (below(random, 5)) {
    case 0:
        write(bytes, at, uint8_t(count));
        break;
    case 1:
        write(bytes, at, uint32_t(count));
        break;
    case 2:
        write(bytes, at, count);
        break;
    case 3:
        write(bytes, at, kFloats[below(random, kFloats.size())]);
        break;
    default:
        bytes[at] = uint8_t(bytes[at] + below(random, 5) - 2);
        break;
    }
}

void changeRange(std::vector<uint8_t>& bytes, Random& random)
{
    const size_t begin = below(random, bytes.size());
    const size_t length = std::min(bytes.size() - begin, size_t(1) << below(random, 9));
    const auto first = bytes.begin() + std::ptrdiff_t(begin), last = first + std::ptrdiff_t(length);
    const size_t choice = below(random, 3);
    if (choice == 0) {
        bytes.erase(first, last);
    } else if (choice == 1) {
        const std::vector<uint8_t> copy(first, last);
        bytes.insert(first, copy.begin(), copy.end());
    } else {
        std::fill(first, last, uint8_t(below(random, 2) * 255));
    }
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned int seed)
{
    Random random(seed + 1);
    if (size == 0 || below(random, 4) == 0)
        return LLVMFuzzerMutate(data, size, maxSize);
    std::vector<uint8_t> bytes(data, data + size);
    for (size_t changes = 1 + below(random, 3); changes > 0 && !bytes.empty(); --changes) {
        if (below(random, 3) == 0)
            changeRange(bytes, random);
        else
            changeNumber(bytes, random);
    }
    bytes.resize(std::min(bytes.size(), maxSize));
    std::copy(bytes.begin(), bytes.end(), data);
    return bytes.size();
}
