#include "fxsdk/cli/dazzle/dazzle_apply.h"

#include "rendering/reference/dazzle/dazzle_levels.h"
#include "rendering/reference/dazzle/dazzle_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace fx::cli {
namespace {

/// The planes of red, green and blue, or gray three times over; null for what the picture does not have.
struct LightPlanes
{
    DazzlePlane* planes[3] = {};
};

LightPlanes lightOf(DazzleImage& image)
{
    LightPlanes light;
    constexpr const char* kNames[] = {"R", "G", "B"};
    for (DazzlePlane& plane : image.planes)
        for (size_t c = 0; c < 3; ++c)
            if (plane.name == kNames[c])
                light.planes[c] = &plane;
    if (!light.planes[0] && !light.planes[1] && !light.planes[2])
        for (DazzlePlane& plane : image.planes)
            if (plane.name == "Y")
                light.planes[0] = &plane;
    return light;
}

DazzleOutcome applyExact(DazzleImage& image, const LightPlanes& light, const render::DazzleSettings& settings)
{
    std::vector<float> rgba(size_t(image.width) * size_t(image.height) * 4, 0.0f);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; light.planes[c] && i < light.planes[c]->values.size(); ++i)
            rgba[4 * i + c] = light.planes[c]->values[i];
    render::DazzleHistory history{};
    const std::vector<float> out =
        render::dazzleReference(rgba, image.width, image.height, settings, 0.0, true, history);
    DazzleOutcome outcome;
    outcome.replaced = history.replaced;
    for (size_t c = 0; c < 3; ++c) {
        outcome.overflow[c] = history.frameMean[c];
        for (size_t i = 0; light.planes[c] && i < light.planes[c]->values.size(); ++i)
            light.planes[c]->values[i] = out[4 * i + c];
    }
    return outcome;
}

/// Levels of one channel; 65504 is far enough above white for any sensor that this mode is for.
std::vector<uint32_t> levelsOf(const std::vector<float>& values, float white, uint32_t& ioReplaced)
{
    const render::DazzleCounter counter(white);
    std::vector<uint32_t> levels;
    levels.reserve(values.size());
    for (const float value : values) {
        const uint32_t bits = counter.sanitized(std::bit_cast<uint32_t>(value), ioReplaced);
        const double level = std::floor(double(std::bit_cast<float>(bits)) / double(white) * 255.0 + 0.5);
        levels.push_back(uint32_t(std::min(level, 65504.0 * 255.0)));
    }
    return levels;
}

DazzleOutcome applyLevels(const LightPlanes& light, const render::DazzleSettings& settings)
{
    DazzleOutcome outcome;
    for (size_t c = 0; c < 3; ++c) {
        if (!light.planes[c])
            continue;
        std::vector<float>& values = light.planes[c]->values;
        const std::vector<uint32_t> levels = levelsOf(values, settings.white, outcome.replaced);
        double over = 0;
        for (const uint32_t level : levels)
            over += level > 255 ? double(level - 255) : 0.0; // whole numbers below 2^53: exact
        outcome.overflow[c] = over / 255.0 / double(levels.size());
        const std::vector<uint8_t> out =
            render::dazzleLevels(levels, render::dazzleGain(outcome.overflow[c], settings));
        for (size_t i = 0; i < out.size(); ++i)
            values[i] = float(double(out[i]) / 255.0 * double(settings.white));
    }
    return outcome;
}

} // namespace

base::Status readSensor(const std::string& text, render::DazzleSettings& ioSettings)
{
    const char* at = text.c_str();
    float numbers[3] = {};
    for (int k = 0; k < 3; ++k) {
        char* end = nullptr;
        numbers[k] = std::strtof(at, &end);
        const char expected = k < 2 ? ',' : '\0';
        if (end == at || *end != expected)
            return {base::Code::InvalidArgument,
                    "--sensor: three numbers A,B,C, as 0.01,0,1; not '" + text + "'"};
        at = end + 1;
    }
    render::DazzleSettings settings = ioSettings;
    settings.a = numbers[0];
    settings.b = numbers[1];
    settings.c = numbers[2];
    if (base::Status status = render::checkSensorLaw(settings); !status)
        return status;
    ioSettings = settings;
    return {};
}

base::Result<DazzleOutcome> applyDazzle(DazzleImage& ioImage, DazzleAlgorithm algorithm,
                                        const render::DazzleSettings& settings)
{
    const LightPlanes light = lightOf(ioImage);
    if (!light.planes[0] && !light.planes[1] && !light.planes[2])
        return base::Status(base::Code::InvalidArgument, "has none of the channels R, G, B and Y");
    return algorithm == DazzleAlgorithm::Exact ? applyExact(ioImage, light, settings)
                                               : applyLevels(light, settings);
}

} // namespace fx::cli
