#include "fxsdk/cli/dazzle/exr_header.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace fx::cli {
namespace {

constexpr std::array<unsigned char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
constexpr uint32_t kMultiPart = 0x1000;  // of the version field
constexpr size_t kLongestName = 255;     // [byte] of an attribute or its type
constexpr uint64_t kDeflateRatio = 1032; // most bytes that one byte of zlib data stands for

/// Types of which the library reads so many bytes, whatever the file says.
struct FixedType
{
    std::string_view name;
    uint32_t size; ///< [byte]
};
constexpr std::array<FixedType, 26> kFixedTypes{{{"box2f", 16},
                                                 {"box2i", 16},
                                                 {"chromaticities", 32},
                                                 {"compression", 1},
                                                 {"deepImageState", 1},
                                                 {"double", 8},
                                                 {"envmap", 1},
                                                 {"float", 4},
                                                 {"int", 4},
                                                 {"keycode", 28},
                                                 {"lineOrder", 1},
                                                 {"m33d", 72},
                                                 {"m33f", 36},
                                                 {"m44d", 128},
                                                 {"m44f", 64},
                                                 {"rational", 8},
                                                 {"tiledesc", 9},
                                                 {"timecode", 8},
                                                 {"v2d", 16},
                                                 {"v2f", 8},
                                                 {"v2i", 8},
                                                 {"v3d", 24},
                                                 {"v3f", 12},
                                                 {"v3i", 12},
                                                 {"v4d", 32},
                                                 {"v4f", 16}}};

/// Reads a header from its bytes. Past the end everything is 0, and failed() is true.
class HeaderReader
{
public:
    explicit HeaderReader(std::string_view bytes) : left_(bytes) {}

    bool failed() const { return failed_; }
    size_t left() const { return left_.size(); }

    /// Little-endian.
    uint32_t word()
    {
        const std::string_view bytes = take(4);
        uint32_t result = 0;
        for (size_t i = 0; i < bytes.size(); ++i)
            result |= uint32_t(static_cast<unsigned char>(bytes[i])) << (8 * i);
        return result;
    }
    /// Up to its zero.
    std::string_view name()
    {
        const size_t length = left_.substr(0, kLongestName + 1).find('\0');
        return length == std::string_view::npos ? take(left_.size() + 1) : take(length + 1).substr(0, length);
    }
    std::string_view take(size_t count)
    {
        failed_ = failed_ || count > left_.size();
        const std::string_view result = left_.substr(0, failed_ ? 0 : count);
        left_.remove_prefix(result.size());
        return result;
    }

private:
    std::string_view left_;
    bool failed_ = false;
};

/// Channels, each a name and 16 bytes, and an empty name at the end.
bool isChannelList(std::string_view value)
{
    HeaderReader reader(value);
    while (!reader.failed() && !reader.name().empty())
        reader.take(16);
    return !reader.failed() && reader.left() == 0;
}

/// Texts, each a number of bytes and the bytes.
bool isTextList(std::string_view value)
{
    HeaderReader reader(value);
    while (!reader.failed() && reader.left() > 0)
        reader.take(reader.word());
    return !reader.failed();
}

/// Width and height, and four bytes a pixel.
bool isPreview(std::string_view value)
{
    HeaderReader reader(value);
    const uint64_t width = reader.word(), height = reader.word();
    return !reader.failed() && width <= reader.left() && height <= reader.left() &&
           4 * width * height == reader.left();
}

/// Whether the library reads as many bytes as the value has, and takes no more memory than they call for.
bool isAsItSays(std::string_view type, std::string_view value)
{
    const auto fixed = std::find_if(kFixedTypes.begin(), kFixedTypes.end(),
                                    [&](const FixedType& candidate) { return candidate.name == type; });
    if (fixed != kFixedTypes.end())
        return value.size() == fixed->size;
    if (type == "chlist")
        return isChannelList(value);
    if (type == "stringvector")
        return isTextList(value);
    if (type == "preview")
        return isPreview(value);
    if (type == "floatvector")
        return value.size() % 4 == 0;
    if (type == "idmanifest") // the number of its bytes when unpacked, and zlib data
        return value.size() >= 4 && HeaderReader(value).word() <= kDeflateRatio * value.size();
    return true; // texts and types that the library does not know are taken as they are
}

base::Status cutHeader(const std::string& what, uint64_t left)
{
    if (left > 0)
        return {base::Code::TooLarge,
                "the header has more than " + std::to_string(kMaxHeaderBytes) + " bytes"};
    return {base::Code::Parse, "the header is cut" + what};
}

/// The attributes of one part. `beyond`: [byte] of the file that the reader does not have. `outIsLast` says
/// whether it has none, which ends a list of parts.
base::Status checkPart(HeaderReader& reader, uint64_t beyond, bool& outIsLast)
{
    outIsLast = true;
    for (std::string_view name = reader.name(); !name.empty(); name = reader.name()) {
        outIsLast = false;
        const std::string_view type = reader.name();
        const uint32_t size = reader.word();
        const size_t left = reader.left();
        const std::string_view value = reader.take(size);
        if (reader.failed())
            return cutHeader(": attribute \"" + std::string(name) + "\" says that it has " +
                                 std::to_string(size) + " bytes, the file has " + std::to_string(left) +
                                 " more",
                             size > left + beyond ? 0 : beyond);
        if (!isAsItSays(type, value))
            return {base::Code::Parse, "the header is damaged: attribute \"" + std::string(name) +
                                           "\" of type \"" + std::string(type) + "\" cannot have " +
                                           std::to_string(size) + " bytes"};
    }
    return {};
}

} // namespace

base::Status checkExrAttributes(std::string_view beginning, uint64_t fileBytes)
{
    HeaderReader reader(beginning);
    const std::string_view magic = reader.take(kMagic.size());
    const auto isSame = [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; };
    if (!std::equal(magic.begin(), magic.end(), kMagic.begin(), kMagic.end(), isSame))
        return {};
    const bool isMultiPart = (reader.word() & kMultiPart) != 0;
    bool isLast = false;
    do {
        if (base::Status status = checkPart(reader, fileBytes - beginning.size(), isLast); !status)
            return status;
    } while (isMultiPart && !isLast);
    return reader.failed() ? cutHeader("", fileBytes - beginning.size()) : base::Status();
}

} // namespace fx::cli
