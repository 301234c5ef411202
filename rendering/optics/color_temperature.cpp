#include "rendering/optics/color_temperature.h"

#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace fx::render {
namespace {

constexpr float kColdest = 401.0f, kHottest = 10000.0f; // [K] that have a color
constexpr float kSameRed = 1e-4f;
constexpr int kHalvings = 20;

} // namespace

glm::vec3 blackBodyColor(float temperature)
{
    const glm::vec3 light = blackBodyLuminance(temperature);
    const float luminance = glm::dot(light, glm::vec3(kLuminance));
    return luminance > 0.0f ? light / luminance : glm::vec3(1.0f);
}

float colorTemperature(float red, float guess)
{
    if (guess >= kColdest && std::abs(blackBodyColor(guess).x - red) <= kSameRed)
        return guess;
    float low = 1.0f / kHottest, high = 1.0f / kColdest; // [1/K]
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = 0.5f * (low + high);
        (blackBodyColor(1.0f / middle).x < red ? low : high) = middle; // colder matter is redder
    }
    return 1.0f / (0.5f * (low + high));
}

} // namespace fx::render
