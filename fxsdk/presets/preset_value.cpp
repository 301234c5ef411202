#include "fxsdk/presets/preset_value.h"

#include "fxsdk/assets/asset_loader.h"

#include <nlohmann/json.hpp>

#include <array>
#include <vector>

namespace fx::preset {

namespace {

using Json = nlohmann::json;

template <size_t N>
std::array<float, N> components(const Json& value)
{
    std::array<float, N> result{};
    for (size_t i = 0; i < N; ++i)
        result[i] = (value.is_array() ? value[i] : value).template get<float>();
    return result;
}

} // namespace

const nlohmann::json* PresetValue::find(const char* member) const
{
    if (!object_)
        return nullptr;
    const auto found = object_->find(member);
    return found == object_->end() ? nullptr : &*found;
}

bool PresetValue::has(const char* member) const
{
    return find(member) != nullptr;
}

void PresetValue::read(const char* member, float& out) const
{
    if (const Json* value = find(member))
        out = value->get<float>();
}

void PresetValue::read(const char* member, double& out) const
{
    if (const Json* value = find(member))
        out = value->get<double>();
}

void PresetValue::read(const char* member, uint32_t& out) const
{
    if (const Json* value = find(member))
        out = value->get<uint32_t>();
}

void PresetValue::read(const char* member, uint64_t& out) const
{
    if (const Json* value = find(member))
        out = value->get<uint64_t>();
}

void PresetValue::read(const char* member, bool& out) const
{
    if (const Json* value = find(member))
        out = value->get<bool>();
}

void PresetValue::read(const char* member, std::string& out) const
{
    if (const Json* value = find(member))
        out = value->get<std::string>();
}

void PresetValue::read(const char* member, glm::vec3& out) const
{
    if (const Json* value = find(member)) {
        const std::array<float, 3> xyz = components<3>(*value);
        out = {xyz[0], xyz[1], xyz[2]};
    }
}

void PresetValue::read(const char* member, glm::dvec3& out) const
{
    if (const Json* value = find(member))
        out = {(*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>()};
}

void PresetValue::read(const char* member, std::array<float, 4>& out) const
{
    if (const Json* value = find(member))
        out = components<4>(*value);
}

void PresetValue::read(const char* member, base::Range& out) const
{
    const Json* const value = find(member);
    if (!value)
        return;
    if (!value->is_object()) {
        out = {value->get<float>(), value->get<float>()};
        return;
    }
    out = {(*value)["min"].get<float>(), (*value)["max"].get<float>()};
    if (out.min > out.max)
        error(member, "found min " + (*value)["min"].dump() + " above max " + (*value)["max"].dump() +
                          "; allowed is min <= max");
}

template <size_t N>
void PresetValue::readCurve(const char* member, base::Curve<N>& out) const
{
    const Json* const value = find(member);
    if (!value)
        return;
    if (!value->is_object()) {
        out = base::Curve<N>(components<N>(*value));
        return;
    }
    std::vector<base::CurveKey<N>> keys;
    for (const Json& key : (*value)["keys"]) {
        keys.push_back({key[0].get<float>(), components<N>(key[1])});
        if (keys.size() > 1 && keys[keys.size() - 2].t > keys.back().t) {
            error((std::string(member) + "/keys/" + std::to_string(keys.size() - 1)).c_str(),
                  "found t = " + key[0].dump() + " after a later key; allowed are keys with rising t");
            return;
        }
    }
    out = base::Curve<N>(std::span<const base::CurveKey<N>>(keys));
}

void PresetValue::read(const char* member, base::ScalarCurve& out) const
{
    readCurve(member, out);
}

void PresetValue::read(const char* member, base::ColorCurve& out) const
{
    readCurve(member, out);
}

std::vector<std::pair<double, double>> PresetValue::steps(const char* member) const
{
    const auto number = [](const Json& value) {
        return value.is_boolean() ? double(value.get<bool>()) : value.get<double>();
    };
    const Json* const value = find(member);
    std::vector<std::pair<double, double>> steps;
    if (value && !value->is_object())
        steps.emplace_back(0.0, number(*value));
    if (value && value->is_object())
        for (const Json& step : (*value)["steps"])
            steps.emplace_back(step[0].get<double>(), number(step[1]));
    return steps;
}

PresetValue PresetValue::child(const char* member) const
{
    return {find(member), pointer_ + "/" + member, findings_};
}

size_t PresetValue::size(const char* member) const
{
    const Json* const value = find(member);
    return value ? value->size() : 0;
}

PresetValue PresetValue::element(const char* member, size_t index) const
{
    return {&(*find(member))[index], pointer_ + "/" + member + "/" + std::to_string(index), findings_};
}

void PresetValue::readElement(const char* member, size_t index, glm::vec3& out) const
{
    const std::array<float, 3> xyz = components<3>((*find(member))[index]);
    out = {xyz[0], xyz[1], xyz[2]};
}

base::Result<std::string> PresetValue::readAsset(const char* member, uint64_t maxBytes) const
{
    std::string name;
    read(member, name);
    if (name.empty())
        return base::Status(base::Code::NotFound, "found no file; this needs one");
    if (!findings_.assets())
        return base::Status(base::Code::NotFound, "cannot read " + name + ": this document has no files");
    return findings_.assets()->read(name, maxBytes);
}

void PresetValue::error(const char* member, std::string message) const
{
    findings_.error(pointer_ + (*member ? "/" : "") + member, std::move(message));
}

void PresetValue::warning(const char* member, std::string message) const
{
    findings_.warning(pointer_ + (*member ? "/" : "") + member, std::move(message));
}

} // namespace fx::preset
