/// @file state_bytes.h
/// The whole state as bytes.
#pragma once

#include "foundation/result/status.h"
#include "simulation/sph/dynamics/dynamics_state.h"

#include <cstddef>
#include <span>
#include <vector>

namespace fx::sim {

/// Appends the state between two frames to `out`: a header, then column after column in the order of places.
template <class T>
void saveState(const DynamicsState<T>& state, std::vector<std::byte>& out);

/// Reads what saveState has written for the same definition. The tree is not in the bytes: it follows from
/// the positions by which particles were sorted last.
template <class T>
base::Status restoreState(DynamicsState<T>& state, std::span<const std::byte> bytes);

} // namespace fx::sim
