/// @file curve_selection.h
/// Keys of several curves of one object that are selected and changed together.
#pragma once

#include "fxsdk/editor/document/document.h"
#include "fxsdk/editor/panels/curve_keys.h"

#include <string>
#include <vector>

namespace fx::editor {

/// A key of one of several curves.
struct SelectedKey
{
    std::string curve; ///< JSON pointer
    size_t index = 0;

    bool operator==(const SelectedKey&) const = default;
};

/// A curve that is shown, on a scale of its own.
struct ShownCurve
{
    std::string pointer; ///< JSON pointer of the member
    Json keys;
    double lowest = 0.0;  ///< value at the lower edge of the scale
    double highest = 1.0; ///< value at the upper edge, above `lowest`
    double least = -1e9;  ///< smallest value that the member allows
    double most = 1e9;    ///< largest one

    bool isColor() const { return keys[0][1].is_array(); }
};

/// Indices of the selected keys of one curve.
std::vector<size_t> indicesOf(const std::vector<SelectedKey>& selected, const std::string& curve);

/// Moves the selected keys of all curves by the same time, as far as all of them can go, and by the same
/// share of the height of their scales.
void moveTogether(std::vector<ShownCurve>& io, const std::vector<SelectedKey>& selected, double time,
                  double share);

/// Multiplies the values of the selected keys, of colors too.
void scaleTogether(std::vector<ShownCurve>& io, const std::vector<SelectedKey>& selected, double factor);

/// Removes the selected keys; of each curve the last one stays.
void removeTogether(std::vector<ShownCurve>& io, const std::vector<SelectedKey>& selected);

/// Writes the curves whose keys differ from those of the document, as one edit.
/// @param curves of one object of the document
/// @param gesture not 0: joins the edit with the last one of this number
base::Status setCurves(Document& io, const std::vector<ShownCurve>& curves, uint64_t gesture);

} // namespace fx::editor
