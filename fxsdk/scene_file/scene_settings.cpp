#include "fxsdk/scene_file/scene_members.h"
#include "rendering/frame/composition_names.h"

#include "foundation/math/euler.h"
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>

namespace fx::scene_file {

namespace {

using preset::PresetValue;

constexpr std::array<std::pair<std::string_view, render::BillboardForm>, 3> kForms{{
    {"planar", render::BillboardForm::Planar},
    {"constant", render::BillboardForm::Constant},
    {"kernel", render::BillboardForm::Kernel},
}};

enum class Scattering
{
    Off,
    ClosedForm,
    Network,
    Automatic, ///< as the presets say
};
constexpr std::array<std::pair<std::string_view, Scattering>, 4> kScatterings{{
    {"off", Scattering::Off},
    {"closed_form", Scattering::ClosedForm},
    {"network", Scattering::Network},
    {"automatic", Scattering::Automatic},
}};

enum class LightType
{
    Point,
    Ball,
    Spot
};

constexpr std::array<std::pair<std::string_view, LightType>, 3> kLightTypes{{
    {"point", LightType::Point},
    {"ball", LightType::Ball},
    {"spot", LightType::Spot},
}};

/// The picture needs a direction to look in, and an up that is not along it.
void checkPose(const PresetValue& value, const glm::dvec3& position, const glm::dvec3& target,
               const glm::vec3& up)
{
    const glm::dvec3 forward = target - position;
    if (glm::length(up) < 1e-6f)
        return; // said of the camera itself
    if (glm::length(forward) < 1e-6)
        value.error("target", "found the same place as position; allowed is any other");
    else if (glm::length(glm::cross(glm::normalize(forward), glm::dvec3(up))) < 1e-4)
        value.error("target", "found a direction of view along the camera's \"up\"; allowed is any other");
}

void readUnitVector(const PresetValue& value, const char* name, glm::vec3& io)
{
    value.read(name, io);
    const float length = glm::length(io);
    if (length < 1e-6f)
        value.error(name, "found a direction of length 0; allowed is any other");
    else
        io /= length;
}

render::Lighting readLighting(const PresetValue& value)
{
    render::Lighting lighting;
    readUnitVector(value, "sunDirection", lighting.sunDirection);
    value.read("sunIlluminance", lighting.sunIlluminance);
    value.read("skyLuminance", lighting.skyLuminance);
    value.read("groundAlbedo", lighting.groundAlbedo);
    return lighting;
}

void readCone(const PresetValue& value, render::SceneLight& io)
{
    float inner = 20.0f, outer = 30.0f; // [degree]
    value.read("innerDegrees", inner);
    value.read("outerDegrees", outer);
    if (outer < inner)
        value.error("outerDegrees", "found an angle below innerDegrees; allowed is at least that");
    io.innerAngle = glm::radians(inner);
    io.outerAngle = glm::radians(outer);
    readUnitVector(value, "direction", io.direction);
}

render::DazzleSettings readDazzle(const PresetValue& value)
{
    render::DazzleSettings dazzle;
    value.read("enabled", dazzle.enabled);
    value.read("white", dazzle.white);
    value.read("a", dazzle.a);
    value.read("b", dazzle.b);
    value.read("c", dazzle.c);
    value.read("riseTime", dazzle.riseTime);
    value.read("fallTime", dazzle.fallTime);
    // f(over) = over (a + b exp(-c over)) has f' = a + b (1 - c over) exp(-c over), least at c over = 2 for b
    // > 0 and at over = 0 for b < 0
    const bool isMonotone = dazzle.b > 0 ? dazzle.a >= dazzle.b * std::exp(-2.0f) : dazzle.a >= -dazzle.b;
    if (!isMonotone)
        value.error("b", "found a law that is not monotone: more light would give less glare; allowed is "
                         "-a <= b <= 7.389 a");
    return dazzle;
}

/// Rotation about x, then y, then z, or as a quaternion.
glm::quat readRotation(const PresetValue& value)
{
    if (value.has("quaternion") && value.has("rotationDegrees"))
        value.error("quaternion", "found both quaternion and rotationDegrees; allowed is one of them");
    std::array<float, 4> q{0, 0, 0, 1};
    if (value.has("quaternion")) {
        value.read("quaternion", q);
        const glm::quat rotation(q[3], q[0], q[1], q[2]);
        if (glm::length(rotation) > 1e-6f)
            return glm::normalize(rotation);
        value.error("quaternion", "found length 0; allowed is any other");
    }
    glm::dvec3 degrees(0.0);
    value.read("rotationDegrees", degrees);
    return base::rotationOf(degrees);
}

} // namespace

CameraPath readCamera(const PresetValue& value)
{
    CameraPath camera;
    value.read("position", camera.position);
    value.read("target", camera.target);
    value.read("up", camera.up);
    value.read("fovYDegrees", camera.fovYDegrees);
    value.read("orthographicHeight", camera.orthographicHeight);
    value.read("near", camera.nearPlane);
    if (value.has("fovYDegrees") && value.has("orthographicHeight"))
        value.error("orthographicHeight",
                    "found both fovYDegrees and orthographicHeight; allowed is one of them");
    if (glm::length(camera.up) < 1e-6f)
        value.error("up", "found length 0; allowed is any other");
    else
        camera.up = glm::normalize(camera.up);
    for (size_t i = 0; i < value.size("keys"); ++i) {
        const PresetValue element = value.element("keys", i);
        CameraKey key;
        element.read("time", key.time);
        element.read("position", key.position);
        element.read("target", key.target);
        if (i > 0 && key.time <= camera.keys.back().time)
            element.error("time", "found a time that is not later than that of the key before");
        checkPose(element, key.position, key.target, camera.up);
        camera.keys.push_back(key);
    }
    if (camera.keys.empty())
        checkPose(value, camera.position, camera.target, camera.up);
    return camera;
}

render::SceneLight readLight(const PresetValue& value)
{
    render::SceneLight light;
    LightType type = LightType::Point;
    value.read("type", std::span<const std::pair<std::string_view, LightType>>(kLightTypes), type);
    value.read("position", light.position);
    value.read("intensity", light.intensity);
    if (type == LightType::Ball) {
        light.radius = 0.1f;
        value.read("radius", light.radius);
    } else if (value.has("radius")) {
        value.warning("radius", "found a radius, but only a light of the type \"ball\" has one");
    }
    if (type == LightType::Spot)
        readCone(value, light);
    else
        for (const char* member : {"direction", "innerDegrees", "outerDegrees"})
            if (value.has(member))
                value.warning(member,
                              "found a member of a cone, but only a light of the type \"spot\" has one");
    return light;
}

render::ViewSettings readView(const PresetValue& root)
{
    render::ViewSettings view;
    root.read("exposureEv100", view.exposureEv100);
    view.lighting = readLighting(root.child("lighting"));
    const PresetValue shimmer = root.child("shimmer");
    shimmer.read("strength", view.shimmer.strength);
    shimmer.read("maxOffset", view.shimmer.maxOffset);
    view.dazzle = readDazzle(root.child("dazzle"));
    root.read("form", std::span<const std::pair<std::string_view, render::BillboardForm>>(kForms), view.form);
    root.read("composition",
              std::span<const std::pair<std::string_view, render::Composition>>(render::kCompositionNames),
              view.composition);
    uint32_t slabs = uint32_t(view.slabs);
    root.read("slabs", slabs);
    view.slabs = int(slabs);
    uint32_t voxels = uint32_t(view.voxels);
    root.read("voxels", voxels);
    view.voxels = int(voxels);
    Scattering scattering = Scattering::ClosedForm;
    root.read("scattering", std::span<const std::pair<std::string_view, Scattering>>(kScatterings),
              scattering);
    view.slices.multiple = scattering != Scattering::Off;
    view.slices.network = scattering == Scattering::Network;
    view.slices.automatic = scattering == Scattering::Automatic;
    root.read("detail", view.detail);
    root.read("toneMap", view.toneMap);
    return view;
}

SceneInstance readInstance(const PresetValue& value)
{
    SceneInstance instance;
    value.read("position", instance.position);
    instance.rotation = readRotation(value);
    value.read("scale", instance.scale);
    value.read("seed", instance.seed);
    value.read("start", instance.start);
    value.read("intensity", instance.parameters.intensity);
    value.read("wind", instance.parameters.wind);
    value.read("tint", instance.parameters.tint);
    double layer = 0.0, sortKey = 0.0; // integers, by the schema
    value.read("layer", layer);
    value.read("sortKey", sortKey);
    instance.layer = int32_t(layer);
    instance.sortKey = int32_t(sortKey);
    instance.play = readPlay(value, instance.start);
    return instance;
}

} // namespace fx::scene_file
