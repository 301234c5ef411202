/// @file programs.h
/// The programs of passes that belong to no technique. Together with the programs of techniques, they are all
/// programs of a view. The warm-up compiles them.
#pragma once

#include "rendering/frame_graph/backend.h"

#include <span>

namespace fx::render {

std::span<const ProgramDesc* const> framePrograms();

} // namespace fx::render
