/// @file programs.h
/// Every program that a view can need: finite, known beforehand, compiled by the warm-up.
#pragma once

#include "rendering/frame_graph/backend.h"

#include <span>

namespace fx::render {

std::span<const ProgramDesc* const> allPrograms();

} // namespace fx::render
