/// @file state_envelope.h
/// Header of a saved state. The header serves to detect foreign, outdated, truncated and damaged states.
///
/// magic u32 · version of the SDK u32 · layout u32 · 0 u32 · size of the state u64 · checksum u64 · state.
/// Numbers are in the byte order of the machine. A state with another byte order is detected by its magic
/// number.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace fx::scene {

constexpr size_t kStateHeaderBytes = 32;

/// Incremented with every change of the layout of the state within one version of the SDK.
constexpr uint32_t kStateLayout = 6;

/// Writes the header of a saved state.
/// @param sdkVersion version in the form of FX_VERSION
/// @param out receives kStateHeaderBytes bytes
void writeStateHeader(std::span<const std::byte> state, uint32_t sdkVersion, std::byte* out);

/// Checks the header of a saved state, and returns the state without the header.
/// @return Parse (not a state, or truncated, or damaged), Version (another version of SDK or layout)
base::Result<std::span<const std::byte>> openState(std::span<const std::byte> bytes, uint32_t sdkVersion);

} // namespace fx::scene
