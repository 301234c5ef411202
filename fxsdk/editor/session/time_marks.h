/// @file time_marks.h
/// Times that a preset states, as marks of the timeline.
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
    Event
};

struct TimeMark
{
    std::string pointer; ///< of the number
    MarkKind kind = MarkKind::Start;
    double time = 0.0;  ///< [s] local time
    double begin = 0.0; ///< [s] local time of the value 0
};

/// Starts, bursts and events at an age, of all elements of a preset; starts of the instances of a scene.
std::vector<TimeMark> timeMarks(const Document& document);

/// Value of the number of a mark at another time, rounded to 1/100 s and limited to the range of the schema.
Json timeAt(const Document& document, const TimeMark& mark, double time);

} // namespace fx::editor
