/// @file programs.h
/// Lists the programs of all passes that do not belong to a technique. The warm-up of a view compiles these
/// programs and the programs of techniques.
#pragma once

#include "rendering/frame_graph/backend.h"

#include <span>

namespace fx::render {

std::span<const ProgramDesc* const> framePrograms();

} // namespace fx::render
