#include "fxsdk/assets/volume_file.h"

#include "foundation/math/hash.h"
#include "foundation/math/signed_half.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <span>
#include <tuple>

namespace fx::asset {

namespace {

using base::Code;
using base::Status;

constexpr size_t kVoxels = base::kVolumeBrickVoxels;
constexpr float kFarthest = 1e6f, kThinnest = 1e-6f;
constexpr uint32_t kHalfOne = 0x3C00;

/// A kind of values.
struct Channel
{
    std::string_view name;
    float most; ///< largest value that a file may state
    size_t components;
    bool isSigned = false;
};
constexpr std::array<Channel, 6> kChannels{{{"extinction", 1e12f, 1},
                                            {"temperature", 1e5f, 1},
                                            {"emission", base::kMostVolumeLight, 3},
                                            {"emission_rates", base::kMostVolumeRate, 1, true},
                                            {"albedos", 1.0f, 3},
                                            {"velocities", 1e9f, 3, true}}};
enum : size_t
{
    Extinction,
    Temperature,
    Emission,
    EmissionRate,
    Albedo,
    Velocity
};

std::span<const float> asFloats(const std::vector<glm::vec3>& v)
{
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    return {v.empty() ? nullptr : &v.front().x, v.size() * 3};
}

std::span<float> asFloats(std::vector<glm::vec3>& v)
{
    return {v.empty() ? nullptr : &v.front().x, v.size() * 3};
}

/// Reads the lines of the header.
class Header
{
public:
    explicit Header(std::string_view bytes) : rest_(bytes) {}

    /// Takes the words behind `name` if this is the name of the next line.
    bool line(std::string_view name)
    {
        if (!rest_.starts_with(name) || rest_.size() == name.size() ||
            (rest_[name.size()] != ' ' && rest_[name.size()] != '\n'))
            return false;
        const size_t end = rest_.find('\n');
        if (end == std::string_view::npos)
            return false;
        words_ = rest_.substr(name.size(), end - name.size());
        rest_.remove_prefix(end + 1);
        ++number_;
        return true;
    }
    /// @return false: the next word of the line is no number
    template <class T, class... Format>
    bool number(T& out, Format... format)
    {
        if (!words_.starts_with(' '))
            return false;
        const char* const last = words_.data() + words_.size();
        const auto [end, error] = std::from_chars(words_.data() + 1, last, out, format...);
        if (error != std::errc())
            return false;
        words_.remove_prefix(size_t(end - words_.data()));
        return true;
    }
    bool isAtEnd() const { return words_.empty(); } ///< of the line
    Status expected(std::string_view what) const
    {
        return {Code::Parse, "line " + std::to_string(number_) + ": expected " + std::string(what) +
                                 "; \"fx import FILE.vdb --bricks\" writes such files"};
    }
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_, words_;
    int number_ = 1; ///< of the next line
};

bool isIn(float value, float low, float high)
{
    return value >= low && value <= high; // not with NaN
}

struct Contents
{
    base::VoxelVolume volume;
    size_t bricks = 0;
    std::array<float, kChannels.size()> largest{}; ///< 0: the channel is absent
    size_t hashLine = 0;                           ///< [byte] where the line of the hash begins
    uint64_t hash = 0;
};

/// The lines between the version and the channels.
Status readShape(Header& io, Contents& out)
{
    base::VoxelVolume& v = out.volume;
    if (!io.line("bricks") || !io.number(out.bricks) || !io.isAtEnd())
        return io.expected("'bricks' and their number");
    if (out.bricks < 1 || out.bricks > base::kMaxVolumeBricks)
        return {Code::TooLarge, "found " + std::to_string(out.bricks) + " bricks; allowed are 1 to " +
                                    std::to_string(base::kMaxVolumeBricks)};
    if (!io.line("side") || !io.number(v.side) || !io.isAtEnd() || !isIn(v.side, kThinnest, kFarthest))
        return io.expected("'side' and 1e-6 to 1e6");
    if (!io.line("origin"))
        return io.expected("'origin'");
    for (int a = 0; a < 3; ++a)
        if (!io.number(v.origin[a]) || !isIn(v.origin[a], -kFarthest, kFarthest))
            return io.expected("three numbers within 1e6");
    if (!io.isAtEnd() || !io.line("albedo"))
        return io.expected("'albedo'");
    for (int a = 0; a < 3; ++a)
        if (!io.number(v.evenAlbedo[a]) || !isIn(v.evenAlbedo[a], 0.0f, 1.0f))
            return io.expected("three numbers from 0 to 1");
    return io.isAtEnd() ? Status() : io.expected("the end of the line");
}

/// @param size [byte] of the file
Status readChannels(Header& io, size_t size, Contents& out)
{
    for (size_t c = 0; c < kChannels.size(); ++c) {
        if (!io.line(kChannels[c].name)) {
            if (c == Extinction)
                return io.expected("'extinction'");
            continue;
        }
        if (!io.number(out.largest[c]) || !io.isAtEnd() || !(out.largest[c] > 0.0f) ||
            !(out.largest[c] <= kChannels[c].most))
            return io.expected("a largest value above 0 and in the range of '" +
                               std::string(kChannels[c].name) + "'");
    }
    out.hashLine = size - io.rest().size();
    if (!io.line("hash") || !io.number(out.hash, 16) || !io.isAtEnd())
        return io.expected("a channel or 'hash'");
    return io.line("data") && io.isAtEnd() ? Status() : io.expected("'data'");
}

bool isBehind(const glm::ivec3& before, const glm::ivec3& b)
{
    return std::tuple(before.z, before.y, before.x) < std::tuple(b.z, b.y, b.x);
}

uint32_t wordAt(std::string_view data, size_t word)
{
    return uint32_t(static_cast<unsigned char>(data[2 * word])) |
           uint32_t(static_cast<unsigned char>(data[2 * word + 1])) << 8;
}

Status readBricks(std::string_view data, Contents& io)
{
    std::vector<glm::ivec3>& bricks = io.volume.bricks;
    bricks.reserve(io.bricks);
    for (size_t i = 0; i < io.bricks; ++i) {
        const glm::ivec3 b(int(wordAt(data, 3 * i)), int(wordAt(data, 3 * i + 1)),
                           int(wordAt(data, 3 * i + 2)));
        for (int a = 0; a < 3; ++a)
            if (b[a] < 1 || b[a] >= base::kMaxVolumeBricksPerAxis)
                return {Code::InvalidArgument, "brick " + std::to_string(i) +
                                                   ": a coordinate is not in 1 to " +
                                                   std::to_string(base::kMaxVolumeBricksPerAxis - 1)};
        if (i > 0 && !isBehind(bricks.back(), b))
            return {Code::InvalidArgument, "brick " + std::to_string(i) + ": is not behind the one before"};
        bricks.push_back(b);
    }
    return {};
}

Status readValues(std::string_view data, const Channel& channel, float largest, std::span<float> out)
{
    for (size_t i = 0; i < out.size(); ++i) {
        const uint32_t half = wordAt(data, i);
        if ((channel.isSigned ? half & ~base::kHalfSign : half) > kHalfOne)
            return {Code::InvalidArgument,
                    std::string(channel.name) + ": value " + std::to_string(i) + " is out of range"};
        out[i] = largest * base::fromSignedHalf(half);
    }
    return {};
}

/// The values of a channel, for `voxels` voxels.
std::span<float> allocate(size_t channel, size_t voxels, base::VoxelVolume& io)
{
    if (kChannels[channel].components == 1) {
        std::vector<float>& numbers = channel == Extinction    ? io.extinction
                                      : channel == Temperature ? io.temperature
                                                               : io.emissionRate;
        numbers.resize(voxels);
        return numbers;
    }
    std::vector<glm::vec3>& vectors = channel == Emission ? io.emission
                                      : channel == Albedo ? io.albedo
                                                          : io.velocity;
    vectors.resize(voxels);
    return asFloats(vectors);
}

void appendWord(std::string& io, uint32_t word)
{
    io += char(word & 0xFF);
    io += char(word >> 8 & 0xFF);
}

std::string shortest(float number)
{
    char text[48];
    const auto [end, error] = std::to_chars(std::begin(text), std::end(text), number);
    return {std::begin(text), end};
}

std::array<std::span<const float>, kChannels.size()> channelsOf(const base::VoxelVolume& v)
{
    return {v.extinction,   v.temperature,      asFloats(v.emission),
            v.emissionRate, asFloats(v.albedo), asFloats(v.velocity)};
}

Status checkShape(const base::VoxelVolume& v)
{
    if (v.bricks.empty() || v.bricks.size() > base::kMaxVolumeBricks)
        return {Code::TooLarge, std::to_string(v.bricks.size()) +
                                    " bricks of 8 x 8 x 8 voxels; allowed are 1 to " +
                                    std::to_string(base::kMaxVolumeBricks) + ": use larger voxels"};
    if (!isIn(v.side, kThinnest, kFarthest) || !isIn(v.origin.x, -kFarthest, kFarthest) ||
        !isIn(v.origin.y, -kFarthest, kFarthest) || !isIn(v.origin.z, -kFarthest, kFarthest))
        return {Code::InvalidArgument, "side or place of the voxels is out of range; change --length-scale"};
    const size_t voxels = v.bricks.size() * kVoxels;
    for (const size_t size :
         {v.temperature.size(), v.emission.size(), v.emissionRate.size(), v.albedo.size(), v.velocity.size()})
        if (v.extinction.size() != voxels || (size != 0 && size != voxels))
            return {Code::InvalidArgument, "the arrays do not have 512 values for each brick"};
    for (int a = 0; a < 3; ++a)
        if (!isIn(v.evenAlbedo[a], 0.0f, 1.0f))
            return {Code::InvalidArgument, "the albedo is not in 0 to 1; change --albedo"};
    if (std::ranges::adjacent_find(v.bricks, std::not_fn(isBehind)) != v.bricks.end())
        return {Code::InvalidArgument, "the bricks are not in ascending order"};
    for (const glm::ivec3& b : v.bricks)
        for (int a = 0; a < 3; ++a)
            if (b[a] < 1 || b[a] >= base::kMaxVolumeBricksPerAxis)
                return {Code::TooLarge, "more than " +
                                            std::to_string((base::kMaxVolumeBricksPerAxis - 1) * 8) +
                                            " voxels along an axis: use larger voxels"};
    return {};
}

/// Where voxels have no medium, neither do they emit: rounding may leave light without extinction.
Status checkEmission(const base::VoxelVolume& v)
{
    for (size_t i = 0; i < v.emission.size(); ++i)
        if (!(v.extinction[i] > 0.0f) && v.emission[i] != glm::vec3(0.0f))
            return {Code::InvalidArgument,
                    "emission: voxel " + std::to_string(i) + " emits, but has no extinction"};
    return {};
}

} // namespace

uint64_t volumeHash(std::string_view header, std::string_view data)
{
    return base::hashBytes(base::hashBytes(1, header.data(), header.size()), data.data(), data.size());
}

base::Result<base::VoxelVolume> parseVolume(std::string_view bytes)
{
    if (!bytes.starts_with("fxvolume "))
        return Header(bytes).expected("'fxvolume'");
    Header header(bytes);
    uint32_t version = 0;
    if (!header.line("fxvolume") || !header.number(version) || !header.isAtEnd() || version != 1)
        return Status(Code::Version, "line 1: expected version 1");
    Contents contents;
    if (Status status = readShape(header, contents); !status)
        return status;
    if (Status status = readChannels(header, bytes.size(), contents); !status)
        return status;
    std::string_view data = header.rest();
    size_t words = 3;
    for (size_t c = 0; c < kChannels.size(); ++c)
        words += contents.largest[c] > 0.0f ? kChannels[c].components * kVoxels : 0;
    if (data.size() != contents.bricks * words * 2)
        return Status(Code::Parse, "found " + std::to_string(data.size()) +
                                       " bytes of data; the header needs " +
                                       std::to_string(contents.bricks * words * 2));
    if (volumeHash(bytes.substr(0, contents.hashLine), data) != contents.hash)
        return Status(Code::Parse, "the file is damaged: its hash is another one");
    if (Status status = readBricks(data, contents); !status)
        return status;
    data.remove_prefix(contents.bricks * 6);
    base::VoxelVolume& v = contents.volume;
    const size_t voxels = contents.bricks * kVoxels;
    for (size_t c = 0; c < kChannels.size(); ++c) {
        if (!(contents.largest[c] > 0.0f))
            continue;
        const std::span<float> values = allocate(c, voxels, v);
        if (Status status = readValues(data, kChannels[c], contents.largest[c], values); !status)
            return status;
        data.remove_prefix(values.size() * 2);
    }
    if (std::ranges::none_of(v.extinction, [](float x) { return x > 0.0f; }))
        return Status(Code::InvalidArgument, "no voxel has medium");
    if (Status status = checkEmission(v); !status)
        return status;
    return std::move(contents.volume);
}

base::Result<std::string> writeVolume(const base::VoxelVolume& volume)
{
    if (Status status = checkShape(volume); !status)
        return status;
    const auto channels = channelsOf(volume);
    const float densest = *std::ranges::max_element(volume.extinction);
    const auto isEmpty = [&](size_t voxel) { return base::toHalf(volume.extinction[voxel] / densest) == 0; };
    glm::vec3 evenAlbedo = volume.evenAlbedo;
    std::string data, lines;
    for (const glm::ivec3& brick : volume.bricks)
        for (int a = 0; a < 3; ++a)
            appendWord(data, uint32_t(brick[a]));
    for (size_t c = 0; c < kChannels.size(); ++c) {
        float largest = 0.0f;
        for (const float value : channels[c]) {
            if (!isIn(value, kChannels[c].isSigned ? -kChannels[c].most : 0.0f, kChannels[c].most))
                return Status(Code::InvalidArgument, std::string(kChannels[c].name) +
                                                         ": a value is out of range; change its --...-scale");
            largest = std::max(largest, std::abs(value));
        }
        if (c == Albedo && !channels[c].empty() && !(largest > 0.0f))
            evenAlbedo = glm::vec3(0.0f);
        if (!(largest > 0.0f) && c == Velocity && !channels[c].empty())
            largest = kThinnest; // at rest, which is not the same as unknown
        if (!(largest > 0.0f))
            continue;
        lines += std::string(kChannels[c].name) + " " + shortest(largest) + "\n";
        for (size_t i = 0; i < channels[c].size(); ++i)
            appendWord(data,
                       c == Emission && isEmpty(i / 3) ? 0 : base::toSignedHalf(channels[c][i] / largest));
    }
    if (!lines.starts_with(kChannels[Extinction].name))
        return Status(Code::InvalidArgument, "the volume has no medium");
    std::string text = "fxvolume 1\nbricks " + std::to_string(volume.bricks.size()) + "\nside " +
                       shortest(volume.side) + "\norigin";
    for (int a = 0; a < 3; ++a)
        text += " " + shortest(volume.origin[a]);
    text += "\nalbedo";
    for (int a = 0; a < 3; ++a)
        text += " " + shortest(evenAlbedo[a]);
    text += "\n" + lines;
    char hash[20];
    const auto [end, error] = std::to_chars(std::begin(hash), std::end(hash), volumeHash(text, data), 16);
    return text + "hash " + std::string(std::begin(hash), end) + "\ndata\n" + data;
}

} // namespace fx::asset
