/// @file programs.h
/// The programs of passes that belong to no technique. With those that techniques list they are all that a
/// view can need, known beforehand and compiled by the warm-up.
#pragma once

#include "rendering/frame_graph/backend.h"

#include <span>

namespace fx::render {

std::span<const ProgramDesc* const> framePrograms();

} // namespace fx::render
