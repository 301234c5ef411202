// The functions of fx_parameters.h: parameters of instances by name, type and value.
#include "fxsdk/api/context.h"
#include "fxsdk/api/parameter_limits.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/text.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_parameters.h"

#include "foundation/result/nearest_name.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace {

using fx::api::HostWorld;
using fx::base::Code;
using fx::base::Status;
using Values = std::array<float, 3>;

/// The parameters that every preset has. Numbers never change, because handles contain them.
enum class Parameter : uint32_t
{
    Intensity,
    Wind,
    Emitting,
    Tint,
    Speed,
};

struct ParameterRow
{
    const char* name;
    FxParameterType type;
    float minimum;
    float maximum;
    float standard; ///< default of each component
    const char* unit;
    bool isVelocity = false; ///< in units and axes of the host
};

constexpr std::array<ParameterRow, 5> kRows{
    {{"intensity", FX_PARAMETER_FLOAT, 0.0f, fx::api::kHighestIntensity, 1.0f, "1"},
     {"wind", FX_PARAMETER_FLOAT3, -fx::api::kStrongestWind, fx::api::kStrongestWind, 0.0f, "m/s", true},
     {"emitting", FX_PARAMETER_BOOL, 0.0f, 1.0f, 1.0f, "1"},
     {"tint", FX_PARAMETER_FLOAT3, 0.0f, fx::api::kHighestTint, 1.0f, "1"},
     {"speed", FX_PARAMETER_FLOAT, 0.0f, fx::api::kHighestSpeed, 1.0f, "1"}}};

/// Distinguishes handles from ids and from small numbers.
constexpr uint64_t kHandleTag = UINT64_C(0x50) << 56;

FxParameterId handleOf(size_t row)
{
    return {kHandleTag | (row + 1)};
}

const char* nameOf(FxParameterType type)
{
    switch (type) {
    case FX_PARAMETER_FLOAT:
        return "FX_PARAMETER_FLOAT";
    case FX_PARAMETER_FLOAT3:
        return "FX_PARAMETER_FLOAT3";
    case FX_PARAMETER_BOOL:
        return "FX_PARAMETER_BOOL";
    case FX_PARAMETER_TYPE_FORCE_32:
        break;
    }
    return "no type";
}

/// The row of a handle, if the parameter has this type.
Status findRow(FxParameterId parameter, FxParameterType type, size_t& outRow)
{
    const uint64_t number = parameter.bits & ~kHandleTag;
    if ((parameter.bits & kHandleTag) != kHandleTag || number == 0 || number > kRows.size())
        return {Code::StaleId, "parameter is no handle of fxFindParameter()"};
    outRow = size_t(number - 1);
    if (kRows[outRow].type != type)
        return fx::api::invalid("type is " + std::string(nameOf(type)) + ", but the parameter \"" +
                                kRows[outRow].name + "\" is of type " + nameOf(kRows[outRow].type));
    return {};
}

size_t componentsOf(FxParameterType type)
{
    return type == FX_PARAMETER_FLOAT3 ? 3 : 1;
}

float limitOf(const HostWorld& world, const ParameterRow& row, float limit)
{
    return row.isVelocity ? world.fromMeters(limit) : limit;
}

/// Reads and checks the value of a host.
Status readValue(const HostWorld& world, const ParameterRow& row, const void* value, Values& out)
{
    out = {};
    if (row.type == FX_PARAMETER_BOOL) {
        uint32_t flag = 0;
        std::memcpy(&flag, value, sizeof flag);
        fx::api::Checks check;
        check.flag(flag, row.name);
        out[0] = flag != 0 ? 1.0f : 0.0f;
        return check.status();
    }
    const size_t count = componentsOf(row.type);
    std::memcpy(out.data(), value, count * sizeof(float));
    fx::api::Checks check;
    for (size_t i = 0; i < count; ++i)
        check.range(out[i], limitOf(world, row, row.minimum), limitOf(world, row, row.maximum), row.name);
    if (row.isVelocity) {
        const glm::vec3 velocity = world.vector(out.data());
        out = {velocity.x, velocity.y, velocity.z};
    }
    return check.status();
}

void writeValue(const HostWorld& world, const ParameterRow& row, Values values, void* out)
{
    if (row.isVelocity)
        world.writeVector({values[0], values[1], values[2]}, values.data());
    if (row.type == FX_PARAMETER_BOOL) {
        const uint32_t flag = values[0] != 0.0f ? 1 : 0;
        std::memcpy(out, &flag, sizeof flag);
        return;
    }
    std::memcpy(out, values.data(), componentsOf(row.type) * sizeof(float));
}

void set(fx::scene::Scene& scene, fx::scene::LocalId id, Parameter parameter, const Values& values)
{
    fx::sim::InstanceParameters changed = scene.parameters(id);
    switch (parameter) {
    case Parameter::Intensity:
        changed.intensity = values[0];
        break;
    case Parameter::Wind:
        changed.wind = {values[0], values[1], values[2]};
        break;
    case Parameter::Emitting:
        changed.emitting = values[0] != 0.0f;
        break;
    case Parameter::Tint:
        changed.tint = {values[0], values[1], values[2]};
        break;
    case Parameter::Speed:
        return scene.setRate(id, fx::api::toRate(values[0]));
    }
    scene.setParameters(id, changed);
}

Values get(fx::scene::Scene& scene, fx::scene::LocalId id, Parameter parameter)
{
    const fx::sim::InstanceParameters& now = scene.parameters(id);
    switch (parameter) {
    case Parameter::Intensity:
        return {now.intensity};
    case Parameter::Wind:
        return {now.wind.x, now.wind.y, now.wind.z};
    case Parameter::Emitting:
        return {now.emitting ? 1.0f : 0.0f};
    case Parameter::Tint:
        return {now.tint.x, now.tint.y, now.tint.z};
    case Parameter::Speed:
        break;
    }
    return {float(scene.rate(id)) / float(fx::sim::kNormalRate)};
}

} // namespace

FxResult fxFindParameter(FxContext* context, FxPresetId preset, const char* name, FxParameterId* outParameter)
{
    return fx::api::guarded("fxFindParameter", fx::api::logOf(context), [&]() -> Status {
        fx::api::Checks check;
        check.notNull(context, "context");
        check.notNull(name, "name");
        check.notNull(outParameter, "outParameter");
        if (!check.status())
            return check.status();
        if (const auto effect = context->findPreset(preset); !effect)
            return effect.status();
        std::array<std::string, kRows.size()> names;
        std::transform(kRows.begin(), kRows.end(), names.begin(),
                       [](const ParameterRow& row) { return row.name; });
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            return {Code::NotFound, "the preset has no parameter \"" + std::string(name) + "\"" +
                                        fx::base::didYouMean(name, names)};
        *outParameter = handleOf(size_t(found - names.begin()));
        return {};
    });
}

FxResult fxGetParameterInfo(FxContext* context, FxPresetId preset, uint32_t index, FxParameterInfo* ioInfo)
{
    return fx::api::guarded("fxGetParameterInfo", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        if (const auto effect = context->findPreset(preset); !effect)
            return effect.status();
        if (index >= kRows.size())
            return fx::api::invalid("the preset has " + std::to_string(kRows.size()) +
                                    " parameters, and none of this index");
        const ParameterRow& row = kRows[index];
        FxParameterInfo info{};
        info.type = uint32_t(row.type);
        info.parameter = handleOf(index);
        info.count = uint32_t(kRows.size());
        info.minimum = limitOf(context->world, row, row.minimum);
        info.maximum = limitOf(context->world, row, row.maximum);
        std::fill_n(info.defaultValue, componentsOf(row.type), row.standard);
        fx::api::copyText(row.name, info.name, sizeof info.name);
        fx::api::copyText(row.unit, info.unit, sizeof info.unit);
        return fx::api::writeStruct(info, ioInfo, "ioInfo");
    });
}

FxResult fxScene_SetParameter(FxScene* scene, FxInstanceId instance, FxParameterId parameter,
                              FxParameterType type, const void* value)
{
    return fx::api::withInstance(
        "fxScene_SetParameter", scene, instance, [&](fx::scene::LocalId id) -> Status {
            if (!value)
                return fx::api::invalid("value is null");
            size_t row = 0;
            if (Status status = findRow(parameter, type, row); !status)
                return status;
            Values values;
            if (Status status = readValue(scene->context->world, kRows[row], value, values); !status)
                return status;
            set(scene->scene, id, Parameter(row), values);
            return {};
        });
}

FxResult fxScene_GetParameter(FxScene* scene, FxInstanceId instance, FxParameterId parameter,
                              FxParameterType type, void* outValue)
{
    return fx::api::withInstance(
        "fxScene_GetParameter", scene, instance, [&](fx::scene::LocalId id) -> Status {
            if (!outValue)
                return fx::api::invalid("outValue is null");
            size_t row = 0;
            if (Status status = findRow(parameter, type, row); !status)
                return status;
            writeValue(scene->context->world, kRows[row], get(scene->scene, id, Parameter(row)), outValue);
            return {};
        });
}
