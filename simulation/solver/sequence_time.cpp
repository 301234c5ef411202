#include "simulation/solver/sequence_time.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {
namespace {

constexpr base::Ticks kAlways = INT64_MAX / 4;              ///< later than any event
constexpr base::Ticks kLongestStep = base::kTicksPerSecond; ///< between two snapshots

} // namespace

double SequenceTime::frameAt(base::Ticks tick) const
{
    const auto frames = double(count);
    const double frame = std::max(base::toSeconds(tick), 0.0) * double(framesPerSecond);
    if (end == SequenceEnd::Hold)
        return std::min(frame, frames - 1.0);
    return std::min(std::fmod(frame, frames), std::nextafter(frames, 0.0));
}

SequenceTime::Way SequenceTime::wayTo(base::Ticks tick, base::Ticks step) const
{
    const auto since = [&](base::Ticks t) { return base::toSeconds(t) * double(framesPerSecond); };
    const double before = since(tick - step), frame = since(tick);
    if (end == SequenceEnd::Hold) {
        const auto last = double(count - 1);
        return before < last ? Way{before, frame} : Way{last, last};
    }
    const double begun = before > 0.0 ? std::floor(before / double(count)) * double(count) : 0.0;
    return {before - begun, frame - begun};
}

base::Ticks SequenceTime::restsUntil(base::Ticks tick) const
{
    const bool isOver = end == SequenceEnd::Hold && frameAt(tick - kLongestStep) >= double(count - 1);
    return isOver || count == 1 ? std::max(tick, kAlways) : tick;
}

} // namespace fx::sim
