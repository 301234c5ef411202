#include "fxsdk/scene/state_envelope.h"

#include "foundation/math/hash.h"

#include <cstddef>
#include <cstring>
#include <string>

namespace fx::scene {

namespace {

constexpr uint32_t kMagic = 0x54535846; // "FXST" where the lowest byte comes first

struct Header
{
    uint32_t magic = kMagic;
    uint32_t sdkVersion = 0;
    uint32_t layout = kStateLayout;
    uint32_t reserved = 0;
    uint64_t size = 0; ///< [byte] of the state
    uint64_t checksum = 0;
};
static_assert(sizeof(Header) == kStateHeaderBytes);

/// Of the state and of all of the header before the checksum.
uint64_t checksumOf(const Header& header, std::span<const std::byte> state)
{
    const uint64_t hash = base::hashBytes(0, &header, offsetof(Header, checksum));
    return base::hashBytes(hash, state.data(), state.size());
}

std::string versionText(uint32_t version)
{
    return std::to_string(version >> 16) + '.' + std::to_string((version >> 8) & 0xFF) + '.' +
           std::to_string(version & 0xFF);
}

} // namespace

void writeStateHeader(std::span<const std::byte> state, uint32_t sdkVersion, std::byte* out)
{
    Header header;
    header.sdkVersion = sdkVersion;
    header.size = state.size();
    header.checksum = checksumOf(header, state);
    std::memcpy(out, &header, sizeof header);
}

base::Result<std::span<const std::byte>> openState(std::span<const std::byte> bytes, uint32_t sdkVersion)
{
    Header header;
    if (bytes.size() < sizeof header)
        return base::Status(base::Code::Parse, "the bytes are fewer than the header of a saved state");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != kMagic)
        return base::Status(base::Code::Parse, "the bytes are not a saved state");
    if (header.sdkVersion != sdkVersion)
        return base::Status(base::Code::Version, "the state was saved by version " +
                                                     versionText(header.sdkVersion) + " of fxsdk, this is " +
                                                     versionText(sdkVersion) +
                                                     "; states do not outlive a version");
    if (header.layout != kStateLayout)
        return base::Status(base::Code::Version,
                            "the state has another layout than this build of fxsdk writes");
    const std::span<const std::byte> state = bytes.subspan(sizeof header);
    if (header.size != state.size())
        return base::Status(base::Code::Parse, "the state has " + std::to_string(state.size()) +
                                                   " bytes, its header says " + std::to_string(header.size));
    if (header.checksum != checksumOf(header, state))
        return base::Status(base::Code::Parse, "the state is damaged: its checksum is wrong");
    return state;
}

} // namespace fx::scene
