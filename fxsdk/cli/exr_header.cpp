#include "fxsdk/cli/exr_header.h"

#include <array>
#include <string>

namespace fx::cli {
namespace {

constexpr std::array<unsigned char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
constexpr uint32_t kMultiPart = 0x1000; // of the version field
constexpr size_t kLongestName = 255;    // [byte] of an attribute or its type

/// Little-endian; 0 when the file ends.
uint32_t readWord(std::istream& file)
{
    std::array<unsigned char, 4> bytes{};
    if (!file.read(reinterpret_cast<char*>(bytes.data()), bytes.size()))
        return 0;
    return uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16 | uint32_t(bytes[3]) << 24;
}

/// Up to its zero; the stream fails when the name is too long or the file ends.
std::string readName(std::istream& file)
{
    std::string name;
    char letter = 0;
    while (file.get(letter) && letter != '\0') {
        name += letter;
        if (name.size() > kLongestName)
            file.setstate(std::ios::failbit);
    }
    return name;
}

/// The attributes of one part. `outIsLast` says whether it has none, which ends a list of parts.
base::Status checkPart(std::istream& file, uint64_t fileBytes, bool& outIsLast)
{
    outIsLast = true;
    for (std::string name = readName(file); file && !name.empty(); name = readName(file)) {
        outIsLast = false;
        readName(file); // its type
        const uint32_t size = readWord(file);
        const uint64_t at = file ? uint64_t(file.tellg()) : fileBytes;
        if (!file || size > fileBytes - at)
            return {base::Code::Parse, "the header is cut: attribute \"" + name + "\" says that it has " +
                                           std::to_string(size) + " bytes, the file has " +
                                           std::to_string(fileBytes - at) + " more"};
        file.seekg(std::streamoff(size), std::ios::cur);
    }
    outIsLast = outIsLast || !file;
    return {};
}

} // namespace

base::Status checkExrAttributes(std::istream& file, uint64_t fileBytes)
{
    std::array<unsigned char, 4> magic{};
    if (!file.read(reinterpret_cast<char*>(magic.data()), magic.size()) || magic != kMagic)
        return {};
    const bool isMultiPart = (readWord(file) & kMultiPart) != 0;
    bool isLast = false;
    do {
        if (base::Status status = checkPart(file, fileBytes, isLast); !status)
            return status;
    } while (isMultiPart && !isLast);
    return {};
}

} // namespace fx::cli
