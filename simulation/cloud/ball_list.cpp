#include "simulation/cloud/ball_list.h"

#include <array>
#include <bit>
#include <charconv>
#include <span>

namespace fx::sim {
namespace {

using base::Code;
using base::Status;

constexpr size_t kNumbers = 12;       // of a ball
constexpr size_t kMovingNumbers = 20; // of a ball of a frame
constexpr size_t kNumberBytes = 8;    // of the number of such a ball
constexpr std::string_view kCount = "count ", kEnd = "\ndata\n";
constexpr size_t kLongestCount = 8; // [byte]

struct Range
{
    const char* name;
    float low, high;
};

constexpr std::array<Range, kMovingNumbers> kRanges{{{"x", -1e6f, 1e6f},
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
                                                     {"emission", 0.0f, 1e12f},
                                                     {"velocity", -1e9f, 1e9f},
                                                     {"velocity", -1e9f, 1e9f},
                                                     {"velocity", -1e9f, 1e9f},
                                                     {"streak", -1e6f, 1e6f},
                                                     {"streak", -1e6f, 1e6f},
                                                     {"streak", -1e6f, 1e6f},
                                                     {"age", 0.0f, kUnknownAge},
                                                     {"rate", -1e6f, 1e6f}}};

std::array<float, kNumbers> numbersOf(const ListedBall& b)
{
    return {b.center.x, b.center.y, b.center.z, b.radius,     b.crossSection, b.temperature,
            b.albedo.r, b.albedo.g, b.albedo.b, b.emission.r, b.emission.g,   b.emission.b};
}

ListedBall ballOf(std::span<const float> n)
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

void appendNumber(std::string& io, uint64_t word, size_t bytes)
{
    for (size_t k = 0; k < bytes; ++k)
        io += char(word >> (8 * k) & 0xFF);
}

/// What follows the header of a file of `version`, and the count of balls.
struct Body
{
    std::string_view bytes;
    size_t count = 0;
};

base::Result<Body> readHeader(std::string_view bytes, char version, size_t least, size_t bytesPerBall)
{
    const std::string start = std::string("fxballs ") + version + "\n" + std::string(kCount);
    if (!bytes.starts_with("fxballs "))
        return Status(Code::Parse,
                      "byte 0: expected 'fxballs'; \"fx import FILE.vdb --fit N\" writes such files");
    if (!bytes.starts_with(start))
        return Status(Code::Version, std::string("byte 8: expected version ") + version +
                                         (version == '1' ? "" : ", of a frame of a sequence,") +
                                         " and the count of balls");
    Body body;
    const char* const first = bytes.data() + start.size();
    const char* const last = first + std::min(bytes.size() - start.size(), kLongestCount);
    const auto [end, error] = std::from_chars(first, last, body.count);
    if (error != std::errc())
        return Status(Code::Parse, "byte 16: expected the count of balls");
    if (body.count < least || body.count > kMaxListedBalls)
        return Status(Code::TooLarge, "found " + std::to_string(body.count) + " balls; allowed are " +
                                          std::to_string(least) + " to " + std::to_string(kMaxListedBalls));
    bytes.remove_prefix(size_t(end - bytes.data()));
    if (!bytes.starts_with(kEnd))
        return Status(Code::Parse, "expected 'data' after the count of balls");
    bytes.remove_prefix(kEnd.size());
    if (bytes.size() != body.count * bytesPerBall)
        return Status(Code::Parse, "found " + std::to_string(bytes.size()) +
                                       " bytes of data; the header needs " +
                                       std::to_string(body.count * bytesPerBall));
    body.bytes = bytes;
    return body;
}

/// The numbers of ball `i`, which begin at `bytes`.
base::Status readNumbers(const char* bytes, size_t i, std::span<float> out)
{
    for (size_t k = 0; k < out.size(); ++k) {
        out[k] = numberAt(bytes + 4 * k);
        if (!(out[k] >= kRanges[k].low && out[k] <= kRanges[k].high))
            return {Code::InvalidArgument,
                    "ball " + std::to_string(i) + ": " + kRanges[k].name + " is out of range"};
    }
    return {};
}

} // namespace

base::Result<std::shared_ptr<const BallList>> parseBallList(std::string_view bytes)
{
    const base::Result<Body> body = readHeader(bytes, '1', 1, kNumbers * 4);
    if (!body)
        return body.status();
    auto list = std::make_shared<BallList>();
    list->reserve(body->count);
    for (size_t i = 0; i < body->count; ++i) {
        std::array<float, kNumbers> numbers{};
        if (Status status = readNumbers(body->bytes.data() + 4 * i * kNumbers, i, numbers); !status)
            return status;
        list->push_back(ballOf(numbers));
    }
    return std::shared_ptr<const BallList>(std::move(list));
}

std::string writeBallList(const BallList& balls)
{
    std::string bytes =
        "fxballs 1\n" + std::string(kCount) + std::to_string(balls.size()) + std::string(kEnd);
    for (const ListedBall& ball : balls)
        for (const float number : numbersOf(ball))
            appendNumber(bytes, std::bit_cast<uint32_t>(number), 4);
    return bytes;
}

base::Result<std::shared_ptr<const MovingBalls>> parseMovingBalls(std::string_view bytes)
{
    constexpr size_t kBytes = kMovingNumbers * 4 + kNumberBytes;
    const base::Result<Body> body = readHeader(bytes, '2', 0, kBytes);
    if (!body)
        return body.status();
    auto balls = std::make_shared<MovingBalls>();
    balls->reserve(body->count);
    for (size_t i = 0; i < body->count; ++i) {
        std::array<float, kMovingNumbers> n{};
        const char* const first = body->bytes.data() + i * kBytes;
        if (Status status = readNumbers(first, i, n); !status)
            return status;
        MovingBall& ball = balls->emplace_back();
        ball.ball = ballOf(n);
        ball.velocity = {n[12], n[13], n[14]};
        ball.streak = {n[15], n[16], n[17]};
        ball.age = n[18];
        ball.rate = n[19];
        for (size_t k = 0; k < kNumberBytes; ++k)
            ball.number |= uint64_t(static_cast<unsigned char>(first[4 * kMovingNumbers + k])) << (8 * k);
        if (i > 0 && ball.number <= (*balls)[i - 1].number)
            return Status(Code::InvalidArgument, "ball " + std::to_string(i) +
                                                     ": its number does not exceed that of the ball before");
    }
    return std::shared_ptr<const MovingBalls>(std::move(balls));
}

std::string writeMovingBalls(const MovingBalls& balls)
{
    std::string bytes =
        "fxballs 2\n" + std::string(kCount) + std::to_string(balls.size()) + std::string(kEnd);
    for (const MovingBall& ball : balls) {
        for (const float number : numbersOf(ball.ball))
            appendNumber(bytes, std::bit_cast<uint32_t>(number), 4);
        for (const glm::vec3& vector : {ball.velocity, ball.streak})
            for (int a = 0; a < 3; ++a)
                appendNumber(bytes, std::bit_cast<uint32_t>(vector[a]), 4);
        for (const float number : {ball.age, ball.rate})
            appendNumber(bytes, std::bit_cast<uint32_t>(number), 4);
        appendNumber(bytes, ball.number, kNumberBytes);
    }
    return bytes;
}

} // namespace fx::sim
