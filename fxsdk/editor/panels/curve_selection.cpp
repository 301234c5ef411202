#include "fxsdk/editor/panels/curve_selection.h"

#include <algorithm>

namespace fx::editor {

namespace {

using Pointer = Json::json_pointer;

Json limitedProduct(const Json& value, double factor, const ShownCurve& curve)
{
    return roundedKey(std::clamp(value.get<double>() * factor, curve.least, curve.most));
}

} // namespace

std::vector<size_t> indicesOf(const std::vector<SelectedKey>& selected, const std::string& curve)
{
    std::vector<size_t> indices;
    for (const SelectedKey& key : selected)
        if (key.curve == curve)
            indices.push_back(key.index);
    return indices;
}

void moveTogether(std::vector<ShownCurve>& io, const std::vector<SelectedKey>& selected, double time,
                  double share)
{
    double least = -1.0, most = 1.0;
    for (const ShownCurve& curve : io) {
        const auto [back, forth] = freeWay(curve.keys, indicesOf(selected, curve.pointer));
        least = std::max(least, back);
        most = std::min(most, forth);
    }
    const double way = std::clamp(time, least, most);
    for (ShownCurve& curve : io)
        moveKeys(curve.keys, indicesOf(selected, curve.pointer), way, share * (curve.highest - curve.lowest),
                 curve.least, curve.most);
}

void scaleTogether(std::vector<ShownCurve>& io, const std::vector<SelectedKey>& selected, double factor)
{
    for (ShownCurve& curve : io)
        for (const size_t index : indicesOf(selected, curve.pointer)) {
            Json& value = curve.keys[index][1];
            if (value.is_number())
                value = limitedProduct(value, factor, curve);
            else
                for (Json& channel : value)
                    channel = limitedProduct(channel, factor, curve);
        }
}

void removeTogether(std::vector<ShownCurve>& io, const std::vector<SelectedKey>& selected)
{
    for (ShownCurve& curve : io)
        removeKeys(curve.keys, indicesOf(selected, curve.pointer));
}

base::Status setCurves(Document& io, const std::vector<ShownCurve>& curves, uint64_t gesture)
{
    std::vector<const ShownCurve*> changed;
    for (const ShownCurve& curve : curves) {
        const Pointer at(curve.pointer);
        if (!io.json().contains(at) || keysOf(io.json().at(at)) != curve.keys)
            changed.push_back(&curve);
    }
    const auto valueOf = [&](const ShownCurve& curve) {
        const Pointer at(curve.pointer);
        return curveOf(io.json().contains(at) ? io.json().at(at) : Json(), curve.keys);
    };
    if (changed.empty())
        return {};
    // A drag of several curves is one gesture of their object, also where only one of them has moved at
    // first.
    if (curves.size() == 1)
        return io.set(changed[0]->pointer, valueOf(*changed[0]), gesture);
    const Pointer parent = Pointer(changed[0]->pointer).parent_pointer();
    Json object = io.json().at(parent);
    for (const ShownCurve* const curve : changed)
        object[Pointer(curve->pointer).back()] = valueOf(*curve);
    return io.set(parent.to_string(), std::move(object), gesture);
}

} // namespace fx::editor
