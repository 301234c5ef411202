/// @file png_repair.h
/// Corrects the checksums of PNG chunks, so that the decoder processes damaged chunks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::fuzz {

/// CRC of ISO 3309, the checksum of PNG.
inline uint32_t crcOf(const uint8_t* bytes, size_t count)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t i = 0; i < count; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/// Writes the CRC of every complete chunk of the PNG file `bytes`.
inline void repairPng(std::vector<uint8_t>& bytes)
{
    constexpr size_t kSignature = 8, kHead = 8, kCrc = 4; // [byte]
    for (size_t at = kSignature; at + kHead + kCrc <= bytes.size();) {
        uint32_t length = 0;
        for (size_t i = 0; i < 4; ++i)
            length = length << 8 | bytes[at + i];
        if (length > bytes.size() - at - kHead - kCrc)
            return;
        const uint32_t crc = crcOf(&bytes[at + 4], size_t(length) + 4);
        uint8_t* const out = &bytes[at + kHead + length];
        for (size_t i = 0; i < 4; ++i)
            out[i] = uint8_t(crc >> (24 - 8 * i));
        at += kHead + length + kCrc;
    }
}

} // namespace fx::fuzz
