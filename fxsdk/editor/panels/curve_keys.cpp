#include "fxsdk/editor/panels/curve_keys.h"

#include <algorithm>
#include <cmath>

namespace fx::editor {

namespace {

constexpr double kCloser = 1e-4; // smallest distance in time of two keys

bool isColor(const Json& value)
{
    return value.is_array() && value.size() == 3 &&
           std::all_of(value.begin(), value.end(), [](const Json& channel) { return channel.is_number(); });
}

double channelOf(const Json& value, size_t channel)
{
    if (value.is_array())
        return channel < value.size() ? value[channel].get<double>() : 0.0;
    return value.is_number() ? value.get<double>() : 0.0;
}

/// Ratio of Planck's law at a wavelength [m] to that at 550 nm.
double planckRatio(double wavelength, double kelvin)
{
    constexpr double kSecond = 0.014387769; // second radiation constant [m K]
    constexpr double kGreen = 550e-9;       // [m]
    return std::pow(kGreen / wavelength, 5.0) * std::expm1(kSecond / (kGreen * kelvin)) /
           std::expm1(kSecond / (wavelength * kelvin));
}

} // namespace

bool isCurve(const Json& value)
{
    if (!value.is_object())
        return value.is_number() || isColor(value);
    if (!value.contains("keys") || !value["keys"].is_array() || value["keys"].empty())
        return false;
    const Json& keys = value["keys"];
    const bool ofColors = keys[0].is_array() && keys[0].size() == 2 && keys[0][1].is_array();
    return std::all_of(keys.begin(), keys.end(), [&](const Json& key) {
        return key.is_array() && key.size() == 2 && key[0].is_number() &&
               (ofColors ? isColor(key[1]) : key[1].is_number());
    });
}

Json keysOf(const Json& value)
{
    if (value.is_object() && value.contains("keys") && value["keys"].is_array() && !value["keys"].empty())
        return value["keys"];
    return Json::array({Json::array({0, value.is_object() ? Json(0) : value})});
}

Json curveOf(const Json& value, Json keys)
{
    Json curve = value.is_object() ? value : Json::object();
    curve["keys"] = std::move(keys);
    return curve;
}

double curveAt(const Json& keys, double t, size_t channel)
{
    size_t next = 0;
    while (next < keys.size() && keys[next][0].get<double>() <= t)
        ++next;
    if (next == 0 || next == keys.size())
        return channelOf(keys[next == 0 ? 0 : next - 1][1], channel);
    const double from = keys[next - 1][0].get<double>();
    const double to = keys[next][0].get<double>();
    const double part = to > from ? (t - from) / (to - from) : 1.0;
    return (1.0 - part) * channelOf(keys[next - 1][1], channel) + part * channelOf(keys[next][1], channel);
}

double roundedKey(double value)
{
    if (value == 0.0 || !std::isfinite(value))
        return 0.0;
    const double unit = std::pow(10.0, 5.0 - std::floor(std::log10(std::abs(value))));
    return std::round(value * unit) / unit;
}

std::pair<double, double> freeWay(const Json& keys, const std::vector<size_t>& selected)
{
    const auto isMoved = [&](size_t i) {
        return std::find(selected.begin(), selected.end(), i) != selected.end();
    };
    double least = -1.0;
    double most = 1.0;
    for (const size_t i : selected) {
        const double at = keys[i][0].get<double>();
        const double before = i == 0 ? 0.0 : keys[i - 1][0].get<double>() + kCloser;
        const double after = i + 1 == keys.size() ? 1.0 : keys[i + 1][0].get<double>() - kCloser;
        if (i == 0 || !isMoved(i - 1))
            least = std::max(least, std::min(before - at, 0.0));
        if (i + 1 == keys.size() || !isMoved(i + 1))
            most = std::min(most, std::max(after - at, 0.0));
    }
    return {least, most};
}

void moveKeys(Json& ioKeys, const std::vector<size_t>& selected, double time, double value, double lowest,
              double highest)
{
    const auto [least, most] = freeWay(ioKeys, selected);
    const double way = std::clamp(time, least, most);
    for (const size_t i : selected) {
        ioKeys[i][0] = roundedKey(std::clamp(ioKeys[i][0].get<double>() + way, 0.0, 1.0));
        if (ioKeys[i][1].is_number())
            ioKeys[i][1] = roundedKey(std::clamp(ioKeys[i][1].get<double>() + value, lowest, highest));
    }
}

KeyMove snapped(const Json& key, KeyMove move, double range)
{
    constexpr double kParts = 20.0;
    const auto snap = [](double from, double way, double step) {
        return step > 0.0 ? std::round((from + way) / step) * step - from : way;
    };
    move.time = snap(key[0].get<double>(), move.time, 1.0 / kParts);
    if (key[1].is_number()) {
        // Steps of 1, 2 or 5 times a power of ten, so that values stay short.
        const double wanted = std::max(range / kParts, 1e-12);
        const double power = std::pow(10.0, std::floor(std::log10(wanted)));
        const double step = wanted < 2.0 * power ? power : wanted < 5.0 * power ? 2.0 * power : 5.0 * power;
        move.value = snap(key[1].get<double>(), move.value, step);
    }
    return move;
}

float toDisplay(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float fromDisplay(float display)
{
    return display <= 0.04045f ? display / 12.92f : std::pow((display + 0.055f) / 1.055f, 2.4f);
}

size_t addKey(Json& ioKeys, double t)
{
    t = roundedKey(std::clamp(t, 0.0, 1.0));
    Json value = roundedKey(curveAt(ioKeys, t));
    if (ioKeys[0][1].is_array())
        value = Json::array({roundedKey(curveAt(ioKeys, t, 0)), roundedKey(curveAt(ioKeys, t, 1)),
                             roundedKey(curveAt(ioKeys, t, 2))});
    size_t index = 0;
    while (index < ioKeys.size() && ioKeys[index][0].get<double>() <= t)
        ++index;
    ioKeys.insert(ioKeys.begin() + std::ptrdiff_t(index), Json::array({t, value}));
    return index;
}

void removeKeys(Json& ioKeys, std::vector<size_t> selected)
{
    std::sort(selected.rbegin(), selected.rend());
    for (const size_t i : selected)
        if (i < ioKeys.size() && ioKeys.size() > 1)
            ioKeys.erase(i);
}

std::vector<std::string> curvePresetNames()
{
    return {"constant", "fade in", "fade out", "rise and fall", "ease in and out"};
}

Json curvePreset(const std::string& name, double low, double high)
{
    if (name == "fade in")
        return Json::array({{0, low}, {1, high}});
    if (name == "fade out")
        return Json::array({{0, high}, {1, low}});
    if (name == "rise and fall")
        return Json::array({{0, low}, {0.2, high}, {1, low}});
    if (name == "ease in and out") {
        Json keys = Json::array();
        for (int i = 0; i <= 8; ++i) {
            const double t = i / 8.0;
            keys.push_back(Json::array({t, roundedKey(low + (high - low) * t * t * (3.0 - 2.0 * t))}));
        }
        return keys;
    }
    return Json::array({{0, high}, {1, high}});
}

Json temperatureRamp(double coldest, double hottest, size_t count)
{
    Json keys = Json::array();
    for (size_t i = 0; i < count; ++i) {
        const double t = count > 1 ? double(i) / double(count - 1) : 0.0;
        const double kelvin = coldest + t * (hottest - coldest);
        const double red = planckRatio(612e-9, kelvin);
        const double blue = planckRatio(465e-9, kelvin);
        const double most = std::max({red, 1.0, blue});
        keys.push_back(Json::array(
            {roundedKey(t), {roundedKey(red / most), roundedKey(1.0 / most), roundedKey(blue / most)}}));
    }
    return keys;
}

} // namespace fx::editor
