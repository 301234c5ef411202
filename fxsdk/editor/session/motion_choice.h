/// @file motion_choice.h
/// How the effect moves in the picture of the editor. It belongs to the view: the document is unchanged.
#pragma once

#include <cstdint>

namespace fx::editor {

enum class MotionKind : uint8_t
{
    Still,    ///< instances stay where they are at their start, that of a preset where its preview shows it
    Document, ///< keys, speed, triggers and jumps of the scene, or of the preset's preview
    Circle,   ///< on a level circle around the place of Still
    Throw     ///< from the place of Still along +X and upwards, until it is as high again
};

struct MotionChoice
{
    MotionKind kind = MotionKind::Document;
    double radius = 2.0; ///< [m] of the circle, > 0
    double speed = 4.0;  ///< [m/s] along the circle, or of the throw, which begins 45 degrees upwards; > 0

    bool operator==(const MotionChoice&) const = default;
};

} // namespace fx::editor
