#include "fxsdk/editor/session/playback.h"

#include <algorithm>
#include <cmath>

namespace fx::editor {

int64_t Playback::lastStep() const
{
    return std::max<int64_t>(1, std::llround(end * kStepsPerSecond));
}

void Playback::scrub(double seconds)
{
    const double limited = std::isfinite(seconds) ? std::clamp(seconds, 0.0, end) : 0.0;
    step_ = std::min<int64_t>(std::llround(limited * kStepsPerSecond), lastStep());
    rest_ = 0.0;
}

void Playback::advance(double seconds)
{
    if (!isPlaying || !(seconds > 0.0))
        return;
    rest_ += seconds * speed * kStepsPerSecond;
    const auto whole = int64_t(std::floor(std::min(rest_, 1e9)));
    rest_ -= double(whole);
    step_ += whole;
    if (step_ <= lastStep())
        return;
    step_ = isLooping ? step_ % (lastStep() + 1) : lastStep();
    isPlaying = isLooping;
}

} // namespace fx::editor
