/// @file time_marks.h
/// Times that a preset or scene states, as marks of the timeline.
#pragma once

#include "fxsdk/editor/document/document.h"

#include <string>
#include <vector>

namespace fx::editor {

enum class MarkKind
{
    Start,
    Burst,
    /// At an age of the first particle of a rate or burst. Emitters whose particles are born of events alone
    /// have no such mark.
    Event,
    Trigger,  ///< of the host, to an instance
    CameraKey ///< of the camera of a scene, or of the preview of a preset
};

struct TimeMark
{
    std::string pointer; ///< of the number
    MarkKind kind = MarkKind::Start;
    double time = 0.0;  ///< [s] local time
    double begin = 0.0; ///< [s] local time of the value 0
    double least = 0.0; ///< [s] smallest value: no mark passes another one of an ordered list
    double most = 1e9;  ///< [s] largest value

    /// Whether the mark can be taken away: it stands for a whole element of a list.
    bool isRemovable() const { return kind == MarkKind::Trigger || kind == MarkKind::CameraKey; }
};

/// Starts, bursts and events at an age, of all elements of a preset, with triggers and camera keys of its
/// preview; starts and triggers of the instances of a scene, and keys of its camera.
std::vector<TimeMark> timeMarks(const Document& document);

/// What a mark is, such as "trigger \"shoot\" at 1.2 s".
std::string markText(const Document& document, const TimeMark& mark);

/// Value of the number of a mark at another time, rounded to 1/100 s and limited to the range of the schema
/// and of the mark; the present value if the range of the mark has no such time.
Json timeAt(const Document& document, const TimeMark& mark, double time);

} // namespace fx::editor
