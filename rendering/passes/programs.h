/// @file programs.h
/// The programs of passes that belong to no technique. These and the programs of techniques are all programs
/// of a view. They are compiled by the warm-up.
#pragma once

#include "rendering/frame_graph/backend.h"

#include <span>

namespace fx::render {

std::span<const ProgramDesc* const> framePrograms();

} // namespace fx::render
