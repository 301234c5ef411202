#include "simulation/cloud/ball_list.h"

#include <array>
#include <bit>
#include <charconv>

namespace fx::sim {
namespace {

using base::Code;
using base::Status;

constexpr size_t kNumbers = 12; // of a ball
constexpr std::string_view kStart = "fxballs 1\ncount ", kEnd = "\ndata\n";
constexpr size_t kLongestCount = 8; // [byte]

struct Range
{
    const char* name;
    float low, high;
};

constexpr std::array<Range, kNumbers> kRanges{{{"x", -1e6f, 1e6f},
                                               {"y", -1e6f, 1e6f},
                                               {"z", -1e6f, 1e6f},
                                               {"radius", 1e-6f, 1e6f},
                                               {"cross section", 0.0f, 1e12f},
                                               {"temperature", 0.0f, 1e5f},
                                               {"albedo", 0.0f, 1.0f},
                                               {"albedo", 0.0f, 1.0f},
                                               {"albedo", 0.0f, 1.0f},
                                               {"emission", 0.0f, 1e12f},
                                               {"emission", 0.0f, 1e12f},
                                               {"emission", 0.0f, 1e12f}}};

std::array<float, kNumbers> numbersOf(const ListedBall& b)
{
    return {b.center.x, b.center.y, b.center.z, b.radius,     b.crossSection, b.temperature,
            b.albedo.r, b.albedo.g, b.albedo.b, b.emission.r, b.emission.g,   b.emission.b};
}

ListedBall ballOf(const std::array<float, kNumbers>& n)
{
    return {{n[0], n[1], n[2]}, n[3], n[4], n[5], {n[6], n[7], n[8]}, {n[9], n[10], n[11]}};
}

float numberAt(const char* bytes)
{
    uint32_t word = 0;
    for (size_t k = 0; k < 4; ++k)
        word |= uint32_t(static_cast<unsigned char>(bytes[k])) << (8 * k);
    return std::bit_cast<float>(word);
}

} // namespace

base::Result<std::shared_ptr<const BallList>> parseBallList(std::string_view bytes)
{
    if (!bytes.starts_with("fxballs "))
        return Status(Code::Parse,
                      "byte 0: expected 'fxballs'; \"fx import FILE.vdb --fit N\" writes such files");
    if (!bytes.starts_with(kStart))
        return Status(Code::Version, "byte 8: expected version 1 and the count of balls");
    size_t count = 0;
    const char* const first = bytes.data() + kStart.size();
    const char* const last = first + std::min(bytes.size() - kStart.size(), kLongestCount);
    const auto [end, error] = std::from_chars(first, last, count);
    if (error != std::errc())
        return Status(Code::Parse, "byte 16: expected the count of balls");
    if (count < 1 || count > kMaxListedBalls)
        return Status(Code::TooLarge, "found " + std::to_string(count) + " balls; allowed are 1 to " +
                                          std::to_string(kMaxListedBalls));
    bytes.remove_prefix(size_t(end - bytes.data()));
    if (!bytes.starts_with(kEnd))
        return Status(Code::Parse, "expected 'data' after the count of balls");
    bytes.remove_prefix(kEnd.size());
    if (bytes.size() != count * kNumbers * 4)
        return Status(Code::Parse, "found " + std::to_string(bytes.size()) +
                                       " bytes of data; the header needs " +
                                       std::to_string(count * kNumbers * 4));
    auto list = std::make_shared<BallList>();
    list->reserve(count);
    for (size_t i = 0; i < count; ++i) {
        std::array<float, kNumbers> numbers{};
        for (size_t k = 0; k < kNumbers; ++k) {
            numbers[k] = numberAt(bytes.data() + 4 * (i * kNumbers + k));
            if (!(numbers[k] >= kRanges[k].low && numbers[k] <= kRanges[k].high))
                return Status(Code::InvalidArgument,
                              "ball " + std::to_string(i) + ": " + kRanges[k].name + " is out of range");
        }
        list->push_back(ballOf(numbers));
    }
    return std::shared_ptr<const BallList>(std::move(list));
}

std::string writeBallList(const BallList& balls)
{
    std::string bytes = std::string(kStart) + std::to_string(balls.size()) + std::string(kEnd);
    for (const ListedBall& ball : balls)
        for (const float number : numbersOf(ball)) {
            const uint32_t word = std::bit_cast<uint32_t>(number);
            for (size_t k = 0; k < 4; ++k)
                bytes += char(word >> (8 * k) & 0xFF);
        }
    return bytes;
}

} // namespace fx::sim
