#include "fxsdk/scene_file/instance_play.h"

namespace fx::scene_file {

double valueAt(const std::vector<TimedValue>& values, double time, double before)
{
    double value = before;
    for (const TimedValue& next : values) {
        if (next.time > time)
            break;
        value = next.value;
    }
    return value;
}

} // namespace fx::scene_file
