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

glm::quat rotationOf(const glm::dvec3& degrees)
{
    const glm::dvec3 angles = glm::radians(degrees);
    return glm::quat(glm::angleAxis(angles.z, glm::dvec3(0, 0, 1)) *
                     glm::angleAxis(angles.y, glm::dvec3(0, 1, 0)) *
                     glm::angleAxis(angles.x, glm::dvec3(1, 0, 0)));
}

} // namespace fx::scene_file
