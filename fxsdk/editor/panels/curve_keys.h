/// @file curve_keys.h
/// Keys of curves and gradients of presets: {"keys": [[t, value], ...]} with t from 0 to 1.
#pragma once

#include "fxsdk/editor/document/json_writer.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace fx::editor {

/// Whether a value is a constant, or has keys that all are numbers, or all are colors. The functions below
/// need that.
bool isCurve(const Json& value);

/// Returns the keys of a member of the kind curve or color curve; a constant has one key at 0.
Json keysOf(const Json& value);

/// Returns `value` with other keys. Other members of it are kept.
Json curveOf(const Json& value, Json keys);

/// Interpolated number, or channel of a color, at `t`. @param channel 0 to 2; ignored for numbers
double curveAt(const Json& keys, double t, size_t channel = 0);

/// How far the keys `selected` can move together, backwards (<= 0) and forwards (>= 0): none passes a key
/// that is not moved.
std::pair<double, double> freeWay(const Json& keys, const std::vector<size_t>& selected);

/// A number of a key: six significant digits, what is dragged needs no more.
double roundedKey(double value);

/// Moves the keys `selected` together. They keep their order: none passes a key that is not moved.
/// @param lowest, highest limits of values
void moveKeys(Json& ioKeys, const std::vector<size_t>& selected, double time, double value, double lowest,
              double highest);

/// Way of keys that are dragged.
struct KeyMove
{
    double time = 0.0;
    double value = 0.0;
};

/// The nearest way that brings a key to a multiple of 1/20 of the time, and to a round value: steps of 1, 2
/// or 5 times a power of ten, of at most 1/20 of the range.
/// @param range of the values that are shown, > 0
KeyMove snapped(const Json& key, KeyMove move, double range);

/// A channel of a linear color as a value of sRGB, and back; beyond 0 to 1 too.
float toDisplay(float linear);
float fromDisplay(float display);

/// Adds a key at `t` on the curve. @return its index
size_t addKey(Json& ioKeys, double t);

/// Removes keys; the last one stays.
void removeKeys(Json& ioKeys, std::vector<size_t> selected);

/// Curves to begin with: "constant", "fade in", "fade out", "rise and fall", "ease in and out".
std::vector<std::string> curvePresetNames();
Json curvePreset(const std::string& name, double low, double high);

/// Colors of a black body from `coldest` to `hottest` [K], relative to the brightest channel.
Json temperatureRamp(double coldest, double hottest, size_t count);

} // namespace fx::editor
